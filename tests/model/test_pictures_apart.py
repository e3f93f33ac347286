# SPDX-License-Identifier: BSD-3-Clause
"""Texts of pictures do not overlap: machines, shapes, stress, waves, documents.

Solutions, predictions, curves, studies and oils are in test_plot.py.
"""

import csv
import importlib

import numpy as np
import pandas as pd
import pytest
from apart import assert_apart

import pyehl
from pyehl.plots import figures, machine, response, style, subsurface, surface
from pyehl.surfaces import Topography


@pytest.fixture
def seen(monkeypatch):
    """Record the pictures that scripts save; none is written."""
    result = {}

    def take(figure, path, *_, **__):
        result[path.stem] = figure
        return path

    monkeypatch.setattr(style, "save", take)
    return result


def rows_of(path):
    """Rows of a table, numbers as numbers; an empty cell is None."""

    def value(cell):
        try:
            return float(cell) if cell else None
        except ValueError:
            return cell

    with path.open(encoding="utf-8", newline="") as stream:
        return [{name: value(cell) for name, cell in r.items()} for r in csv.DictReader(stream)]


@pytest.mark.long
@pytest.mark.parametrize("units", ["si", "hertz"])
@pytest.mark.parametrize(
    ("case", "count"),
    [("roller", 2), ("duty", 3), ("greased", 2), ("line", 1), ("dent", 5), ("gear_pair", 5)],
)
def test_shapes_and_conditions_of_a_contact(cases, case, count, units):
    """Rollers, loads that change, greased and line contacts, two rough surfaces, a dent."""
    steps = {"time.steps": 4, "time.estimate_error": False} if count == 5 else {}
    data = pyehl.solve(cases / f"{case}.nml", {"grid.points": 33} | steps, check=False)
    made = figures.solution_figures(data, units)
    assert len(made) == count
    for name, figure in made.items():
        assert_apart(figure, (case, name))


@pytest.mark.long
@pytest.mark.parametrize("length", [2e-4, 8e-4])
@pytest.mark.parametrize("kappa", [0.1, 1.0, 25.0])
def test_prediction_of_two_surfaces(kappa, length):
    """Roughness of both, their spectra and their passage."""
    heights = np.random.default_rng(1).normal(scale=1e-8, size=(48, 48))
    about = {"moes_m": 1e3, "moes_l": 10.0, "hertz_pressure_Pa": 1.66e9, "status": "predicted"}
    about |= {"hertz_radius_m": 2e-4, "ellipticity": kappa, "film_scale_m": 1e-5}
    arrays, shift = {}, np.linspace(0.0, length, 64)
    for prefix in ("", "second_"):
        about |= {f"{prefix}length_{axis}_m": length for axis in "xy"}
        about |= {f"{prefix}surface": "fractal"}
        names = ("surface", "deformed", "delta_p")
        factors = (1.0, 0.3, 1e16)
        arrays |= {f"{prefix}{n}": f * heights for n, f in zip(names, factors, strict=True)}
    about["second_surface"] = "fractal"
    passage = {"shift_m": shift, "second_shift_m": 0.8 * shift, "mu_ratio": 1.0 + shift}
    bands = {"longest_m": [length, length / 2], "shortest_m": [length / 2, length / 4]}
    bands = {name: np.array(result) for name, result in bands.items()} | {
        "increase": np.array([2e-4, 0.3])
    }
    made = figures.prediction_figures(about, arrays, {"passage": passage, "bands": bands})
    assert len(made) == 5
    for name, figure in made.items():
        assert_apart(figure, name)


@pytest.mark.long
@pytest.mark.parametrize("height", [1e-9, 3e-8, 5e-7])
def test_machines(height):
    """Along a ring of a bearing and along a path of contact, thick and thin films."""
    angle = np.array([0.0, 40.0, 80.0, 280.0, 320.0])
    film = 1e-7 * (1.0 + (angle - 180.0) ** 2 / 1e4)
    columns = {"azimuth_deg": angle, "h_c_m": film, "h_min_m": 0.8 * film, "load_N": 100.0}
    columns |= {"hertz_pressure_Pa": 2e9}
    rings = pd.concat([pd.DataFrame(columns | {"ring": ring}) for ring in ("inner", "outer")])
    summary = {"rms_height_m": height}
    assert_apart(machine.figure("bearing", rings, summary), "bearing")
    path = np.linspace(-9e-3, 9e-3, 41)
    columns = {"s_m": path, "h_c_m": 2e-7 + 1e-6 * path, "h_min_m": 1.5e-7, "mu": 0.04}
    columns |= {"hertz_pressure_Pa": 1.2e9, "slide_to_roll": path / 7e-3}
    assert_apart(machine.figure("gear", pd.DataFrame(columns), summary), "gear")


@pytest.mark.long
def test_stress_waves_and_a_prepared_scan(cases):
    """Stress below the surface, responses, and a scan before and after."""
    solved = pyehl.solve(
        cases / "finish.nml", {"surface.kind": "smooth", "grid.points": 65}, check=False
    )
    for name, figure in subsurface.stress_figures(pyehl.stress(solved)).items():
        assert_apart(figure, name)
    nabla = np.geomspace(0.25, 15.0, 12)
    lines = {d: (nabla, 0.5 * np.exp(1j * nabla)) for d in (0.0, 45.0, 90.0)}
    waves = {"nabla_2": nabla, "direction": 0.0 * nabla, "amplitude": 0.5 + 0.0 * nabla}
    assert_apart(response.response_figure(waves | {"lag": nabla}, lines, "waves"), "response")
    heights = np.random.default_rng(1).normal(scale=1e-8, size=(48, 48))
    for size in ((1e-4, 1e-4), (3e-3, 1e-3)):
        tile = Topography(heights, size)
        for conditions in (None, (2e-4, 1e3, 10.0, "components")):
            assert_apart(surface.before_and_after(tile, conditions), size)
    scan = pyehl.predict(cases / "scan.nml", {"surface.outliers": 100}).surface
    assert scan.preparation is not None
    assert_apart(surface.before_and_after(scan, (2e-4, 1e3, 10.0, "components")), "scan")


@pytest.mark.long
def test_pictures_of_the_primer_and_the_front_page(seen, script, monkeypatch, root, cases):
    """Sketch, films, map of the first picture, and all pictures of the primer."""
    monkeypatch.syspath_prepend(str(root / "docs" / "start"))
    front = importlib.import_module("contact")
    changes = {"time.steps": 4, "time.estimate_error": False, "grid.points": 65}
    figure = front.drawn(pyehl.solve(cases / "finish.nml", front.CHANGES | changes, check=False))
    assert_apart(figure, "front page")
    primer = script("docs/start/primer.py")
    monkeypatch.setattr(primer, "on_one_line", lambda path: None)
    for draw in (primer.lines, primer.moes, primer.regimes, primer.stribeck):
        draw()
    assert set(seen) == {"ehl", "moes", "regimes", "stribeck"}
    for name, made in seen.items():
        assert_apart(made, name)


@pytest.mark.long
@pytest.mark.parametrize(
    ("folder", "name", "table"),
    [
        ("prediction", "compare", "table.csv"),
        ("pairs", "compare", "table.csv"),
        ("ellipse", "compare", "table.csv"),
        ("validation", "make", "formulas.csv"),
        ("stribeck", "make", "curves.csv"),
        ("films", "make", ""),
        ("workprec", "make", "workprec.csv"),
        ("stress", "make", "table.csv"),
        ("mixed_curve", "make", "curve.csv"),
    ],
)
def test_pictures_of_the_evidence(seen, evidence, root, folder, name, table):
    """Each picture is drawn from its stored record."""
    module = evidence(folder, name)
    home = root / "docs" / "evidence" / folder
    path = home / "picture.png"
    if folder == "films":
        data, result = (module.read_profiles(home / f"{n}.csv") for n in ("mourier", "profiles"))
        for source in ("measured", "simulated"):
            module.draw(source, data, result)
    elif folder == "validation":
        module.draw(module.table_of(home / table))
    elif folder == "stribeck":
        module.draw(module.stored(), path)
    elif folder == "workprec":
        module.main([])
    elif folder == "mixed_curve":
        seen["curve"] = module.draw()
    elif folder == "stress":
        rows = rows_of(home / table)
        module.draw_outcomes(
            [row | {"values": {"grid.points": int(row["points"])}} for row in rows], path
        )
    else:
        module.draw(rows_of(home / table))
    assert len(seen) == (2 if folder == "films" else 1)
    for stem, figure in seen.items():
        assert_apart(figure, (folder, stem))
