# SPDX-License-Identifier: BSD-3-Clause
"""Position of the controls, and its case."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

from pyehl import namelist
from pyehl.app.controls import CONTROLS, GROUPS, Control, Value
from pyehl.case import Case
from pyehl.errors import InputError
from pyehl.surfaces import rough_groups
from pyehl.theory.oils import known_oils
from pyehl.theory.operating import OperatingPoint

# Keys that the controls set; all other keys of an opened case stay
OWNED = {
    "bodies": None,
    "contact": {
        "load", "mean_velocity", "radius", "radius_x", "radius_y", "radius_ratio", "moes_m",
        "moes_l", "reduced_modulus", "slide_to_roll",
    },
    "lubricant": {
        "name", "viscosity", "kinematic_viscosity_40", "kinematic_viscosity_100", "temperature",
        "pressure_viscosity", "shear_law", "eyring_stress", "carreau_stress", "carreau_exponent",
    },
    "surface": {
        "kind", "rms_height", "ra", "rq", "finish", "hurst", "seed", "file", "length_x", "length_y",
    },
    "grid": {"points", "points_y", "target_error", "max_points"},
}  # fmt: skip
# Keys that belong to the oil of an opened case only
OF_SHEET = ("density_15", "thermal_expansion")
# Keys of a surface that follow from its finish, and are no controls
OF_FINISH = ("rolloff_wavenumber", "lay_ratio")
STEEL = {"modulus_1": 206.0, "poisson_1": 0.3, "modulus_2": 206.0, "poisson_2": 0.3}
STEEL_MODULUS = STEEL["modulus_1"] * 1e9 / (1.0 - STEEL["poisson_1"] ** 2)
"""E' of two such bodies [Pa]."""
DEFAULTS: dict[str, Value] = {
    "oil": "at the inlet",
    "oil_name": next(iter(known_oils())),
    "kinematic_40": 68.0,
    "kinematic_100": 8.8,
    "temperature": 40.0,
    "shear_law": "newtonian",
    "eyring_stress": 5.0,
    "carreau_stress": 5.0,
    "carreau_exponent": 0.6,
    "surface": "smooth",
    "rms": 50.0,
    "hurst": 0.8,
    "seed": 1,
    "map_x": 0.0,
    "map_y": 0.0,
}
KINDS = ("smooth", "fractal", "map")
_OF_SURFACE = tuple(control.name for control in GROUPS["Surface"])


@dataclass(frozen=True, slots=True)
class Position:
    """Values of all controls, in their units; immutable.

    Attributes
    ----------
    values
        Values by the names of `pyehl.app.controls.CONTROLS`.
    base
        The other keys of the case, as namelist text.
    modulus
        E' [Pa] of an opened case, until an elastic constant of a body changes; 0: by these.
    file
        Height map of the surface 'map'; '': none yet.
    oil
        Value of the control 'oil' for the opened case.
    """

    values: Mapping[str, Value]
    base: str = ""
    modulus: float = 0.0
    file: str = ""
    oil: Value = "at the inlet"

    def changed(self, name: str, value: Value) -> Self:
        """Give the position with a control changed."""
        modulus = 0.0 if name in STEEL else self.modulus
        return replace(self, values={**self.values, name: value}, modulus=modulus)

    def _si(self, name: str) -> float:
        control = CONTROLS[name]
        assert isinstance(control, Control)
        # rounded to the value of a decimal text, 22 1/GPa as 2.2e-8
        return float(f"{float(self.values[name]) * control.scale:.12g}")

    def reduced_modulus(self) -> float:
        """E' [Pa]: 2/E' = sum of (1 - nu^2)/E. InputError for impossible moduli."""
        if self.modulus:
            return self.modulus
        total = 0.0
        for body in ("1", "2"):
            modulus, poisson = self._si(f"modulus_{body}"), float(self.values[f"poisson_{body}"])
            if modulus <= 0.0 or not -1.0 < poisson <= 0.5:
                raise InputError(
                    f"body {body}: E = {modulus:g} Pa, ν = {poisson:g}: expected E above 0 and ν "
                    "above -1 and up to 0.5"
                )
            total += (1.0 - poisson**2) / modulus
        return float(f"{2.0 / total:.12g}")

    def options(self, points: int) -> dict[str, Value]:
        """Give the keys of the case that the controls set."""
        v = self.values
        result: dict[str, Value] = {
            "contact.load": self._si("load"),
            "contact.mean_velocity": self._si("velocity"),
            "contact.slide_to_roll": float(v["slide_to_roll"]),
            "contact.reduced_modulus": self.reduced_modulus(),
            "grid.points": points,
            **self._oil(),
        }
        if v["radius_x"] == v["radius_y"]:
            result["contact.radius"] = self._si("radius_x")
        else:
            result["contact.radius_x"] = self._si("radius_x")
            result["contact.radius_y"] = self._si("radius_y")
        if v["shear_law"] != "newtonian":
            result["lubricant.shear_law"] = v["shear_law"]
        if v["shear_law"] == "eyring":
            result["lubricant.eyring_stress"] = self._si("eyring_stress")
        if v["shear_law"] == "carreau":
            result["lubricant.carreau_stress"] = self._si("carreau_stress")
            result["lubricant.carreau_exponent"] = float(v["carreau_exponent"])
        if v["surface"] != "smooth":
            result |= self._surface()
        return result

    def _oil(self) -> dict[str, Value]:
        v = self.values
        temperature = {"lubricant.temperature": float(v["temperature"])}
        if v["oil"] == "of an oil by name":
            return {"lubricant.name": v["oil_name"], **temperature}
        alpha = {"lubricant.pressure_viscosity": self._si("alpha")}
        if v["oil"] == "at the inlet":
            return {"lubricant.viscosity": self._si("viscosity"), **alpha}
        return {
            "lubricant.kinematic_viscosity_40": float(v["kinematic_40"]),
            "lubricant.kinematic_viscosity_100": float(v["kinematic_100"]),
            **temperature,
            **alpha,
        }

    def _surface(self) -> dict[str, Value]:
        v = self.values
        if v["surface"] == "fractal":
            return {
                "surface.kind": "fractal",
                "surface.rms_height": self._si("rms"),
                "surface.hurst": float(v["hurst"]),
                "surface.seed": int(v["seed"]),
            }
        if not self.file:
            raise InputError("there is no height map yet: expected an upload")
        result: dict[str, Value] = {"surface.kind": "map", "surface.file": self.file}
        for control, key in (("map_x", "length_x"), ("map_y", "length_y")):
            if float(v[control]) != 0.0:
                result[f"surface.{key}"] = self._si(control)
        return result

    def case(self, points: int, *, smooth: bool = False) -> Case:
        """Make the case on a grid, or that of its smooth contact; InputError if it is invalid."""
        base = self.base
        if self.values["oil"] != self.oil:
            lines = base.splitlines(keepends=True)
            base = "".join(line for line in lines if line.split(" =")[0].strip() not in OF_SHEET)
        case = Case.from_text(base, self.options(points), origin="the controls")
        return case.smooth() if smooth else case

    def text(self, points: int) -> str:
        """Give the case file without defaults, and the map without its folder."""
        text = namelist.given(self.case(points).text, comments=False)
        return text.replace(self.file, Path(self.file).name) if self.file else text

    @property
    def contact(self) -> tuple[object, ...]:
        """The values that the smooth contact depends on."""
        controls = [v for name, v in self.values.items() if name not in _OF_SURFACE]
        return (*controls, self.modulus, self.base, self.oil)

    def map_message(self) -> dict[str, Value]:
        """Give the keys of the case that `Uploads.check` takes for its height map."""
        kept = namelist.values(self.base).get("surface", {})
        keys = ("channel", "height_unit", "lateral_unit")
        result = {key: kept[key] for key in keys if key in kept}
        return result | {f"length_{x}": self._si(f"map_{x}") for x in "xy"}

    @property
    def rough(self) -> bool:
        """Whether there is a rough surface."""
        return self.values["surface"] != "smooth"


def _kept(text: str) -> str:
    """Give the keys of a resolved case that the controls do not set.

    In place of a finish its spectrum and lay.
    """
    groups, surface = {}, namelist.values(text)["surface"]
    for group, keys in namelist.values(namelist.given(text)).items():
        owned = OWNED.get(group, set())
        rest = {} if owned is None else {k: v for k, v in keys.items() if k not in owned}
        if keys.get("finish", "none") != "none":
            rest |= {key: surface[key] for key in OF_FINISH}
        if rest:
            groups[group] = rest
    return namelist.text_of(groups)


def from_case(case: Case, files: Mapping[str, str] | None = None) -> tuple[Position, str]:
    """Give the position of the controls for a case, and a note on conversions.

    `files` are the maps that may be read, by their names; None: those of the case. A case in M and
    L becomes one in SI units with the radius and the modulus of a steel ball. InputError if the
    controls cannot represent the case.
    """
    settings = case.resolve()
    if "second_surface" in rough_groups(settings):
        raise InputError("second_surface: the page takes one rough surface, that of &surface")
    surface = settings["surface"]
    kind = str(surface["kind"])
    if kind not in KINDS:
        raise InputError(f"surface.kind = '{kind}': the page takes {', '.join(KINDS)}")
    contact, lubricant = settings["contact"], settings["lubricant"]
    if lubricant.get("table"):
        raise InputError("lubricant.table: the page takes viscosities, data sheets and names")
    # the viscosity without shear heating
    plain = {**lubricant, "thermal_reduction": False}
    point = OperatingPoint.from_settings({"contact": contact, "lubricant": plain})
    note = ""
    if not point.si:
        note = (
            f"Given as M = {contact['moes_m']:g} and L = {contact['moes_l']:g}: the controls show "
            "a steel ball with these."
        )
    values: dict[str, Value] = {**DEFAULTS, **STEEL}
    values |= {
        "load": _tidy(point.load),
        "velocity": _tidy(point.mean_velocity),
        "slide_to_roll": point.slide_to_roll,
        "radius_x": _tidy(point.radius * 1e3),
        "radius_y": _tidy(point.radius / point.radius_ratio * 1e3),
        "viscosity": _tidy(float(lubricant["viscosity"])),
        "alpha": _tidy(point.pressure_viscosity * 1e9),
        "shear_law": str(lubricant["shear_law"]),
        "surface": kind,
        "rms": _tidy(float(surface["rms_height"]) * 1e9),
        "hurst": float(surface["hurst"]),
        "seed": int(surface["seed"]),
        "map_x": _tidy(float(surface["length_x"]) * 1e3) if kind == "map" else 0.0,
        "map_y": _tidy(float(surface["length_y"]) * 1e3) if kind == "map" else 0.0,
    }
    values |= _oil(lubricant)
    bodies = settings.get("bodies")
    if bodies is not None:
        scales = {name: 1e-9 if name.startswith("modulus") else 1.0 for name in STEEL}
        values |= {name: _tidy(float(bodies[name]) * scales[name]) for name in STEEL}
    elif not math.isclose(point.reduced_modulus, STEEL_MODULUS, rel_tol=2e-3):
        # not steel, even with the few digits that users write
        note += f" E' = {point.reduced_modulus * 1e-9:.6g} GPa until a modulus is changed."
    file = str(surface["file"]) if kind == "map" else ""
    if file and files is not None:
        name = Path(file).name
        if name not in files:
            raise InputError(f"surface.file = '{name}': expected an upload of this map first")
        file = files[name]
    kept = _kept(case.text)
    return Position(values, kept, point.reduced_modulus, file, values["oil"]), note.strip()


def _oil(lubricant: Mapping[str, Any]) -> dict[str, Value]:
    """Give the controls of the oil that depend on the case."""
    result: dict[str, Value] = {"eyring_stress": _tidy(float(lubricant["eyring_stress"]) * 1e-6)}
    if lubricant["shear_law"] == "carreau":
        result["carreau_stress"] = _tidy(float(lubricant["carreau_stress"]) * 1e-6)
        result["carreau_exponent"] = float(lubricant["carreau_exponent"])
    if lubricant.get("name"):
        result["oil"] = "of an oil by name"
        result["oil_name"] = str(lubricant["name"])
        result["temperature"] = float(lubricant["temperature"])
    elif lubricant.get("kinematic_viscosity_40"):
        result["oil"] = "of the data sheet"
        result["kinematic_40"] = float(lubricant["kinematic_viscosity_40"])
        result["kinematic_100"] = float(lubricant["kinematic_viscosity_100"])
        result["temperature"] = float(lubricant["temperature"])
    return result


def _tidy(value: float) -> float:
    """Remove the rounding errors of a conversion of units."""
    return float(f"{value:.12g}")
