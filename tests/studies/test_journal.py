# SPDX-License-Identifier: BSD-3-Clause
"""The journal of a study: rows are kept, whatever happens to process or file."""

import re
import resource
import shutil
import sqlite3
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import pytest

from pyehl import Case, FileError, InputError
from pyehl.results import load
from pyehl.studies.journal import FILES, NAME, Journal, difference, read_header

WAL = FILES[1]
STUDY = {"run": "film", "vary": {"contact.load": [1.0, 2.0]}}


def rows_of(folder: Path) -> dict[int, dict[str, object]]:
    with Journal(folder, STUDY) as journal:
        return dict(journal.rows)


def test_rows_come_back(tmp_path: Path):
    with Journal(tmp_path, STUDY) as journal:
        journal.append([(0, {"x": 0.1 + 0.2}), (2, {"x": None, "status": "failed"})])
        journal.append([(1, {"x": 1e-300, "message": 'two\nlines, "quoted" µ'})])
        reported = dict(journal.rows)
    assert rows_of(tmp_path) == reported
    assert reported[0]["x"] == 0.1 + 0.2


def test_killed_anywhere_it_has_all_rows_before(tmp_path: Path):
    """A kill after the last transaction leaves some initial part of the next one."""
    whole = tmp_path / "whole"
    with Journal(whole, STUDY) as journal:
        sizes = []
        for number in range(4):
            journal.append([(number, {"x": float(number)})])
            sizes.append((whole / WAL).stat().st_size)
        shutil.copytree(whole, tmp_path / "killed")
    data = (tmp_path / "killed" / WAL).read_bytes()
    for length in range(0, len(data) + 1, 509):
        cut = tmp_path / "cut"
        shutil.copytree(tmp_path / "killed", cut)
        (cut / WAL).write_bytes(data[:length])
        complete = sum(size <= length for size in sizes)
        assert rows_of(cut) == {n: {"x": float(n)} for n in range(complete)}
        # and it can be resumed
        with Journal(cut, STUDY) as journal:
            journal.append([(9, {"x": 9.0})])
        assert list(rows_of(cut)) == [*range(complete), 9]
        shutil.rmtree(cut)


@pytest.mark.parametrize("damage", [b"all of my thesis\n" * 300, None])
def test_foreign_journals_are_refused_and_unchanged(tmp_path: Path, damage: bytes | None):
    """A text, or a database of another program, of the same name."""
    path = tmp_path / NAME
    if damage is None:
        with closing(sqlite3.connect(path)) as base:
            base.execute("CREATE TABLE songs (name TEXT)")
    else:
        path.write_bytes(damage)
    before = path.read_bytes()
    with pytest.raises(InputError, match=r"journal\.sqlite: (no journal|not a journal)"):
        Journal(tmp_path, STUDY)
    assert path.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == [NAME]
    assert read_header(tmp_path) is None


def test_another_study_is_refused_with_the_difference(tmp_path: Path):
    Journal(tmp_path, STUDY).close()
    other = {"run": "solve", "vary": {"contact.load": [1.0, 2.0], "surface.seed": [1]}}
    with pytest.raises(InputError) as refusal:
        Journal(tmp_path, other)
    text = str(refusal.value)
    assert "run: there film, here solve" in text
    assert "vary.surface.seed: there nothing, here [1]" in text
    assert "contact.load" not in text
    assert rows_of(tmp_path) == {}


def test_many_differences_are_counted(tmp_path: Path):
    """A study of another command differs in every key."""
    with Journal(tmp_path, {f"key{k}": 1 for k in range(30)}):
        pass
    with pytest.raises(InputError) as caught, Journal(tmp_path, STUDY):
        pass
    lines = str(caught.value).splitlines()
    assert len(lines) < 18
    assert lines[-2].endswith("more")
    assert lines[-1] == "expected: another folder"
    with pytest.raises(InputError, match=r"not a result folder of one case \(of a study"):
        load(tmp_path)


def test_equal_studies_have_no_difference():
    assert difference(STUDY, dict(STUDY)) == []


def test_two_processes_do_not_write_one_journal(tmp_path: Path):
    """The message to the second one names the other; the study itself can be read."""
    code = (
        "import sys, json; from pyehl.studies.journal import Journal\n"
        f"with Journal({str(tmp_path)!r}, {STUDY!r}) as journal:\n"
        "    print('begun', flush=True); sys.stdin.read()"
    )
    words = [sys.executable, "-P", "-c", code]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == b"begun\n"
        with pytest.raises(InputError, match=f"process {other.pid} on .* is running this study"):
            Journal(tmp_path, STUDY)
        assert read_header(tmp_path) == STUDY
        other.kill()
    # a lock ends with its process, however that ends
    assert rows_of(tmp_path) == {}


def test_other_folders_are_left_alone(tmp_path: Path):
    (tmp_path / "thesis.txt").write_text("all of it")
    with pytest.raises(InputError, match=r"thesis\.txt"):
        Journal(tmp_path, STUDY)
    assert [p.name for p in tmp_path.iterdir()] == ["thesis.txt"]
    with pytest.raises(InputError, match="not a folder"):
        Journal(tmp_path / "thesis.txt", STUDY)


def test_first_starts_at_once_lose_nothing(tmp_path: Path):
    """Rows after `append` returned are kept, whichever is first; the others are refused."""
    starts = 4
    lost, refused = [], 0
    with ThreadPoolExecutor(starts) as pool:
        for n in range(50):
            folder, barrier = tmp_path / str(n), threading.Barrier(starts)

            def start(number: int, folder: Path = folder, barrier: threading.Barrier = barrier):
                barrier.wait()
                try:
                    with Journal(folder, STUDY) as journal:
                        journal.append([(number, {"x": number})])
                except InputError as error:
                    return str(error)
                return number

            result = list(pool.map(start, range(starts)))
            words = {text for text in result if isinstance(text, str)}
            assert all(
                re.fullmatch(f"{folder}: .*process.* is running this study", w) for w in words
            )
            refused += len(words)
            lost += sorted({k for k in result if isinstance(k, int)} - set(rows_of(folder)))
            assert {p.name for p in folder.iterdir()} <= set(FILES)
    assert lost == []
    assert refused


def test_a_row_that_is_not_written_is_not_counted(tmp_path: Path):
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    with Journal(tmp_path, STUDY) as journal:
        # no file can grow beyond a part of the row
        resource.setrlimit(resource.RLIMIT_FSIZE, (8192, limits[1]))
        try:
            with pytest.raises(FileError, match="cannot write: disk I/O error"):
                journal.append([(0, {"x": "long" * 5000})])
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        assert journal.rows == {}
    assert rows_of(tmp_path) == {}


def test_cases_differ_by_their_keys():
    old = Case.from_text("", ["grid.points=65", "contact.load=600.0"]).text
    new = Case.from_text("", ["grid.points=129"]).text
    assert difference({"case": old}, {"case": new}) == [
        # a default depends on other values, a given value does not
        "contact.load: there 600.0, here 600.0 (default)",
        "grid.points: there 65, here 129",
        "grid.points_y: there 65 (derived), here 129 (derived)",
    ]
