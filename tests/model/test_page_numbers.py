# SPDX-License-Identifier: BSD-3-Clause
"""Figures in the pages beside the records that they are from: what a record says stands there."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from records import Read, Said, largest, missing, of, percent
from scipy.optimize import brentq

from pyehl.theory.ellipse import ellipse


def compared(read: Read) -> Iterator[str]:
    """The prediction and the full simulation, all cases and those drawn at random."""
    rows = read("prediction/table.csv")
    yield f"{len(rows)} rough surfaces were simulated on 513 × 513 nodes"
    chose, drawn = ([r for r in rows if r["drawn"] == n] for n in "01")
    yield f"covers {sum(r['covered'] == '1' for r in chose)} of these {len(chose)} deviations"
    committed = {row["name"]: float(row["prediction"]) for row in read("prediction/committed.csv")}
    found = of(drawn, "mu_ratio")
    before = 100.0 * (np.array([committed[row["name"]] for row in drawn]) / found - 1.0)
    now = of(drawn, "deviation_percent")
    rms, rms_now = (f"{np.sqrt(np.mean(part**2)):.1f}" for part in (before, now))
    yield f"deviate by {rms} % (rms) and {largest(before, 1)} % at the most"
    yield f"those of this version by {rms_now} and {largest(now, 1)} %"
    yield f"covers {sum(r['covered'] == '1' for r in drawn)} of {len(drawn)}."
    low = [row for row in rows if float(row["mu_ratio"]) <= 1.5]
    worst = max(low, key=lambda row: abs(float(row["deviation_percent"])))
    assert worst["name"] == "u108l4"
    yield f"the largest deviation, {percent(float(worst['deviation_percent']))}, is that"
    yield f"(L = {float(worst['moes_l']):g}, U_rat = {float(worst['velocity_ratio']):.2f})"
    fine = [row for row in rows if row["mu_ratio_1025"]]
    for name, words in (("deviation_percent", "deviates by {} in"), ("deviation_1025_percent", "")):
        mean = percent(float(np.mean(of(fine, name))))
        yield (words or "deviates by {}: it is a little too low").format(mean)


def finest(read: Read) -> Iterator[str]:
    """Surfaces on 1025 x 1025 nodes."""
    rows = [row for row in read("prediction/table.csv") if row["mu_ratio_1025"]]
    inside = 0
    for row in rows:
        coarse, fine = float(row["mu_ratio"]), float(row["mu_ratio_1025"])
        error, error_fine = float(row["mu_ratio_error"]), float(row["mu_ratio_error_1025"])
        inside += abs(fine - coarse) <= error
        yield (
            f"| {row['name']} | {coarse:.4f} ± {error:.2g} "
            f"| {percent(float(row['deviation_percent']), 2)} | {fine:.4f} ± {error_fine:.2g} "
            f"| {percent(float(row['deviation_1025_percent']), 2)} |"
        )
    yield f"covers the change to 1025 × 1025 in {inside} of {len(rows)}"


def even_part(read: Read) -> Iterator[str]:
    """The pressure of second order beside the even part of the simulated one."""
    whole, cut = read("prediction/even.csv")
    yield f"a correlation of {float(cut['correlation']):.2f} with this $P_2$"
    yield f"of {float(whole['correlation']):.2f} with them, and $P_2$ makes six tenths"
    for row in (whole, cut):
        share = float(row["effect_second"]) / float(row["effect_even"])
        assert share == pytest.approx(0.6, abs=0.05)


def accuracy(read: Read) -> Iterator[str]:
    """Domains, errors on 129² nodes, waves that 257² nodes leave out."""
    rows = [row for row in read("errors/smooth.csv") if row["H_c"] and row["H_c_doubled"]]
    change = 100.0 * np.abs(of(rows, "H_c") / of(rows, "H_c_doubled") - 1.0)
    light = of(rows, "moes_m") < 500.0
    yield f"changes H_c by at most {change[light].max():.2f} % below M = 500"
    yield f"and by {change[~light].max():.1f} % from there on (at L = 25)"
    for name in ("H_c", "H_min"):
        off = np.abs(of(rows, name) - of(rows, f"{name}_doubled"))
        assert np.all(off <= of(rows, f"{name}_error"))
    yield f"cover that in all of {len(rows)} results"
    known = [
        row
        for row in read("errors/rough.csv")
        if row["mu_ratio_error"] and row["mu_ratio_limit"] and row["points"] == "129"
    ]
    off = np.abs(of(known, "mu_ratio") - of(known, "mu_ratio_limit"))
    good = int(np.sum(off <= 2.0 * of(known, "mu_ratio_error")))
    yield f"On 129² nodes alone it is {good} of {len(known)}."
    fine = {row["name"]: float(row["mu_ratio"]) for row in read("prediction/cases.csv")}
    coarse = read("prediction/coarse.csv")
    rise = np.array([fine[row["name"]] for row in coarse]) - of(coarse, "mu_ratio")
    yield f"the value on 513 × 513 nodes is {rise.min():.2f} to {rise.max():.2f} higher"
    grid = of(coarse, "grid_error")
    yield f"the error from the two grids alone is {grid.min():.2f} to {grid.max():.2f},"


def limits(read: Read) -> Iterator[str]:
    """The rough ball on a disc whose films are as thin as its roughness, and narrow contacts."""
    said, runs = (
        [
            row
            for row in read(f"thin_film/{name}.csv")
            if row["flow"] == "consistent" and row["speed"] == "6"
        ]
        for name in ("predicted", "simulated")
    )
    fine = [row for row in runs if row["points"] == "513"]
    assert [row["seed"] for row in fine] == [row["seed"] for row in said] == ["1", "2"]
    assert np.all(np.abs(of(said, "mu_ratio") / of(fine, "mu_ratio") - 1.0) <= 0.005)
    yield "agree in friction within 0.5 %"
    films, errors, there = (
        1e9 * of(rows, name)
        for rows, name in (
            (said, "h_min_rough_m"),
            (said, "h_min_rough_error_m"),
            (fine, "h_min_rough_m"),
        )
    )
    yield f"{films[0]:.0f} and {films[1]:.0f} ± {errors[1]:.0f} nm, are above those"
    yield f"{there[0]:.0f} and {there[1]:.0f} nm"
    # M of the round contact with the same equations over M by R_x
    narrow = [
        ellipse(brentq(lambda d, kappa=kappa: ellipse(d).ellipticity - kappa, 1.0, 1e3))
        for kappa in (0.1, 1.0 / 30.0)
    ]
    ten, thirty = (1.0 / (e.ellipticity * e.kernel_ratio**0.25) for e in narrow)
    yield f"at κ = 0.1 M is {ten:.1f} times that by R_x, at 1/30 it is {thirty:.0f} times"


def starts(read: Read) -> Iterator[str]:
    """Steps of runs that start from the prediction, over those of others."""
    rows = [row for row in read("start/scenes.csv") if "slide-to-roll" not in row["scene"]]
    share = of(rows, "steps") / of(rows, "steps_front")
    yield f"That takes {share.min():.2f} to {share.max():.2f} of the steps"


def partial_rows(read: Read) -> Iterator[str]:
    """Every contact of the evidence of boundary films, in the tables of its page."""
    names = ("contact_load_share", "contact_area_share", "mu")
    for row in read("partial/table.csv"):
        then = "predicted" if row["name"].startswith("d") else "now"
        load, area, friction = (
            ", ".join(
                f"{float(row[key]):.{4 if name == 'mu' else 3}f}"
                for key in (f"{name}_{then}", name)
            )
            for name in names
        )
        errors = ", ".join(f"{float(row[key]):.3f}" for key in ("stated_error", "simulation_error"))
        head = f"| {row['name']} | {row['points']} | {float(row['moes_m']):g} "
        yield f"{head}| {float(row['slide_to_roll']):g} | {load} | {errors} | {area} | {friction} |"
    moes_m, slip = (of(read("partial/table.csv"), name) for name in ("moes_m", "slide_to_roll"))
    yield f"M from {moes_m.min():g} to {moes_m.max():g},"
    yield f"slide-to-roll ratios from {slip.min():g} to {slip.max():g}."


def mixed(read: Read) -> Iterator[str]:
    """How good the load share of a prediction is, and how it changes with the mesh."""
    rows = read("partial/table.csv")
    blind, others = ([r for r in rows if (r["name"][0] == "d") == told] for told in (True, False))
    off = np.abs(of(blind, "contact_load_share_predicted") - of(blind, "contact_load_share"))
    covered = int(np.sum(off <= of(blind, "stated_error")))
    yield f"the load share is right to {off.max():.3f} of the load in all of them"
    off = np.abs(of(others, "contact_load_share_now") - of(others, "contact_load_share"))
    covered += int(np.sum(off <= of(others, "stated_error")))
    yield f"The stated error covers {covered} of these {len(rows)}"
    shares = {
        (row["contact"], float(row["boundary_film"]), int(row["points"])): float(
            row["contact_load_share"] or "nan"
        )
        for row in read("contact/shares.csv")
    }
    falls = {
        points: [
            100.0 * (1.0 - share / shares[(*key[:2], points // 2 + 1)])
            for key, share in shares.items()
            if key[2] == points
        ]
        for points in (513, 1025)
    }
    middle, last = (f"{min(part):.0f} to {max(part):.0f} %" for part in falls.values())
    yield f"changes by {middle} of itself from 257 to 513 nodes"
    yield f"by {last} to 1025"


def pairs(read: Read) -> Iterator[str]:
    """Pairs of rough surfaces that were predicted before they were simulated."""
    rows = read("pairs/table.csv")
    slip, ratio, off = (of(rows, n) for n in ("slide_to_roll", "mu_ratio", "deviation_percent"))
    yield (
        f"{len(rows)} pairs, with slide-to-roll ratios from {slip.min():g} to {slip.max():g} "
        f"and ratios from {ratio.min():.2f} to {ratio.max():.2f},"
    )
    yield f"The largest deviation is {largest(off, 1)} %"
    assert all(row["covered"] == "1" for row in rows)


def pair_ranges(read: Read) -> Iterator[str]:
    """The table of the pairs by their ratio."""
    rows = read("pairs/table.csv")
    for head, low, high in (("up to 1.5", 0.0, 1.5), ("1.5 to 2.5", 1.5, 2.5)):
        off = of([r for r in rows if low < float(r["mu_ratio"]) <= high], "deviation_percent")
        cells = percent(off.mean()), percent(np.sqrt((off**2).mean())), f"{largest(off, 1)} %"
        yield f"| {head} | {len(off)} | {' | '.join(cells)} |"


def high_ratios(read: Read) -> Iterator[str]:
    """How far the prediction is off where the ratio is large."""
    rows = [row for row in read("prediction/table.csv") if float(row["mu_ratio"]) > 2.5]
    yield f"above 2.5 by {-of(rows, 'deviation_percent').mean():.1f} % in the mean"


def introduction(read: Read) -> Iterator[str]:
    """The number of surfaces in the picture."""
    yield f"*Friction of {len(read('prediction/table.csv'))} rough contacts over that of"


@pytest.mark.parametrize(
    ("page", "said"),
    [
        ("README.md", introduction),
        ("docs/accuracy.md", accuracy),
        ("docs/limits.md", limits),
        ("docs/howto/mixed.md", mixed),
        ("docs/theory/prediction.md", high_ratios),
        ("docs/theory/prediction-compared.md", compared),
        ("docs/theory/prediction-second-order.md", even_part),
        ("docs/theory/prediction-pairs.md", pairs),
        ("docs/theory/transient.md", starts),
        ("docs/evidence/prediction/README.md", finest),
        ("docs/evidence/pairs/README.md", pair_ranges),
        ("docs/evidence/partial/README.md", partial_rows),
    ],
)
def test_the_page_says_what_its_record_has(root: Path, page: str, said: Said):
    assert missing(root, page, said) == []
