# SPDX-License-Identifier: BSD-3-Clause
"""Figures in accuracy, limits and theory beside the records that they are from."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from records import Read, Row, Said, missing, of, span
from scipy.optimize import brentq

from pyehl.theory.ellipse import ellipse


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
    widths: dict[tuple[str, ...], dict[str, Row]] = {}
    for row in read("errors/ratios.csv"):
        wave = tuple(row[n] for n in ("moes_m", "moes_l", "amplitude", "wavelength"))
        widths.setdefault((*wave, row["velocity_ratio"]), {})[row["width"]] = row
    shares = [
        abs(float(two["4.0"]["mu_ratio"]) - float(two["8.0"]["mu_ratio"]))
        / float(two["4.0"]["mu_ratio_error_domain"])
        for two in widths.values()
    ]
    assert len(shares) == 9
    yield f"on domains of 4 a and 8 a with P = 0 changed by {span(shares, '.2f')} of that"
    plain, better = (
        float(row["error"])
        for end in ("", ", extrapolated")
        for row in read("workprec/workprec.csv")
        if row["setting"] == f"default{end}"
        and (row["quantity"], row["points"], row["threads"]) == ("H_c", "513", "1")
    )
    assert better < 1e-3
    yield f"H_c is within {100.0 * plain:.1f} % of its limit for fine grids. The extrapolated"
    paper, usual = (
        float(row["pyehl"])
        for row in read("paper/table.csv")
        if (row["piece"], row["grid"]) == ("figure 2", "513")
        and row["paper"] in ("1.461", "1.4631")
    )
    yield f"μ_r/μ_s is {paper:.3f} ± 0.003"
    yield f"gives {usual:.3f} (`tests/cases/test_waviness.py`)"
    fine = {row["name"]: float(row["mu_ratio"]) for row in read("prediction/cases.csv")}
    coarse = read("prediction/coarse.csv")
    rise = np.array([fine[row["name"]] for row in coarse]) - of(coarse, "mu_ratio")
    yield f"the value on 513 × 513 nodes is {rise.min():.2f} to {rise.max():.2f} higher"
    grid = of(coarse, "grid_error")
    yield f"the error from the two grids alone is {grid.min():.2f} to {grid.max():.2f};"


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
    yield f"κ = 0.1 M is {ten:.1f} times that by R_x, at 1/30 it is {thirty:.0f} times"


def starts(read: Read) -> Iterator[str]:
    """Steps of runs that start from the prediction, over those of others."""
    rows = [row for row in read("start/scenes.csv") if "slide-to-roll" not in row["scene"]]
    share = of(rows, "steps") / of(rows, "steps_front")
    yield f"That takes {share.min():.2f} to {share.max():.2f} of the steps"


@pytest.mark.parametrize(
    ("page", "said"),
    [
        ("docs/accuracy.md", accuracy),
        ("docs/limits.md", limits),
        ("docs/theory/transient.md", starts),
    ],
)
def test_the_page_says_what_its_record_has(root: Path, page: str, said: Said):
    assert missing(root, page, said) == []
