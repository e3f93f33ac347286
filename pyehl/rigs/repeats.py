# SPDX-License-Identifier: BSD-3-Clause
"""Means of repeated measurements, with their scatter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pyehl.rigs.quantities import CONDITIONS, Quantity
from pyehl.rigs.reading import Step
from pyehl.types import Array

# Conditions that differ less, relatively, are the same if they are far nearer than the next ones
SAME, NEARER = 0.03, 0.25


@dataclass(frozen=True, slots=True)
class Curve:
    """A measured quantity over a condition, repeats averaged."""

    over: str
    quantity: str
    places: Array  # (n,) ascending
    values: Array  # means (n,)
    scatter: Array  # standard deviation over repeats (n,); NaN of a single value
    count: Array  # repeats (n,)
    conditions: dict[str, tuple[float, float]]  # smallest and largest of the other conditions


def varied(steps: Sequence[Step]) -> Quantity | None:
    """Give the condition that changes most, in logarithms (the slip by its values); None if none.

    Values below zero count by their size.
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
    """Average what was measured of a quantity over a condition."""
    used = [s for s in steps if quantity.name in s.columns and over.name in s.columns]
    places = np.concatenate([s.columns[over.name] for s in used])
    values = np.concatenate([s.columns[quantity.name] for s in used])
    known = np.isfinite(places) & np.isfinite(values)
    order = np.argsort(places[known], kind="stable")
    places, values = places[known][order], values[known][order]
    groups = _groups(places)
    at, mean = (np.array([a[g].mean() for g in groups]) for a in (places, values))
    scatter = [values[g].std(ddof=1) if len(g) > 1 else np.nan for g in groups]
    others = {}
    for condition in CONDITIONS:
        parts = [s.columns[condition.name] for s in used if condition.name in s.columns]
        if parts and condition is not over:
            every = np.concatenate(parts)
            others[condition.name] = float(np.nanmin(every)), float(np.nanmax(every))
    counts = np.array([len(g) for g in groups])
    return Curve(over.name, quantity.name, at, mean, np.array(scatter), counts, others)


def _groups(places: Array) -> list[Array]:
    """Give indices of ascending places that are the same within the scatter of a set point.

    They are one if they differ by less than `SAME` and by less than `NEARER` of the gap to the
    next ones; a finely stepped curve has gaps alone.
    """
    gaps = np.diff(places) / np.maximum(np.abs(places[1:]), 1e-300)
    large = gaps[gaps >= SAME]
    limit = min(SAME, NEARER * float(np.median(large))) if large.size else 0.0
    ends = np.flatnonzero(gaps > limit) + 1
    return list(np.split(np.arange(places.size), ends))
