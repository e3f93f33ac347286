# SPDX-License-Identifier: BSD-3-Clause
"""Film formulas and the page of ``pyehl film``."""

import pytest
import reference

import pyehl
from pyehl.case import Case
from pyehl.contact import film_formulas
from pyehl.contact.film_formulas import report
from pyehl.theory import film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint


@pytest.mark.parametrize("row", reference.SMOOTH, ids=lambda r: f"M{r.moes_m:g}-z{r.roelands_z}")
def test_nijenbanning_venner_moes_against_converged_solutions(row):
    point = OperatingPoint.from_moes(row.moes_m, row.moes_l)
    oil = Lubricant(roelands_z=row.roelands_z)
    value = film.central_film(point, oil) / point.film_scale
    assert value == pytest.approx(row.limit_c, rel=0.008 if row.moes_m >= 500 else 0.02)


def test_nijenbanning_asymptotes():
    low, high = 1e6, 1e8
    stiff = [film.nijenbanning_venner_moes(m, 0.0) * (1.5 * m) ** (2 / 3) for m in (low, high)]
    # isoviscous-elastic: proportional to M^(-2/15)
    assert stiff[1] / stiff[0] == pytest.approx((high / low) ** (-2 / 15), rel=1e-3)
    # piezoviscous-elastic at large L: proportional to L^(3/4)
    thick = [film.nijenbanning_venner_moes(1e10, ell) for ell in (1e3, 2e3)]
    assert thick[1] / thick[0] == pytest.approx(2**0.75, rel=2e-3)


def test_error_of_hamrock_dowson_is_the_one_on_the_page():
    row = reference.SMOOTH[0]
    point = OperatingPoint.from_moes(row.moes_m, row.moes_l)
    scale = point.radius / point.film_scale
    h_c, h_min = film.hamrock_dowson(point.speed, point.material, point.load_number)
    assert h_c * scale / row.limit_c == pytest.approx(1.08, abs=0.01)
    assert h_min * scale / row.limit_min == pytest.approx(1.76, abs=0.02)


def test_validity_flags():
    by_name = {f.name: f for f in film.estimates(OperatingPoint(), Lubricant())}
    assert by_name["Hamrock-Dowson"].outside  # W2 = 8e-6 is far above the cases it was fitted to
    assert not by_name["Nijenbanning-Venner-Moes"].outside
    light = OperatingPoint(load=20.0)
    assert not {f.name: f for f in film.estimates(light, Lubricant())}["Hamrock-Dowson"].outside


def test_sheet_of_the_harmonic_case(settings):
    settings["surface"]["kind"] = "harmonic"
    settings["surface"]["amplitude_over_film"] = 0.4
    values = film_formulas.sheet(settings)
    # the paper's fig. 2: eq. 16 gives 1.466 at L = 10; here L = 10.024
    assert values["mu_ratio_eq_16"] == pytest.approx(1.468, abs=0.002)
    assert values["theta_2_outside"] == []
    assert values["lambda_ratio_central"] == pytest.approx(2 / 0.4)
    page = report(values)
    for word in ("p_h", "1.6602 GPa", "h_c/sigma", "theta_2", "inside", "Hamrock-Dowson"):
        assert word in page


def test_sheet_names_what_is_outside(settings):
    settings["surface"] |= {"kind": "harmonic", "wavelength_x": 2.0, "wavelength_y": 3.0}
    outside = film_formulas.sheet(settings)["theta_2_outside"]
    assert any("wavelength = 2" in text for text in outside)
    assert any("equal wavelengths" in text for text in outside)


def test_sheet_from_moes_numbers_and_smooth():
    case = pyehl.Case(contact={"moes_m": 20.0, "moes_l": 10.0}).resolve()
    values = film_formulas.sheet(case)
    assert values["moes_m"] == pytest.approx(20.0)
    assert "lambda_ratio_central" not in values
    assert "made from M and L" in report(values)


def test_columns_of_the_sheet_do_not_touch_at_a_low_load():
    """M = 0.05: H_c has five digits before its decimal point."""
    values = film_formulas.sheet(pyehl.Case(contact={"moes_m": 0.05, "moes_l": 5.0}).resolve())
    line = next(text for text in report(values).splitlines() if "Brewe" in text)
    h_c, h_min, reduced, reduced_min = map(float, line.split()[2:6])
    brewe = next(f for f in values["formulas"] if f["name"].startswith("Brewe"))
    assert (h_c, h_min) == pytest.approx((brewe["h_c_m"] * 1e6, brewe["h_min_m"] * 1e6), rel=1e-4)
    assert (reduced, reduced_min) == pytest.approx((brewe["H_c"], brewe["H_min"]), rel=1e-4)


def test_ellipses():
    """The accuracies are known for circles; at an angle only the dry contact is given."""
    ellipse = {"contact.load": 50.0, "contact.radius_x": 0.01, "contact.radius_y": 0.03}
    straight, turned = (
        film_formulas.sheet(Case.from_text("", ellipse | {"contact.angle": angle}).resolve())
        for angle in (0.0, 30.0)
    )
    page = report(straight)
    assert "Hamrock-Dowson" in page
    assert "too high" not in page
    assert turned["formulas"] == []
    assert turned["hertz_pressure_Pa"] == straight["hertz_pressure_Pa"]
    page = report(turned)
    assert "both rotated by                       30 deg" in page
    assert page.endswith("the formulas need an axis along the motion")


def test_names_keys_without_effect_on_the_formulas():
    reported = {
        "grid.border": "zero",
        "grid.x_inlet": -1.5,
        "lubricant.shear_law": "eyring",
        "lubricant.boundary_film": 1e-9,
    }
    values = film_formulas.sheet(Case.from_text("", reported).resolve())
    keys = [text.split(" = ")[0] for text in values["left_out"]]
    assert keys == ["grid.x_inlet", "lubricant.shear_law", "lubricant.boundary_film"]
    assert "left out: grid.x_inlet = -1.5" in report(values)
    assert film_formulas.sheet(Case.from_text("").resolve())["left_out"] == []


def test_refuses():
    with pytest.raises(ValueError, match="M > 0"):
        film.nijenbanning_venner_moes(0.0, 10.0)
