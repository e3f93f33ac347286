# SPDX-License-Identifier: BSD-3-Clause
"""The controls: names, units and ranges."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from pyehl.errors import InputError
from pyehl.theory.oils import known_oils

Value = float | int | str

# Number of steps of a slider
STEPS = 400


@dataclass(frozen=True, slots=True)
class Control:
    """A number with a slider and a text field.

    `low` and `high` are the ends of the slider; typed values may be beyond them.
    """

    name: str
    label: str
    unit: str
    scale: float  # unit of the control in the unit of the case file
    low: float
    high: float
    log: bool = True  # whether the slider is logarithmic
    whole: bool = False

    def at(self, place: int) -> Value:
        """Give the value at a place of the slider, 0 to `STEPS`, with three digits."""
        fraction = place / STEPS
        if self.log:
            value = self.low * (self.high / self.low) ** fraction
        else:
            value = self.low + (self.high - self.low) * fraction
        return round(value) if self.whole else float(f"{value:.3g}")

    def place(self, value: float) -> int:
        """Give the nearest place of the slider."""
        inside = min(max(value, self.low), self.high)
        if self.log:
            fraction = math.log(inside / self.low) / math.log(self.high / self.low)
        else:
            fraction = (inside - self.low) / (self.high - self.low)
        return round(fraction * STEPS)

    def read(self, text: str) -> Value:
        """Read typed text; InputError if it is not a number."""
        try:
            value = int(text) if self.whole else float(text)
            finite = math.isfinite(value)
        except (ValueError, OverflowError):
            kind = "a whole number" if self.whole else "a number"
            unit = f" [{self.unit}]" if self.unit else ""
            raise InputError(f"{self.label} = '{text}': expected {kind}{unit}") from None
        if not finite:
            raise InputError(f"{self.label} = '{text}': expected a finite number")
        return value


@dataclass(frozen=True, slots=True)
class Choice:
    """One of several words."""

    name: str
    label: str
    words: tuple[str, ...]

    def read(self, text: str) -> str:
        """Check a word; InputError if it is not one of them."""
        if text not in self.words:
            raise InputError(f"{self.label} = '{text}': expected one of {', '.join(self.words)}")
        return text


GROUPS: dict[str, tuple[Control | Choice, ...]] = {
    "Operation": (
        Control("load", "load w", "N", 1.0, 1.0, 5000.0),
        Control("velocity", "mean velocity u", "m/s", 1.0, 0.01, 20.0),
        Control("slide_to_roll", "slide-to-roll ratio", "", 1.0, 0.0, 2.0, log=False),
    ),
    "Bodies": (
        Control("radius_x", "reduced radius along, R_x", "mm", 1e-3, 1.0, 200.0),
        Control("radius_y", "reduced radius across, R_y", "mm", 1e-3, 1.0, 200.0),
        Control("modulus_1", "E of body 1", "GPa", 1e9, 10.0, 700.0),
        Control("poisson_1", "ν of body 1", "", 1.0, 0.0, 0.5, log=False),
        Control("modulus_2", "E of body 2", "GPa", 1e9, 10.0, 700.0),
        Control("poisson_2", "ν of body 2", "", 1.0, 0.0, 0.5, log=False),
    ),
    "Oil": (
        Choice("oil", "viscosity", ("at the inlet", "of the data sheet", "of an oil by name")),
        Choice("oil_name", "oil", tuple(known_oils())),
        Control("viscosity", "η₀ at the inlet", "Pa s", 1.0, 0.002, 1.0),
        Control("kinematic_40", "ν at 40 °C", "mm²/s", 1.0, 5.0, 1000.0),
        Control("kinematic_100", "ν at 100 °C", "mm²/s", 1.0, 1.5, 60.0),
        Control("temperature", "inlet temperature", "°C", 1.0, -20.0, 150.0, log=False),
        Control("alpha", "pressure-viscosity α", "1/GPa", 1e-9, 5.0, 40.0),
        Choice("shear_law", "shear stress", ("newtonian", "eyring", "limiting", "carreau")),
        Control("eyring_stress", "Eyring stress", "MPa", 1e6, 0.5, 50.0),
        Control("carreau_stress", "Carreau stress G", "MPa", 1e6, 0.01, 50.0),
        Control("carreau_exponent", "Carreau exponent n", "", 1.0, 0.2, 1.0, log=False),
    ),
    "Surface": (
        Choice("surface", "surface", ("smooth", "fractal", "map")),
        Control("rms", "rms height σ", "nm", 1e-9, 1.0, 500.0),
        Control("hurst", "Hurst exponent", "", 1.0, 0.1, 1.0, log=False),
        Control("seed", "seed", "", 1.0, 1, 401, log=False, whole=True),
        Control("map_x", "map along x (0: from file)", "mm", 1e-3, 0, 4, log=False),
        Control("map_y", "map across (0: from file)", "mm", 1e-3, 0, 4, log=False),
    ),
}
CONTROLS = {control.name: control for group in GROUPS.values() for control in group}

# Controls that are shown only for some values of another control
ONLY: dict[str, tuple[str, ...]] = {
    "oil_name": ("oil", "of an oil by name"),
    "viscosity": ("oil", "at the inlet"),
    "alpha": ("oil", "at the inlet", "of the data sheet"),
    "kinematic_40": ("oil", "of the data sheet"),
    "kinematic_100": ("oil", "of the data sheet"),
    "temperature": ("oil", "of the data sheet", "of an oil by name"),
    "eyring_stress": ("shear_law", "eyring"),
    "carreau_stress": ("shear_law", "carreau"),
    "carreau_exponent": ("shear_law", "carreau"),
    "rms": ("surface", "fractal"),
    "hurst": ("surface", "fractal"),
    "seed": ("surface", "fractal"),
    "map_x": ("surface", "map"),
    "map_y": ("surface", "map"),
}


def shown(name: str, values: Mapping[str, Value]) -> bool:
    """Whether a control is shown with these values."""
    if name not in ONLY:
        return True
    other, *words = ONLY[name]
    return values[other] in words
