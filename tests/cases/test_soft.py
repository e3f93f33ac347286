# SPDX-License-Identifier: BSD-3-Clause
"""Soft bodies and water: formulas of their regimes, keys, limits of the theory."""

import math
from pathlib import Path

import pytest

import pyehl
from pyehl.theory import film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint


def solved(*options):
    return pyehl.solve(pyehl.Case.from_text(""), *options, check=False)


def moes(moes_m: float, moes_l: float, points: int = 257) -> dict[str, float]:
    return {"contact.moes_m": moes_m, "contact.moes_l": moes_l, "grid.points": points}


def formulas(point: OperatingPoint) -> dict[str, film.FilmEstimate]:
    return {f.name: f for f in film.estimates(point, Lubricant())}


@pytest.mark.parametrize("load_number", [1e-4, 1e-3, 1e-2])
@pytest.mark.parametrize("ellipticity", [1.0, 3.0])
def test_soft_formula_is_that_of_textbooks(load_number: float, ellipticity: float):
    """The formula in the form of textbooks, which has other constants."""
    speed = 1e-8
    elasticity = load_number ** (8.0 / 3.0) / speed**2
    shape = 1.0 - 0.85 * math.exp(-0.31 * ellipticity)
    textbook = 8.70 * elasticity**0.67 * shape * (speed / load_number) ** 2
    result = film.hamrock_dowson_soft(speed, load_number, ellipticity)[1]
    assert result == pytest.approx(textbook, rel=0.012)


@pytest.mark.parametrize("moes_m", [0.2, 1.0, 2.0])
def test_rigid_bodies(moes_m):
    """Brewe, Hamrock & Taylor: as much below the solver as the documents state."""
    ds = solved(moes(moes_m, 0.0, 129))
    point = OperatingPoint.from_moes(moes_m, 0.0)
    first = film.estimates(point, Lubricant())[0]
    assert (first.name, first.outside) == ("Brewe-Hamrock-Taylor", ())
    assert -0.03 < first.h_c / point.film_scale / float(ds.H_c) - 1.0 < -0.005
    reported = solved(moes(moes_m, 10.0, 129))
    off = formulas(OperatingPoint.from_moes(moes_m, 10.0))["Brewe-Hamrock-Taylor"].h_c
    off = off / OperatingPoint.from_moes(moes_m, 10.0).film_scale / float(reported.H_c) - 1.0
    assert off == pytest.approx({0.2: -0.01, 1.0: -0.018, 2.0: -0.076}[moes_m], abs=2e-3)
    # 140.1 (U/W)^2 R for a ball on a plane
    expected = 140.1 * (point.speed / point.load_number) ** 2
    assert first.h_min / point.radius == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("moes_m", [20.0, 200.0, 1000.0])
def test_soft_bodies(moes_m):
    ds = solved(moes(moes_m, 0.0, 513))
    unit = OperatingPoint.from_moes(moes_m, 0.0)
    # U = 1e-8 as between rubber and glass; with L = 0 the film does not depend on it
    speed, load_number = 1e-8, moes_m * 2e-8**0.75
    scale = (1.5 * load_number) ** (-2.0 / 3.0)
    h_c = film.de_vicente(speed, load_number) * scale
    h_min = film.hamrock_dowson_soft(speed, load_number)[1] * scale
    assert 0.02 < h_c / float(ds.H_c_extrapolated) - 1.0 < 0.10
    assert h_min / float(ds.H_min_extrapolated) == pytest.approx(1.0, abs=0.045)
    first = film.estimates(unit, Lubricant())[0]
    assert first.name == "de Vicente et al."


@pytest.mark.parametrize(
    ("radius_ratio", "moes_m", "off"),
    [(0.8, 8.0, -0.091), (0.8, 200.0, -0.077), (0.7, 8.0, -0.152), (0.5, 200.0, -0.140)],
)
def test_soft_ellipses(radius_ratio, moes_m, off):
    """Hamrock & Dowson's h_min of soft ellipses: its range ends where it is 10 % off."""
    ds = solved({**moes(moes_m, 0.0), "contact.radius_ratio": radius_ratio})
    unit = OperatingPoint.from_moes(moes_m, 0.0, radius_ratio=radius_ratio)
    load_number = moes_m * 2e-8**0.75
    scale = unit.radius / unit.film_scale * (unit.load_number / load_number) ** (2.0 / 3.0)
    h_min = film.hamrock_dowson_soft(1e-8, load_number, unit.ellipse.ellipticity)[1] * scale
    assert h_min / float(ds.H_min_extrapolated) - 1.0 == pytest.approx(off, abs=0.005)
    outside = formulas(unit)["Hamrock-Dowson soft"].outside
    assert any(stated.startswith("R_x/R_y") for stated in outside) == (off < -0.1)


@pytest.mark.parametrize(
    ("moes_m", "moes_l", "points"),
    [(2000.0, 0.0, 513), (2000.0, 0.5, 513), (5000.0, 0.1, 513), (5000.0, 1.0, 513)],
)
def test_soft_contacts_converge(moes_m, moes_l, points):
    """With the relaxation of hard contacts the iteration would enter a cycle."""
    with pyehl.Solver(pyehl.Case.from_text("", moes(moes_m, moes_l, points))) as solver:
        assert solver.run()
        assert solver.summary["status"] == "converged"


@pytest.mark.parametrize(("moes_m", "ratio"), [(655.0, 1.0), (1500.0, 1.0), (1800.0, 1.4)])
def test_errors_of_thin_films_on_a_single_grid(moes_m, ratio):
    """No coarser grid has a solution: the error is that of an unresolved inlet."""
    options = {"contact.radius_ratio": 1.0 / ratio}
    coarse, fine = (solved(moes(moes_m, 0.0, points), options) for points in (129, 513))
    assert coarse.attrs["error_estimate"] == "a priori"
    for name in ("H_c", "H_min"):
        limit = float(fine[f"{name}_extrapolated"])
        off = abs(float(coarse[name]) - limit)
        assert off <= float(coarse[f"{name}_error"]) < 2.5 * off


def test_alpha_of_0_is_an_l_of_0(root: Path):
    """A contact in SI units with alpha = 0 is that of M with L = 0, in every law."""
    file = root / "cases/soft.nml"
    by_si = pyehl.solve(file, {"grid.points": 129}, check=False)
    by_moes = solved(
        moes(float(by_si.moes_m), 0.0, 129),
        {"lubricant.density_law": "incompressible"},
    )
    assert float(by_si.moes_l) == 0.0
    assert float(by_si.H_c) == pytest.approx(float(by_moes.H_c), rel=1e-9)
    barus = pyehl.solve(file, {"grid.points": 129, "lubricant.viscosity_law": "barus"}, check=False)
    assert float(barus.H_c) == float(by_si.H_c)
    for law in ("roelands", "barus"):
        oil = Lubricant(pressure_viscosity=0.0, viscosity_law=law)
        assert float(oil.viscosity_ratio(1e9)) == 1.0


def test_water(root: Path):
    """Low alpha under Roelands; the formula for all regimes is accurate to 5 %."""
    file = root / "cases/water.nml"
    ds = pyehl.solve(file, {"grid.points": 257}, check=False)
    sheet = pyehl.film(file).summary
    assert sheet["regime"] == "elastic-isoviscous"
    assert sheet["formulas"][0]["name"] == "Nijenbanning-Venner-Moes"
    assert sheet["formulas"][0]["H_c"] == pytest.approx(float(ds.H_c_extrapolated), rel=0.05)
    thin = next(f for f in sheet["formulas"] if f["name"] == "Hamrock-Dowson")
    assert not thin["applies"]


def test_large_strain_is_reported(root: Path):
    reported = str(pyehl.solve(root / "cases/soft.nml", {"grid.points": 65}).attrs["assessment"])
    assert "the contact radius is 0.11 of the radius of curvature (p_h/E' = 0.034)" in reported
    assert "a strain of about 2.1 %" in reported
    small = {"contact.load": 0.01, "grid.points": 65}
    assert "strain" not in str(pyehl.solve(root / "cases/soft.nml", small).attrs["assessment"])
    with pytest.raises(pyehl.InputError, match="exceeds the reduced radius"):
        pyehl.check(root / "cases/soft.nml", {"bodies.modulus_1": 1e4, "contact.load": 5.0})


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("&lubricant viscosity=10.0, pressure_viscosity=1e-10, roelands_p0=1e7 /", "1:47"),
        ("&lubricant roelands_z=3.0 /", "1:23"),
    ],
)
def test_an_implausible_roelands_exponent(text, found):
    way_out = r"in \[0.001, 2\].*viscosity_law = 'barus'"
    with pytest.raises(pyehl.InputError, match=way_out) as error:
        pyehl.Case.from_text(text).resolve()
    assert "roelands_z" in str(error.value)
    assert f":{found}:" in str(error.value).splitlines()[0]
    barus = pyehl.Case.from_text(text, {"lubricant.viscosity_law": "barus"})
    assert "barus" in str(pyehl.check(barus))


def test_no_alpha_where_it_is_needed(root: Path):
    with pytest.raises(pyehl.InputError, match=r"moes_l = 0.0, or a pressure_viscosity above 0"):
        pyehl.check(pyehl.Case(), moes(100.0, 5.0), {"lubricant.pressure_viscosity": 0.0})
    rough = {"surface.kind": "fractal", "surface.pixels": 32, "grid.points": 65}
    with pytest.raises(pyehl.InputError, match="needs a viscosity that increases with pressure"):
        pyehl.predict(root / "cases/soft.nml", rough)
    page = pyehl.film(root / "cases/soft.nml", rough).summary
    assert page["lambda_ratio_central"] > 0.0
