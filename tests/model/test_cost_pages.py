# SPDX-License-Identifier: BSD-3-Clause
"""What runs cost and how they end: pages beside the tables of docs/evidence."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest
from records import Read, Said, missing, of, percent, span

RESOLVED = "resolved fractal"
GRIDS = (129, 257, 513)


def starts(read: Read) -> Iterator[str]:
    """Time saved, and shares of the steps."""
    saved = [
        f"{100.0 * float(row['saved']):.0f} %"
        for row in read("speed/skips.csv")
        if "start = 'prediction'" in row["skipped"]
    ]
    yield f"by {saved[0]} for a wave and by {saved[1]} for the surface of Table 1"
    rows = [row for row in read("start/scenes.csv") if "slide-to-roll" not in row["scene"]]
    yield f"the shares are {span(of(rows, 'steps') / of(rows, 'steps_front'), '.2f')}"


def stress(read: Read) -> Iterator[str]:
    """How cases with a law fail."""
    ends = [
        Counter(row["outcome"] for row in read("stress/laws.csv") if row["law"] == law)
        for law in ("eyring", "carreau", "newtonian")
    ]
    assert ends[0] == ends[1]
    film, apart = ends[0]["negative film"], ends[0]["diverged"]
    yield f"Of the {film + apart} failures with either law {film} are `negative film` and {apart}"
    assert ends[2]["diverged"] == ends[2]["cycle limit"] == 1
    yield f"by `negative film` ({ends[2]['negative film']}), `diverged` and `cycle limit` (1 each)"


def workprec(read: Read) -> Iterator[str]:
    """The cheapest settings, and what the others cost."""
    rows = {
        (row["scene"], row["setting"], row["points"], row["threads"]): row
        for row in read("workprec/workprec.csv")
        if row["quantity"] in ("H_c", "mu_ratio")
    }

    def number(scene: str, setting: str, points: int, name: str = "seconds") -> float:
        return float(rows[scene, setting, str(points), "1"][name])

    def over(scene: str, other: str, points: int, name: str = "seconds") -> float:
        return number(scene, other, points, name) / number(scene, "default", points, name)

    smooth = [number("smooth", "default, extrapolated", n) for n in (257, 513)]
    yield f"257², extrapolated, {smooth[0]:.2f} s | the same | the same | 513², extrapolated"
    yield f"| 513², extrapolated, {smooth[1]:.2f} s |"
    wave = [number("wave", "default", n) for n in (129, 257, 513)]
    yield f"129², {wave[0]:.2f} s | 257², {wave[1]:.1f} s | 513², {wave[2]:.0f} s"
    predicted, finest = number(RESOLVED, "prediction", 257), number(RESOLVED, "default", 1025)
    yield f"| prediction, {predicted:.2f} s | the same"
    yield f"at a {round(finest / predicted, -2):.0f}th of the cost of the simulation on 1025²"
    yield f"reference itself is known to {100.0 * number('fractal', 'default', 513, 'bar'):.0f} %"
    rough = ("wave", RESOLVED, "fractal")
    usual = [over(s, o, 513) for s in rough for o in ("fft", "alcouffe", "classical", "paper")]
    assert min(*usual, over("smooth", "fft", 513)) >= 0.95
    paper = [(over(s, "paper", n), over(s, "paper", n, "error")) for s in rough for n in GRIDS]
    dear, wrong = (max(part) for part in zip(*paper, strict=True))
    dear = round(100.0 * (dear - 1.0), -1)
    yield f"costs up to {dear:.0f} % more and has errors up to {wrong:.0f} times"
    by_chance = [f"{100.0 * number('wave', 'paper', n, 'error'):.1f} %" for n in (129, 257)]
    yield f"{by_chance[0]} on 129² in the wave of Fig. 2 is chance, as its {by_chance[1]} on 257²"
    fft = [100.0 * (over(s, "fft", n) - 1.0) for s in (*rough, "smooth") for n in (129, 257)]
    fine = [100.0 * (over(s, "fft", 513) - 1.0) for s in (*rough, "smooth")]
    yield f"`fft` costs {-min(fft):.0f} % less to {max(fft):.0f} % more up to 257², "
    yield f"more up to 257², {span(fine, '.0f')} % more on 513²"
    gain = [1.0 / over("wave", "default, extrapolated", n, "error") for n in (257, 513)]
    more = [1.0 / over(RESOLVED, "default, extrapolated", n, "error") for n in (257, 513)]
    yield f"gains {span(gain, '.1f')} in the wave; on the resolved surface {more[1]:.1f} on 513²"
    assert more[0] < 1.1
    cost = [over("wave", "default, extrapolated", n) for n in (257, 513)]
    assert cost == pytest.approx([1.2, 1.125], abs=0.01)
    yield "it costs an eighth (513²) to a fifth (257²)"
    whole = [number("fractal", f"default{end}", 513, "error") for end in ("", ", extrapolated")]
    yield f"513² has {percent(100 * whole[0])} and the extrapolated value {percent(100 * whole[1])}"
    second = [float(rows["smooth", "default", n, "2"]["seconds"]) for n in ("513", "1025")]
    first = [number("smooth", "default", n) for n in (513, 1025)]
    most = max(100.0 * (b / a - 1.0) for a, b in zip(first, second, strict=True))
    yield f"up to {most:.0f} % more in the smooth contact"


def robustness(read: Read) -> Iterator[str]:
    """How the random cases end, and what the second solver says of them."""
    rows = read("stress/table.csv")
    ended = Counter((row["outcome"] == "converged", row["second"]) for row in rows)
    assert ended[True, "differs"] == ended[False, "has a solution"] == 0
    none, open_ = ended[False, "no solution"], ended[False, "not solved either"]
    yield f"{ended[True, 'same']} that had converged are the same there"
    yield f"Of the {none + open_} that had not, {none} have a negative film in the second"
    yield f"{open_} it does not solve either"
    for outcome in ("cycle limit", "diverged"):
        kinds = {r["family"]: r for r in rows if r["outcome"] == outcome}
        wave, rest = (
            f"({float(kinds[n]['moes_m']):.0f}, {float(kinds[n]['moes_l']):g})"
            for n in ("wave", "rest")
        )
        yield f", 2 cases: a wave at {wave} and one at rest at {rest}"
    for points, most in ((65, 960), (129, 3800)):
        assert 0.16 * most * (4.0 / (points - 1)) ** 2 == pytest.approx(0.6, rel=0.02)


def speed(read: Read) -> Iterator[str]:
    """The finest run, and the cycle that an ellipse does without."""
    (run,) = (r for r in read("speed/runs.csv") if (r["points"], r["case"]) == ("513", "fractal"))
    yield f"took {run['units']} units of {1e3 * float(run['unit_seconds']):.0f} ms"
    ends = {
        row["case"]: int(row["cycles"])
        for row in read("speed/ratios.csv")
        if row["case"] in ("circle", "ellipse") and row["points"] == "257"
    }
    assert ends["circle"] - ends["ellipse"] == 1
    yield "which needed a cycle less on 257 nodes"


def coarse_film(read: Read) -> Iterator[str]:
    """What the grid takes of the central film."""
    (error,) = (
        float(row["error"])
        for row in read("speed/smooth.csv")
        if (row["points"], row["engine"], row["threads"]) == ("257", "mlmi", "1")
    )
    yield f"H_c is {100.0 * error:.0f} % low at 257 × 257"


@pytest.mark.parametrize(
    ("page", "said"),
    [
        ("docs/robustness.md", robustness),
        ("docs/speed.md", speed),
        ("fortran/README.md", coarse_film),
        ("docs/evidence/start/README.md", starts),
        ("docs/evidence/stress/README.md", stress),
        ("docs/evidence/workprec/README.md", workprec),
    ],
)
def test_the_page_says_what_its_record_has(root: Path, page: str, said: Said):
    assert missing(root, page, said) == []
