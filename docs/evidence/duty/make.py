# SPDX-License-Identifier: BSD-3-Clause
"""Line contacts under duties: ``python docs/evidence/duty/make.py`` rewrites table.csv."""

import csv
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "tests/cases"))
import line_newton  # noqa: E402
from test_duty import BOTH_SIDES, DUTIES, LINE, L, M, columns, run, step_errors  # noqa: E402

import pyehl  # noqa: E402

Row = tuple[str, str, float, float]


def periodic() -> Iterator[Row]:
    """Speed 1 + 0.5 sin(2 pi T/8), third period, compared with another line-contact solver."""
    time = np.linspace(0.0, 8.0, 65)
    speed = 1.0 + 0.5 * np.sin(2.0 * np.pi * time / 8.0)
    speed[-1] = speed[0]
    others = {
        257: (0.1119, 0.357, 0.0535, 0.0868, 0.0505),
        513: (0.1127, 0.357, 0.0542, 0.0876, 0.0519),
    }
    for points, other in others.items():
        data = run(
            time, {"points": points}, mean_velocity=speed, interpolation="cubic", periodic=True
        )
        h = columns(data)
        last = h["T"] >= 16.0 - 1e-9
        t, film = (h["T"][last] - 16.0) / 8.0, h["H_c"][last]
        mean = float(np.trapezoid(film, t) / (t[-1] - t[0]))
        result = film.max(), t[film.argmax()], film.min(), mean, h["H_min"][last].min()
        names = "largest H_c", "its T/8", "least H_c", "mean H_c", "least H_min"
        for name, value, reference in zip(names, result, other, strict=True):
            yield f"periodic speed, {points} nodes", name, float(value), reference


def steady(speed: float) -> float:
    """H_c [m] of the steady contact at a speed over that of the case."""
    contact = LINE["contact"] | {"mean_velocity": speed * LINE["contact"]["mean_velocity"]}
    return float(
        pyehl.solve(pyehl.Case(**LINE | {"contact": contact}), {"grid.border": "zero"}).h_c_m
    )


def slow() -> Iterator[Row]:
    """Deficit of H_c to the steady film at the middle of a speed ramp from 1 to 1.2."""
    film = steady(1.1)
    before = 0.0
    for length in (10.0, 20.0, 40.0):
        data = run([0.0, length], mean_velocity=[1.0, 1.2])
        lag = 1.0 - np.interp(length / 2.0, data.history_T.values, data.history_h_c_m.values) / film
        yield f"speed from 1 to 1.2 in {length:g} b/u", "share below steady", lag, 0.5 * before
        before = lag


def steps() -> Iterator[Row]:
    """Maximum difference to an eighth of the time step, maximum stated error, and coverage."""
    for name, (time, duty) in DUTIES.items():
        grid = BOTH_SIDES if name == "reversal" else None
        for share in (2.0, 1.0, 0.5):
            for what, error, stated in step_errors(time, grid, share, **duty):
                case = f"steps of {share:g}, {name}"
                yield case, f"{what}: difference, stated", error.max(), stated.max()
                covered = float(np.mean(error <= stated + 5e-5))
                yield case, f"{what}: share of instants covered", covered, 1.0


def asked() -> Iterator[Row]:
    """Maximum difference of both films to a sixteenth of the time step, and requested error."""
    for name, (time, duty) in DUTIES.items():
        grid = BOTH_SIDES if name == "reversal" else None
        some = slice(None, None, 4 if len(time) > 8 else 1)
        rows = {k: v if isinstance(v, str) else v[some] for k, v in duty.items()}
        fine = run(time[some], grid, time_step=1.0 / 16.0, **rows)
        for target in (0.05, 0.02, 0.005):
            data = run(time[some], grid, target_error=target, **rows)
            worst = 0.0
            for film in ("history_H_c", "history_H_min"):
                other = np.interp(data.history_T, fine.history_T, fine[film])
                worst = max(worst, float(np.abs(other / data[film].values - 1.0).max()))
            yield f"error asked for, {name}", "largest difference, asked for", worst, target
            yield f"error asked for, {name}", "time steps", data.history_T.size, target


def phase() -> Iterator[Row]:
    """Phase lag of H_c behind the quasi-static film under 1 + 0.1 sin(2 pi T/period)."""
    slope = (steady(1.1) - steady(0.9)) / 0.2
    for period in (4.0, 8.0, 16.0, 32.0):
        time = np.linspace(0.0, period, 65)
        speed = 1.0 + 0.1 * np.sin(2.0 * np.pi * time / period)
        speed[-1] = speed[0]
        data = run(time, mean_velocity=speed, interpolation="cubic", periodic=True, periods=3)
        t, film = data.history_T.values, data.history_h_c_m.values
        # first harmonic of the last period, on equal times
        at = 2.0 * period + period * np.arange(256) / 256
        wave = np.fft.rfft(np.interp(at, t, film))[1] / 128.0
        lag = (-np.pi / 2.0 - np.angle(wave)) / (2.0 * np.pi) % 1.0 * period
        yield f"speed 1 + 0.1 sin 2 pi T/{period:g}", "lag of H_c behind the speed [b/u]", lag, 1.0
        gain = float(np.abs(wave) / (0.1 * slope))
        yield f"speed 1 + 0.1 sin 2 pi T/{period:g}", "amplitude over quasi-static", gain, 1.0


def newton() -> Iterator[Row]:
    """Maximum differences of H_c and H_min to Newton's method in the same steps."""
    duties = {
        "load from 1 to 1.5": (
            (-4.0, 1.5),
            177,
            [0.0, 0.5, 1.0, 3.5],
            {"load": [1.0, 1.0, 1.5, 1.5]},
        ),
        "reversal": (
            (-4.0, 4.0),
            257,
            [0.0, 0.5, 1.5, 4.0],
            {"mean_velocity": [1.0, 1.0, -1.0, -1.0]},
        ),
    }
    for name, (ends, points, time, duty) in duties.items():
        h = columns(run(time, {"points": points, "x_inlet": ends[0], "x_outlet": ends[1]}, **duty))
        line = line_newton.Line(M, L, points - 1, ends, 0.6684)
        both = zip([1.0, *h["speed"]], [1.0, *h["load"]], strict=True)
        states = [{"speed": u, "load": w} for u, w in both]
        films = line_newton.march(line, 0.0856, np.array([0.0, *h["T"]]), states)[1:]
        for k, film in enumerate(("H_c", "H_min")):
            yield (
                name,
                f"difference of {film}",
                float(np.abs(h[film] / films[:, k] - 1.0).max()),
                0.0,
            )


if __name__ == "__main__":
    with (HERE / "table.csv").open("w", newline="", encoding="utf-8") as stream:
        rows = csv.writer(stream, lineterminator="\n")
        rows.writerow(["case", "quantity", "found", "beside"])
        for part in (periodic, slow, phase, steps, asked, newton):
            rows.writerows((case, name, f"{a:.5g}", f"{b:.5g}") for case, name, a, b in part())
