# SPDX-License-Identifier: BSD-3-Clause
"""Time and error of the deflection engines."""

import argparse
import statistics
import sys
from collections.abc import Sequence

import numpy as np
from common import GRIDS, ScipyDeflection, columns, hertz, measure, median_seconds, parser, show

from pyehl import library
from pyehl.types import Array, Row

# Error of a deflection requested, over the discretisation error
SHARE = 0.1

COLUMNS = columns(
    "points:d engine:s domain:s threads:d seconds:.5f units:.3f error:.1e share:.3f "
    "discretisation:.1e megabytes:.1f"
)
MEANING = (
    "seconds: one application; units: of one scipy.fft deflection at that grid; error: relative to "
    "the maximum deflection;\nshare: of the discretisation error of the sum; half: Y >= 0 of a "
    "symmetric pressure"
)
"""Meaning of the columns."""


def deflection_rows(grids: Sequence[int], threads: Sequence[int]) -> list[Row]:
    """Time and error of every engine on every grid, whole and half domain.

    The error is relative to the maximum deflection, against the sum that all engines approximate
    (computed by scipy.fft to rounding); the discretisation error is that of the sum against the
    analytic deflection of the Hertz pressure, 1 - r^2/2.
    """
    rows: list[Row] = []
    for points in grids:
        p, h, exact, inside = hertz(points)
        yardstick = ScipyDeflection(points, points, h, h)
        unit = median_seconds(lambda p=p, y=yardstick: y.apply(p))  # type: ignore[misc]
        reference = yardstick.apply(p)
        scale = reference.max()
        discretisation = float(np.abs(reference - exact)[inside].max() / scale)
        mine: list[Row] = [
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
) -> Row:
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


def work(args: argparse.Namespace) -> Row:
    """Measure and print."""
    rows = deflection_rows(args.points, args.threads)
    show(rows, COLUMNS, MEANING)
    return {"rows": rows}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__, points=GRIDS, threads=(1, 2))
    return measure(work, made, arguments)


if __name__ == "__main__":
    sys.exit(main())
