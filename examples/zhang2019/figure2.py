# SPDX-License-Identifier: BSD-3-Clause
"""Figure 2: mu_r/mu_s of a moving wave over time."""

import csv
from dataclasses import dataclass

import numpy as np
import pictures
from conditions import SCHEME_NAMES, SCHEMES
from piece import Check, Level, References, Result
from runs import Made, Runs

from pyehl.studies.compare import read_reference
from pyehl.types import Array

NAME = "figure 2"
TITLE = "Relative friction of a moving wave over time"
AMPLITUDE = 9.734e-3
CASE = f"""&contact moes_m = 1000.0 moes_l = 10.0 /
&surface kind = 'harmonic' amplitude = {AMPLITUDE} wavelength = 0.5 velocity_ratio = 1.01 /
&time estimate_error = .false. /
&output fields = .false. checkpoint_interval = 0.0 /
"""


@dataclass(frozen=True, slots=True)
class Wave:
    """One run: grid, scheme, times (n,) [a/u], mu_r/mu_s (n,), its mean, H_c, seconds, its row."""

    points: int
    scheme: str
    time: Array
    ratio: Array
    mean: float
    film: float
    seconds: float
    made: Made


def run(runs: Runs, level: Level) -> list[Wave]:
    """Run the wave on all grids with both schemes."""
    cases = [(points, scheme) for points in level.wave_grids for scheme in SCHEMES]
    made = runs.study(
        "figure2-" + "-".join(map(str, level.wave_grids)),
        CASE,
        {"grid.points": [c[0] for c in cases], "time.scheme": [c[1] for c in cases]},
        keep=True,
    )
    result = []
    for k, ((points, scheme), folder) in enumerate(zip(cases, made.kept, strict=True)):
        row = made.solved(k)
        with (folder / "history.csv").open(newline="", encoding="utf-8") as stream:
            history = list(csv.DictReader(stream))
        time, ratio = (np.array([float(r[n]) for r in history]) for n in ("T", "mu_ratio"))
        mean, film = float(row["mu_ratio"]), float(row["H_c"])
        result.append(Wave(points, scheme, time, ratio, mean, film, row["seconds"], made))
    return result


def _independent(wave: Wave) -> list[Check]:
    """Compare with another program if it has computed the same wave on the same grid.

    Its Roelands exponent is 0.6684, ours 0.66841: a change of H_c by 1e-5.
    """
    wanted = {
        "grid.points": float(wave.points),
        "time.scheme": wave.scheme,
        "surface.amplitude": AMPLITUDE,
        "lubricant.roelands_z": 0.6684,
    }
    result = []
    for row in read_reference("waviness").rows:
        if wanted.items() <= row.keys.items():
            expected = row.expected["mu_ratio"]
            result.append(
                Check(
                    f"mean, {wave.points} x {wave.points} nodes, scheme '{wave.scheme}'",
                    wave.mean,
                    expected.value,
                    expected.tolerance,
                    "0.5 %: other residuals and periods",
                    "an independent program (waviness.csv)",
                )
            )
    return result


def show(data: list[Wave], references: References, level: Level) -> Result:
    """Draw all runs, and compare the mean on the finest grid with the scheme of the paper."""
    paper_wave = next(w for w in reversed(data) if w.scheme == "paper")
    printed = references["fig2.mu_ratio"]
    checks = [
        Check.of(
            f"mean mu_r/mu_s, scheme of the paper, {paper_wave.points} x {paper_wave.points} nodes",
            paper_wave.mean,
            printed,
        ),
        Check.of("H_c of the smooth contact", paper_wave.film, references["fig2.film"]),
    ]
    checks += [check for wave in data for check in _independent(wave)]
    rows = [(w.points, w.scheme, t, r) for w in data for t, r in zip(w.time, w.ratio, strict=True)]
    figure = pictures.wave_history(
        [(f"{w.points}², {SCHEME_NAMES[w.scheme]}: {w.mean:.4f}", w.time, w.ratio) for w in data],
        printed.value,
    )
    means = ", ".join(f"{w.points} x {w.points} {w.scheme}: {w.mean:.4f}" for w in data)
    notes = [
        f"Means over the last period: {means}.",
        "The paper prints the mean; its curve is not published as numbers.",
    ]
    return Result(
        checks,
        (("points", "scheme", "T", "mu_ratio"), rows),
        figure,
        "Ours over time; dashed, the mean that the paper prints.",
        notes,
        studies=[data[0].made],
    )
