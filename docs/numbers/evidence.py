# SPDX-License-Identifier: BSD-3-Clause
"""Pages of docs/evidence: contact, ellipses, errors, fields, mixed films, response."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import pandas as pd
from records import Row, Values, largest, of, read, span

from pyehl.prediction import model
from pyehl.prediction.mixed_lubrication import TOUCHING_FILM_ERROR
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transition import lift_off

NOW, BEFORE = "deviation_percent", "deviation_before_percent"
ADDED = ("k040c", "k040d", "k050b", "k350", "k040e", "k060b")


def contact() -> Values:
    """Friction, and thinner boundary films."""
    rows = {
        (row["boundary_film"], row["points"]): row
        for row in read("contact/shares.csv")
        if row["contact"] == "light"
    }
    pairs = [
        " and ".join(f"{float(rows[layer, n]['mu']):.4f}" for n in ("257", "513"))
        for layer in ("4e-08", "8e-08")
    ]
    share = {key: float(row["contact_load_share"]) for key, row in rows.items()}
    heavy, light = (OperatingPoint(load=load, mean_velocity=0.1).moes_m for load in (600.0, 100.0))
    assert round(share["8e-08", "513"] / share["4e-08", "513"]) == 8
    assert round(share["4e-08", "257"] / share["2e-08", "257"], -1) == 40
    return locals()


def ellipse() -> Values:
    """Simulated cases, blind predictions, and the errors that remain."""
    rows, cases = read("ellipse/table.csv"), read("ellipse/cases.csv")
    moes_m, moes_l, ratio = (of(rows, n) for n in ("moes_m", "moes_l", "velocity_ratio"))
    whole = [row["name"] for row in cases if row["shortest_wavelength"] == "0"]
    assert (len(whole), len(cases)) == (6, 30)
    blind = [row for row in rows if row["name"][0] == "r"]
    low, high = (
        largest(of([r for r in blind if (float(r["mu_ratio"]) <= 1.5) is small], BEFORE), 1)
        for small in (True, False)
    )
    assert all(row["covered_before"] == "1" for row in blind)
    covered = sum(row["covered_before"] == "1" for row in rows)
    first = [r for r in rows if r["name"] not in ADDED and r["name"][0] == "k"]
    assert len(first) == 14
    assert all(row["covered_before"] == "1" for row in first)
    assert [r["name"] for r in rows if r["covered_before"] == "0"] == ["k040c", "k050b"]
    worst = sorted(rows, key=lambda row: -abs(float(row["deviation_percent"])))[:2]
    assert [row["name"] for row in worst] == ["r09", "k070"]
    (gain,) = (
        f"{row['predicted_gain']} of {row['gain']}"
        for row in read("ellipse/sides.csv")
        if (row["ellipticity"], row["wavelength"], row["y"]) == ("1", "0.5", "0")
    )
    known = [float(r["mu_ratio_error"]) for r in rows if r["name"] in whole]
    off = [
        100.0 * (float(row["predicted_pressure"]) / float(row["pressure"]) - 1.0)
        for row in read("ellipse/ridges.csv")
        if row["wavelength"] == "1" and float(row["ellipticity"]) < 1.0
    ]
    term = model.NARROW
    return locals()


def ellipse_waves() -> Values:
    """T of the circles that may replace an ellipse, and the mean pressure."""
    runs = defaultdict(list)
    for row in read("ellipse/response.csv"):
        key = (row[n] for n in ("ellipticity", "moes_m", "moes_l", "velocity_ratio"))
        runs[tuple(map(float, key))].append(row)
    worst: dict[bool, float] = {False: 0.0, True: 0.0}
    lines = {}
    for (kappa, m, ell, ratio), rows in runs.items():
        t = of(rows, "T_re") + 1j * of(rows, "T_im")
        off = [
            np.abs(of(rows, f"{n}_re") + 1j * of(rows, f"{n}_im") - t)
            for n in ("circle", "dry", "houpert", "by_rx")
        ]
        cells = [f"{np.sqrt(np.mean(np.square(one))):.3f}" for one in off]
        lines[f"{kappa:g}; {m:g}, {ell:g}; {ratio:g}"] = " | ".join(cells)
        mean = np.mean(of(rows, "circle_pressure") / of(rows, "pressure") - 1.0)
        worst[kappa == 0.4] = max(worst[kappa == 0.4], abs(100.0 * float(mean)))
    return locals()


def rough_errors() -> Values:
    """Contacts without a stated error of the ratio, and the largest error not covered."""
    known: dict[tuple[str, ...], list[Row]] = defaultdict(list)
    names = ("moes_m", "moes_l", "kind", "wavelength", "width", "amplitude_over_film")
    for row in read("errors/rough.csv"):
        known[tuple(row[n] for n in (*names, "velocity_ratio"))].append(row)
    without = [
        rows
        for rows in known.values()
        if not any(row["mu_ratio_error"] and row["mu_ratio_limit"] for row in rows)
    ]
    ends = [float([row for row in rows if row["mu_ratio"]][-1]["mu_ratio"]) for rows in without]
    assert sum(end > 1e3 for end in ends) == 11
    off = {
        abs(float(row["mu_ratio"]) - float(row["mu_ratio_limit"])) / float(row["mu_ratio_error"]): (
            f"({float(row['moes_m']):.0f}, {float(row['moes_l']):.0f})"
        )
        for rows in known.values()
        for row in rows
        if row["mu_ratio_error"] and row["mu_ratio_limit"]
    }
    points = [
        len({(row["moes_m"], row["moes_l"]) for row in read(f"errors/{name}.csv")})
        for name in ("flooded", "zero")
    ]
    return locals()


def wide_ellipses() -> Values:
    """Domain errors of H_c that the estimate does not cover."""
    rows = [row for row in read("errors_ellipses/errors.csv") if row["H_c_doubled"]]
    off = np.abs(of(rows, "H_c") - of(rows, "H_c_doubled")) / of(rows, "H_c_error_domain")
    missed = [row for row, ratio in zip(rows, off, strict=True) if ratio > 1.1]
    assert all(r["border"] == "flooded" and float(r["kappa"]) > 6.0 for r in missed)
    assert all(float(row["moes_m"]) < 20.0 for row in missed)
    return locals()


def extreme_ellipses() -> Values:
    """Convergence of very narrow and very wide contacts."""
    lines: dict[str, str] = {}
    for row in read("errors_ellipses/ends.csv"):
        kappa = "1/30" if row["kappa"].startswith("0.03") else f"{float(row['kappa']):g}"
        heads = f"{float(row['moes_m']):g}", f"{float(row['moes_l']):g}", row["points"]
        ended = row["status"] == "converged"
        lines["; ".join((kappa, *heads))] = f"{row['cycles']} cycles" if ended else row["status"]
    return locals()


def fields() -> Values:
    """Slopes on the coarser grid, and the second-order part of the pressure."""
    rows = read("fields/table.csv")
    coarse = [row for row in rows if (row["points"], row["place"]) == ("257", "r < 0.4")]
    film, pressure = (100.0 * (of(coarse, f"{n}_slope") - 1.0) for n in ("film", "p"))
    there = [row for row in rows if row["place"] == "X = -0.5"]
    for row in there:
        if row["name"] in ("c16l5", "f2", "f4"):
            assert float(row["p_square"]) > 1.5 * float(row["gamma"]), row["name"]
    return locals()


def lobes() -> Values:
    """Correlations of the loss of film, and its rms, at small and large slip."""
    rows = read("fields/lobes.csv")
    lines = {}
    for names in ("g1, g4, h1, h3, h7, h8", "i1 to i6"):
        group = [row for row in rows if (row["name"][0] == "i") == (names[0] == "i")]
        slip = 2.0 * np.abs(of(group, "velocity_ratio") - 1.0)
        places = [
            span(of([r for r in group if r["place"] == place], "correlation"), ".3f")
            for place in ("r < 0.4", "lobes")
        ]
        lines[names] = " | ".join([f"{slip.min():.2g} to {slip.max():.2g}", *places])
    shares = [float(r["rms_predicted"]) / float(r["rms_simulated"]) for r in group]
    return locals()


def curve() -> Values:
    """Moes loads, and the speed at which solid contact ends."""
    rows = read("mixed_curve/curve.csv")
    speeds = of(rows, "contact.mean_velocity")
    moes_m = [OperatingPoint(load=20.0, mean_velocity=u).moes_m for u in speeds]
    names = ("contact_load_share", "contact_load_share_error", "lambda_ratio")
    result = lift_off(
        np.array(speeds),
        pd.DataFrame([{n: float(row[n]) for n in names} | {"theta_2": 1.0} for row in rows]),
    )
    assert result is not None
    assert abs(OperatingPoint(load=20.0, mean_velocity=0.195).moes_m - 100.0) < 1.0
    return locals()


def partial() -> Values:
    """The earlier version, and the width of its errors."""
    rows = read("partial/table.csv")
    share, result = of(rows, "contact_load_share_now"), of(rows, "contact_load_share")
    seen = [row for row in rows if row["name"][0] == "c" and float(row["contact_load_share"])]
    over = of(seen, "contact_load_share_predicted") / of(seen, "contact_load_share")
    high = over[over > 1.2]
    assert high.size == 9
    wide = of(rows, "stated_error")[share > 0.1] / share[share > 0.1]
    cases = read("partial/cases.csv")
    share_of_rms = TOUCHING_FILM_ERROR
    return locals()


def response() -> Values:
    """Points that the fit omits, and waves with large slip."""
    rows = read("response/leave_out.csv")
    slow, slip = of(rows, "slow"), of(rows, "slip")
    corner = int(np.nanargmax(slow))
    assert (rows[corner]["moes_m"], rows[corner]["moes_l"]) == ("100", "3")
    assert np.sum(slip <= 0.024) == 10
    far = {row["moes_m"] + row["moes_l"]: row["slip"] for row in rows if row["slip"] > "0.062"}
    said = [f"{float(far[key]):.2f}" for key in ("10003", "30003", "10020", "1003")]
    assert len(far) == len(said)
    fitted = sum(int(r["waves"]) for r in read("response/residuals.csv") if r["moes_m"])
    ridges = len(read("response/ridges.csv"))
    runs: dict[tuple[str, str], dict[str, float]] = defaultdict(dict)
    for row in read("response/slip.csv"):
        kx, q = float(row["kx"]), np.hypot(float(row["kx"]), float(row["ky"]))
        if float(row["x"]) == 0.0 and 2.0 * np.pi / q * 128.0 >= 10.0 and 2.0 * np.pi / kx < 3.0:
            real, imaginary = (
                float(row[f"T_{n}"]) - float(row[f"predicted_{n}"]) for n in ("re", "im")
            )
            off = float(np.hypot(real, imaginary))
            there = runs[row["moes_m"], row["moes_l"]]
            there[row["velocity_ratio"]] = max(off, there.get(row["velocity_ratio"], 0.0))
    lines = {}
    for (m, ell), there in runs.items():
        cells = (f"{there[u]:.3f}" if u in there else "" for u in ("0.5", "0.7", "1.3", "1.5"))
        lines[f"{m}, {ell}"] = " | ".join(cells)
        assert not 200.0 <= float(m) <= 1000.0 or max(there.values()) < 0.0505
    return locals()
