# SPDX-License-Identifier: BSD-3-Clause
"""The prediction compared with simulations and measurements."""

from __future__ import annotations

import numpy as np
from records import Values, largest, of, percent, read, span

from pyehl.theory.operating import OperatingPoint


def measured() -> Values:
    """Mean films near a dimple by interferometry and by pyehl."""
    rows = [
        row
        for row in read("films/table.csv")
        if row["source"] == "measured" and row["quantity"] in ("plateau", "behind", "ahead")
    ]
    off = 100.0 * np.abs(of(rows, "pyehl_nm") / of(rows, "theirs_nm") - 1.0)
    worst = rows[int(off.argmax())]
    assert (worst["quantity"], worst["ssr"]) == ("ahead", "-0.5")
    count, middle, most = len(rows), f"{np.median(off):.0f}", f"{off.max():.0f}"
    return locals()


def share_of_contact() -> Values:
    """Load shares of predictions compared with those of the solver."""
    rows = read("partial/table.csv")
    share, result = of(rows, "contact_load_share_now"), of(rows, "contact_load_share")
    assert np.mean(np.abs(share - result) <= 0.0305) > 0.7
    assert abs(np.max(share[result > 0.1] / result[result > 0.1]) - 2.0) < 0.05
    return locals()


def mixed() -> Values:
    """Accuracy of predicted load shares, and their change with the mesh."""
    rows = read("partial/table.csv")
    blind, others = ([r for r in rows if (r["name"][0] == "d") == first] for first in (True, False))
    worst = np.abs(of(blind, "contact_load_share_predicted") - of(blind, "contact_load_share"))
    covered = int(np.sum(worst <= of(blind, "stated_error")))
    off = np.abs(of(others, "contact_load_share_now") - of(others, "contact_load_share"))
    covered += int(np.sum(off <= of(others, "stated_error")))
    named = [row for row in others if row["name"] in ("c5", "c11", "c14")]
    over = of(named, "contact_load_share_now") / of(named, "contact_load_share")
    most = max(of(read("mixed_curve/curve.csv"), "contact_load_share"))
    shares = {
        (row["contact"], float(row["boundary_film"]), int(row["points"])): float(
            row["contact_load_share"] or "nan"
        )
        for row in read("contact/shares.csv")
    }
    falls = {
        points: [
            100.0 * abs(1.0 - share / shares[(*key[:2], points // 2 + 1)])
            for key, share in shares.items()
            if key[2] == points
        ]
        for points in (513, 1025)
    }
    middle, last = (f"{min(part):.0f} to {max(part):.0f} %" for part in falls.values())
    return locals()


def high_ratios() -> Values:
    """Deviations of the prediction at large ratios."""
    rows = [row for row in read("prediction/table.csv") if float(row["mu_ratio"]) > 2.5]
    return locals()


def left_out() -> Values:
    """T at operating points outside the fit; the corner (100, 3) is the worst."""
    rows = read("response/leave_out.csv")
    slow, slip = of(rows, "slow"), of(rows, "slip")
    corners = [r["moes_m"] in ("100", "3000") or r["moes_l"] in ("3", "20") for r in rows]
    middle = slip[~np.array(corners)]
    return locals()


def ellipses() -> Values:
    """T of measured waves, and rough surfaces with the earlier and the present model."""
    left: dict[str, dict[str, list[float]]] = {}
    for row in read("ellipse/response.csv"):
        t = complex(float(row["T_re"]), float(row["T_im"]))
        kind = {"1": "circle", "0.4": "narrow"}.get(row["ellipticity"], "others")
        for name in ("circle", "houpert", "by_rx"):
            off = t - complex(float(row[f"{name}_re"]), float(row[f"{name}_im"]))
            run = f"{kind} {row['ellipticity']} {row['moes_m']} {row['moes_l']}"
            left.setdefault(name, {}).setdefault(run, []).append(abs(off))

    def rms(name: str, *kinds: str, digits: int = 2) -> str:
        parts = [v for run, v in left[name].items() if run.split()[0] in kinds]
        return span((np.sqrt(np.mean(np.square(v))) for v in parts), f".{digits}f")

    gain = max(of(read("ellipse/sides.csv"), "predicted_gain"))
    rows = read("ellipse/table.csv")
    before, now = (of(rows, f"deviation{end}_percent") for end in ("_before", ""))
    covered = sum(row["covered_before"] == "1" for row in rows)
    low = of(rows, "mu_ratio") <= 1.5
    return locals()


def wide_predictions() -> Values:
    """Wide rough contacts, predicted before they were simulated."""
    predictions = {row["name"]: row for row in read("ellipse/wide_predicted.csv")}
    runs = [r for r in read("ellipse/wide_simulated.csv") if r["status"] == "converged"]
    rows = [run | predictions[run["name"]] for run in runs]
    result = of(rows, "mu_ratio")
    off = 100.0 * (of(rows, "prediction") / result - 1.0)
    covered = int(sum(abs(of(rows, "prediction") - result) <= of(rows, "model_error")))
    thins = np.array([row["law"] != "newtonian" for row in rows])
    along = np.array([row["lay"] == "along" for row in rows])
    grid = [100.0 * float(r["mu_ratio_error_grid"] or 0.0) / float(r["mu_ratio"]) for r in rows]
    return locals()


def slips() -> Values:
    """Waves at velocity ratios beyond the fit."""
    worst: dict[str, float] = {}
    for row in read("response/slip.csv"):
        kx, ky, x = (float(row[name]) for name in ("kx", "ky", "x"))
        if x == 0.0 and np.hypot(kx, ky) <= 2.0 * np.pi * 12.8 and kx > 2.0 * np.pi / 3.0:
            real, imaginary = (
                float(row[f"T_{n}"]) - float(row[f"predicted_{n}"]) for n in ("re", "im")
            )
            place = f"{row['moes_m']}, {row['moes_l']}"
            worst[place] = max(worst.get(place, 0.0), float(np.hypot(real, imaginary)))
    middle = max(v for k, v in worst.items() if 200.0 <= float(k.split(",")[0]) <= 1000.0)
    return locals()


def compared() -> Values:
    """The prediction and the full simulation, all cases and those drawn at random."""
    rows = read("prediction/table.csv")
    chose, drawn = ([r for r in rows if r["drawn"] == n] for n in "01")
    committed = {row["name"]: float(row["prediction"]) for row in read("prediction/committed.csv")}
    result = of(drawn, "mu_ratio")
    before = 100.0 * (np.array([committed[row["name"]] for row in drawn]) / result - 1.0)
    now = of(drawn, "deviation_percent")
    rms, rms_now = (f"{np.sqrt(np.mean(part**2)):.1f}" for part in (before, now))
    low = [row for row in rows if float(row["mu_ratio"]) <= 1.5]
    worst = max(low, key=lambda row: abs(float(row["deviation_percent"])))
    assert worst["name"] == "u108l4"
    stated = [row for row in rows if row["mu_ratio_error"]]
    coarse = [r for r in stated if float(r["mu_ratio_error"]) > 0.05 * float(r["mu_ratio"])]
    assert not any(row["drawn"] == "1" for row in coarse)
    fine = [row for row in rows if row["mu_ratio_1025"]]
    means = [
        percent(float(np.mean(of(fine, name))))
        for name in ("deviation_percent", "deviation_1025_percent")
    ]
    return locals()


def pairs() -> Values:
    """Pairs of rough surfaces that were predicted before they were simulated."""
    rows = read("pairs/table.csv")
    slip, ratio, off = (of(rows, n) for n in ("slide_to_roll", "mu_ratio", "deviation_percent"))
    assert all(row["covered"] == "1" for row in rows)
    return locals()


def by_ratio() -> Values:
    """Deviations of the prediction and of the paper's model, by the simulated ratio."""
    rows = read("prediction/table.csv")
    ends = {"up to 1.3": (0.0, 1.3), "1.3 to 1.6": (1.3, 1.6), "1.6 to 2.5": (1.6, 2.5)}
    ends["above 2.5"] = (2.5, 9.9)
    lines = {}
    for head, (low, high) in ends.items():
        part = [row for row in rows if low < float(row["mu_ratio"]) <= high]
        ours, paper = (of(part, f"{n}deviation_percent") for n in ("", "paper_"))
        cells = percent(ours.mean()), f"{largest(ours, 1)} %", percent(paper.mean())
        lines[head] = " | ".join((str(len(part)), *cells))
    assert sum(int(line.split()[0]) for line in lines.values()) == len(rows)
    example = {row["name"]: row for row in rows if row["name"].startswith("t1s21")}
    return locals()


def finest() -> Values:
    """Surfaces on 1025 x 1025 nodes."""
    rows = [row for row in read("prediction/table.csv") if row["mu_ratio_1025"]]
    inside = 0
    lines = {}
    for row in rows:
        coarse, fine = float(row["mu_ratio"]), float(row["mu_ratio_1025"])
        error, error_fine = float(row["mu_ratio_error"]), float(row["mu_ratio_error_1025"])
        inside += abs(fine - coarse) <= error
        lines[row["name"]] = (
            f"{coarse:.4f} ± {error:.2g} "
            f"| {percent(float(row['deviation_percent']), 2)} | {fine:.4f} ± {error_fine:.2g} "
            f"| {percent(float(row['deviation_1025_percent']), 2)}"
        )
    coarse, fine = (of(rows, f"deviation{n}_percent").mean() for n in ("", "_1025"))
    return locals()


def surfaces() -> Values:
    """Ranges of the simulated surfaces."""
    rows = read("prediction/cases.csv")
    m, ell, ratio, hurst = (of(rows, n) for n in ("moes_m", "moes_l", "velocity_ratio", "hurst"))
    tiles = [
        float(r["length"])
        / OperatingPoint(float(r["load"]), float(r["mean_velocity"])).hertz_radius
        for r in rows
    ]
    return locals()


def pair_ranges() -> Values:
    """The table of the pairs by their ratio."""
    rows = read("pairs/table.csv")
    lines = {}
    for head, low, high in (("up to 1.5", 0.0, 1.5), ("1.5 to 2.5", 1.5, 2.5)):
        off = of([r for r in rows if low < float(r["mu_ratio"]) <= high], "deviation_percent")
        cells = percent(off.mean()), percent(np.sqrt((off**2).mean())), f"{largest(off, 1)} %"
        lines[head] = " | ".join((str(len(off)), *cells))
    return locals()


def all_positions() -> Values:
    """The two pairs that sample all relative positions."""
    table = read("pairs/table.csv")
    m, ell, slip = (of(table, name) for name in ("moes_m", "moes_l", "slide_to_roll"))
    most = 0.5 * max(slip)
    rows = [row for row in read("pairs/cases.csv") if row["name"][0] == "n"]
    assert [row["name"] for row in rows] == ["n30ff", "n10wf"]
    slower = [float(row["second_tiles"]) for row in rows]
    for tiles, lasts, passages in zip(slower, (14, 16), (17, 19), strict=True):
        assert abs(tiles * lasts - passages) < 1e-6
    return locals()


def partial_rows() -> Values:
    """Every contact of the evidence on boundary films, as rows of the tables."""
    names = ("contact_load_share", "contact_area_share", "mu")
    lines = {}
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
        head = f"{row['points']} | {float(row['moes_m']):g} | {float(row['slide_to_roll']):g}"
        lines[row["name"]] = f"{head} | {load} | {errors} | {area} | {friction}"
    moes_m, slip = (of(read("partial/table.csv"), name) for name in ("moes_m", "slide_to_roll"))
    return locals()


def strips() -> Values:
    """Rough strips of line contacts, predicted before they were simulated."""
    said = {row["name"]: row for row in read("prediction_lines/committed.csv")}
    rows = read("prediction_lines/simulated.csv")
    table = [
        "| strip | M, L | predicted | simulated | deviation | stated error |",
        "|" + "---|" * 6,
    ]
    covered = 0
    for row in rows:
        one = said[row["name"]]
        p, error, s = (
            float(v) for v in (one["mu_ratio"], one["mu_ratio_model_error"], row["mu_ratio"])
        )
        covered += abs(p - s) <= error
        table.append(
            f"| {row['name']} | {row['moes_m']}, {row['moes_l']} | {p:.4f} | {s:.4f} | "
            f"{percent(100.0 * (p / s - 1.0), 2)} | {100.0 * error / s:.1f} % |"
        )
    return {"rows": rows, "table": "\n".join(table), "covered": covered}
