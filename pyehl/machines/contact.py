# SPDX-License-Identifier: BSD-3-Clause
"""One contact of a machine element: what the machine makes of it, and its film by formulas."""

import math
from dataclasses import dataclass

from pyehl.case.machine import Machine
from pyehl.namelist import values
from pyehl.theory import film, line_contact
from pyehl.theory.ellipse import ellipse
from pyehl.theory.film import FilmEstimate
from pyehl.theory.heat import thermal_loading, thermal_reduction
from pyehl.theory.line_contact import LineContact
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.moes_film import regime
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Settings

LINE, ELLIPSE = "line", "ellipse"
# R_x/R_y of an ellipse as wide as a line is near it: half widths agree within 1 %
WIDE = 0.01
OUTSIDE = " outside its range of "
LINES = "a line by formulas: the solver has no lines"
LONGEST = 30.0
"""Largest ratio of the semi-axes of an ellipse that the solver takes."""


@dataclass(frozen=True, slots=True)
class Contact:
    """A contact, by what its machine makes of it.

    Attributes
    ----------
    place
        Where it is, in words.
    load
        [N].
    mean_velocity, slide_to_roll
        Of both surfaces [m/s], [-]; body 1 is the rolling element, or the pinion.
    radii
        In the plane of the motion and across it, of body 1, then of body 2 [m]; negative: concave,
        infinite: flat.
    length
        Of a line contact [m]; 0: an ellipse.
    spin
        Angular velocity of one body against the other about the normal [rad/s].
    """

    place: str
    load: float
    mean_velocity: float
    slide_to_roll: float
    radii: tuple[float, float, float, float]
    length: float = 0.0
    spin: float = 0.0

    @property
    def shape(self) -> str:
        """`LINE` or `ELLIPSE`."""
        return LINE if self.length else ELLIPSE

    @property
    def radius(self) -> float:
        """R_x [m]."""
        return 1.0 / (1.0 / self.radii[0] + 1.0 / self.radii[2])

    @property
    def radius_ratio(self) -> float:
        """R_x/R_y [-]; of a line that of a wide ellipse in its place."""
        across = 1.0 / self.radii[1] + 1.0 / self.radii[3]
        return WIDE if self.length else self.radius * across

    def line(self, modulus: float) -> LineContact:
        """Give the line contact, of a reduced modulus [Pa] and without an oil."""
        load = self.load / self.length
        return LineContact(load, self.mean_velocity, self.radius, modulus)

    def case_text(self, machine: Machine) -> str:
        """Give the resolved case of the contact.

        The one place for line contacts: until the solver has them, that of a wide ellipse with the
        p_h and, within 1 %, the half width of the line. It has the oil, the solids and their heat;
        its film is not that of the line, and it is not solved.
        """
        radii, load = self.radii, self.load
        if self.length:
            shape = ellipse(WIDE)
            pressure, kappa = self.line(machine.reduced_modulus).hertz_pressure, shape.ellipticity
            semi_axis = math.pi * kappa * self.radius * pressure
            semi_axis /= machine.reduced_modulus * shape.load_share
            radii = (radii[0], self.radius / WIDE, radii[2], math.inf)
            load = 2.0 / 3.0 * math.pi * kappa * semi_axis**2 * pressure
        contact = {
            "contact.load": load,
            "contact.mean_velocity": self.mean_velocity,
            "contact.slide_to_roll": self.slide_to_roll,
        }
        for name, radius in zip(("x1", "y1", "x2", "y2"), radii, strict=True):
            contact[f"bodies.radius_{name}"] = radius if math.isfinite(radius) else 0.0
        # elements that mirror each other have the same case
        rounded = {name: float(f"{value:.10g}") for name, value in contact.items()}
        return machine.case_text(rounded, self.place)


@dataclass(frozen=True, slots=True)
class Film:
    """A contact with its film by formulas.

    Attributes
    ----------
    text, settings
        The resolved case, as text and by groups.
    point
        Its operating point; of a line that of the wide ellipse in its place.
    line
        The line contact, of a line.
    lubricant
        The oil.
    h_c, h_min
        Central and minimum film [m].
    regime
        As :func:`pyehl.theory.moes_film.regime` names it.
    outside
        What is outside of the range of a formula that gives them, in words; '' if nothing is.
    """

    contact: Contact
    text: str
    settings: Settings
    point: OperatingPoint
    line: LineContact | None
    lubricant: Lubricant
    h_c: float
    h_min: float
    regime: str
    outside: str

    @property
    def hertz_pressure(self) -> float:
        """Maximum pressure p_h [Pa]."""
        return (self.line or self.point).hertz_pressure

    @property
    def half_width(self) -> float:
        """Half width of the contact along the motion [m]."""
        return self.line.half_width if self.line else self.point.hertz_radius

    @property
    def moes(self) -> tuple[float, float]:
        """M and L [-]; those of a line are not those of a point."""
        found = self.line or self.point
        return found.moes_m, found.moes_l

    @property
    def ellipticity(self) -> float:
        """Semi-axis across the motion over that along it [-]; infinite for a line."""
        return math.inf if self.line else self.point.ellipse.ellipticity


def film_of(contact: Contact, machine: Machine) -> Film:
    """Give the film of a contact by formulas.

    Central: Nijenbanning-Venner-Moes, of lines Moes 1992; minimum: Hamrock-Dowson 1977, of lines
    Dowson-Higginson. InputError if there is no such contact.
    """
    text = contact.case_text(machine)
    settings = values(text)
    oil = Lubricant.from_settings(settings)
    if not contact.length:
        point = OperatingPoint.from_settings(settings)
        found = {f.name: f for f in film.estimates(point, oil)}
        central = found["Nijenbanning-Venner-Moes"]
        least = found.get("Hamrock-Dowson") or found["Hamrock-Dowson soft"]
        name = regime(point.moes_m, point.moes_l, point.ellipse)
        beyond = _beyond(central, least)
        h_c, h_min = central.h_c, least.h_min
        return Film(contact, text, settings, point, None, oil, h_c, h_min, name, beyond)
    group = settings["lubricant"]
    isothermal = {**settings, "lubricant": {**group, "thermal_reduction": False}}
    point = OperatingPoint.from_settings(isothermal)
    line = LineContact(
        contact.load / contact.length,
        contact.mean_velocity,
        contact.radius,
        point.reduced_modulus,
        oil.viscosity,
        oil.pressure_viscosity,
        contact.slide_to_roll,
    )
    share = 1.0
    if group["thermal_reduction"]:
        loading = thermal_loading(
            oil.temperature_viscosity,
            oil.viscosity,
            line.mean_velocity,
            float(group["thermal_conductivity"]),
        )
        strain = line.hertz_pressure / line.reduced_modulus
        share = thermal_reduction(loading, strain, line.slide_to_roll)
    formulas = line_contact.estimates(line, oil)
    beyond = _beyond(*formulas)
    h_min = formulas[1].h_min if len(formulas) > 1 else math.nan
    name = line_contact.regime(line.moes_m, line.moes_l)
    h_c = formulas[0].h_c * share
    return Film(contact, text, settings, point, line, oil, h_c, h_min * share, name, beyond)


def _beyond(*formulas: FilmEstimate) -> str:
    """Name the numbers with which formulas are outside of their ranges."""
    found = {f.name: [text.partition(" =")[0] for text in f.outside] for f in formulas if f.outside}
    return "; ".join(f"{name}{OUTSIDE}{', '.join(of)}" for name, of in found.items())
