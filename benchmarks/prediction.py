# SPDX-License-Identifier: BSD-3-Clause
"""Time of predictions, measured alternately with the unit."""

import argparse
import statistics
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from common import ScipyDeflection, add_list, add_number, columns, hertz, measure, parser, show

import pyehl
from pyehl.contact.smooth import forget, solve_contact
from pyehl.types import Row

POINTS = 513
"""Nodes per side of the grid of the unit."""
CALLS = 4
"""Number of deflections, the median of which is the unit of the prediction after them."""

COLUMNS = columns("problem:s unit_seconds:.4f seconds:.3f units:.1f smooth:.1f bands:.1f")
MEANING = (
    f"processor seconds; unit: one scipy.fft deflection on {POINTS} x {POINTS} nodes; units: of "
    "the whole prediction,\nof its smooth contact, and of its bands of wavelengths; medians"
)
"""Meaning of the columns."""

TABLE_1 = Path(__file__).resolve().parents[1] / "cases" / "table1.nml"
SURFACE = pyehl.Case(TABLE_1)["surface"]
SECOND = {
    f"second_surface.{key}": SURFACE[key] for key in ("kind", "rms_height", "hurst", "pixels")
}
PROBLEMS: dict[str, dict[str, Any]] = {
    "fractal": {},
    "fractal-law": {"lubricant.shear_law": "eyring"},
    "two-fractals": SECOND | {"second_surface.seed": 2, "surface.velocity_ratio": 1.05},
}
"""The case of Table 1 of Zhang et al. 2019, with a shear law, and with a second surface."""


def prediction_rows(problems: Sequence[str], repeats: int) -> list[Row]:
    """Time each problem some times, alternately with the unit and with the other problems."""
    pressure, step, _, _ = hertz(POINTS)
    deflection = ScipyDeflection(POINTS, POINTS, step, step)
    cases = {name: pyehl.Case(TABLE_1, PROBLEMS[name]) for name in problems}
    times: dict[str, list[tuple[float, ...]]] = {name: [] for name in problems}
    # the first time of all is without those of imports and tables
    for repeat in range(repeats + 1):
        for name, case in cases.items():
            calls = [seconds(lambda: deflection.apply(pressure)) for _ in range(CALLS)]
            forget()
            smooth = seconds(lambda case=case: solve_contact(case.resolve()))  # type: ignore[misc]
            made: list[pyehl.Prediction] = []
            rough = seconds(lambda case=case, to=made: to.append(pyehl.predict(case)))  # type: ignore[misc]
            bands = seconds(lambda of=made: len(of[0].bands))  # type: ignore[misc]
            if repeat:
                times[name].append((statistics.median(calls), smooth, rough, bands))
    return [_row(name, times[name]) for name in problems]


def seconds(call: Callable[[], object]) -> float:
    """Processor time of a call [s]."""
    began = time.process_time()
    call()
    return time.process_time() - began


def _row(name: str, times: Sequence[tuple[float, ...]]) -> Row:
    def median(of: Callable[[float, float, float, float], float]) -> float:
        return statistics.median(of(*one) for one in times)

    return {
        "problem": name,
        "unit_seconds": median(lambda unit, *_: unit),
        "seconds": median(lambda _, smooth, rough, bands: smooth + rough + bands),
        "units": median(lambda unit, smooth, rough, bands: (smooth + rough + bands) / unit),
        "smooth": median(lambda unit, smooth, *_: smooth / unit),
        "bands": median(lambda unit, _, __, bands: bands / unit),
    }


def work(args: argparse.Namespace) -> Row:
    """Measure and print."""
    rows = prediction_rows(args.problems, args.repeats)
    show(rows, COLUMNS, MEANING)
    return {"rows": rows}


def main(words: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__)
    names = list(PROBLEMS)
    add_list(made, "problems", names, known=names)
    add_number(made, "repeats", 15, "number of times of each", minimum=1)
    return measure(work, made, words)


if __name__ == "__main__":
    sys.exit(main())
