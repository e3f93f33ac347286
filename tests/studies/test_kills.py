# SPDX-License-Identifier: BSD-3-Clause
"""Workers and studies that are stopped or killed: no finished case is lost."""

import csv
import os
import random
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest
from journals import rows_in

import pyehl
from pyehl.studies import pool
from pyehl.studies import tasks as tasks_module
from pyehl.studies.journal import Journal
from pyehl.studies.tasks import FAILED, Task, execute

SWEEP = [sys.executable, "-P", "-m", "pyehl", "sweep"]
FAST = ("--set", "grid.points=33", "--vary", "contact.moes_m=20:60:10")


def table(folder: Path) -> list[dict[str, str]]:
    with (folder / "results.csv").open(newline="") as stream:
        return list(csv.DictReader(stream))


def test_a_failing_case_does_not_stop_the_rest():
    good = pyehl.Case.from_text("", ["grid.points=17"]).text
    bad = good.replace("points = 17", "points = 18")
    row = execute(Task(0, bad, "solve"))
    assert row["status"] == FAILED
    assert "points" in row["message"]
    tasks = [Task(n, good if n % 2 else bad, "solve") for n in range(4)]
    rows = dict(row for some in pool.rows(tasks, 2) for row in some)
    assert [rows[n]["status"] == FAILED for n in range(4)] == [True, False, True, False]


def test_a_fault_of_the_program_keeps_its_traceback(monkeypatch: pytest.MonkeyPatch):
    """The journal contains the lines of the source; the table only the message."""

    def broken(task: Task) -> dict[str, object]:
        raise ZeroDivisionError("no such thing")

    monkeypatch.setitem(tasks_module.RUNNERS, "film", broken)
    row = execute(Task(0, "", "film"))
    assert row["message"] == "ZeroDivisionError: no such thing"
    assert "in broken" in row["traceback"]
    # an invalid case is no such fault
    bad = pyehl.Case.from_text("").text.replace("points = 513", "points = 514")
    assert "traceback" not in execute(Task(0, bad, "solve"))


def test_a_task_that_ends_its_worker_is_a_row(monkeypatch: pytest.MonkeyPatch):
    """The task also ends a second worker, and all other tasks are done."""
    real = pool.execute_all

    def deadly(tasks: list[Task], folder: str) -> list[dict[str, object]]:
        if any(task.number == 1 for task in tasks):
            os.abort()
        return real(tasks, folder)

    monkeypatch.setattr(pool, "execute_all", deadly)
    text = pyehl.Case.from_text("").text
    tasks = [Task(n, text, "film") for n in range(5)]
    rows = dict(row for some in pool.rows(tasks, 2) for row in some)
    assert sorted(rows) == [0, 1, 2, 3, 4]
    assert rows[1]["status"] == FAILED
    assert "died 2 times, at last by SIGABRT" in rows[1]["message"]
    assert all(rows[n]["h_c_m"] > 0.0 for n in (0, 2, 3, 4))


def runs(process: int) -> bool:
    with suppress(ProcessLookupError):
        os.kill(process, 0)
        return True
    return False


def test_a_worker_waits_for_the_next_study_and_ends(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
):
    """It is used again within its lifetime; after that a new one is made, whose death is noticed.

    It works in the folder of the study that uses it.
    """
    real = pool.execute_all

    def deadly(tasks: list[Task], folder: str) -> list[dict[str, object]]:
        real([], folder)
        if tasks[0].number == 1:
            os.abort()
        return [{"process": os.getpid(), "folder": os.getcwd()} for _ in tasks]

    def process(number: int) -> object:
        ((_, row),) = (row for some in pool.rows([Task(number, "", "film")], 1) for row in some)
        assert row.get("folder", os.getcwd()) == os.getcwd()
        return row.get("process", row.get("status"))

    monkeypatch.setattr(pool, "execute_all", deadly)
    monkeypatch.setattr(pool, "IDLE_TIMEOUT", 1.0)
    first = process(0)
    assert isinstance(first, int)
    monkeypatch.chdir(tmp_path)
    assert process(2) == first
    end = time.monotonic() + 30.0
    while runs(first):
        assert time.monotonic() < end, "the worker has not ended"
        time.sleep(0.05)
    assert process(1) == FAILED
    assert process(0) != first


def test_long_tasks_first_and_sharing_tasks_together():
    tasks = [Task(n, "", "solve", seconds=float(n % 3), shares=f"s{n % 3}") for n in range(9)]
    waiting = pool.Queue(tasks)
    (one,), (other,) = waiting.take(""), waiting.take("")
    assert (one.seconds, other.seconds) == (2.0, 1.0)
    (same,) = waiting.take(one.shares)
    assert same.shares == one.shares
    waiting.put_back([one])
    left = []
    while some := waiting.take(""):
        left += [task.number for task in some]
    assert sorted(left) == sorted({*range(9)} - {other.number, same.number})


def test_short_tasks_share_a_worker_until_it_dies():
    waiting = pool.Queue([Task(n, "", "film", seconds=0.03) for n in range(9)])
    some = waiting.take("")
    assert [task.number for task in some] == [0, 1, 2, 3]
    waiting.put_back(some)
    assert [len(waiting.take("")) for _ in range(6)] == [1, 1, 1, 1, 4, 1]
    assert waiting.take("") == []


def begin(folder: Path, case: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [*SWEEP, str(case), *FAST, "--vary", "contact.moes_l=1:9:20", "-o", str(folder)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def finish(folder: Path, case: Path) -> None:
    process = begin(folder, case)
    reported, complaint = process.communicate(timeout=300)
    assert process.returncode == 0, reported + complaint


def children(process: subprocess.Popen[str]) -> list[int]:
    path = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    return [int(word) for word in path.read_text().split()] if path.is_file() else []


def wait_for_rows(folder: Path, count: int) -> None:
    end = time.monotonic() + 60.0
    while time.monotonic() < end:
        if len(rows_in(folder)) >= count:
            return
        time.sleep(0.01)
    raise AssertionError(f"there are no {count} rows")


def check_whole(folder: Path, unbroken: Path) -> None:
    """Every case once, with the numbers of an uninterrupted study."""
    assert list(rows_in(folder)) == list(range(200))
    for a, b in zip(table(folder), table(unbroken), strict=True):
        assert {k: v for k, v in a.items() if k != "seconds"} == {
            k: v for k, v in b.items() if k != "seconds"
        }


@pytest.fixture(scope="module")
def unbroken(cases: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("unbroken") / "out"
    finish(folder, cases / "quick.nml")
    return folder


@pytest.mark.long
def test_ctrl_c_keeps_all_finished_rows(cases: Path, tmp_path: Path, unbroken: Path):
    folder = tmp_path / "out"
    process = begin(folder, cases / "quick.nml")
    wait_for_rows(folder, 3)
    process.send_signal(signal.SIGINT)
    reported, complaint = process.communicate(timeout=60)
    assert process.returncode == 130, reported + complaint
    assert "the same command resumes it" in complaint
    finished = rows_in(folder)
    assert 3 <= len(finished) < 200
    assert len(table(folder)) == len(finished)
    finish(folder, cases / "quick.nml")
    check_whole(folder, unbroken)


def test_a_row_written_at_the_instant_of_ctrl_c_is_in_the_table(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    real = Journal.append

    def interrupted(journal: Journal, rows: list[tuple[int, dict[str, object]]]) -> None:
        known, journal.rows = journal.rows, {}
        real(journal, rows)
        journal.rows = known
        raise KeyboardInterrupt

    monkeypatch.setattr(Journal, "append", interrupted)
    with pytest.raises(KeyboardInterrupt):
        pyehl.sweep(
            pyehl.Case.from_text(""),
            {"contact.moes_m": [100.0, 200.0]},
            run="film",
            output=tmp_path / "out",
            jobs=1,
        )
    assert len(table(tmp_path / "out")) == len(rows_in(tmp_path / "out")) > 0


def test_a_kill_leaves_no_workers_behind(cases: Path, tmp_path: Path):
    process = begin(tmp_path / "out", cases / "quick.nml")
    wait_for_rows(tmp_path / "out", 2)
    workers = children(process)
    assert workers
    process.kill()
    process.communicate()
    end = time.monotonic() + 20.0
    while any(alive(worker) for worker in workers) and time.monotonic() < end:
        time.sleep(0.05)
    assert not [worker for worker in workers if alive(worker)]


def alive(number: int) -> bool:
    try:
        os.kill(number, 0)
        state = Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0]
    except (ProcessLookupError, FileNotFoundError):
        return False
    return state != "Z"


@pytest.mark.slow
def test_killed_at_random_it_has_every_finished_row(cases: Path, tmp_path: Path, unbroken: Path):
    """At least twenty kills by SIGKILL, from before the first row to near the last."""
    folder = tmp_path / "out"
    draw = random.Random(5)
    kills = 0
    before: dict[int, dict[str, object]] = {}
    while kills < 24:
        process = begin(folder, cases / "quick.nml")
        # most kills while rows are written; the others at random times
        if kills % 4:
            wait_for_rows(folder, min(len(before) + draw.randint(0, 6), 199))
        time.sleep(draw.uniform(0.0, 0.02 if kills % 4 else 1.2))
        process.kill()
        process.communicate()
        if process.returncode != -signal.SIGKILL:
            break
        kills += 1
        now = rows_in(folder)
        assert {number: now[number] for number in before} == before
        before = now
    assert kills >= 20
    assert len(before) >= 50
    finish(folder, cases / "quick.nml")
    check_whole(folder, unbroken)
