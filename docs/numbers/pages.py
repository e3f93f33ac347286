# SPDX-License-Identifier: BSD-3-Clause
"""Numbers of the pages on accuracy, limits and theory."""

from __future__ import annotations

import numpy as np
from records import Row, Values, of, read
from scipy.optimize import brentq

from pyehl.theory.ellipse import ellipse


def accuracy() -> Values:
    """Domains, errors on 129² nodes, waves that 257² nodes do not resolve."""
    rows = [row for row in read("errors/smooth.csv") if row["H_c"] and row["H_c_doubled"]]
    change = 100.0 * np.abs(of(rows, "H_c") / of(rows, "H_c_doubled") - 1.0)
    light = of(rows, "moes_m") < 500.0
    for name in ("H_c", "H_min"):
        off = np.abs(of(rows, name) - of(rows, f"{name}_doubled"))
        assert np.all(off <= of(rows, f"{name}_error"))
    known = [
        row
        for row in read("errors/rough.csv")
        if row["mu_ratio_error"] and row["mu_ratio_limit"] and row["points"] == "129"
    ]
    off = np.abs(of(known, "mu_ratio") - of(known, "mu_ratio_limit"))
    good = int(np.sum(off <= 2.0 * of(known, "mu_ratio_error")))
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
    plain, better = (
        float(row["error"])
        for end in ("", ", extrapolated")
        for row in read("workprec/workprec.csv")
        if row["setting"] == f"default{end}"
        and (row["quantity"], row["points"], row["threads"]) == ("H_c", "513", "1")
    )
    assert better < 1e-3
    paper, usual = (
        float(row["pyehl"])
        for row in read("paper/table.csv")
        if (row["piece"], row["grid"]) == ("figure 2", "513")
        and row["paper"] in ("1.461", "1.4631")
    )
    fine = {row["name"]: float(row["mu_ratio"]) for row in read("prediction/cases.csv")}
    coarse = read("prediction/coarse.csv")
    rise = np.array([fine[row["name"]] for row in coarse]) - of(coarse, "mu_ratio")
    grid = of(coarse, "grid_error")
    return locals()


def limits() -> Values:
    """A rough ball on a disc with films as thin as its roughness, and narrow contacts."""
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
    films, errors, there = (
        1e9 * of(rows, name)
        for rows, name in (
            (said, "h_min_rough_m"),
            (said, "h_min_rough_error_m"),
            (fine, "h_min_rough_m"),
        )
    )
    # M of the round contact with the same equations over M by R_x
    narrow = [
        ellipse(brentq(lambda d, kappa=kappa: ellipse(d).ellipticity - kappa, 1.0, 1e3))
        for kappa in (0.1, 1.0 / 30.0)
    ]
    ten, thirty = (1.0 / (e.ellipticity * e.kernel_ratio**0.25) for e in narrow)
    return locals()


def starts() -> Values:
    """Steps of runs that start from the prediction over those that start behind a front."""
    rows = [row for row in read("start/problems.csv") if "slide-to-roll" not in row["problem"]]
    share = of(rows, "steps") / of(rows, "steps_front")
    return locals()
