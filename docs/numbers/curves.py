# SPDX-License-Identifier: BSD-3-Clause
"""Numbers of the how-tos of Stribeck and traction curves."""

from __future__ import annotations

import numpy as np
from records import Row, Values, of, read, script

SMOOTH, TABLE, SHORT = "smooth", "table 1", "short waves x 10"
FULL, BROKEN = "full film", "film breakdown"


def stribeck() -> Values:
    """Curves by surface, law and slide-to-roll ratio; each has ten points of increasing speed."""
    make = script("stribeck/make.py")
    stored = make.stored()
    data = {
        (surface, law, slip): list(make.rows(stored, surface, law, slip))
        for surface in make.SURFACES
        for law in make.LAWS
        for slip in make.SLIPS
    }
    assert [len(rows) for rows in data.values()] == [10] * 18

    def speed(row: Row) -> float:
        return float(row["contact.mean_velocity"])

    # 1: slip is decisive
    slow, fast = (data[SMOOTH, "eyring", slip][3] for slip in (0.02, 0.3))
    increases = [
        float(row["mu_ratio"]) - 1.0
        for (surface, law, _), rows in data.items()
        for row in rows
        if surface != SMOOTH and law == "eyring" and row["status"] == FULL
    ]
    assert len(increases) > 40
    assert 0.0 < max(increases) <= 0.003
    # 2: heat
    hot = data[SMOOTH, "eyring", 0.3]
    friction, isothermal = of(hot, "mu"), of(hot, "mu_isothermal")
    assert np.all(np.diff(friction) < 0.0)
    # 3, 4: where full film ends
    table, short = data[TABLE, "eyring", 0.02], data[SHORT, "eyring", 0.02]
    height = float(table[0]["lambda_ratio"]) / float(short[0]["lambda_ratio"])
    broken, full = ([row for row in short if row["status"] == end] for end in (BROKEN, FULL))
    assert speed(broken[-1]) < speed(full[0])
    assert {row["status"] for row in table} == {FULL}
    assert short[4] in broken
    # 5: a friction ratio depends on slip
    ratios = [float(data[TABLE, "newtonian", slip][3]["mu_ratio"]) for slip in (0.02, 0.1, 0.3)]
    falls = of(data[TABLE, "newtonian", 0.02], "mu_ratio")
    assert np.all(np.diff(falls) < 0.0)
    return locals()


def traction() -> Values:
    """Friction over the slide-to-roll ratio, and an empirical law for thin films."""
    rows, thin = read("traction/traction.csv"), read("traction/empirical.csv")
    mu, slip = of(rows, "mu"), of(rows, "contact.slide_to_roll")
    film = 1e9 * of(rows, "h_c_m")
    top = int(np.nanargmax(mu))
    flat = mu[(slip > 0.06) & (slip < 0.19)]
    hottest, isothermal = (float(rows[-1][n]) for n in ("temperature_rise_max_K", "mu_isothermal"))
    empirical, share = of(thin, "mu_empirical"), of(thin, "asperity_load_share_empirical")
    fast = of(thin, "contact.mean_velocity") >= 0.5
    assert np.all(np.abs(empirical[fast] / of(thin, "mu")[fast] - 1.0) < 0.004)
    return locals()
