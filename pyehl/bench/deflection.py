# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl bench deflection``: time and error of the deflection engines."""

import statistics
from collections.abc import Sequence
from typing import Any

import numpy as np

from pyehl import library
from pyehl.bench.unit import ScipyDeflection, hertz, median_seconds
from pyehl.types import Array

# Share of the discretisation error that the error of a deflection may have
SHARE = 0.1

COLUMNS = (
    ("points", "d"),
    ("engine", "s"),
    ("domain", "s"),
    ("threads", "d"),
    ("seconds", ".5f"),
    ("units", ".3f"),
    ("error", ".1e"),
    ("share", ".3f"),
    ("discretisation", ".1e"),
    ("megabytes", ".1f"),
)
MEANING = (
    "seconds: one application; units: of one scipy.fft deflection at that grid; error: relative to "
    "the largest deflection;\nshare: of the discretisation error of the sum; half: Y >= 0 of a "
    "symmetric pressure"
)
"""What the columns are."""


def deflection_rows(grids: Sequence[int], threads: Sequence[int]) -> list[dict[str, Any]]:
    """Time and error of every engine on every grid, whole and half domain.

    The error is relative to the largest deflection, against the sum that all engines
    approximate (made by scipy.fft to rounding); the discretisation error is that of the sum
    against the analytic deflection of the Hertz pressure, 1 - r^2/2.
    """
    rows: list[dict[str, Any]] = []
    for points in grids:
        p, h, exact, inside = hertz(points)
        yardstick = ScipyDeflection(points, points, h, h)
        unit = median_seconds(lambda p=p, y=yardstick: y.apply(p))  # type: ignore[misc]
        reference = yardstick.apply(p)
        scale = reference.max()
        discretisation = float(np.abs(reference - exact)[inside].max() / scale)
        mine: list[dict[str, Any]] = [
            {"engine": "scipy.fft", "domain": "whole", "threads": 1, "seconds": unit}
            | {"error": 0.0, "megabytes": yardstick.transform.nbytes / 1e6}
        ]
        for engine in ("mlmi", "fft"):
            for half in (False, True):
                first = points // 2 if half else 0
                part, wanted = p[:, first:], reference[:, first:]
                accuracy = SHARE * discretisation
                mine += [_measured(engine, part, wanted, h, half, n, accuracy) for n in threads]
        for row in mine:
            row |= {"points": points, "discretisation": discretisation}
            row |= {"units": row["seconds"] / unit, "share": row["error"] / discretisation}
        rows += mine
    return rows


def _measured(
    engine: str, p: Array, reference: Array, h: float, half: bool, threads: int, accuracy: float
) -> dict[str, Any]:
    def call(repeats: int) -> library.Deflection:
        return library.deflection(
            p, h, h, engine, mirror=half, accuracy=accuracy, threads=threads, repeats=repeats
        )

    first = call(1)
    repeats = max(1, min(20, round(0.1 / max(first.seconds, 1e-6))))
    seconds = statistics.median(call(repeats).seconds for _ in range(3))
    error = float(np.abs(first.values - reference).max() / reference.max())
    return {
        "engine": engine,
        "domain": "half" if half else "whole",
        "threads": threads,
        "seconds": seconds,
        "error": error,
        "megabytes": first.bytes / 1e6,
    }
