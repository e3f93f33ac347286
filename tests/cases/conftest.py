# SPDX-License-Identifier: BSD-3-Clause
"""Runs of the program that several tests share: each is made once."""

import csv
import json
import os
import subprocess
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import pyehl

Array = NDArray[np.float64]
HERE = Path(__file__).resolve().parent
COMPLETED = ("bodies.", "lubricant.name", "lubricant.kinematic", "lubricant.table")
"""Beginnings of keys that only pyehl reads, from which it derives keys for `ehl`."""


@dataclass(frozen=True)
class Run:
    """A finished run: result folder, exit status, duration [s], summary, columns of the history."""

    folder: Path
    code: int
    seconds: float
    summary: dict[str, Any]
    history: dict[str, Array]

    def __getitem__(self, name: str) -> Any:
        """A number or word of the summary."""
        return self.summary[name]

    @property
    def converged(self) -> bool:
        """Whether the run converged, by its status and by its exit status."""
        return self.summary["status"] == "converged" and self.code == 0

    @property
    def plan(self) -> str:
        """The plan of the run in words."""
        with pyehl.Solver(self.folder / "case.nml") as solver:
            return solver.describe()

    def field(self, name: str) -> Array:
        """X, Y, P or H, in Hertz units."""
        return np.load(self.folder / f"{name}.npy")


Solve = Callable[..., Run]


@pytest.fixture(scope="session")
def solve(
    ehl: str,
    command: Callable[..., subprocess.CompletedProcess[str]],
    tmp_path_factory: pytest.TempPathFactory,
) -> Solve:
    """Run the program: ``solve((M, L), points, {"group.key": value})``.

    The summary of `ehl` has numbers; with `words` the run is made by ``pyehl run``, with sentences.
    Without an operating point (None) the contact is that of the settings, in SI units by default.
    Fields are written only on request. A run that takes longer than `timeout` seconds fails.
    """
    place = tmp_path_factory.mktemp("runs")
    (place / "case.nml").write_text("! all from the command line\n")
    environment = {k: v for k, v in os.environ.items() if k != "OMP_NUM_THREADS"}
    runs: dict[tuple[str, ...], Run] = {}

    def call(
        point: tuple[float, float] | None,
        points: int,
        settings: Mapping[str, object] | None = None,
        *,
        fields: bool = False,
        timeout: float = 600.0,
        words: bool = False,
    ) -> Run:
        values: dict[str, object] = {"grid.points": points, "output.fields": fields}
        if point is not None:
            values |= {"contact.moes_m": point[0], "contact.moes_l": point[1]}
        values |= settings or {}
        options = {
            f"{key}={f'.{value}.'.lower() if isinstance(value, bool) else value}"
            for key, value in values.items()
        }
        key = ("pyehl" if words else "ehl", *sorted(options))
        if key not in runs:
            runs[key] = start(key[0], key[1:], timeout)
        return runs[key]

    def start(driver: str, words: tuple[str, ...], timeout: float) -> Run:
        folder = place / f"{len(runs)}"
        options = [part for word in words for part in ("--set", word)]
        name = "case.nml"
        if any(word.startswith(COMPLETED) for word in words):
            name, options = f"{folder.name}.nml", []
            (place / name).write_text(pyehl.Case.from_text("", words).text)
        given = [name, "-o", folder.name, "--quiet", *options]
        began = time.monotonic()
        if driver == "pyehl":
            done = command(place, "run", *given, seconds=int(timeout))
        else:
            done = subprocess.run(
                [ehl, *given],
                cwd=place,
                env=environment,
                capture_output=True,
                text=True,
                timeout=timeout,
                check=False,
            )
        seconds = time.monotonic() - began
        assert done.returncode in (0, 1), f"{words}: exit status {done.returncode}, {done.stderr}"
        return read_run(folder, done.returncode, seconds)

    return call


def read_run(folder: Path, code: int = 0, seconds: float = 0.0) -> Run:
    """Read a result folder."""
    summary = json.loads((folder / "summary.json").read_text())
    with (folder / "history.csv").open(newline="") as stream:
        names, *rows = csv.reader(stream)
    table = np.array([[float(cell or "nan") for cell in row] for row in rows])
    columns = table.reshape(len(rows), len(names)).T
    return Run(folder, code, seconds, summary, dict(zip(names, columns, strict=True)))


@pytest.fixture(scope="session")
def run_from() -> Callable[[Path], Run]:
    """Read a result folder as a run."""
    return read_run


@pytest.fixture(scope="session")
def table() -> Callable[[str], list[dict[str, str]]]:
    """Rows of a table of reference data in this folder; its '#' lines state the source."""

    def read(name: str) -> list[dict[str, str]]:
        lines = (HERE / name).read_text().splitlines()
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))

    return read
