# SPDX-License-Identifier: BSD-3-Clause
"""Costs and outcomes of runs."""

from __future__ import annotations

from collections import Counter

import numpy as np
from records import Values, read

RESOLVED = "resolved fractal"
GRIDS = (129, 257, 513)


def robustness() -> Values:
    """Outcomes of the random cases, and of the second solver."""
    rows = read("stress/table.csv")
    ended = Counter((row["outcome"] == "converged", row["second"]) for row in rows)
    assert ended[True, "differs"] == ended[False, "has a solution"] == 0
    none, open_ = ended[False, "no solution"], ended[False, "not solved either"]
    waves = {}
    for outcome in ("cycle limit", "diverged"):
        kinds = {r["family"]: r for r in rows if r["outcome"] == outcome}
        wave, rest = (
            f"({float(kinds[n]['moes_m']):.0f}, {float(kinds[n]['moes_l']):g})"
            for n in ("wave", "rest")
        )
        waves[outcome] = f"a wave at {wave} and one at rest at {rest}"
    for points, most in ((65, 960), (129, 3800)):
        assert abs(0.16 * most * (4.0 / (points - 1)) ** 2 / 0.6 - 1.0) < 0.02
    return locals()


def speed() -> Values:
    """The finest run, and the cycle that an ellipse saves."""
    (run,) = (r for r in read("speed/runs.csv") if (r["points"], r["case"]) == ("513", "fractal"))
    ends = {
        row["case"]: int(row["cycles"])
        for row in read("speed/ratios.csv")
        if row["case"] in ("circle", "ellipse") and row["points"] == "257"
    }
    assert ends["circle"] - ends["ellipse"] == 1
    return locals()


def start_times() -> Values:
    """Time saved, and fractions of the steps."""
    saved = [
        f"{100.0 * float(row['saved']):.0f} %"
        for row in read("speed/skips.csv")
        if "start = 'prediction'" in row["skipped"]
    ]
    rows = [row for row in read("start/problems.csv") if "slide-to-roll" not in row["problem"]]
    return locals()


def stress() -> Values:
    """Failures of cases with a shear law."""
    ends = [
        Counter(row["outcome"] for row in read("stress/laws.csv") if row["law"] == law)
        for law in ("eyring", "carreau", "newtonian")
    ]
    assert ends[0] == ends[1]
    film, apart = ends[0]["negative film"], ends[0]["diverged"]
    assert ends[2]["diverged"] == ends[2]["cycle limit"] == 1
    return locals()


def workprec() -> Values:
    """The cheapest settings, and the cost of others."""
    rows = {
        (row["problem"], row["setting"], row["points"], row["threads"]): row
        for row in read("workprec/workprec.csv")
        if row["quantity"] in ("H_c", "mu_ratio")
    }

    def number(problem: str, setting: str, points: int, name: str = "seconds") -> float:
        return float(rows[problem, setting, str(points), "1"][name])

    def over(problem: str, other: str, points: int, name: str = "seconds") -> float:
        return number(problem, other, points, name) / number(problem, "default", points, name)

    smooth = [number("smooth", "default, extrapolated", n) for n in (257, 513)]
    wave = [number("wave", "default", n) for n in (129, 257, 513)]
    predicted, finest = number(RESOLVED, "prediction", 257), number(RESOLVED, "default", 1025)
    rough = ("wave", RESOLVED, "fractal")
    usual = [over(s, o, 513) for s in rough for o in ("fft", "alcouffe", "classical", "paper")]
    assert min(*usual, over("smooth", "fft", 513)) >= 0.95
    paper = [(over(s, "paper", n), over(s, "paper", n, "error")) for s in rough for n in GRIDS]
    dear, wrong = (max(part) for part in zip(*paper, strict=True))
    dear = round(100.0 * (dear - 1.0), -1)
    fft = [100.0 * (over(s, "fft", n) - 1.0) for s in (*rough, "smooth") for n in (129, 257)]
    fine = [100.0 * (over(s, "fft", 513) - 1.0) for s in (*rough, "smooth")]
    gain = [1.0 / over("wave", "default, extrapolated", n, "error") for n in (257, 513)]
    more = [1.0 / over(RESOLVED, "default, extrapolated", n, "error") for n in (257, 513)]
    assert more[0] < 1.1
    cost = [over("wave", "default, extrapolated", n) for n in (257, 513)]
    assert np.allclose(cost, [1.2, 1.125], rtol=0.0, atol=0.01)
    second = [float(rows["smooth", "default", n, "2"]["seconds"]) for n in ("513", "1025")]
    first = [number("smooth", "default", n) for n in (513, 1025)]
    most = max(100.0 * (b / a - 1.0) for a, b in zip(first, second, strict=True))
    return locals()
