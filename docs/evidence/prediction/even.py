# SPDX-License-Identifier: BSD-3-Clause
"""The part of the pressure that is even in the roughness: ``even.csv``.

python docs/evidence/prediction/even.py [NAME ...] [--points N]

Cases of cases.csv are simulated with their surface and with its negative, several minutes each. The
mean of the two pressures, less that of the smooth contact, is compared within half a Hertz radius
with the second-order pressure (pyehl/prediction/response.py) computed from half the difference of
the two: standard deviations, correlation, and b times the mean of each pressure weighted by
exp(b P1).
"""

from __future__ import annotations

import argparse
import csv
from typing import Any

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from cases import HERE, case, rows, surface
from pyehl.solver import solver_on_heights
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transport import stiffness

NAMES = ("c16m200", "m200l10")
COLUMNS = "name points positions std_even std_second correlation effect_even effect_second".split()
# Maximum number of cycles of the smooth contact; stride of the steps, and last fraction of a run,
# that are compared; radius of the compared part of the contact [a]
BEFORE, EVERY, LAST, RADIUS = 30, 16, 0.18, 0.5
Array = NDArray[np.float64]
Fields = list[tuple[Array, Array]]


def fields(row: dict[str, Any], factor: float) -> tuple[Array, Array, Fields]:
    """X, Y and P, H of some steps of a run with its surface times a factor.

    The first fields are those of the smooth contact, before the surface arrives.
    """
    one_grid = case(row).with_options("time.estimate_error=.false.")
    with solver_on_heights(one_grid, {"surface": surface(row).heights * factor}) as solver:
        result = [
            (solver.field("P"), solver.field("H"))
            for step in solver
            if step.number > BEFORE and step.number % EVERY == 0
        ]
        return *solver.axes(), [result[0], *result[-round(LAST * len(result)) :]]


def compared(row: dict[str, Any]) -> list[str]:
    """Make the row of a case."""
    settings = case(row).resolve()
    operating, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    x, y, result = fields(row, 1.0)
    _, _, turned = fields(row, -1.0)
    smooth, film = result[0]
    step = 1e-3
    rho = [
        oil.density_ratio(np.maximum(smooth + d, 0.0) * operating.hertz_pressure)
        for d in (-step, 0.0, step)
    ]
    c = (rho[2] - rho[0]) / (2.0 * step * rho[1])
    r = (rho[2] - 2.0 * rho[1] + rho[0]) / (step**2 * rho[1])
    eta = oil.viscosity_ratio(
        np.array([smooth.max(), smooth.max() + step]) * operating.hertz_pressure
    )
    b = float(np.log(eta[1] / eta[0]) / step)
    radius = np.hypot(x[:, np.newaxis], y)
    window = np.clip((1.1 - radius) / 0.25, 0.0, 1.0)
    h = float(x[1] - x[0])
    q = np.hypot(
        2.0 * np.pi * np.fft.fftfreq(x.size, h)[:, np.newaxis],
        2.0 * np.pi * np.fft.rfftfreq(y.size, h),
    )
    middle = np.unravel_index(np.argmin(radius), radius.shape)
    stiff = stiffness(q) / (1.0 + stiffness(q) * film[middle] * c[middle])
    part = radius < RADIUS
    values = []
    for (up, film_up), (down, film_down) in zip(result[1:], turned[1:], strict=True):
        p1, t1 = 0.5 * (up - down), 0.5 * (film_down - film_up)
        source = window * (c * p1 * t1 - 0.5 * r * film * p1**2)
        second = scipy.fft.irfft2(stiff * scipy.fft.rfft2(source), s=source.shape)
        even = 0.5 * (up + down) - smooth
        values.append([p1[part], even[part] - even[part].mean(), second[part]])
    p1, even, second = np.concatenate(values, axis=1)
    second -= second.mean()
    weight = np.exp(b * p1)
    effects = [b * np.mean(p * weight) / np.mean(weight) for p in (even, second)]
    numbers = [even.std(), second.std(), np.corrcoef(even, second)[0, 1], *effects]
    heads = [row["name"], f"{x.size}", f"{len(values)}"]
    return [*heads, *(f"{v:.3g}" for v in numbers)]


def main() -> None:
    """Simulate and write the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", default=NAMES)
    parser.add_argument("--points", type=int, help="nodes per side in place of those of the table")
    arguments = parser.parse_args()
    lines = [COLUMNS]
    for row in rows():
        if row["name"] in arguments.names:
            row["points"] = arguments.points or row["points"]
            lines.append(compared(row))
            print(*lines[-1], flush=True)
    with (HERE / "even.csv").open("w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, lineterminator="\n").writerows(lines)


if __name__ == "__main__":
    main()
