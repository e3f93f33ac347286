# SPDX-License-Identifier: BSD-3-Clause
"""What pages say of the prediction, beside the records of what was simulated and measured."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from records import Read, Said, largest, missing, of, percent, span

from pyehl.theory.operating import OperatingPoint


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
    coarse, fine = (of(rows, f"deviation{n}_percent").mean() for n in ("", "_1025"))
    yield f"by {percent(coarse)} in the mean from the coarser grid and by {percent(fine)} from"


def even_part(read: Read) -> Iterator[str]:
    """The pressure of second order beside the even part of the simulated one."""
    whole, cut = read("prediction/even.csv")
    yield f"a correlation of {float(cut['correlation']):.2f} with this $P_2$"
    yield f"of {float(whole['correlation']):.2f} with them, and $P_2$ makes six tenths"
    for row in (whole, cut):
        share = float(row["effect_second"]) / float(row["effect_even"])
        assert share == pytest.approx(0.6, abs=0.05)


def share_of_contact(read: Read) -> Iterator[str]:
    """Load shares of predictions beside those of the solver."""
    rows = read("partial/table.csv")
    share, found = of(rows, "contact_load_share_now"), of(rows, "contact_load_share")
    assert np.mean(np.abs(share - found) <= 0.0305) > 0.7
    assert np.max(share[found > 0.1] / found[found > 0.1]) == pytest.approx(2.0, abs=0.05)
    yield "mostly to 0.03 of the load, with much slip and a layer as thick as the film to a factor"


def left_out(read: Read) -> Iterator[str]:
    """T at operating points that the fit does not know; the corner (100, 3) is the worst."""
    rows = read("response/leave_out.csv")
    slow, slip = of(rows, "slow"), of(rows, "slip")
    corners = [r["moes_m"] in ("100", "3000") or r["moes_l"] in ("3", "20") for r in rows]
    middle = slip[~np.array(corners)]
    yield f"T is right to {np.nanmax(slow[1:]):.2f}, with much slip to {np.nanmax(middle):.2f},"
    yield f"of the range to {slow[0]:.2f}, with much slip to {np.nanmax(slip):.2f} ("


def ellipses(read: Read) -> Iterator[str]:
    """T of measured waves, and rough surfaces before and today."""
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

    yield f"met within {rms('circle', 'others', digits=3)} (rms; circles on the same grid "
    yield f"{rms('circle', 'circle', digits=3)}) for κ = 0.6 to 4, and within "
    yield f"within {rms('circle', 'narrow')} at κ = 0.4"
    all_but = ("others", "narrow")
    yield f"Houpert 2010 leave {rms('houpert', *all_but)}, M and L by R_x {rms('by_rx', *all_but)}."
    gain = max(of(read("ellipse/sides.csv"), "predicted_gain"))
    yield f"takes up to {100.0 * (gain - 1.0):.0f} % more pressure"
    rows = read("ellipse/table.csv")
    before, now = (of(rows, f"deviation{end}_percent") for end in ("_before", ""))
    covered = sum(row["covered_before"] == "1" for row in rows)
    yield f"{len(rows)} rough surfaces on ellipses from κ = 0.4 to 4"
    yield f"deviated by {largest(before, 1)} % at most, and the error stated then covers {covered}"
    low = of(rows, "mu_ratio") <= 1.5
    yield f"the {low.sum()} up to a ratio of 1.5 are met within {largest(now[low], 1)} %"
    yield f"and the {(~low).sum()} above within {largest(now[~low], 1)} %"


def slips(read: Read) -> Iterator[str]:
    """Waves at velocity ratios beyond the fit."""
    worst: dict[str, float] = {}
    for row in read("response/slip.csv"):
        kx, ky, x = (float(row[name]) for name in ("kx", "ky", "x"))
        if x == 0.0 and np.hypot(kx, ky) <= 2.0 * np.pi * 12.8 and kx > 2.0 * np.pi / 3.0:
            parts = (float(row[f"T_{n}"]) - float(row[f"predicted_{n}"]) for n in ("re", "im"))
            place = f"{row['moes_m']}, {row['moes_l']}"
            worst[place] = max(worst.get(place, 0.0), float(np.hypot(*parts)))
    middle = max(v for k, v in worst.items() if 200.0 <= float(k.split(",")[0]) <= 1000.0)
    one, two = (
        max(worst[k] for k in pair) for pair in (("2000, 15", "3000, 3"), ("100, 3", "100, 20"))
    )
    yield f"are met within {middle:.2f} from M = 200 to 1000, within {one:.2f} at (M, L)"
    yield f"{two:.2f} at (100, 3) and (100, 20), {worst['3000, 20']:.2f} at (3000, 20)"


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
    named = [row for row in others if row["name"] in ("c5", "c11", "c14")]
    over = of(named, "contact_load_share_now") / of(named, "contact_load_share")
    yield f"too high by a factor of {span(over, '.1f')} in three"
    most = max(of(read("mixed_curve/curve.csv"), "contact_load_share"))
    yield f"from {100.0 * most:.0f} % of the load at the boundary film to none"
    yield f"The stated error covers {covered} of these {len(rows)}"
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


def surfaces(read: Read) -> Iterator[str]:
    """What was simulated."""
    rows = read("prediction/cases.csv")
    m, ell, ratio, hurst = (of(rows, n) for n in ("moes_m", "moes_l", "velocity_ratio", "hurst"))
    yield f"{len(rows)} rough surfaces, M from {span(m, 'g')}, L from {span(ell, 'g')}, velocity"
    yield f"ratios from {span(ratio, 'g')}, Hurst exponents from {span(hurst, 'g')}"
    tiles = [
        float(r["length"])
        / OperatingPoint(float(r["load"]), float(r["mean_velocity"])).hertz_radius
        for r in rows
    ]
    yield f"tiles of {span(tiles, '.2g')} Hertz radii"


def all_positions(read: Read) -> Iterator[str]:
    """The two pairs that meet in all positions."""
    table = read("pairs/table.csv")
    m, ell, slip = (of(table, name) for name in ("moes_m", "moes_l", "slide_to_roll"))
    yield f"{len(table)} pairs, M from {span(m, 'g')}, L from {span(ell, 'g')}, slide-to-roll"
    most = 0.5 * max(slip)
    yield f"{span(slip, 'g')} (velocity ratios of both up to {1 + most:g} and down to {1 - most:g})"
    rows = [row for row in read("pairs/cases.csv") if row["name"][0] == "n"]
    assert [row["name"] for row in rows] == ["n30ff", "n10wf"]
    slower = [float(row["second_tiles"]) for row in rows]
    for tiles, lasts, passages in zip(slower, (14, 16), (17, 19), strict=True):
        assert tiles * lasts == pytest.approx(passages)
    yield "17 and 19 passages of the slower tile bring both back"
    yield "their runs of 14 and 16 a/u"


@pytest.mark.parametrize(
    ("page", "said"),
    [
        ("README.md", introduction),
        ("docs/limits.md", share_of_contact),
        ("docs/howto/mixed.md", mixed),
        ("docs/theory/prediction.md", high_ratios),
        ("docs/theory/prediction.md", left_out),
        ("docs/theory/prediction-ellipses.md", ellipses),
        ("docs/theory/prediction-inlet.md", slips),
        ("docs/theory/prediction-compared.md", compared),
        ("docs/theory/prediction-second-order.md", even_part),
        ("docs/theory/prediction-pairs.md", pairs),
        ("docs/evidence/prediction/README.md", finest),
        ("docs/evidence/pairs/README.md", pair_ranges),
        ("docs/evidence/pairs/README.md", all_positions),
        ("docs/evidence/prediction/README.md", surfaces),
        ("docs/evidence/partial/README.md", partial_rows),
    ],
)
def test_the_page_says_what_its_record_has(root: Path, page: str, said: Said):
    assert missing(root, page, said) == []
