# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of a study with measurements of a rig under the same conditions."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyehl.errors import InputError
from pyehl.rigs.comparison import Deviation, deviations
from pyehl.rigs.quantities import CONDITIONS, LOAD, MEASURED, SLIP, SPEED, TEMPERATURE, Quantity
from pyehl.rigs.reading import RigFile, Step, read_rig
from pyehl.rigs.repeats import Curve, averaged, varied
from pyehl.studies.compare import Results
from pyehl.studies.measured_friction import Measured
from pyehl.types import Array, Settings

# Tolerances of the conditions of a rig: relative, and absolute
RELATIVE = {SPEED: 0.03, LOAD: 0.05}
ABSOLUTE = {TEMPERATURE: 2.0, SLIP: 0.01}


@dataclass(frozen=True, slots=True)
class Compared:
    """A measured quantity with the deviations of a study, and the omitted steps."""

    curve: Curve
    parts: list[Deviation]
    left_out: list[str]  # title and reason


def compared(results: Results, rig: RigFile) -> list[Compared]:
    """Compare a study with the steps of a rig file under the same conditions.

    Raises
    ------
    InputError
        If the study does not vary the condition that the rig varies, if no step has its other
        conditions, or if they have no quantity or range in common.
    """
    over, used, left_out = steps_of(
        rig, results.vary, lambda name: results.key(results.rows[0], name)
    )
    places = _column(results, over.name)
    result = []
    for quantity in MEASURED:
        values = _column(results, quantity.name)
        if _has(used, quantity) and np.isfinite(values).any():
            curve = averaged(used, quantity, over)
            result.append(Compared(curve, deviations(curve, places, values), left_out))
    if not result:
        measured = {q.name for q in MEASURED for step in used if q.name in step.columns}
        raise InputError(
            f"{rig.name}: error: it has {', '.join(sorted(measured))}; the results have none of "
            "them\nexpected: a study with films, or with a coefficient of friction"
        )
    return result


def _column(results: Results, name: str) -> Array:
    """Give a result or key over all rows; NaN for a missing value."""
    values = [row.get(name) for row in results.rows]
    return np.array([math.nan if v is None else float(v) for v in values])


def steps_of(
    rig: RigFile, vary: Sequence[str], here: Callable[[str], object]
) -> tuple[Quantity, list[Step], list[str]]:
    """Find the condition that a rig varied, and the steps under the other conditions of a case.

    Parameters
    ----------
    rig
        Its file.
    vary
        Keys that the study varies.
    here
        Value of a key of the case.

    Returns
    -------
    tuple
        Condition, steps, and title and reason of each omitted step.

    Raises
    ------
    InputError
        If the rig varied another condition, or no step has the others.
    """
    over = varied(rig.steps)
    if over is None:
        raise InputError(f"{rig.name}: error: no condition varies\nexpected: a curve over one")
    if over.name not in vary:
        raise InputError(
            f"{rig.name}: error: measured over {over.name}; the results vary "
            f"{', '.join(vary) or 'nothing'}\nexpected: results of a sweep or curve over it"
        )
    pairs = [(step, _difference(step, here, over)) for step in rig.steps]
    used = [step for step, why in pairs if not why]
    left_out = [f"{step.title or 'table'}: {why}" for step, why in pairs if why]
    if not used:
        raise InputError(
            f"{rig.name}: error: no step has the conditions of the case\n" + "\n".join(left_out)
        )
    return over, used, left_out


def rig_curves(path: str, settings: Settings, vary: Sequence[str]) -> dict[Quantity, Measured]:
    """Give the measurements of a rig under the conditions of a case; only values above 0.

    Raises
    ------
    InputError
        If the file has no curve over one of the keys of `vary` under these conditions.
    """
    over, used, _ = steps_of(read_rig(path), vary, lambda name: _value(settings, name))
    return {q: _above_0(averaged(used, q, over)) for q in MEASURED if _has(used, q)}


def measured_curve(
    path: str,
    settings: Settings,
    quantity: Quantity,
    over: Quantity,
    between: tuple[float, float] = (-math.inf, math.inf),
) -> tuple[Measured, list[str]]:
    """Give a measured quantity over a condition `between` two values, and the omitted steps.

    Raises
    ------
    InputError
        If the file has no such curve under the conditions of the case.
    """
    rig = read_rig(path)
    _, used, left_out = steps_of(rig, [over.name], lambda name: _value(settings, name))
    if not _has(used, quantity):
        columns = sorted({name for step in used for name in step.columns})
        raise InputError(
            f"{path}: error: no column of {quantity.known_as[0]}; columns: {', '.join(columns)}\n"
            f"expected: {quantity.name} over {over.name}"
        )
    within = [_within(step, over, *between) for step in used]
    curve = averaged(within, quantity, over)
    if not curve.places.size:
        raise InputError(f"{path}: error: no point between {between[0]:g} and {between[1]:g}")
    measured = _above_0(curve)
    if omitted := curve.places.size - measured.places.size:
        left_out.append(f"{omitted} points that are not above 0")
    return measured, left_out


def _within(step: Step, over: Quantity, low: float, high: float) -> Step:
    if over.name not in step.columns:
        return step
    places = step.columns[over.name]
    keep = (places >= low) & (places <= high)
    return replace(step, columns={name: v[keep] for name, v in step.columns.items()})


def _value(settings: Settings, name: str) -> object:
    group, _, key = name.partition(".")
    return settings[group].get(key)


def _above_0(curve: Curve) -> Measured:
    """Give a curve as measured values; friction at negative slip mirrors that at positive slip."""
    values = np.where((curve.places < 0.0) & (curve.values < 0.0), -curve.values, curve.values)
    places = np.abs(curve.places)
    good = (places > 0.0) & (values > 0.0)
    error = curve.error[good]
    if not (error > 0.0).all():
        error = np.zeros_like(error)
    return Measured(curve.over, places[good], curve.quantity, values[good], error)


def _has(steps: list[Step], quantity: Quantity) -> bool:
    return any(quantity.name in step.columns for step in steps)


def _difference(step: Step, here: Callable[[str], object], over: Quantity) -> str:
    """Describe the first condition of a step that differs from the case; '' for none."""
    for condition in CONDITIONS:
        if condition is over or condition.name not in step.columns:
            continue
        there = float(np.nanmedian(step.columns[condition.name]))
        value = here(condition.name)
        if not isinstance(value, int | float):
            continue
        limit = RELATIVE.get(condition, 0.0) * abs(value) + ABSOLUTE.get(condition, 0.0)
        if abs(there - value) > limit:
            unit = "" if condition.unit == "-" else f" {condition.unit}"
            return f"{condition.name} = {there:.4g}{unit}, in the case {value:.4g}{unit}"
    return ""


def lines(result: list[Compared]) -> list[str]:
    """Give the lines that ``pyehl compare --measured`` prints."""
    text = []
    for one in result:
        curve = one.curve
        repeats = int(curve.count.max())
        text.append(
            f"{curve.quantity} over {curve.over}: {curve.places.size} measured points"
            + (f", means of up to {repeats}" if repeats > 1 else "")
        )
        if repeats > 1:
            known = np.isfinite(curve.scatter)
            scatter = float(np.median(curve.scatter[known] / curve.values[known]))
            text.append(f"   scatter of repeats {scatter:.1%} (median)")
        text += [f"   {part}" for part in one.parts]
    return text + [f"left out  {words}" for words in result[0].left_out]
