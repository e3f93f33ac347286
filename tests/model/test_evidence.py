# SPDX-License-Identifier: BSD-3-Clause
"""The prediction against simulated cases: docs/evidence/prediction says what it says."""

import csv
import math
import re
import statistics
import sys
from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl.prediction import rough_contact
from pyehl.prediction.errors import KNOWN_RATIO, model_error
from pyehl.prediction.resolution import resolution
from pyehl.prediction.second_order import INLET_FILM
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import edge_gain


@pytest.fixture(scope="module")
def evidence(root: Path):
    """The module compare.py of the evidence, and its folder."""
    folder = root / "docs" / "evidence" / "prediction"
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(folder))
        import compare

        yield compare, folder
        for name in ("compare", "cases"):
            sys.modules.pop(name)


@pytest.fixture(scope="module")
def table(evidence):
    """Rows of table.csv by name, numbers as numbers."""
    with (evidence[1] / "table.csv").open() as stream:
        return {
            row["name"]: {k: float(v or "nan") for k, v in row.items() if k != "name"}
            for row in csv.DictReader(stream)
        }


# Surfaces with all their waves that were simulated on 1025 x 1025 nodes, too
FINE = 5
NAMES = ["c16s11", "c8s12", "t1s21", "t1s21u1", "m700l7", "c16m2000", "u080c16", "u120c16"]


@pytest.mark.parametrize("name", NAMES)
def test_table_is_what_is_predicted(evidence, table, name):
    compare, _ = evidence
    (row,) = (row for row in compare.rows() if row["name"] == name)
    ours, paper = compare.predictions(row)
    assert ours == pytest.approx(table[name]["prediction"], rel=1e-3)
    assert paper == pytest.approx(table[name]["paper"], rel=1e-3)
    assert abs(ours - row["mu_ratio"]) <= model_error(ours)


def test_load_is_kept_in_rings(root: Path, evidence, table, monkeypatch):
    """One ring over the whole contact would lower the friction by what the theory says."""
    compare, _ = evidence
    rows = {row["name"]: row for row in compare.rows()}
    monkeypatch.setattr(rough_contact, "RINGS", np.zeros(1))
    lower = [
        100.0 * (1.0 - compare.predictions(rows[name])[0] / table[name]["prediction"])
        for name in ("t1s21", "m120l12", "m250l6")
    ]
    text = (root / "docs" / "theory" / "prediction-second-order.md").read_text(encoding="utf-8")
    said = "t1s21, m120l12 and m250l6 by {:.1f}, {:.1f} and {:.1f} %".format(*lower)
    assert said in text


def test_waves_that_a_coarse_grid_leaves_out_are_in_its_error(evidence):
    """257 x 257 nodes against 513 x 513: the error from two grids does not know these waves."""
    compare, folder = evidence
    cases = sys.modules["cases"]
    lines = (folder / "coarse.csv").read_text().splitlines()
    fine = {row["name"]: row["mu_ratio"] for row in compare.rows()}
    missed = 0
    for coarse in csv.DictReader(x for x in lines if not x.startswith("#")):
        (row,) = (row for row in compare.rows() if row["name"] == coarse["name"])
        row["points"] = float(coarse["points"])
        found = resolution(cases.case(row), {"surface": cases.surface(row)})
        difference = abs(fine[row["name"]] - float(coarse["mu_ratio"]))
        missed += difference > float(coarse["grid_error"])
        assert difference <= float(coarse["grid_error"]) + abs(found.left_out), row["name"]
    assert missed == 6


def test_deviations(table):
    """1.7 % up to a ratio of 1.5 but for one, 3 % to 2.5, 7 % above.

    1 % without short waves and up to 1.3.
    """
    assert len(table) == 63
    for name, row in table.items():
        deviation = abs(row["prediction"] / row["mu_ratio"] - 1.0)
        if name.startswith(("c8", "c16", "n")) and row["mu_ratio"] <= 1.3:
            assert deviation <= 0.01, name
        share = 0.017 if row["mu_ratio"] <= 1.5 else 0.03 if row["mu_ratio"] <= 2.5 else 0.07
        # L = 4 and 8 % of slip: 0.2 % lower since negative pressures carry nothing
        assert deviation <= (0.0187 if name == "u108l4" else share), name


def test_deviations_from_the_finest_grid(table):
    fine = [row for row in table.values() if row["mu_ratio_1025"] > 0.0]
    assert len(fine) >= FINE
    for row in fine:
        assert abs(row["prediction"] / row["mu_ratio_1025"] - 1.0) <= 0.031
        assert abs(row["mu_ratio_1025"] - row["mu_ratio"]) <= row["mu_ratio_error"]


def test_cases_drawn_at_random(evidence, table):
    """They chose nothing; what is compared was predicted before they were simulated."""
    with (evidence[1] / "committed.csv").open(encoding="utf-8") as stream:
        before = {row["name"]: float(row["prediction"]) for row in csv.DictReader(stream)}
    drawn = {name: row for name, row in table.items() if row["drawn"]}
    assert sorted(drawn) == sorted(before)
    for name, row in drawn.items():
        assert before[name] == pytest.approx(row["mu_ratio"], rel=0.0155)
        assert abs(row["prediction"] - row["mu_ratio"]) <= row["model_error"]
    for row in table.values():
        simulated = row["mu_ratio_1025"] if row["mu_ratio_1025"] > 0.0 else row["mu_ratio"]
        assert row["covered"] == (abs(row["prediction"] - simulated) <= row["model_error"])


def test_stated_error_covers_nine_of_ten(table):
    known = [row for row in table.values() if row["prediction"] <= KNOWN_RATIO]
    assert len(known) == len(table)
    errors = [
        abs(row["prediction"] - row["mu_ratio"]) / model_error(row["prediction"]) for row in known
    ]
    assert sum(error <= 1.0 for error in errors) >= 0.9 * len(known)


@pytest.mark.long
def test_better_than_the_model_of_the_paper(table):
    for name, row in table.items():
        if row["mu_ratio"] > 1.02:
            assert abs(row["deviation_percent"]) < 0.5 * abs(row["paper_deviation_percent"]), name


@pytest.mark.long
def test_page_of_the_theory_prints_the_table(root, table):
    """The example of docs/theory/prediction-compared.md, and the summary of all cases."""
    text = (root / "docs" / "theory" / "prediction-compared.md").read_text().replace("−", "-")
    for name in ("t1s21u1", "t1s21", "t1s21u105"):
        row = table[name]
        (line,) = re.findall(rf"^\| {row['velocity_ratio']:.2f} \|.*$", text, re.M)
        simulated, predicted, paper = (c.split()[0] for c in line.split("|")[2:5])
        assert float(simulated) == pytest.approx(row["mu_ratio"], abs=6e-4)
        assert float(predicted) == pytest.approx(row["prediction"], abs=6e-4)
        assert float(paper) == pytest.approx(row["paper"], abs=6e-4)
    summary = re.findall(
        r"^\| [\w. ]+ \| (\d+) \| ([-\d.]+) % \| ([\d.]+) % \| ([-\d.]+) % \|$", text, re.M
    )
    limits = (0.0, 1.3, 1.6, 2.5, 9.9)
    assert len(summary) == len(limits) - 1
    for low, high, words in zip(limits[:-1], limits[1:], summary, strict=True):
        part = [row for row in table.values() if low < row["mu_ratio"] <= high]
        ours = [row["deviation_percent"] for row in part]
        paper = [row["paper_deviation_percent"] for row in part]
        count, mean, largest, mean_paper = (float(word) for word in words)
        assert count == len(part)
        assert mean == pytest.approx(sum(ours) / len(part), abs=0.06)
        assert largest == pytest.approx(max(map(abs, ours)), abs=0.06)
        assert mean_paper == pytest.approx(sum(paper) / len(part), abs=0.06)


def test_page_of_the_theory_prints_the_bands(root: Path):
    """What each octave adds without slip and with 1 %, and what is below and above a/16."""
    text = (root / "docs" / "theory" / "prediction-compared.md").read_text()
    shown = re.findall(r"^\| \d+ to \d+ \| (\S+) \((\S+)\) \| (\S+) \((\S+)\) \|$", text, re.M)
    table = [[float(word) for word in line] for line in shown]
    for column, ratio in ((0, 1.0), (2, 1.01)):
        keys = {"surface.seed": 21, "surface.velocity_ratio": ratio}
        found = pyehl.predict(root / "cases/table1.nml", keys)
        rises = [band.rise for band in found.bands]
        assert [line[column] for line in table] == pytest.approx(rises, abs=6e-4)
        totals = [1.0 + sum(rises[: k + 1]) for k in range(len(rises))]
        assert [line[column + 1] for line in table] == pytest.approx(totals, abs=6e-4)
    short = [band.longest < 1.01 * found.operating.hertz_radius / 16.0 for band in found.bands]
    below = sum(rise for rise, is_short in zip(rises, short, strict=True) if is_short)
    assert f"add {below:.2f};" in text
    assert f"by −{below - sum(rises):.2f}" in text


def test_starts_from_the_prediction(root: Path, script):
    """The table is that of scenes.csv, and holds what the text says of all scenes."""
    folder = root / "docs" / "evidence" / "start"
    make = script("docs/evidence/start/make.py")
    rows = make.rows_of(folder / "scenes.csv")
    text = (folder / "README.md").read_text()
    assert len(rows) == 19
    for row in rows:
        assert make.line_of(row) in text
        assert row["start"] == "prediction"
        stop = row["error_stop"] + row["error_stop_front"]
        assert abs(row["mu_ratio"] - row["mu_ratio_front"]) <= stop
        # the mean of two speeds takes several periods, of which the start saves a part of one
        most = 0.83 if "slide-to-roll" in row["scene"] else 0.695
        assert 0.54 < row["steps"] / row["steps_front"] < most


def test_fields_are_those_of_the_simulation(root: Path):
    """First order at the centre, at the sides, and what the inlet makes of second order."""
    with (root / "docs" / "evidence" / "fields" / "table.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    fine = [row for row in rows if row["points"] == "513"]
    assert len({row["name"] for row in fine}) == 6
    for row in rows:
        if row["place"] == "r < 0.4":
            assert float(row["p_correlation"]) > 0.992, row
            assert float(row["film_correlation"]) > 0.987, row
    centre = [row for row in fine if row["place"] == "r < 0.4"]
    for row in centre:
        assert float(row["p_slope"]) == pytest.approx(1.0, abs=0.005), row
        assert float(row["film_slope"]) == pytest.approx(1.0, abs=0.013), row
    measured = sum(float(row["film_square"]) for row in centre) / len(centre)
    assert measured == pytest.approx(-INLET_FILM, abs=0.02)
    for row in rows:
        # stiff contacts that slip a little
        if row["name"] in ("c8s12c", "f1", "c16s11", "c16l15") and row["place"] == "X = 0":
            assert float(row["gamma"]) == pytest.approx(float(row["p_square"]), abs=0.05), row


def test_pressure_of_ridges(root: Path):
    """docs/evidence/response says by how much it is above K (1 - T), and what the response has."""
    folder = root / "docs" / "evidence" / "response"
    heavy, light, lost, gains = [], [], [], []
    with (folder / "ridges.csv").open(newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            m, ell, ky, ratio = (
                float(row[n]) for n in ("moes_m", "moes_l", "ky", "pressure_ratio")
            )
            # the wavelengths in the table are rounded
            if 2.0 * math.pi / ky > 0.501:
                continue
            if m >= 300.0:
                point = OperatingPoint.from_moes(m, ell)
                film = central_film(point, Lubricant()) / point.film_scale
                gains.append(100.0 * (float(edge_gain(0.0, ky, film)) - 1.0))
                heavy.append(100.0 * (ratio - 1.0))
            elif float(row["T"]) < 0.9:
                light.append(100.0 * (ratio - 1.0))
            else:
                lost.append(ratio)
    text = (folder / "README.md").read_text(encoding="utf-8")
    middle = statistics.median(heavy)
    assert f"by {min(heavy):.1f} to {max(heavy):.1f} % (median {middle:.1f} %)" in text
    assert f"`edge_gain` has {min(gains):.1f} to {max(gains):.1f} %" in text
    assert f"by {min(light):.1f} to {max(light):.1f} % where T < 0.9" in text
    assert f"the other {len(lost)} ridges" in text
    assert f"goes from {min(lost):.1f} to {max(lost):.1f}." in text
