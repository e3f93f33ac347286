# SPDX-License-Identifier: BSD-3-Clause
"""What a worker does: one case of a study, to a row of its table.

Nothing that a case does ends a worker: whatever goes wrong is the status and the message of a row.
"""

import json
import math
import time
import traceback
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from pyehl.case import trusted
from pyehl.errors import EhlError
from pyehl.prediction import film_formulas, folder
from pyehl.prediction.friction import BEYOND
from pyehl.prediction.predict import predict
from pyehl.run import run
from pyehl.solver import Solver
from pyehl.studies.outputs import NOT_IN_A_TABLE, TRACKS, film_columns
from pyehl.types import Row

FAILED = "failed"
"""Status of a case that ended with an exception."""
INSIDE, OUTSIDE = "inside all ranges", "outside the range of a formula"
RESULTS = frozenset({"converged", "predicted", INSIDE, OUTSIDE})
"""Statuses of cases that have a result."""
FINDINGS = RESULTS | {"film breakdown", BEYOND}
"""Statuses of cases that are answered: with a result, or with what keeps the case from one."""


@dataclass(frozen=True, slots=True)
class Task:
    """One case to be done."""

    number: int  # place in the table
    text: str  # the resolved case
    run: str  # 'solve', 'predict' or 'film'
    folder: str = ""  # where its results go; '' for nowhere
    seconds: float = 0.0  # how long it may take, by estimate
    shares: str = ""  # what it has in common with others; those go to one worker where possible
    # A prediction with its tracks, bands and a suggested cut-off; else mu_r/mu_s and its errors
    full: bool = False

    def message(self) -> dict[str, Any]:
        """Give the task as values of JSON."""
        return asdict(self)


def why_none(row: Mapping[str, Any]) -> str:
    """Say in words why a case has no result; '' for one that has.

    A film breakdown is a finding, and yet no result: there is no ratio.
    """
    if row["status"] in RESULTS:
        return ""
    return f"{row['status']}: {row['message']}" if row.get("message") else str(row["status"])


def execute(task: Task) -> Row:
    """Do a task; results by their names in ``summary.json``, ``status``, ``seconds``, ``message``.

    `seconds` is the time of the case itself [s].
    """
    began = time.perf_counter()
    try:
        row = RUNNERS[task.run](task)
    except Exception as error:
        row = {"status": FAILED, "message": str(error)}
        if not isinstance(error, EhlError):
            # no fault of the case: the journal keeps where it was raised
            row["message"] = f"{type(error).__name__}: {error}"
            row["traceback"] = traceback.format_exc()
    row["seconds"] = round(time.perf_counter() - began, 6)
    return row


def _solve(task: Task) -> Row:
    case = trusted(task.text)
    if task.folder:
        run(case, task.folder)
        text = (Path(task.folder) / "summary.json").read_text(encoding="utf-8")
        return _scalars(json.loads(text))
    with Solver(case) as solver:
        solver.run()
        return _scalars(solver.summary)


def _predict(task: Task) -> Row:
    case = trusted(task.text)
    full = task.full or bool(task.folder)
    prediction = predict(case.resolve(), case.text, brief=not full)
    if task.folder:
        folder.write(prediction, folder.destination(task.folder))
    row = _scalars(prediction.summary)
    return row if full else {name: row[name] for name in row if name not in TRACKS}


def _film(task: Task) -> Row:
    values = film_formulas.sheet(trusted(task.text).resolve())
    row = _scalars(values)
    row["h_c_m"] = values["formulas"][0]["h_c_m"]
    for formula in values["formulas"]:
        central, least = film_columns(formula["name"])
        row[central] = formula["h_c_m"]
        if formula["h_min_m"] is not None:
            row[least] = formula["h_min_m"]
    outside = [f["name"] for f in values["formulas"] if f["applies"] and f["outside"]]
    row["status"] = OUTSIDE if outside else INSIDE
    row["message"] = ", ".join(outside)
    return row


RUNNERS: dict[str, Callable[[Task], Row]] = {"solve": _solve, "predict": _predict, "film": _film}


def _scalars(summary: Mapping[str, Any]) -> Row:
    """Numbers, truth values and words of a summary; None for a number that does not exist."""
    row: Row = {}
    for name, value in summary.items():
        if name in NOT_IN_A_TABLE:
            continue
        if isinstance(value, float) and not math.isfinite(value):
            row[name] = None
        elif isinstance(value, list) and all(isinstance(word, str) for word in value):
            row[name] = "; ".join(value)
        elif value is None or isinstance(value, bool | int | float | str):
            row[name] = value
    return row
