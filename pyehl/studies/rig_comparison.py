# SPDX-License-Identifier: BSD-3-Clause
"""A study beside what a rig measured under the same conditions."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from pyehl.errors import InputError
from pyehl.rigs.comparison import Deviation, deviations
from pyehl.rigs.quantities import (
    CONDITIONS,
    LOAD,
    MEASURED,
    SLIP,
    SPEED,
    TEMPERATURE,
    Quantity,
)
from pyehl.rigs.reading import RigFile, Step
from pyehl.rigs.repeats import Curve, averaged, varied
from pyehl.studies.compare import Results
from pyehl.types import Array

# How far a condition of a rig may be from that of the case: relative, or as a difference
RELATIVE = {SPEED: 0.03, LOAD: 0.05}
ABSOLUTE = {TEMPERATURE: 2.0, SLIP: 0.01}


@dataclass(frozen=True, slots=True)
class Compared:
    """A measured quantity with the deviations of a study, and steps that it is not about."""

    curve: Curve
    parts: list[Deviation]
    left_out: list[str]  # title and reason


def compared(results: Results, rig: RigFile) -> list[Compared]:
    """Compare a study with the steps of a rig file that are under its conditions.

    Raises
    ------
    InputError
        If the study does not go over the condition that the rig varies, if no step has its other
        conditions, or if they have no quantity or range in common.
    """
    over = varied(rig.steps)
    if over is None:
        raise InputError(f"{rig.name}: error: one condition alone\nexpected: a curve over one")
    if over.name not in results.vary:
        raise InputError(
            f"{rig.name}: error: measured over {over.name}; the results go over "
            f"{', '.join(results.vary) or 'nothing'}\nexpected: results of a sweep or curve over it"
        )
    used: list[Step] = []
    left_out = []
    for step in rig.steps:
        why = _difference(step, results, over)
        if why:
            left_out.append(f"{step.title or 'table'}: {why}")
        else:
            used.append(step)
    if not used:
        raise InputError(
            f"{rig.name}: error: no step has the conditions of the case\n" + "\n".join(left_out)
        )
    places = _column(results, over.name)
    found = []
    for quantity in MEASURED:
        values = _column(results, quantity.name)
        if any(quantity.name in step.columns for step in used) and np.isfinite(values).any():
            curve = averaged(used, quantity, over)
            found.append(Compared(curve, deviations(curve, places, values), left_out))
    if not found:
        measured = {q.name for q in MEASURED for step in used if q.name in step.columns}
        raise InputError(
            f"{rig.name}: error: it holds {', '.join(sorted(measured))}; the results have none of "
            "them\nexpected: a study with films, or with a coefficient of friction"
        )
    return found


def _column(results: Results, name: str) -> Array:
    """Give a result or key over all rows; NaN where there is none."""
    values = [row.get(name) for row in results.rows]
    return np.array([math.nan if v is None else float(v) for v in values])


def _difference(step: Step, results: Results, over: Quantity) -> str:
    """Say which condition of a step is not that of the case; '' for none."""
    for condition in CONDITIONS:
        if condition is over or condition.name not in step.columns:
            continue
        there = float(np.nanmedian(step.columns[condition.name]))
        here = results.key(results.rows[0], condition.name)
        if not isinstance(here, int | float):
            continue
        limit = RELATIVE.get(condition, 0.0) * abs(here) + ABSOLUTE.get(condition, 0.0)
        if abs(there - here) > limit:
            unit = "" if condition.unit == "-" else f" {condition.unit}"
            return f"{condition.name} = {there:.4g}{unit}, in the case {here:.4g}{unit}"
    return ""


def lines(found: list[Compared]) -> list[str]:
    """Give what ``pyehl compare --measured`` prints."""
    told = []
    for one in found:
        curve = one.curve
        repeats = int(curve.count.max())
        told.append(
            f"{curve.quantity} over {curve.over}: {curve.places.size} measured points"
            + (f", means of up to {repeats}" if repeats > 1 else "")
        )
        if repeats > 1:
            known = np.isfinite(curve.scatter)
            scatter = float(np.median(curve.scatter[known] / curve.values[known]))
            told.append(f"   scatter of repeats {scatter:.1%} (median)")
        told += [f"   {part}" for part in one.parts]
    return told + [f"left out  {words}" for words in found[0].left_out]
