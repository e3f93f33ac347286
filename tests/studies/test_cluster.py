# SPDX-License-Identifier: BSD-3-Clause
"""A study on workers of a dask scheduler: killing a worker loses no result."""

import csv
import json
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from journals import rows_in

import pyehl
from pyehl import InputError
from pyehl.studies import pool


def test_missing_dask_names_the_package_to_install(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"pyehl\[cluster\]"):
        next(pool.cluster_rows([], "tcp://127.0.0.1:1"))


def dask(stack: ExitStack, *words: str) -> subprocess.Popen[bytes]:
    process = stack.enter_context(
        subprocess.Popen(
            [sys.executable, "-P", "-m", "distributed.cli." + words[0], *words[1:]],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
    )
    stack.callback(process.kill)
    return process


@pytest.fixture
def workers(tmp_path: Path) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """Address of a scheduler on loopback, and its two workers."""
    pytest.importorskip("distributed")
    place = tmp_path / "scheduler.json"
    with ExitStack() as stack:
        dask(
            stack,
            "dask_scheduler",
            "--host=127.0.0.1",
            "--port=0",
            "--no-dashboard",
            f"--scheduler-file={place}",
        )
        result = [
            dask(
                stack,
                "dask_worker",
                f"--scheduler-file={place}",
                "--nthreads=1",
                "--no-nanny",
                "--no-dashboard",
                "--host=127.0.0.1",
                f"--name={n}",
                f"--local-directory={tmp_path}",
            )
            for n in range(2)
        ]
        end = time.monotonic() + 60.0
        while not place.is_file():
            assert time.monotonic() < end
            time.sleep(0.1)
        yield json.loads(place.read_text())["address"], result


@pytest.mark.slow
def test_a_killed_worker_loses_no_result(
    workers: tuple[str, list[subprocess.Popen[bytes]]], cases: Path, tmp_path: Path
):
    address, result = workers
    folder = tmp_path / "out"
    words = ["--set", "grid.points=129", "--vary", "contact.moes_m=50:400:40log"]
    words += ["-o", str(folder), "--scheduler", address]
    with subprocess.Popen(
        [sys.executable, "-P", "-m", "pyehl", "sweep", str(cases / "quick.nml"), *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as process:
        end = time.monotonic() + 120.0
        while len(rows_in(folder)) < 3:
            assert time.monotonic() < end
            assert process.poll() is None, process.communicate()[0]
            time.sleep(0.01)
        result[0].kill()
        rows_then = len(rows_in(folder))
        reported, _ = process.communicate(timeout=240)
    assert process.returncode == 0, reported
    assert rows_then < 40
    with (folder / "results.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 40
    assert {row["status"] for row in rows} == {"converged"}
    with pyehl.Solver(
        cases / "quick.nml", f"contact.moes_m={rows[20]['contact.moes_m']}"
    ) as solver:
        solver.run()
        assert float(rows[20]["H_c"]) == solver.summary["H_c"]
