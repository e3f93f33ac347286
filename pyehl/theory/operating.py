# SPDX-License-Identifier: BSD-3-Clause
"""Operating conditions of a point contact, in SI units and as Moes and Hertz numbers.

The reduced modulus E' follows 2/E' = sum over the bodies of (1 - nu^2)/E, as everywhere in this
package. Codes that use 1/E* = sum of (1 - nu^2)/E have E* = E'/2.
"""

import math
from dataclasses import dataclass, replace
from typing import Self

from pyehl.case.groups import Contact
from pyehl.case.key import typed
from pyehl.case.lubricant_group import Lubricant as LubricantGroup
from pyehl.errors import InputError
from pyehl.given import positive
from pyehl.theory.ellipse import Ellipse, ellipse
from pyehl.theory.heat import thermal_loading, thermal_reduction
from pyehl.theory.moes_film import inlet_viscosity_ratio
from pyehl.types import Settings

# Contact body of the reference conditions (Zhang et al. 2019, table 1). A case given by M and L
# alone has no length scale; these two provide one when an SI quantity is requested.
REFERENCE_RADIUS = 0.018
REFERENCE_MODULUS = 2.26e11
# L that fixes the speed of a case with L = 0, and alpha [1/Pa] where the case has none
REFERENCE_L, REFERENCE_COEFFICIENT = 10.0, 2.2e-8
NO_LINE = (
    "contact.shape = 'line': this is for point contacts\nexpected: a point contact; check, run, "
    "solve, film, predict, stribeck, stress, sweep, plot, report and export take lines"
)
NO_ROLLER = (
    "contact.shape = 'roller': this is for points and lines\nexpected: a point contact or a line; "
    "check, run, solve, sweep, plot, report and export take rollers"
)


def twice_speed_number(moes_l: float, pressure_viscosity: float) -> float:
    """2U [-] of a contact with the material number L and the reference modulus, from alpha [1/Pa].

    At L = 0 that of `REFERENCE_L`, there also without alpha. InputError if alpha is not positive at
    L > 0.
    """
    if moes_l == 0.0:
        moes_l, pressure_viscosity = REFERENCE_L, pressure_viscosity or REFERENCE_COEFFICIENT
    alpha = positive("pressure_viscosity", pressure_viscosity, "1/Pa")
    return (moes_l / (alpha * REFERENCE_MODULUS)) ** 4


@dataclass(frozen=True, slots=True)
class OperatingPoint:
    """A circular or elliptical contact under load, with its derived quantities.

    Attributes
    ----------
    load
        w [N].
    mean_velocity
        (u1 + u2)/2 [m/s].
    radius
        Reduced radius R [m]; of an elliptical contact R_x, in the plane of the motion.
    reduced_modulus
        E' [Pa], 2/E' = sum of (1 - nu^2)/E.
    viscosity
        eta0 of the inlet [Pa s], which determines the film.
    pressure_viscosity
        alpha [1/Pa]; 0 for the isoviscous limit L = 0.
    si
        Whether the SI values were given; False when they were made from (M, L) with the radius
        and modulus of the reference conditions.
    slide_to_roll
        Slide-to-roll ratio (u1 - u2)/u [-], u the mean velocity.
    thermal_conductivity, thermal_diffusivity
        Of the solids [W/(m K)], [m^2/s].
    thermal_reduction
        Film over the isothermal one [-], included in `viscosity`; 1 where it is neglected.
    radius_ratio
        R_x/R_y [-]; 1: circular.
    thermal_conductivity_2, thermal_diffusivity_2
        Of body 2, if it is of another material; 0: as body 1.

    Raises
    ------
    InputError
        For a load, speed, radius, ratio, modulus or viscosity that is not positive and finite, a
        negative pressure-viscosity coefficient, or a slide-to-roll ratio outside -2 ... 2.

    Examples
    --------
    >>> import pyehl
    >>> point = pyehl.OperatingPoint(load=600.0, mean_velocity=0.84)
    >>> round(point.moes_m), round(point.moes_l, 1), round(point.hertz_pressure / 1e9, 2)
    (1000, 10.0, 1.66)
    >>> case = pyehl.Case(contact={"load": 300.0})
    >>> pyehl.OperatingPoint.from_settings(case.resolve()).load
    300.0
    """

    load: float = 600.0
    mean_velocity: float = 0.84
    radius: float = REFERENCE_RADIUS
    reduced_modulus: float = REFERENCE_MODULUS
    viscosity: float = 0.04
    pressure_viscosity: float = 2.2e-8
    si: bool = True
    slide_to_roll: float = 0.02
    thermal_conductivity: float = 46.0
    thermal_diffusivity: float = 1.25e-5
    thermal_reduction: float = 1.0
    radius_ratio: float = 1.0
    thermal_conductivity_2: float = 0.0
    thermal_diffusivity_2: float = 0.0

    def __post_init__(self) -> None:
        """Check the numbers."""
        positive("load", self.load, "N")
        positive("mean_velocity", self.mean_velocity, "m/s")
        positive("radius", self.radius, "m")
        positive("radius_ratio", self.radius_ratio, "-")
        positive("reduced_modulus", self.reduced_modulus, "Pa")
        positive("viscosity", self.viscosity, "Pa s")
        if not (math.isfinite(self.pressure_viscosity) and self.pressure_viscosity >= 0.0):
            raise InputError(
                f"pressure_viscosity must not be negative [1/Pa], not {self.pressure_viscosity!r}"
            )
        if not abs(self.slide_to_roll) <= 2.0:
            raise InputError(f"slide_to_roll must be -2 ... 2 [-], not {self.slide_to_roll!r}")

    @classmethod
    def from_moes(
        cls,
        moes_m: float,
        moes_l: float,
        *,
        viscosity: float = 0.04,
        pressure_viscosity: float = 2.2e-8,
        radius: float = REFERENCE_RADIUS,
        slide_to_roll: float = 0.02,
        radius_ratio: float = 1.0,
    ) -> Self:
        """Return the contact that has the given M and L, for a lubricant and a radius [m].

        M and L do not fix the scales: the radius, eta0 and alpha are given, E' is the reference
        modulus. The Hertz pressure p_h = alpha_bar/alpha follows from M, L and alpha alone. L = 0
        does not fix the speed: then alpha is 0 and the speed that of L = 10, at the given alpha, or
        at 2.2e-8/Pa if this is 0.

        Raises
        ------
        InputError
            For M that is not positive, L that is negative, or alpha that is not positive at L > 0.
        """
        m = positive("moes_m", moes_m, "-")
        if not 0.0 <= moes_l < math.inf:
            raise InputError(f"moes_l must not be negative [-], not {moes_l!r}")
        modulus, two_u = REFERENCE_MODULUS, twice_speed_number(moes_l, pressure_viscosity)
        if moes_l == 0.0:
            pressure_viscosity = 0.0
        return cls(
            load=m * two_u**0.75 * modulus * radius**2,
            mean_velocity=0.5 * two_u * modulus * radius / positive("viscosity", viscosity, "Pa s"),
            radius=radius,
            reduced_modulus=modulus,
            viscosity=viscosity,
            pressure_viscosity=pressure_viscosity,
            si=False,
            slide_to_roll=slide_to_roll,
            radius_ratio=radius_ratio,
        )

    @classmethod
    def from_settings(cls, settings: Settings) -> Self:
        """From the groups ``contact`` and ``lubricant`` of a resolved case, in SI units or Moes.

        With ``lubricant.thermal_reduction`` the viscosity is that of the warmer inlet. InputError
        for a line or a roller.
        """
        c = typed(Contact, settings["contact"])
        oil = typed(LubricantGroup, settings["lubricant"])
        if c.is_cylinder:
            raise InputError(NO_LINE if c.is_line else NO_ROLLER)
        if "load" not in settings["contact"]:
            return cls.from_moes(
                c.moes_m,
                c.moes_l,
                viscosity=oil.viscosity,
                pressure_viscosity=oil.pressure_viscosity,
                slide_to_roll=c.slide_to_roll,
                radius_ratio=c.radius_ratio,
            )
        radius_x, radius_y = c.radius_x or c.radius, c.radius_y or c.radius
        point = cls(
            load=c.load,
            mean_velocity=c.mean_velocity,
            radius=radius_x,
            reduced_modulus=c.reduced_modulus,
            viscosity=oil.viscosity,
            pressure_viscosity=oil.pressure_viscosity,
            slide_to_roll=c.slide_to_roll,
            thermal_conductivity=c.thermal_conductivity,
            thermal_diffusivity=c.thermal_diffusivity,
            thermal_conductivity_2=c.thermal_conductivity_2,
            thermal_diffusivity_2=c.thermal_diffusivity_2,
            radius_ratio=radius_x / radius_y,
        )
        if not oil.thermal_reduction:
            return point
        loading = thermal_loading(
            oil.temperature_viscosity, oil.viscosity, c.mean_velocity, oil.thermal_conductivity
        )
        pressure = point.hertz_pressure / point.reduced_modulus
        reduction = thermal_reduction(loading, pressure, c.slide_to_roll)
        ratio = inlet_viscosity_ratio(point.moes_m, point.moes_l, reduction, point.ellipse)
        return replace(point, viscosity=oil.viscosity * ratio, thermal_reduction=reduction)

    @property
    def sliding_speed(self) -> float:
        """Sliding speed abs(u1 - u2) [m/s]."""
        return abs(self.slide_to_roll) * self.mean_velocity

    @property
    def thermal_conductivities(self) -> tuple[float, float]:
        """Thermal conductivity of body 1 and of body 2 [W/(m K)]."""
        return self.thermal_conductivity, self.thermal_conductivity_2 or self.thermal_conductivity

    @property
    def thermal_diffusivities(self) -> tuple[float, float]:
        """Thermal diffusivity of body 1 and of body 2 [m^2/s]."""
        return self.thermal_diffusivity, self.thermal_diffusivity_2 or self.thermal_diffusivity

    @property
    def ellipse(self) -> Ellipse:
        """Shape of the dry contact."""
        return ellipse(self.radius_ratio)

    @property
    def hertz_radius(self) -> float:
        """Radius a of the dry contact [m], a^3 = 3 w R/(2 E'); its semi-axis along the motion."""
        modulus = self.reduced_modulus * self.ellipse.load_factor
        return float((1.5 * self.load * self.radius / modulus) ** (1.0 / 3.0))

    @property
    def semi_axis_y(self) -> float:
        """Semi-axis of the dry contact across the motion [m]."""
        return self.ellipse.ellipticity * self.hertz_radius

    @property
    def dry_area(self) -> float:
        """Area of the dry contact [m^2]."""
        return math.pi * self.hertz_radius * self.semi_axis_y

    @property
    def semi_axes(self) -> tuple[float, float]:
        """Semi-axes of the dry contact along the motion and across it [m]."""
        return self.hertz_radius, self.semi_axis_y

    @property
    def hertz_pressure(self) -> float:
        """Maximum pressure p_h of the dry contact [Pa], 3 w/(2 pi a b) with its semi-axes."""
        return 1.5 * self.load / (math.pi * self.ellipse.ellipticity * self.hertz_radius**2)

    @property
    def density_pressure(self) -> float:
        """Pressure for the density of the film [Pa]: p_h, or 0 at L = 0 without SI values.

        M alone does not fix a pressure, and the solver then omits the compression.
        """
        return self.hertz_pressure if self.si or self.pressure_viscosity > 0.0 else 0.0

    @property
    def speed(self) -> float:
        """U = eta0 u/(E' R) [-]."""
        return self.viscosity * self.mean_velocity / (self.reduced_modulus * self.radius)

    @property
    def load_number(self) -> float:
        """W2 = w/(E' R^2) [-]."""
        return self.load / (self.reduced_modulus * self.radius**2)

    @property
    def material(self) -> float:
        """G = alpha E' [-]."""
        return self.pressure_viscosity * self.reduced_modulus

    @property
    def moes_m(self) -> float:
        """Moes load M = W2 (2U)^(-3/4) [-] of a point contact (a line has W (2U)^(-1/2))."""
        return float(self.load_number * (2.0 * self.speed) ** -0.75)

    @property
    def moes_l(self) -> float:
        """Moes material number L = G (2U)^(1/4) [-]."""
        return float(self.material * (2.0 * self.speed) ** 0.25)

    @property
    def viscosity_parameter(self) -> float:
        """g_V = G W2^3/U^2 [-], viscosity axis of regime maps (Esfahanian & Hamrock 1991)."""
        return self.material * self.load_number**3 / self.speed**2

    @property
    def elasticity_parameter(self) -> float:
        """g_E = W2^(8/3)/U^2 [-], elasticity axis of regime maps."""
        return float(self.load_number ** (8.0 / 3.0) / self.speed**2)

    @property
    def equivalent_moes(self) -> tuple[float, float]:
        """M and L [-] of the circle with the same dry inlet on Y = 0; for a circle its own.

        It has the same alpha_bar, and the same lambda_bar with heights over kernel_ratio a^2/R_x,
        which makes waves equally stiff and the dry contacts equal near the edge. Side flow is not
        included; :func:`pyehl.theory.line_contact.circle_with_same_inlet` includes it.
        """
        shape = self.ellipse
        kernel = shape.kernel_ratio
        return self.moes_m * kernel**1.25 / shape.ellipticity, self.moes_l * kernel**0.25

    @property
    def alpha_bar(self) -> float:
        """Pressure-viscosity number alpha p_h [-], for a circle (L/pi)(3M/2)^(1/3)."""
        return self.pressure_viscosity * self.hertz_pressure

    @property
    def speed_parameter(self) -> float:
        """lambda_bar = 12 eta0 u R^2/(a^3 p_h) [-], for a circle (128 pi^3/(3 M^4))^(1/3)."""
        a, u = self.hertz_radius, self.mean_velocity
        return 12.0 * self.viscosity * u * self.radius**2 / (a**3 * self.hertz_pressure)

    @property
    def film_scale(self) -> float:
        """The film thickness that is one in Hertz units, a^2/R [m]; H = h R/a^2."""
        return self.hertz_radius**2 / self.radius

    @property
    def time_scale(self) -> float:
        """The time that is one in Hertz units, a/u [s]; T = t u/a."""
        return self.hertz_radius / self.mean_velocity
