# SPDX-License-Identifier: BSD-3-Clause
"""One contact of a machine element: its operating conditions, and its film by formulas."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from pyehl.case.contact import is_light
from pyehl.case.key import Value
from pyehl.case.machine import Machine
from pyehl.namelist import values
from pyehl.theory import film, line_contact
from pyehl.theory.ellipse import ellipse
from pyehl.theory.film import FilmEstimate
from pyehl.theory.line_contact import LineContact
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.moes_film import regime
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Settings

LINE, ELLIPSE = "line", "ellipse"
RIGID = "rigid-isoviscous"
# R_x/R_y of the wide ellipse that stands for a line: the half widths agree within 1 %
WIDE_RATIO = 0.01
CROSSED = "minimum film above the central one: two formulas, of which one fails here"
OUTSIDE = " outside its range of "
MAX_ELLIPTICITY = 30.0
"""Largest ratio of the semi-axes of an ellipse that the solver accepts."""


@dataclass(frozen=True, slots=True)
class Contact:
    """A contact of a machine element with its operating conditions.

    Attributes
    ----------
    place
        Its position, as text.
    load
        Load [N].
    mean_velocity, slide_to_roll
        Of both surfaces [m/s], [-]; body 1 is the rolling element, or the pinion.
    radii
        Radii in the plane of the motion and across it, of body 1, then of body 2 [m]; negative:
        concave, infinite: flat.
    length
        Length of a line contact [m]; 0: an ellipse.
    spin
        Angular velocity of one body relative to the other about the normal [rad/s].
    may_be_light
        Whether a very low load is plausible because other contacts carry the load.
    """

    place: str
    load: float
    mean_velocity: float
    slide_to_roll: float
    radii: tuple[float, float, float, float]
    length: float = 0.0
    spin: float = 0.0
    may_be_light: bool = False

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
        """R_x/R_y [-]; for a line that of the equivalent wide ellipse."""
        across = 1.0 / self.radii[1] + 1.0 / self.radii[3]
        return WIDE_RATIO if self.length else self.radius * across

    def line(self, modulus: float) -> LineContact:
        """Return the line contact for a reduced modulus [Pa], with the default oil."""
        load = self.load / self.length
        return LineContact(load, self.mean_velocity, self.radius, modulus)

    def case_text(self, machine: Machine) -> str:
        """Return the resolved case of the contact."""
        if not self.length:
            return self._ellipse_text(machine, self.load, self.radii)
        contact = {
            "contact.load_per_length": self.load / self.length,
            "contact.radius": self.radius,
            **self._motion(),
        }
        line: dict[str, Value] = {"contact.shape": LINE, **_rounded(contact)}
        light = self.may_be_light
        return machine.case_text(line, self.place, bodies=False, may_be_light=light)

    def wide_text(self, machine: Machine) -> str:
        """Return the case of the equivalent wide ellipse of a line, for the frictional heating.

        It has the p_h and, within 1 %, the half width of the line; its film differs.
        """
        shape = ellipse(WIDE_RATIO)
        pressure, kappa = self.line(machine.reduced_modulus).hertz_pressure, shape.ellipticity
        semi_axis = math.pi * kappa * self.radius * pressure
        semi_axis /= machine.reduced_modulus * shape.load_factor
        load = 2.0 / 3.0 * math.pi * kappa * semi_axis**2 * pressure
        radii = (self.radii[0], self.radius / WIDE_RATIO, self.radii[2], math.inf)
        return self._ellipse_text(machine, load, radii)

    def _motion(self) -> dict[str, float]:
        return {
            "contact.mean_velocity": self.mean_velocity,
            "contact.slide_to_roll": self.slide_to_roll,
        }

    def _ellipse_text(
        self, machine: Machine, load: float, radii: tuple[float, float, float, float]
    ) -> str:
        contact = {"contact.load": load, **self._motion()}
        for name, radius in zip(("x1", "y1", "x2", "y2"), radii, strict=True):
            contact[f"bodies.radius_{name}"] = radius if math.isfinite(radius) else 0.0
        return machine.case_text(_rounded(contact), self.place, may_be_light=self.may_be_light)


def _rounded(keys: Mapping[str, float]) -> dict[str, float]:
    """Round the values of keys, so that mirrored elements have the same case."""
    return {name: float(f"{value:.10g}") for name, value in keys.items()}


@dataclass(frozen=True, slots=True)
class Film:
    """A contact with its film by formulas.

    Attributes
    ----------
    contact
        The contact.
    text, settings
        The resolved case, as text and by groups.
    point
        Its operating point; for a line that of the equivalent wide ellipse.
    line
        The line contact; None for an ellipse.
    lubricant
        Its lubricant.
    h_c, h_min
        Central and minimum film [m].
    regime
        As :func:`pyehl.theory.moes_film.regime` names it.
    outside
        Quantities outside the range of their formula, as text; '' if there are none.
    wide
        For a line, the case of `point`.
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
    wide: Settings | None = None

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
        result = self.line or self.point
        return result.moes_m, result.moes_l

    @property
    def is_solvable(self) -> bool:
        """Whether the solver accepts it: the ellipse is not too long, the load not too low."""
        modulus = self.settings["contact"]["reduced_modulus"]
        long = self.line is None and self.ellipticity > MAX_ELLIPTICITY
        return not (long or is_light(self.moes[0], self.hertz_pressure, modulus))

    @property
    def ellipticity(self) -> float:
        """Semi-axis across the motion over that along it [-]; infinite for a line."""
        return math.inf if self.line else self.point.ellipse.ellipticity


def film_of(contact: Contact, machine: Machine) -> Film:
    """Return the film of a contact by formulas.

    Central film: Nijenbanning-Venner-Moes, for lines Moes 1992; minimum film: Hamrock-Dowson 1977,
    for lines Dowson-Higginson. Where alpha is 0, h_min is by Hamrock-Dowson 1978 for soft bodies,
    and NaN for lines. In the rigid-isoviscous regime, as for some elements at the edge of the load
    zone, h_min of an ellipse is the film of Brewe, Hamrock & Taylor 1979, and that of a line its
    central film. InputError if the case of the contact is not valid.
    """
    text = contact.case_text(machine)
    settings = values(text)
    oil = Lubricant.from_settings(settings)
    if not contact.length:
        point = OperatingPoint.from_settings(settings)
        result = {f.name: f for f in film.estimates(point, oil)}
        central = result["Nijenbanning-Venner-Moes"]
        name = regime(point.moes_m, point.moes_l, point.ellipse)
        minimum = result.get("Hamrock-Dowson") or result["Hamrock-Dowson soft"]
        if name == RIGID:
            minimum = result["Brewe-Hamrock-Taylor"]
        beyond = _beyond(central, minimum)
        h_c, h_min = central.h_c, minimum.h_min
        if h_min > h_c:
            beyond = f"{beyond}; {CROSSED}".removeprefix("; ")
        return Film(contact, text, settings, point, None, oil, h_c, h_min, name, beyond)
    wide = values(contact.wide_text(machine))
    wide["lubricant"] = {**wide["lubricant"], "thermal_reduction": False}
    point, line = OperatingPoint.from_settings(wide), LineContact.from_settings(settings)
    formulas = line_contact.estimates(line, oil)
    name = line_contact.regime(line.moes_m, line.moes_l)
    h_c = formulas[0].h_c
    if name == RIGID:
        formulas, h_min = formulas[:1], h_c
    else:
        h_min = formulas[1].h_min if len(formulas) > 1 else math.nan
    beyond = _beyond(*formulas)
    return Film(contact, text, settings, point, line, oil, h_c, h_min, name, beyond, wide)


def _beyond(*formulas: FilmEstimate) -> str:
    """Name the quantities that are outside the ranges of the formulas."""
    result = {
        f.name: [text.partition(" =")[0] for text in f.outside] for f in formulas if f.outside
    }
    return "; ".join(f"{name}{OUTSIDE}{', '.join(of)}" for name, of in result.items())
