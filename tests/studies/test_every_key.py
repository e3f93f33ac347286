# SPDX-License-Identifier: BSD-3-Clause
"""Runs, predictions, curves and fits use each key of a smooth contact: over the key table."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyehl
from pyehl.app.position import from_case
from pyehl.case import KEYS, resolved_case
from pyehl.case.settings import MACHINES
from pyehl.contact.smooth import OF_RUN, smooth_case, solve_contact
from pyehl.handle import SolverHandle, results_of
from pyehl.studies.curve_plan import plan_curve
from pyehl.studies.shear_fit import smooth_base
from pyehl.studies.study import axis
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array

POINTS = {"grid.points": 65}
SI = {"contact.load": 20.0, "contact.mean_velocity": 1.0, "contact.radius": 0.01}
SHEET = {
    "lubricant.kinematic_viscosity_40": 32.0,
    "lubricant.kinematic_viscosity_100": 5.4,
    "lubricant.temperature": 60.0,
}
DICKE = {
    "lubricant.viscosity_law": "dicke",
    "lubricant.vogel_viscosity": 5e-5,
    "lubricant.vogel_b": 980.0,
    "lubricant.vogel_c": 95.0,
    "lubricant.dicke_a1": 4.0e7,
    "lubricant.dicke_a2": 1.0e5,
    "lubricant.dicke_b1": 0.02,
    "lubricant.dicke_b2": 1e-5,
}
YASUTOMI = {
    "lubricant.viscosity_law": "yasutomi",
    "lubricant.yasutomi_tg0": -75.0,
    "lubricant.yasutomi_a1": 50.0,
    "lubricant.yasutomi_a2": 5e-9,
    "lubricant.yasutomi_b1": 7e-9,
    "lubricant.yasutomi_b2": -0.4,
    "lubricant.yasutomi_c1": 16.0,
    "lubricant.yasutomi_c2": 25.0,
}
TAIT = {
    "lubricant.density_law": "tait",
    "lubricant.tait_modulus": 9e9,
    "lubricant.tait_rate": 11.0,
    "lubricant.tait_softening": 6e-3,
    "lubricant.tait_expansion": 8e-4,
    "lubricant.tait_temperature": 20.0,
    "lubricant.temperature": 60.0,
}
DOOLITTLE = TAIT | {
    "lubricant.viscosity_law": "doolittle",
    "lubricant.doolittle_viscosity": 0.03,
    "lubricant.doolittle_temperature": 40.0,
    "lubricant.doolittle_b": 4.0,
    "lubricant.doolittle_r0": 0.65,
    "lubricant.doolittle_expansion": -1e-3,
}
MURNAGHAN = {
    "lubricant.density_law": "murnaghan",
    "lubricant.murnaghan_modulus": 9e9,
    "lubricant.murnaghan_rate": 11.0,
    "lubricant.murnaghan_softening": 6e-3,
}
RANGE = {"lubricant.range_temperature_max": 90.0}
BODIES = {"bodies.radius_x1": 0.01, "bodies.radius_y1": 0.01, "bodies.radius_x2": 0.03}
THINS = {"lubricant.shear_law": "eyring", "contact.slide_to_roll": 0.5}
CARREAU = THINS | {
    "lubricant.shear_law": "carreau",
    "lubricant.carreau_stress": 2e6,
    "lubricant.carreau_exponent": 0.5,
}
HEATED = SHEET | {"lubricant.thermal_reduction": True, "contact.slide_to_roll": 0.5}
BOUNDARY_FILM = {"lubricant.boundary_film": 1e-9}

# By key: its value, and other keys that it requires
VALUES: dict[str, tuple[Any, Mapping[str, Any]]] = {
    "contact.moes_m": (150.0, {"contact.moes_l": 5.0}),
    "contact.moes_l": (6.0, {"contact.moes_m": 200.0}),
    "contact.radius_ratio": (0.8, {"contact.moes_m": 100.0, "contact.moes_l": 5.0}),
    "contact.load": (30.0, SI),
    "contact.mean_velocity": (1.5, SI),
    "contact.radius": (0.012, SI),
    "contact.radius_x": (0.01, {"contact.radius_y": 0.012}),
    "contact.radius_y": (0.011, {"contact.radius_x": 0.01}),
    "contact.reduced_modulus": (1.5e11, SI),
    "contact.hardness": (9e9, SI | BOUNDARY_FILM),
    "contact.angle": (20.0, {"contact.radius_x": 0.01, "contact.radius_y": 0.012}),
    "contact.slide_to_roll": (0.6, SI | THINS),
    "contact.rough_surface": (2, SI | THINS),
    "contact.thermal_conductivity": (30.0, SI | HEATED),
    "contact.thermal_diffusivity": (1e-5, SI | HEATED),
    "contact.thermal_conductivity_2": (30.0, SI | HEATED),
    "contact.thermal_diffusivity_2": (1e-5, SI | HEATED),
    "bodies.radius_x1": (0.012, BODIES),
    "bodies.radius_y1": (0.012, BODIES),
    "bodies.radius_x2": (0.05, BODIES),
    "bodies.radius_y2": (0.05, BODIES),
    "bodies.modulus_1": (1e11, BODIES),
    "bodies.modulus_2": (1e11, BODIES),
    "bodies.poisson_1": (0.2, BODIES),
    "bodies.poisson_2": (0.2, BODIES),
    "lubricant.name": ("pao100", SI | {"lubricant.temperature": 60.0}),
    "lubricant.viscosity": (0.02, SI),
    "lubricant.pressure_viscosity": (1.8e-8, SI),
    "lubricant.viscosity_law": ("barus", SI),
    "lubricant.roelands_z": (0.6, SI),
    "lubricant.roelands_p0": (1.98e8, SI),
    "lubricant.density_law": ("incompressible", SI),
    "lubricant.murnaghan_modulus": (1e10, SI | MURNAGHAN),
    "lubricant.murnaghan_rate": (10.0, SI | MURNAGHAN),
    "lubricant.murnaghan_softening": (5e-3, SI | MURNAGHAN),
    "lubricant.range_temperature_min": (10.0, SI | DICKE | RANGE),
    "lubricant.range_temperature_max": (90.0, SI | DICKE),
    "lubricant.range_pressure_max": (1e9, SI | DICKE),
    "lubricant.shear_law": ("eyring", SI | {"contact.slide_to_roll": 0.5}),
    "lubricant.flow": ("newtonian", SI | THINS),
    "lubricant.eyring_stress": (3e6, SI | THINS),
    "lubricant.limiting_stress": (5e7, SI | {"lubricant.shear_law": "limiting"}),
    "lubricant.limiting_coefficient": (0.05, SI | {"lubricant.shear_law": "limiting"}),
    "lubricant.carreau_stress": (1e6, SI | CARREAU),
    "lubricant.carreau_exponent": (0.6, SI | CARREAU),
    "lubricant.boundary_film": (2e-9, SI),
    "lubricant.boundary_friction": (0.1, SI | BOUNDARY_FILM),
    "lubricant.temperature": (80.0, SI | SHEET),
    "lubricant.kinematic_viscosity_40": (46.0, SI | SHEET),
    "lubricant.kinematic_viscosity_100": (6.8, SI | SHEET),
    "lubricant.density_15": (900.0, SI | SHEET),
    "lubricant.thermal_expansion": (8e-4, SI | SHEET),
    "lubricant.thermal_reduction": (True, SI | SHEET),
    "lubricant.temperature_viscosity": (0.05, SI | HEATED),
    "lubricant.thermal_conductivity": (0.12, SI | HEATED),
    "lubricant.thermal_friction": ("always", SI | SHEET | THINS),
    "inlet.position": (1.6e-4, SI),
    "inlet.position_hertz": (1.4, SI),
    "grid.x_inlet": (-3.0, SI),
    "grid.x_outlet": (1.6, SI),
    "grid.y_extent": (2.5, SI),
    "grid.border": ("zero", {"contact.moes_m": 30.0, "contact.moes_l": 10.0}),
    "solver.deflection": ("fft", SI),
    "solver.coarsening": ("alcouffe", SI),
    "solver.symmetry": ("full", SI),
    "solver.cycle": ("W", SI),
    "solver.accuracy": (0.01, SI),
    "solver.max_cycles": (7, SI),
    "solver.threads": (2, SI),
} | {
    f"lubricant.{name}": (by * kind[f"lubricant.{name}"], SI | kind)
    for kind, names, by in (
        (DICKE, "vogel_viscosity vogel_b vogel_c dicke_a1 dicke_a2 dicke_b1 dicke_b2", 1.02),
        (YASUTOMI, "yasutomi_tg0 yasutomi_a1 yasutomi_a2 yasutomi_b1 yasutomi_b2", 0.98),
        (YASUTOMI, "yasutomi_c1 yasutomi_c2", 0.98),
        (TAIT, "tait_modulus tait_rate tait_softening tait_expansion tait_temperature", 1.02),
        (DOOLITTLE, "doolittle_viscosity doolittle_temperature doolittle_b doolittle_r0", 0.98),
        (DOOLITTLE, "doolittle_expansion", 0.98),
    )
    for name in names.split()
} | {"lubricant.yasutomi_viscosity": (5e11, SI | YASUTOMI)}  # fmt: skip
# Keys of a line contact, used only by runs: there is no prediction, curve or fit
LINE: dict[str, Mapping[str, Any]] = {
    "contact.shape": {"contact.moes_m_line": 20.0},
    "contact.moes_m_line": {"contact.moes_m_line": 20.0},
    "contact.moes_l_line": {"contact.moes_m_line": 20.0, "contact.moes_l_line": 7.0},
    "contact.load_per_length": {
        "contact.load_per_length": 1e5,
        "contact.mean_velocity": 1.0,
        "contact.radius": 0.01,
    },
}
# Keys of a roller, used only by runs
END: dict[str, Mapping[str, Any]] = {
    "contact.length": {},
    "contact.misalignment": {"contact.misalignment": 1e-4},
    "contact.profile": {"contact.profile": "crown", "contact.crown_radius": 1.0},
    "contact.crown_radius": {"contact.profile": "crown", "contact.crown_radius": 1.0},
    "contact.log_amplitude": {"contact.profile": "logarithmic", "contact.log_amplitude": 3e-6},
    "contact.chamfer_length": {
        "contact.profile": "chamfer",
        "contact.chamfer_length": 1e-3,
        "contact.chamfer_drop": 1e-5,
    },
}
END["contact.chamfer_drop"] = END["contact.chamfer_length"]
END |= {
    f"{name}_2": {f"{key}_2": value for key, value in keys.items()}
    for name, keys in END.items()
    if keys and name != "contact.misalignment"
}
# A layer of oil requires smooth surfaces: predictions, curves and fits have rough ones
SMOOTH = ("inlet.film", "inlet.film_hertz", "inlet.passages", "inlet.replenishment")
# A table of viscosities and one of a profile are files
TABLE, PROFILE = "lubricant.table", ("contact.profile_file", "contact.profile_file_2")
ROUGH = {"surface.kind": "harmonic", "surface.amplitude_over_film": 0.1}
# Groups that are no part of a smooth contact (although slide_to_roll follows from a velocity
# ratio), and the duty, which predictions refuse
OTHERS = ("surface", "second_surface", "time", "duty", "psd", "output", *MACHINES)


def test_every_key_has_a_value():
    """A new key of the table fails here until it has a value in this test."""
    # keys of a lubricant that are no input are tested with the key that they follow from
    inside = {
        name for name, key in KEYS.items() if name.partition(".")[0] not in OTHERS and key.for_input
    }
    with_one = VALUES.keys() | LINE.keys() | END.keys() | {TABLE, *PROFILE, *SMOOTH}
    assert inside == with_one | {f"grid.{name}" for name in OF_RUN}


@pytest.mark.parametrize("key", END)
def test_commands_without_rollers_refuse_them(key: str):
    """Predictions, film formulas, `fit-lubricant` and the app take none for a point contact."""
    roller = {
        "contact.shape": "roller",
        "contact.load": 2000.0,
        "contact.length": 0.01,
        "contact.radius": 0.01,
        "contact.mean_velocity": 1.0,
    }
    case = pyehl.Case.from_text("", roller | END[key] | POINTS)
    for asked in (
        lambda: OperatingPoint.from_settings(case.resolve()),  # first of a fit
        lambda: from_case(case),
        lambda: pyehl.predict(case.with_options("surface.kind=fractal")),
        lambda: pyehl.film(case),
    ):
        with pytest.raises(pyehl.InputError, match="roller"):
            asked()


def test_a_layer_of_oil_is_refused_with_roughness():
    with pytest.raises(pyehl.InputError, match=r"with inlet\.film"):
        pyehl.predict(pyehl.Case.from_text("", SI | ROUGH | {"inlet.film": 1e-7}))


@pytest.mark.parametrize("key", LINE)
def test_commands_without_line_contacts_refuse_them(key: str):
    """`fit-lubricant` and the app take none for a point contact."""
    case = pyehl.Case.from_text("", {"contact.shape": "line"} | LINE[key] | ROUGH | POINTS)
    for asked in (
        lambda: OperatingPoint.from_settings(case.resolve()),  # first of a fit
        lambda: from_case(case.with_options("surface.kind=smooth")),
    ):
        with pytest.raises(pyehl.InputError, match=r"line contacts have no|for point contacts"):
            asked()


def fields(text: str) -> tuple[Array, Array, str]:
    """P and H of a case, and the status."""
    with SolverHandle(text) as solver:
        solver.run()
        return solver.field("P"), solver.field("H"), str(results_of(solver).values["status"])


def made(key: str, tmp_path: Path) -> pyehl.Case:
    """A rough case with a value of a key other than its default."""
    if key == TABLE:
        rows = [f"{p},{t},{0.04 * np.exp(1.6e-8 * p - 0.03 * (t - 40))}"
                for t in (40, 80) for p in (0.0, 4e8, 8e8, 1.6e9)]  # fmt: skip
        path = tmp_path / "oil.csv"
        path.write_text("\n".join(["pressure_Pa,temperature_degC,viscosity_Pa_s", *rows]) + "\n")
        value, beside = str(path), SI
    else:
        value, beside = VALUES[key]
    with_it = pyehl.Case.from_text("", beside | ROUGH | POINTS | {key: value})
    group, _, name = key.partition(".")
    assert with_it.resolve()[group][name] == value
    return with_it


@pytest.mark.parametrize("key", [*VALUES, TABLE])
def test_the_contact_of_a_prediction_is_that_of_a_run(key: str, tmp_path: Path):
    """Bit for bit, except for the friction; with its boundary film if it has one."""
    case = made(key, tmp_path)
    text = smooth_case(case.resolve(), boundary=True)
    predicted = fields(pyehl.Case.from_text(text, POINTS).text)
    solved = fields(case.smooth().text)
    assert predicted[2] == solved[2]
    assert np.array_equal(predicted[0], solved[0])
    assert np.array_equal(predicted[1], solved[1])


@pytest.mark.parametrize("key", [*VALUES, TABLE])
def test_curves_and_fits_keep_every_key(key: str, tmp_path: Path):
    case = made(key, tmp_path)
    group, _, name = key.partition(".")
    wanted = case.resolve()[group][name]
    fit = smooth_base(case.resolve(), 65)
    taken = ("slide_to_roll", "rough_surface", "limiting_stress", "limiting_coefficient")
    if group != "bodies" and name not in taken:
        assert fit[group][name] == wanted
    contact = case.resolve()["contact"]
    if "load" not in contact or contact["angle"]:
        return
    speed = contact["mean_velocity"]
    plan = plan_curve(case, [axis("contact.mean_velocity", [speed])])
    smooth, predicted = (
        resolved_case(task.text).resolve() for task in (plan.tasks[0], plan.tasks[1])
    )
    assert predicted[group][name] == wanted
    assert smooth[group][name] == wanted


def test_a_prediction_without_a_border_pressure():
    """M = 30 with P = 0 at the border: the film is 5 % thinner than flooded, in both."""
    case = pyehl.Case(
        contact={"moes_m": 30.0, "moes_l": 10.0},
        surface={"kind": "harmonic", "amplitude_over_film": 0.1},
        grid={"border": "zero", "points": 257},
    )
    solved = float(pyehl.solve(case.smooth()).H_c_extrapolated)
    contact = solve_contact(case.resolve())
    assert contact.central_film == solved
    flooded = solve_contact(case.with_options("grid.border=flooded").resolve())
    assert flooded.central_film > 1.04 * solved
    p = pyehl.predict(case)
    assert p.film / p.operating.film_scale == pytest.approx(solved, rel=1e-12)


def test_the_grid_of_a_run_is_not_that_of_a_prediction():
    """The keys that `cases/README.md` names: the prediction has its own grids."""
    case = pyehl.Case.from_text("", SI | ROUGH | POINTS)
    for name, value in zip(OF_RUN, (129, 129, 1e-2, 257), strict=True):
        other = case.with_options({f"grid.{name}": value})
        assert smooth_case(other.resolve()) == smooth_case(case.resolve())


def test_the_app_keeps_every_key_but_its_own(tmp_path: Path):
    """A case that is opened keeps keys without a control, in both of its contacts."""
    for key in ("grid.x_inlet", "grid.y_extent", "solver.accuracy", "lubricant.density_law"):
        case = made(key, tmp_path)
        position, _ = from_case(case.with_options("surface.kind=smooth"))
        group, _, name = key.partition(".")
        for smooth in (True, False):
            shown = position.case(65, smooth=smooth).resolve()
            assert shown[group][name] == case.resolve()[group][name]
    position, _ = from_case(pyehl.Case.from_text("", SI | {"grid.target_error": 1e-4}))
    assert position.case(65).resolve()["grid"]["target_error"] == 0.0
