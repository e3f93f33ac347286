# SPDX-License-Identifier: BSD-3-Clause
"""Tasks of a worker process: one case of a study gives one row of its table.

A failed case does not end its worker: the row has the status and the message.
"""

import json
import math
import os
import time
import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pyehl import schema
from pyehl.case import resolved_case
from pyehl.contact import film_formulas
from pyehl.errors import EhlError, InputError, did_you_mean
from pyehl.prediction import result
from pyehl.prediction.friction import BEYOND
from pyehl.prediction.predict import predict
from pyehl.run import run
from pyehl.solver import Solver
from pyehl.theory.film import estimates
from pyehl.theory.line_contact import LineContact
from pyehl.theory.line_contact import estimates as estimates_of_line
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Row

LAST = ("status", "seconds", "message")
"""Last columns of every table."""
TRACKS = ("tracks", "mu_ratio_tracks", "mu_ratio_tracks_spread")
"""Results of a prediction that are computed only on request."""

KINDS = {"solve": "solution", "predict": "prediction", "film": "film"}
NOT_IN_A_TABLE = frozenset(
    "bands film_breakdown formulas pixels schema_version second_pixels second_surface_preparation "
    "surface_preparation wall_seconds".split()
)
"""Quantities that are not scalars, that all cases have in common, or that equal `seconds`."""


def film_columns(name: str) -> tuple[str, str]:
    """Columns of the central and the minimum film by a formula with this name."""
    short = "".join(c if c.isalnum() else "_" for c in name.lower()).strip("_")
    return f"h_c_m_{short}", f"h_min_m_{short}"


def known(run: str) -> list[str]:
    """Names of all results that a table may have for a kind of run."""
    kind = KINDS[run]
    names = [q.name for q in schema.QUANTITIES if kind in q.kinds]
    if run == "film":
        names.append("h_c_m")
        line = LineContact.from_moes(20.0, 10.0)
        of_line = estimates_of_line(line, Lubricant())
        for formula in [*estimates(OperatingPoint(), Lubricant()), *of_line]:
            names += film_columns(formula.name)
    return [*(name for name in names if name not in NOT_IN_A_TABLE), *LAST]


def checked(outputs: Sequence[str], run: str, origin: str = "") -> tuple[str, ...]:
    """Return the requested names, each once.

    InputError for an unknown name, with the nearest one; `origin` names the study file.
    """
    names = known(run)
    for name in outputs:
        if name not in names:
            hint = did_you_mean(name, names) or f": {', '.join(names)}"
            raise InputError(
                f"{origin}outputs: unknown result '{name}'\nexpected: names of the summary of "
                f"run = '{run}'{hint}"
            )
    return tuple(dict.fromkeys(outputs))


FAILED = "failed"
"""Status of a case that ended with an exception."""
INSIDE, OUTSIDE = "inside all ranges", "outside the range of a formula"
RESULTS = frozenset({"converged", "predicted", INSIDE, OUTSIDE})
"""Statuses of cases that have a result."""
FINDINGS = RESULTS | {"film breakdown", BEYOND}
"""Statuses of finished cases: with a result, or without one for a physical reason."""


@dataclass(frozen=True, slots=True)
class Task:
    """One case to be run."""

    number: int  # row of the table
    text: str  # the resolved case
    run: str  # 'solve', 'predict' or 'film'
    folder: str = ""  # result folder; '' for none
    seconds: float = 0.0  # estimated time
    shares: str = ""  # work in common with other tasks, which preferably go to the same worker
    # Whether a prediction has tracks, bands and a suggested cut-off, or only mu_r/mu_s and errors
    full: bool = False


def why_none(row: Mapping[str, Any]) -> str:
    """State why a case has no result; '' if it has one.

    Film breakdown is a valid outcome without a result: there is no friction ratio.
    """
    if row["status"] in RESULTS:
        return ""
    return f"{row['status']}: {row['message']}" if row.get("message") else str(row["status"])


def execute(task: Task) -> Row:
    """Run a task; results by their names in ``summary.json``, ``status``, ``seconds``, ``message``.

    `seconds` is the time of the case alone [s].
    """
    began = time.perf_counter()
    try:
        row = RUNNERS[task.run](task)
    except Exception as error:
        row = {"status": FAILED, "message": str(error)}
        if not isinstance(error, EhlError):
            # not an error of the case: the journal records where it was raised
            row["message"] = f"{type(error).__name__}: {error}"
            row["traceback"] = traceback.format_exc()
    row["seconds"] = round(time.perf_counter() - began, 6)
    return row


def execute_all(tasks: Sequence[Task], folder: str) -> list[Row]:
    """Run several tasks in a folder, one after the other."""
    os.chdir(folder)
    return [execute(task) for task in tasks]


def _solve(task: Task) -> Row:
    case = resolved_case(task.text)
    if task.folder:
        run(case, task.folder)
        text = (Path(task.folder) / "summary.json").read_text(encoding="utf-8")
        return _scalars(json.loads(text))
    with Solver(case) as solver:
        solver.run()
        return _scalars(solver.summary)


def _predict(task: Task) -> Row:
    case = resolved_case(task.text)
    full = task.full or bool(task.folder)
    prediction = predict(case.resolve(), case.text, brief=not full)
    if task.folder:
        result.write(prediction, result.destination(task.folder))
    row = _scalars(prediction.summary)
    return row if full else {name: row[name] for name in row if name not in TRACKS}


def _film(task: Task) -> Row:
    values = film_formulas.sheet(resolved_case(task.text).resolve())
    row = _scalars(values)
    row["h_c_m"] = values["formulas"][0]["h_c_m"]
    for formula in values["formulas"]:
        central, minimum = film_columns(formula["name"])
        row[central] = formula["h_c_m"]
        if formula["h_min_m"] is not None:
            row[minimum] = formula["h_min_m"]
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
