# SPDX-License-Identifier: BSD-3-Clause
"""Sentences of docs/evidence/*/README.md beside the tables of their folders."""

from __future__ import annotations

import csv
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from records import Read, Row, Said, largest, missing, of, span

from pyehl.prediction import errors
from pyehl.prediction.mixed_lubrication import TOUCHING_FILM_ERROR
from pyehl.studies.curve_contact import lift_off
from pyehl.theory.operating import OperatingPoint


def contact(read: Read) -> Iterator[str]:
    """Friction, and thinner layers."""
    rows = {
        (row["boundary_film"], row["points"]): row
        for row in read("contact/shares.csv")
        if row["contact"] == "light"
    }
    pairs = [
        " and ".join(f"{float(rows[layer, n]['mu']):.4f}" for n in ("257", "513"))
        for layer in ("4e-08", "8e-08")
    ]
    yield f"is {pairs[0]} on 257 and 513 nodes at 40 nm, {pairs[1]} at 80 nm"
    share = {key: float(row["contact_load_share"]) for key, row in rows.items()}
    for load, said in ((600.0, "At 600 N (M = {})"), (100.0, "At 100 N (M = {}")):
        moes_m = OperatingPoint(load=load, mean_velocity=0.1).moes_m
        yield said.format(round(moes_m, -2 if load > 500.0 else -1)).replace(".0", "")
    assert round(share["8e-08", "513"] / share["4e-08", "513"]) == 8
    assert round(share["4e-08", "257"] / share["2e-08", "257"], -1) == 40
    yield "carries an eighth on 513 nodes, and 20 nm a fortieth of 40 nm on 257"


def ellipse(read: Read) -> Iterator[str]:
    """What was simulated, what was blind, and what the waves leave."""
    rows, cases = read("ellipse/table.csv"), read("ellipse/cases.csv")
    moes_m, moes_l, ratio = (of(rows, n) for n in ("moes_m", "moes_l", "velocity_ratio"))
    yield f"from {span(of(cases, 'ellipticity'), 'g')}; M by R_x from {span(moes_m, '.0f')}"
    yield f"L from {span(moes_l, '.0f')}; velocity ratios from {span(ratio, '.2g')};"
    whole = [row["name"] for row in cases if row["shortest_wavelength"] == "0"]
    assert (len(whole), len(cases)) == (6, 30)
    blind = [row for row in rows if row["name"][0] == "r"]
    low, high = (
        largest(of([r for r in blind if (float(r["mu_ratio"]) <= 1.5) is told], BEFORE), 1)
        for told in (True, False)
    )
    yield f"the prediction from before was within {low} %, above within {high} %"
    assert all(row["covered_before"] == "1" for row in blind)
    covered = sum(row["covered_before"] == "1" for row in rows)
    yield f"Of all {len(rows)} predictions from before it covers {covered}."
    first = [r for r in rows if r["name"] not in ADDED and r["name"][0] == "k"]
    assert len(first) == 14
    assert all(row["covered_before"] == "1" for row in first)
    assert [r["name"] for r in rows if r["covered_before"] == "0"] == ["k040c", "k050b"]
    worst = sorted(rows, key=lambda row: -abs(float(row["deviation_percent"])))[:2]
    assert [row["name"] for row in worst] == ["r09", "k070"]
    yield f"{' to '.join(sorted(f'{-float(r[NOW]):.0f}' for r in worst))} % too low"
    narrow = max(float(row[BEFORE]) for row in rows if float(row["ellipticity"]) <= 0.5)
    yield f"was up to {narrow:.1f} % too high"
    off = [f"{float(r[BEFORE]):.1f}" for r in rows if r["name"] in ("k040e", "k060b")]
    yield f"{' and '.join(off)} % too high"
    yield f"a term {errors.NARROW:g} (1/κ − 1)"
    yield f"the predicted ratios are {span(of(read('ellipse/predicted.csv'), 'prediction'), '.1f')}"
    (gain,) = (
        f"{row['predicted_gain']} of {row['gain']}"
        for row in read("ellipse/sides.csv")
        if (row["ellipticity"], row["wavelength"], row["y"]) == ("1", "0.5", "0")
    )
    yield f"({gain} for ridges of a/2)"
    known = [float(r["mu_ratio_error"]) for r in rows if r["name"] in whole]
    yield f"states an error of {span(known, '.2f')},"
    off = [
        100.0 * (float(row["predicted_pressure"]) / float(row["pressure"]) - 1.0)
        for row in read("ellipse/ridges.csv")
        if row["wavelength"] == "1" and float(row["ellipticity"]) < 1.0
    ]
    yield f"are {-max(off):.0f} to {-min(off):.0f} % too low in pressure at κ = 0.4 to 0.6"


NOW, BEFORE = "deviation_percent", "deviation_before_percent"
ADDED = ("k040c", "k040d", "k050b", "k350", "k040e", "k060b")


def ellipse_waves(read: Read) -> Iterator[str]:
    """T by the circles that may stand for an ellipse, and the mean pressure."""
    runs = defaultdict(list)
    for row in read("ellipse/response.csv"):
        key = (row[n] for n in ("ellipticity", "moes_m", "moes_l", "velocity_ratio"))
        runs[tuple(map(float, key))].append(row)
    worst: dict[bool, float] = {False: 0.0, True: 0.0}
    for (kappa, m, ell, ratio), rows in runs.items():
        t = of(rows, "T_re") + 1j * of(rows, "T_im")
        off = [
            np.abs(of(rows, f"{n}_re") + 1j * of(rows, f"{n}_im") - t)
            for n in ("circle", "dry", "houpert", "by_rx")
        ]
        cells = [f"{np.sqrt(np.mean(np.square(one))):.3f}" for one in off]
        yield f"| {kappa:g} | {m:g}, {ell:g} | {ratio:g} | {' | '.join(cells)} |"
        mean = np.mean(of(rows, "circle_pressure") / of(rows, "pressure") - 1.0)
        worst[kappa == 0.4] = max(worst[kappa == 0.4], abs(100.0 * mean))
    yield f"right within {worst[False]:.1f} %, at κ = 0.4 within {worst[True]:.1f} %"


def rough_errors(read: Read) -> Iterator[str]:
    """Contacts without a stated error of the ratio, and the worst miss."""
    known: dict[tuple[str, ...], list[Row]] = defaultdict(list)
    names = ("moes_m", "moes_l", "kind", "wavelength", "width", "amplitude_over_film")
    for row in read("errors/rough.csv"):
        known[tuple(row[n] for n in (*names, "velocity_ratio"))].append(row)
    yield f"(`rough.csv`): {len(known)} waves, dents and ridges"
    without = [
        rows
        for rows in known.values()
        if not any(row["mu_ratio_error"] and row["mu_ratio_limit"] for row in rows)
    ]
    yield f"The other {len(without)} cases"
    ends = [float([row for row in rows if row["mu_ratio"]][-1]["mu_ratio"]) for rows in without]
    assert sum(end > 1e3 for end in ends) == 11
    yield "in eleven of them to ratios above 10³"
    off = {
        abs(float(row["mu_ratio"]) - float(row["mu_ratio_limit"])) / float(row["mu_ratio_error"]): (
            f"({float(row['moes_m']):.0f}, {float(row['moes_l']):.0f})"
        )
        for rows in known.values()
        for row in rows
        if row["mu_ratio_error"] and row["mu_ratio_limit"]
    }
    yield f"by up to a factor of {round(max(off), -2):.0f} at {off[max(off)]}"
    points = [
        len({(row["moes_m"], row["moes_l"]) for row in read(f"errors/{name}.csv")})
        for name in ("flooded", "zero")
    ]
    yield f"contacts at {points[0]} and {points[1]} points,"


def wide_ellipses(read: Read) -> Iterator[str]:
    """What the estimate of the domain misses of H_c."""
    rows = [row for row in read("errors_ellipses/errors.csv") if row["H_c_doubled"]]
    off = np.abs(of(rows, "H_c") - of(rows, "H_c_doubled")) / of(rows, "H_c_error_domain")
    missed = [row for row, ratio in zip(rows, off, strict=True) if ratio > 1.0]
    assert all(r["border"] == "flooded" and float(r["kappa"]) > 6.0 for r in missed)
    assert all(float(row["moes_m"]) < 20.0 for row in missed)
    yield f"κ above 6 at M below 20: up to {off.max():.1f} times the stated share"


def extreme_ellipses(read: Read) -> Iterator[str]:
    """Which very narrow and wide contacts converge."""
    lines: dict[str, list[str]] = {}
    for row in read("errors_ellipses/ends.csv"):
        kappa = "1/30" if row["kappa"].startswith("0.03") else f"{float(row['kappa']):g}"
        heads = f"{float(row['moes_m']):g}", f"{float(row['moes_l']):g}", row["points"]
        cells = lines.setdefault(f"| {' | '.join((kappa, *heads))} |", ["", ""])
        ended = row["status"] == "converged"
        cells[int(row["short_cells"])] = f"{row['cycles']} cycles" if ended else row["status"]
    yield "\n".join(f"{head} {' | '.join(cells)} |" for head, cells in lines.items())


def fields(read: Read) -> Iterator[str]:
    """Slopes on the coarser grid, and the part of second order in pressure."""
    rows = read("fields/table.csv")
    coarse = [row for row in rows if (row["points"], row["place"]) == ("257", "r < 0.4")]
    film, pressure = (100.0 * (of(coarse, f"{n}_slope") - 1.0) for n in ("film", "p"))
    yield f"the film is {span(film, '.0f')} % too steep there, the pressure up to"
    yield f"the pressure up to {largest(pressure, 0)} %."
    there = [row for row in rows if row["place"] == "X = -0.5"]
    yield f"The part in P₁² is {span(of(there, 'p_square'), '.2f')} at X = −0.5"
    for row in there:
        if row["name"] in ("c16l5", "f2", "f4"):
            assert float(row["p_square"]) > 1.5 * float(row["gamma"]), row["name"]


def lobes(read: Read) -> Iterator[str]:
    """Correlations of the loss of film, and its rms, at little and at much slip."""
    rows = read("fields/lobes.csv")
    for names in ("g1, g4, h1, h3, h7, h8", "i1 to i6"):
        group = [row for row in rows if (row["name"][0] == "i") == (names[0] == "i")]
        slip = 2.0 * np.abs(of(group, "velocity_ratio") - 1.0)
        places = [
            span(of([r for r in group if r["place"] == place], "correlation"), ".3f")
            for place in ("r < 0.4", "lobes")
        ]
        yield f"| {names} | {slip.min():.2g} to {slip.max():.2g} | {' | '.join(places)} |"
    shares = [float(r["rms_predicted"]) / float(r["rms_simulated"]) for r in group]
    yield f"the predicted loss is {min(shares):.2f} to {max(shares):.2f} of that"


def curve(read: Read) -> Iterator[str]:
    """Loads by Moes, and the speed at which contact ends."""
    rows = read("mixed_curve/curve.csv")
    speeds = of(rows, "contact.mean_velocity")
    moes_m = [OperatingPoint(load=20.0, mean_velocity=u).moes_m for u in speeds]
    yield f"20 N (M from {max(moes_m):.0f} to {min(moes_m):.0f})"
    names = ("contact_load_share", "contact_load_share_error", "lambda_ratio")
    found = lift_off(
        "contact.mean_velocity",
        speeds,
        [{n: float(row[n]) for n in names} | {"theta_2": 1.0} for row in rows],
    )
    assert found is not None
    yield f"at {found.speed:.3g} ± {found.error:.2g} m/s (Λ = {found.lambda_ratio:.2f})"
    assert OperatingPoint(load=20.0, mean_velocity=0.195).moes_m == pytest.approx(100.0, rel=0.01)
    yield "Above 0.19 m/s M is below 100"


def partial(read: Read) -> Iterator[str]:
    """The earlier version, and how wide errors are."""
    rows = read("partial/table.csv")
    share, found = of(rows, "contact_load_share_now"), of(rows, "contact_load_share")
    seen = [row for row in rows if row["name"][0] == "c" and float(row["contact_load_share"])]
    over = of(seen, "contact_load_share_predicted") / of(seen, "contact_load_share")
    high = over[over > 1.2]
    assert high.size == 9
    yield f"too high by a factor of {span(high, '.1f')} in nine of them"
    wide = of(rows, "stated_error")[share > 0.1] / share[share > 0.1]
    yield f"It is wide: {span(wide, '.1f')} of load shares above 0.1."
    coarse = of(rows, "points") == 129
    stated = [
        (of(rows, "simulation_error") / np.maximum(found, 1e-9))[(found > 0.1) & part].max()
        for part in (coarse, ~coarse)
    ]
    yield f"up to {stated[0]:.1f} on 129 nodes and up to {stated[1]:.1f} on 257"
    yield f"wrong by {TOUCHING_FILM_ERROR:g} of the deformed rms height"
    moes_m, slip = of(rows, "moes_m"), of(rows, "slide_to_roll")
    cases = read("partial/cases.csv")
    yield f"{len(cases)} fractal surfaces in contacts with M from {span(moes_m, 'g')}"
    yield f"slide-to-roll ratios from {span(slip, 'g')}."


def response(read: Read) -> Iterator[str]:
    """Points left out, and waves with much slip."""
    rows = read("response/leave_out.csv")
    slow, slip = of(rows, "slow"), of(rows, "slip")
    corner = int(np.nanargmax(slow))
    assert (rows[corner]["moes_m"], rows[corner]["moes_l"]) == ("100", "3")
    yield (
        f"At U = 1 and 1.01 within {np.nanmax(np.delete(slow, corner)):.3f}, 0.024 or less at "
        f"{np.sum(slow <= 0.024)} of {np.sum(slow > 0.0)} points; only (100, 3), a corner, is "
        f"worse, {slow[corner]:.2f}. At other U within 0.062 at {np.sum(slip <= 0.062)} of "
        f"{np.sum(slip > 0.0)} points"
    )
    assert np.sum(slip <= 0.024) == 10
    far = {row["moes_m"] + row["moes_l"]: row["slip"] for row in rows if row["slip"] > "0.062"}
    said = [f"{float(far[key]):.2f}" for key in ("10003", "30003", "10020", "1003")]
    assert len(far) == len(said)
    yield "0.024 or less at ten; {} at (1000, 3), {} and {} at (3000, 3)".format(*said)
    yield f"and (100, 20), {said[3]} at (100, 3)."
    fitted = sum(int(r["waves"]) for r in read("response/residuals.csv") if r["moes_m"])
    ridges = len(read("response/ridges.csv"))
    yield f"shorter than 3 a along the motion: {fitted} of them, and {ridges} ridges"
    runs = defaultdict(dict)
    for row in read("response/slip.csv"):
        kx, q = float(row["kx"]), np.hypot(float(row["kx"]), float(row["ky"]))
        if float(row["x"]) == 0.0 and 2.0 * np.pi / q * 128.0 >= 10.0 and 2.0 * np.pi / kx < 3.0:
            off = np.hypot(
                *(float(row[f"T_{n}"]) - float(row[f"predicted_{n}"]) for n in ("re", "im"))
            )
            there = runs[row["moes_m"], row["moes_l"]]
            there[row["velocity_ratio"]] = max(off, there.get(row["velocity_ratio"], 0.0))
    yield f"has {sum(map(len, runs.values()))} runs on 513 × 513 nodes at nine operating points"
    for (m, ell), there in runs.items():
        cells = (f"{there[u]:.3f}" if u in there else "" for u in ("0.5", "0.7", "1.3", "1.5"))
        yield f"| {m}, {ell} | {' | '.join(cells)} |"
        assert not 200.0 <= float(m) <= 1000.0 or max(there.values()) < 0.0505


PAGES: dict[str, tuple[Said, ...]] = {
    "contact": (contact,),
    "ellipse": (ellipse, ellipse_waves),
    "errors": (rough_errors,),
    "errors_ellipses": (wide_ellipses, extreme_ellipses),
    "fields": (fields, lobes),
    "mixed_curve": (curve,),
    "partial": (partial,),
    "response": (response,),
}


@pytest.mark.parametrize(("name", "said"), [(n, s) for n, part in PAGES.items() for s in part])
def test_the_page_says_what_its_tables_have(root: Path, name: str, said: Said):
    assert missing(root, f"docs/evidence/{name}/README.md", said) == []


def test_this_build_makes_a_narrow_contact(root: Path, script):
    """A row of ends.csv."""
    made = script("docs/evidence/errors_ellipses/make.py").ends((0.1, 200.0, 10.0, 257))
    (row,) = ({name: str(value) for name, value in one.items()} for one in made)
    with (root / "docs/evidence/errors_ellipses/ends.csv").open(encoding="utf-8") as stream:
        assert row == next(csv.DictReader(stream))


@pytest.mark.long
def test_this_build_makes_a_point_left_out(root: Path, evidence):
    leave_out = evidence("response", "leave_out")
    everything = leave_out.read()
    data = everything.chosen(leave_out.select(everything))
    found = leave_out.left_out(data, leave_out.fit(data), 500.0, 5.0)
    text = (root / "docs/evidence/response/leave_out.csv").read_text(encoding="utf-8")
    assert f"500,5,{','.join(found)}\n" in text
