# SPDX-License-Identifier: BSD-3-Clause
"""Inlets short of oil: formulas, conservation, limits, passages, refusals."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

import pyehl
from pyehl.assessment import HOLDS, assess
from pyehl.theory.starvation import CENTRAL, layer_reduction, position_reduction

CIRCLE = {"moes_m": 100.0, "moes_l": 10.0}
LINE = {"shape": "line", "moes_m_line": 20.0, "moes_l_line": 10.0}
DENSITY = 1.19
"""About that of the oil at the Hertz pressure of these contacts."""


def solve(contact=CIRCLE, points=65, grid=None, **inlet):
    return pyehl.solve(
        pyehl.Case(contact=contact, inlet=inlet, grid={"points": points, **(grid or {})})
    )


@pytest.fixture(scope="module")
def flooded():
    return solve()


@pytest.mark.parametrize("layer", [0.02, 0.1, 0.2])
def test_layer_of_a_point_contact(flooded, layer):
    result = solve(film_hertz=layer)
    assert abs(float(result.oil_imbalance)) <= 1e-6
    leaves = float(result.oil_out) + float(result.oil_at_sides)
    assert float(result.oil_in) == pytest.approx(leaves, rel=2e-6)
    ratio = layer / (DENSITY * float(flooded.H_c))
    share = float(result.H_c) / float(flooded.H_c)
    if ratio < 0.2:
        assert share == pytest.approx(ratio, rel=0.01)
        return
    exponent = brentq(lambda gamma: layer_reduction(ratio, gamma) - share, 1.0, 10.0)
    assert 2.0 < exponent < 5.0


@pytest.mark.parametrize("law", ["eyring", "carreau"])
@pytest.mark.parametrize("radius_y", [0.01, 0.03])
def test_oil_layer_with_a_shear_thinning_flow(law, radius_y):
    """A stress that is never reached leaves the film of the Newtonian flow unchanged."""
    contact = {k: v for k, v in SI.items() if k != "radius"}
    contact |= {"radius_x": 0.01, "radius_y": radius_y, "slide_to_roll": 0.3}
    case = pyehl.Case(contact=contact, inlet={"film": 1e-7}, grid={"points": 65})
    plain = pyehl.solve(case)
    law_of = {"lubricant.shear_law": law}
    if law == "carreau":
        law_of["lubricant.carreau_exponent"] = 0.8
    thin, never = (
        pyehl.solve(case, law_of, {f"lubricant.{law}_stress": stress}) for stress in (3e6, 1e9)
    )
    assert float(never.H_c) == pytest.approx(float(plain.H_c), rel=1e-3)
    assert abs(float(thin.oil_imbalance)) <= 1e-6
    assert 0.8 * float(plain.H_c) < float(thin.H_c) < float(plain.H_c)


def test_a_thick_layer_gives_a_flooded_contact():
    thick, zero = solve(film_hertz=50.0), solve(grid={"border": "zero"})
    assert float(thick.H_c) == pytest.approx(float(zero.H_c), rel=1e-5)
    assert float(thick.H_c_error_domain) == pytest.approx(float(zero.H_c_error_domain), rel=1e-2)


@pytest.mark.parametrize("layer", [0.02, 0.06, 0.15])
def test_all_oil_passes_a_line_contact(layer):
    result, flooded = solve(LINE, 129, film_hertz=layer), solve(LINE, 129, grid={"border": "zero"})
    if layer > 0.11:
        assert float(result.H_c) == pytest.approx(float(flooded.H_c), rel=1e-4)
        return
    assert float(result.oil_out) == pytest.approx(layer, rel=1e-6)
    # flat pressure: no flow by pressure in the middle
    assert float(result.H_c) * DENSITY == pytest.approx(layer, rel=0.01)


def test_inlet_position_is_the_border_without_an_error():
    place = {"x_inlet": -1.3, "x_outlet": 1.5, "y_extent": 2.0}
    meant = solve(grid={"x_outlet": 1.5, "y_extent": 2.0}, points=257, position_hertz=1.3)
    domain = solve(grid=place | {"border": "zero"}, points=257)
    assert float(meant.H_c) == float(domain.H_c)
    assert float(domain.H_c_error_domain) > 0.1 * float(domain.H_c)
    assert float(meant.H_c_error_domain) < 0.01 * float(meant.H_c)
    formula = position_reduction(1.3, float(meant.H_c_flooded), CENTRAL)
    assert float(meant.starvation_by_formula) == pytest.approx(formula, rel=1e-9)
    assert float(meant.starvation) == pytest.approx(formula, rel=0.1)
    summary = {name: value.item() for name, value in meant.data_vars.items() if value.ndim == 0}
    result = assess({"status": "converged", **summary})
    assert result.confidence == HOLDS
    assert "starved as in the case" in result.text


def test_passages():
    result = solve(film_hertz=0.1, passages=3)
    assert int(result.passages) == 3
    of = np.asarray(result.history_passage)
    films = [np.asarray(result.history_H_c)[of == k][-1] for k in (1, 2, 3)]
    layers = [np.asarray(result.history_oil_layer)[of == k][-1] for k in (1, 2, 3)]
    assert films[0] > films[1] > films[2]
    # the layer that arrives is the film of the passage before
    assert layers[1:] == pytest.approx([DENSITY * film for film in films[:2]], rel=0.02)
    once = solve(film_hertz=0.1, passages=3, replenishment=1.0)
    assert int(once.passages) == 2
    assert float(once.H_c) == pytest.approx(films[0], rel=1e-3)


SI = {"load": 20.0, "radius": 0.01, "mean_velocity": 1.0}


@pytest.mark.parametrize(
    ("groups", "key", "expected"),
    [
        ({"contact": SI, "inlet": {"position": 5e-5}}, "inlet.position", "at least 1.05 a"),
        ({"contact": SI, "inlet": {"film": -1e-7}}, "inlet.film", "[0, 0.01]"),
        (
            {"contact": SI, "inlet": {"film": 1e-9}, "lubricant": {"boundary_film": 2e-9}},
            "inlet.film",
            "above lubricant.boundary_film",
        ),
        ({"contact": SI, "inlet": {"passages": 2}}, "inlet.passages", "layer"),
        ({"contact": CIRCLE, "inlet": {"film": 1e-7}}, "inlet.film", "film_hertz"),
        (
            {"contact": CIRCLE, "inlet": {"position_hertz": 2.0, "film": 1e-7}},
            "inlet.film in metres",
            "expected: inlet.film_hertz",
        ),
        (
            {"contact": SI, "inlet": {"film": 1e-7}, "grid": {"border": "flooded"}},
            "grid.border",
            "'zero'",
        ),
        (
            {"contact": SI, "inlet": {"film": 1e-7}, "surface": {"kind": "fractal"}},
            "surface.kind",
            "inlet.position",
        ),
    ],
)
def test_refusals(groups, key, expected):
    with pytest.raises(pyehl.InputError) as refused:
        pyehl.Case(**groups).resolve()
    assert key in str(refused.value)
    assert expected in str(refused.value)


def test_film_has_the_formula():
    case = pyehl.Case(contact=CIRCLE, inlet={"position_hertz": 1.3})
    starved = pyehl.film(case).formulas[-1]
    assert starved["name"] == "starved: Hamrock-Dowson IV"
    assert json.dumps(starved)
    layer = pyehl.film(pyehl.Case(contact=CIRCLE, inlet={"film_hertz": 0.05})).formulas[-1]
    first = pyehl.film(pyehl.Case(contact=CIRCLE)).formulas[0]
    assert 0.2 * first["h_c_m"] < layer["h_c_m"] < first["h_c_m"]


def without_roughness(root: Path, name: str, folder: Path) -> Path:
    """A machine of cases/ with smooth surfaces."""
    text = (root / "cases" / f"{name}.nml").read_text(encoding="utf-8")
    path = folder / f"{name}.nml"
    path.write_text(re.sub(r"&(second_)?surface\n.*?\n/\n", "", text, flags=re.DOTALL))
    return path


@pytest.mark.parametrize("inlet", [{"inlet.film": 5e-8}, {"inlet.position": 1e-3}])
def test_formulas_of_machines_refuse_a_starved_inlet(root: Path, tmp_path: Path, inlet):
    for call, name in ((pyehl.bearing, "bearing_6206"), (pyehl.gear, "fzg_c")):
        path = without_roughness(root, name, tmp_path)
        with pytest.raises(pyehl.InputError, match="formulas of flooded contacts"):
            call(path, inlet)


def test_stations_of_a_starved_gear_are_solved(root: Path, tmp_path: Path):
    few = {"spur_gear.stations": 5, "inlet.film": 5e-8}
    result = pyehl.gear(without_roughness(root, "fzg_c", tmp_path), few, run="solve", jobs=1)
    # the layer, thinned by compression
    assert set(result.table["status"]) == {"converged"}
    assert result.table["h_c_m"].between(3.9e-8, 4.2e-8).all()


def test_waves_are_not_measured_in_a_starved_contact(root: Path):
    with pytest.raises(pyehl.InputError, match="waves are measured in a flooded contact"):
        pyehl.response(root / "cases" / "greased.nml")


def test_lines_that_are_nearly_flooded():
    """A layer gives the film of the position at which it fills the gap, up to the flooded film."""
    flooded = pyehl.solve(pyehl.Case(contact=LINE))
    for position, share in ((1.2, 0.646), (1.5, 0.878), (2.0, 0.966), (2.5, 0.986)):
        place = pyehl.solve(pyehl.Case(contact=LINE, inlet={"position_hertz": position}))
        assert float(place.H_c) / float(flooded.H_c) == pytest.approx(share, abs=3e-3)
        layer = solve(LINE, 257, film_hertz=DENSITY * float(place.H_c))
        assert float(layer.H_c) == pytest.approx(float(place.H_c), rel=0.01)
        assert float(layer.oil_out) == pytest.approx(float(layer.oil_in), rel=1e-6)
        if position > 1.5:
            continue
        # farther away the film hardly depends on this position
        begins = float(layer.X[np.flatnonzero(layer.P.values.ravel() > 0.0)[0]])
        assert begins == pytest.approx(-position, abs=0.05)


@pytest.mark.parametrize(
    ("load", "points"),
    [
        *((load, 129) for load in (2e4, 1.8e5, 5e5)),
        (5e5, 257),
        *(pytest.param(load, 257, marks=pytest.mark.long) for load in (2e4, 1.8e5)),
    ],
)
def test_layers_just_below_the_flooded_film_converge(load, points):
    """The meniscus shifts there: each layer has its film, and oil is conserved."""
    contact = {"shape": "line", "radius": 0.01, "mean_velocity": 0.4622, "load_per_length": load}
    case = pyehl.Case(contact=contact, grid={"points": points, "border": "zero"})
    flooded, thin = pyehl.solve(case), pyehl.solve(case, {"inlet.film": 5e-8})
    density = 5e-8 / float(thin.h_c_m)
    for share in (0.9, 0.95, 0.98, 0.995):
        layer = share * density * float(flooded.h_c_m)
        result = pyehl.solve(case, {"inlet.film": layer})
        assert abs(float(result.oil_imbalance)) <= 1e-6
        # the border of the domain reduces the film by some tenths of a per cent
        assert float(result.h_c_m) / float(flooded.h_c_m) == pytest.approx(share, abs=0.006)


def test_thick_films_that_begin_near_the_contact():
    """The flooded film of 31 is too thick to start from; a shear-thinning flow converges, too."""
    contact = {"radius": 0.004453, "load": 1.028, "mean_velocity": 8.842, "slide_to_roll": 0.434}
    law = {"lubricant.shear_law": "eyring", "lubricant.eyring_stress": 3.63e6}
    case = pyehl.Case(contact=contact, lubricant={"viscosity": 0.08571}, grid={"points": 65})
    films = [
        float(pyehl.solve(case, law, {"inlet.position_hertz": at}).H_c) for at in (1.1, 1.5, 3)
    ]
    assert films == sorted(films)
    # they have to fit into the gap where the oil begins, x^2/2 and the film
    assert films[0] < 3.0 * 1.1**2 / 2.0
    newtonian = pyehl.solve(case, {"inlet.position_hertz": 1.1})
    assert films[0] < float(newtonian.H_c) == pytest.approx(films[0], rel=0.05)


def test_a_layer_without_a_solution_names_a_remedy():
    """A wide contact at M = 17 000, for which finer grids do not help."""
    case = pyehl.Case(
        contact={"load": 2444.0, "mean_velocity": 0.7, "radius_x": 0.01196, "radius_y": 0.1784},
        lubricant={"viscosity": 0.01409, "shear_law": "eyring", "eyring_stress": 8.323e6},
        grid={"points": 65},
    )
    failed = pyehl.solve(case, {"inlet.film": 1.152e-7}, check=False)
    assert failed.attrs["status"] != "converged"
    assert "or inlet.position in place of inlet.film" in failed.attrs["message"]
    assert float(pyehl.solve(case, {"inlet.position_hertz": 1.1}).H_c) > 0.0
