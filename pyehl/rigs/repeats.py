# SPDX-License-Identifier: BSD-3-Clause
"""Means of repeated measurements, with their standard deviations and errors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pyehl.rigs.quantities import CONDITIONS, ERRORS, Quantity
from pyehl.rigs.reading import Step
from pyehl.types import Array

# Repeats: conditions with a relative difference below both SAME and NEARER times the typical gap
SAME, NEARER = 0.03, 0.25
# Minimum number of repeats whose own standard deviation is used; else that of all points is pooled
MIN_REPEATS = 5


@dataclass(frozen=True, slots=True)
class Curve:
    """A measured quantity over a condition, repeats averaged."""

    over: str
    quantity: str
    places: Array  # values of the condition (n,), ascending
    values: Array  # means (n,)
    scatter: Array  # standard deviation over repeats (n,); NaN for a single value
    error: Array  # error of the means (n,); NaN where it is not known
    count: Array  # number of repeats (n,)
    conditions: dict[str, tuple[float, float]]  # minimum and maximum of the other conditions


def varied(steps: Sequence[Step]) -> Quantity | None:
    """Return the condition with the largest ratio of maximum to minimum; None if none varies.

    Negative values count by their magnitude, zeros and missing values not at all.
    """
    spans = {}
    for quantity in CONDITIONS:
        parts = [s.columns[quantity.name] for s in steps if quantity.name in s.columns]
        values = np.abs(np.concatenate(parts)) if parts else np.zeros(0)
        values = values[np.isfinite(values) & (values > 0.0)]
        if values.size > 1:
            spans[quantity] = float(np.log(values.max() / values.min()))
    best = max(spans, key=lambda q: spans[q], default=None)
    return best if best is not None and spans[best] > SAME else None


def averaged(steps: Sequence[Step], quantity: Quantity, over: Quantity) -> Curve:
    """Average the measurements of a quantity over a condition.

    The error of a mean is the standard deviation of its repeats over the square root of their
    number; below `MIN_REPEATS` repeats the relative standard deviation is pooled over all points.
    Without any repeats it is the error stated in the file.
    """
    used = [s for s in steps if quantity.name in s.columns and over.name in s.columns]
    places = np.concatenate([s.columns[over.name] for s in used])
    values = np.concatenate([s.columns[quantity.name] for s in used])
    nothing = [np.full(s.columns[over.name].shape, np.nan) for s in used]
    name = ERRORS.get(quantity, quantity).name
    stated = [
        s.columns.get(name, n) if name != quantity.name else n
        for s, n in zip(used, nothing, strict=True)
    ]
    known = np.isfinite(places) & np.isfinite(values)
    order = np.argsort(places[known], kind="stable")
    places, values = places[known][order], values[known][order]
    given = np.concatenate(stated)[known][order]
    groups = _groups(places)
    at, mean = (np.array([a[g].mean() for g in groups]) for a in (places, values))
    scatter = np.array([values[g].std(ddof=1) if len(g) > 1 else np.nan for g in groups])
    counts = np.array([len(g) for g in groups])
    error = np.array([given[g].mean() for g in groups])
    if (counts > 1).any():
        free = np.where(counts > 1, counts - 1.0, 0.0)
        shares = np.nan_to_num(scatter / mean) ** 2
        pooled = float(np.sqrt((free * shares).sum() / free.sum())) * np.abs(mean)
        error = np.where(counts < MIN_REPEATS, pooled, scatter) / np.sqrt(counts)
    others = {}
    for condition in CONDITIONS:
        parts = [s.columns[condition.name] for s in used if condition.name in s.columns]
        if parts and condition is not over:
            every = np.concatenate(parts)
            others[condition.name] = float(np.nanmin(every)), float(np.nanmax(every))
    return Curve(over.name, quantity.name, at, mean, scatter, error, counts, others)


def _groups(places: Array) -> list[Array]:
    """Return indices of ascending conditions grouped into repeats of one set point.

    Neighbours are repeats if their relative difference is at most `SAME` and `NEARER` times the
    median of the gaps of `SAME` or more; without such gaps, in a finely stepped curve, only equal
    conditions are repeats.
    """
    gaps = np.diff(places) / np.maximum(np.abs(places[1:]), 1e-300)
    large = gaps[gaps >= SAME]
    limit = min(SAME, NEARER * float(np.median(large))) if large.size else 0.0
    ends = np.flatnonzero(gaps > limit) + 1
    return list(np.split(np.arange(places.size), ends))
