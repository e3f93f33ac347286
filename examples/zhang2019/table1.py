# SPDX-License-Identifier: BSD-3-Clause
"""Table 1: the operating conditions, and quantities that follow from them."""

from piece import Check, Level, References, Result
from runs import Runs

from pyehl import surfaces
from pyehl.case import Case
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

NAME = "table 1"
TITLE = "Operating conditions and what follows from them"
CASE = """&contact
   load = 600.0  mean_velocity = 0.84  radius = 0.018  reduced_modulus = 2.26e11
/
&lubricant
   viscosity = 0.04  pressure_viscosity = 2.2e-8
/
&surface
   kind = 'fractal'  rms_height = 5e-8  length_x = 8.29e-4  length_y = 8.29e-4
   pixels = 256  hurst = 0.8  rolloff_wavenumber = 0.0  velocity_ratio = 1.01
/
"""
"""The case of Table 1, for all pieces with its surface."""
GIVEN = "load mean_velocity radius reduced_modulus pressure_viscosity viscosity".split()
FOLLOWING = "moes_m moes_l hertz_pressure hertz_radius speed_parameter".split()


def run(runs: Runs, level: Level) -> dict[str, float]:
    """Resolve the case, and make its surface."""
    settings = Case.from_text(CASE, origin="table 1").resolve()
    point = OperatingPoint.from_settings(settings)
    tile = surfaces.from_settings(settings, point, 1e-7)
    return {
        **{name: getattr(point, name) for name in GIVEN},
        "rms_height": tile.rms_height,
        "length": tile.length_x,
        "pixels": float(tile.shape[0]),
        "hurst": float(settings["surface"]["hurst"]),
        **{name: getattr(point, name) for name in FOLLOWING},
        "roelands_z": Lubricant.from_settings(settings).roelands_z or 0.0,
        "length_over_radius": tile.length_x / point.hertz_radius,
    }


def show(data: dict[str, float], references: References, level: Level) -> Result:
    """Compare with the printed numbers, and with those that follow from them by hand."""
    checks = [Check.of(name, value, references[f"table1.{name}"]) for name, value in data.items()]
    rows = [
        (name, c.value, c.expected, references[f"table1.{name}"].unit, c.deviation)
        for c, name in zip(checks, data, strict=True)
    ]
    notes = [
        "The rms height is measured on the surface that the generator makes. The tile is as wide "
        "as the contact and is repeated; its pixels are those of the grid of 513 x 513 nodes to "
        "0.2 %."
    ]
    return Result(checks, (("name", "ours", "paper", "unit", "deviation"), rows), notes=notes)
