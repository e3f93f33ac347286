# SPDX-License-Identifier: BSD-3-Clause
"""Viscosity by Doolittle's free volume, density by Tait: formulas, and one law everywhere."""

import json
import math
import subprocess
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad

import pyehl
from pyehl import Case, InputError, Lubricant
from pyehl.theory.oils import reciprocal_isoviscous

Array = NDArray[np.float64]

# No particular oil: numbers like those of mineral oils
ETA, T_R, B, R0, EPS = 0.02, 40.0, 4.5, 0.66, -7.5e-4
K00, RATE, BETA, A_V = 9e9, 11.0, 6e-3, 8e-4
OIL = {
    "lubricant.viscosity_law": "doolittle",
    "lubricant.doolittle_viscosity": ETA,
    "lubricant.doolittle_temperature": T_R,
    "lubricant.doolittle_b": B,
    "lubricant.doolittle_r0": R0,
    "lubricant.doolittle_expansion": EPS,
    "lubricant.tait_modulus": K00,
    "lubricant.tait_rate": RATE,
    "lubricant.tait_softening": BETA,
    "lubricant.tait_expansion": A_V,
    "lubricant.tait_temperature": T_R,
}
PRESSURES = np.array([0.0, 5e7, 2e8, 6e8, 1.2e9])
TEMPERATURES = pytest.mark.parametrize("temperature", [10.0, 40.0, 95.0])


def modulus(temperature: float) -> float:
    return K00 * math.exp(-BETA * (temperature + 273.15))


def volume(p: Array | float, temperature: float) -> Array:
    """V/V_R, Bair 2007."""
    share = np.log(1.0 + np.asarray(p) * (1.0 + RATE) / modulus(temperature)) / (1.0 + RATE)
    return (1.0 + A_V * (temperature - T_R)) * (1.0 - share)


def viscosity(p: Array | float, temperature: float) -> Array:
    occupied = 1.0 + EPS * (temperature - T_R)
    free = volume(p, temperature) - R0 * occupied
    return ETA * np.exp(B * R0 * (occupied / free - 1.0 / (1.0 - R0)))


def of_case(*options: dict[str, object]) -> Lubricant:
    return Lubricant.from_settings(Case(Case.from_text(""), *options).resolve())


@TEMPERATURES
def test_laws_are_their_formulas(temperature: float):
    oil = of_case(OIL, {"lubricant.temperature": temperature})
    assert oil.density_law == "tait"
    for rise in (0.0, 35.0):
        eta = oil.viscosity * oil.viscosity_ratio(PRESSURES, rise)
        assert eta == pytest.approx(viscosity(PRESSURES, temperature + rise), rel=1e-9)
        rho = volume(0.0, temperature) / volume(PRESSURES, temperature + rise)
        assert oil.density_ratio(PRESSURES, rise) == pytest.approx(rho, rel=1e-12)


@TEMPERATURES
def test_coefficients_follow(temperature: float):
    """Alpha in closed form, the decrease with temperature, and alpha* by an integral of scipy."""
    oil = of_case(OIL, {"lubricant.temperature": temperature})
    occupied, whole = 1.0 + EPS * (temperature - T_R), 1.0 + A_V * (temperature - T_R)
    alpha = B * R0 * occupied * whole / modulus(temperature) / (whole - R0 * occupied) ** 2
    assert oil.pressure_viscosity == pytest.approx(alpha, rel=1e-12)
    fall = math.log(float(viscosity(0.0, temperature - 0.1) / viscosity(0.0, temperature + 0.1)))
    assert oil.temperature_viscosity == pytest.approx(fall / 0.2, rel=1e-5)
    ambient = float(viscosity(0.0, temperature))
    inverse, _ = quad(lambda p: ambient / float(viscosity(p, temperature)), 0.0, 3e9, limit=200)
    assert reciprocal_isoviscous(oil) == pytest.approx(1.0 / inverse, rel=1e-5)


def test_reference_temperature_does_not_matter():
    """The volume for another T_R, with K0 unchanged and a_V over the volume there."""
    other = {
        "lubricant.tait_temperature": T_R - 25.0,
        "lubricant.tait_expansion": A_V / (1.0 - 25.0 * A_V),
    }
    first, second = (
        of_case({**OIL, **more}, {"lubricant.temperature": 70.0}) for more in ({}, other)
    )
    assert second.viscosity == pytest.approx(first.viscosity, rel=1e-12)
    assert second.viscosity_ratio(PRESSURES, 20.0) == pytest.approx(
        first.viscosity_ratio(PRESSURES, 20.0), rel=1e-9
    )
    assert second.density_ratio(PRESSURES, 20.0) == pytest.approx(
        first.density_ratio(PRESSURES, 20.0), rel=1e-12
    )


def test_an_oil_without_free_volume_is_refused():
    """Above 1.15 GPa there is no free volume: the default contact reaches it, a light one not."""
    thick = {**OIL, "lubricant.doolittle_r0": 0.8, "lubricant.doolittle_b": 1.0}
    assert not np.isfinite(of_case(thick, {"contact.load": 1.0}).log_viscosity_ratio(5e9))
    with pytest.raises(InputError, match="no viscosity that increases with pressure"):
        Case.from_text("", thick)


def test_a_written_case_reads_back():
    for options in (
        OIL,
        {**OIL, "lubricant.density_law": "dowson-higginson"},
        {**OIL, "lubricant.name": "pao100"},
        {
            key: value
            for key, value in {**OIL, "lubricant.density_law": "tait"}.items()
            if "doolittle" not in f"{key} {value}"
        },
    ):
        case = Case(Case.from_text("", {"lubricant.temperature": 50.0, **options}))
        assert Case.from_text(case.text).text == case.text
    warm = Case.from_text(Case.from_text("", OIL).text, {"lubricant.temperature": 70.0})
    assert warm.resolve()["lubricant"]["viscosity"] == pytest.approx(
        float(viscosity(0.0, 70.0)), rel=1e-12
    )
    # an option keeps the default
    law = Case.from_text(Case.from_text("", OIL).text, {"lubricant.viscosity_law": "roelands"})
    assert law.resolve()["lubricant"]["density_law"] == "dowson-higginson"


@pytest.fixture
def table(tmp_path: Path) -> Path:
    """The viscosities of the law at 60 degC, with points dense enough to represent it."""
    path = tmp_path / "oil.csv"
    p = 2e9 * np.linspace(0.0, 1.0, 400) ** 1.5
    states = zip(p.tolist(), viscosity(p, 60.0).tolist(), strict=True)
    lines = (f"{a!r},60,{b!r}" for a, b in states)
    path.write_text("pressure_Pa,temperature_degC,viscosity_Pa_s\n" + "\n".join(lines) + "\n")
    return path


CONTACT = {
    "contact.load": 150.0,
    "contact.mean_velocity": 3.0,
    "contact.slide_to_roll": 0.2,
    "lubricant.temperature": 60.0,
    "lubricant.shear_law": "eyring",
    "lubricant.thermal_friction": "never",
    "grid.points": 129,
}


def test_film_friction_and_prediction_obey_the_law(table: Path):
    """A table of the viscosities of the law, with its density, is the same lubricant."""
    volume_alone = {key: value for key, value in OIL.items() if "tait" in key}
    tabulated = {**volume_alone, "lubricant.table": str(table), "lubricant.density_law": "tait"}
    rough = {"surface.kind": "fractal", "surface.pixels": 64, "surface.rms_height": 1e-8}
    # the smooth contact is solved for the prediction
    rough["psd.smooth"] = "hertz"
    runs = []
    for law in (OIL, tabulated):
        case = Case.from_text("", {**law, **CONTACT})
        data, predicted = pyehl.solve(case), pyehl.predict(case, rough)
        assert data.attrs["status"] == "converged"
        formula = pyehl.film(case).formulas[0]["h_c_m"]
        solved = float(data.h_c_m), float(data.h_min_m), float(data.mu)
        runs.append((solved, predicted.mu_ratio, formula))
    first, second = runs
    assert second[0] == pytest.approx(first[0], rel=1e-4)
    assert second[1] - 1.0 == pytest.approx(first[1] - 1.0, abs=1e-6)
    assert abs(first[1] - 1.0) > 1e-4
    # by alpha, the slope of the first chord of the table
    assert second[2] == pytest.approx(first[2], rel=1e-3)


def test_compression_thins_the_film():
    """A film of a compressed liquid is thinner by the ratio of densities."""
    solved, formula = {}, {}
    for law in ("tait", "incompressible"):
        case = Case.from_text("", {**OIL, **CONTACT, "lubricant.density_law": law})
        solved[law] = float(pyehl.solve(case).h_c_m)
        film = pyehl.film(case).summary
        formula[law] = film["formulas"][0]["h_c_m"]
    inlet, pressed = volume(np.array([1.5e8, film["hertz_pressure_Pa"]]), 60.0) / volume(0.0, 60.0)
    assert formula["tait"] / formula["incompressible"] == pytest.approx(pressed, rel=1e-9)
    # the inlet determines the flow through the contact, where the oil is denser already
    assert pressed < solved["tait"] / solved["incompressible"] < pressed / inlet


def test_both_programs_take_the_law(drivers: dict[str, list[str]], tmp_path: Path):
    case = tmp_path / "case.nml"
    case.write_text(
        Case.from_text("", {**OIL, **CONTACT, "lubricant.range_pressure_max": 4e8}).text
    )
    result = []
    for name, command in drivers.items():
        folder = tmp_path / name
        subprocess.run([*command, str(case), "-o", str(folder)], check=True, capture_output=True)
        summary = json.loads((folder / "summary.json").read_text())
        result.append((summary["H_c"], summary["mu"]))
    assert result[0] == result[1]
    # the last is the summary of pyehl, with the limits of the lubricant
    assert "doolittle viscosity at 60.0 degC" in summary["lubricant_note"]
    assert "the pressure is above it" in summary["lubricant_note"]
