# SPDX-License-Identifier: BSD-3-Clause
"""Line contact: Hertz contact, Moes numbers and film formulas of rollers and gear flanks.

M, W and p_h differ from those of a point contact: here the load is per unit length [N/m].
"""

import math
from dataclasses import dataclass, replace
from typing import Self

from pyehl.case.groups import Contact
from pyehl.case.key import typed
from pyehl.case.lubricant_group import Lubricant as LubricantGroup
from pyehl.errors import InputError
from pyehl.given import positive
from pyehl.theory import film
from pyehl.theory.ellipse import LINE, Ellipse
from pyehl.theory.film import FilmEstimate, outside
from pyehl.theory.heat import thermal_loading, thermal_reduction
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.moes_film import ALIKE, inlet_viscosity_ratio, nijenbanning_venner_moes
from pyehl.theory.operating import (
    REFERENCE_MODULUS,
    REFERENCE_RADIUS,
    OperatingPoint,
    twice_speed_number,
)
from pyehl.types import Settings

__all__ = [
    "LineContact",
    "central_film",
    "circle_with_same_inlet",
    "contact_of",
    "dowson_higginson",
    "estimates",
    "moes_film",
    "regime",
]

# Conditions over which both film formulas were compared with converged solutions
COMPARED = {"M": (3.0, 100.0), "L": (5.0, 10.0)}


@dataclass(frozen=True, slots=True)
class LineContact:
    """An infinitely long contact under load, with its derived quantities.

    Attributes
    ----------
    load_per_length
        w [N/m].
    mean_velocity
        (u1 + u2)/2 [m/s].
    radius
        Reduced radius R in the plane of the motion [m].
    reduced_modulus
        E' [Pa], 2/E' = sum of (1 - nu^2)/E.
    viscosity
        eta0 of the inlet [Pa s].
    pressure_viscosity
        alpha [1/Pa]; 0 for the isoviscous limit L = 0.
    slide_to_roll
        (u1 - u2)/u [-], u the mean velocity.
    si
        Whether the SI values were given; False when they were made from (M, L).
    thermal_reduction
        Film over the isothermal one [-], included in `viscosity`; 1 where it is neglected.
    thermal_conductivities, thermal_diffusivities
        Of body 1 and of body 2 [W/(m K)], [m^2/s].

    Raises
    ------
    InputError
        For a load, speed, radius, modulus or viscosity that is not positive and finite, or a
        negative pressure-viscosity coefficient.

    Examples
    --------
    >>> from pyehl.theory.line_contact import LineContact
    >>> line = LineContact.from_moes(20.0, 10.0)
    >>> round(line.moes_m, 6), round(line.moes_l, 6), round(line.alpha_bar, 3)
    (20.0, 10.0, 17.841)
    """

    load_per_length: float
    mean_velocity: float
    radius: float
    reduced_modulus: float = REFERENCE_MODULUS
    viscosity: float = 0.04
    pressure_viscosity: float = 2.2e-8
    slide_to_roll: float = 0.0
    si: bool = True
    thermal_reduction: float = 1.0
    thermal_conductivities: tuple[float, float] = (46.0, 46.0)
    thermal_diffusivities: tuple[float, float] = (1.25e-5, 1.25e-5)

    def __post_init__(self) -> None:
        """Check the numbers."""
        positive("load_per_length", self.load_per_length, "N/m")
        positive("mean_velocity", self.mean_velocity, "m/s")
        positive("radius", self.radius, "m")
        positive("reduced_modulus", self.reduced_modulus, "Pa")
        positive("viscosity", self.viscosity, "Pa s")
        if not 0.0 <= self.pressure_viscosity < math.inf:
            raise InputError(
                f"pressure_viscosity must not be negative [1/Pa], not {self.pressure_viscosity!r}"
            )

    @classmethod
    def from_moes(
        cls,
        moes_m: float,
        moes_l: float,
        *,
        viscosity: float = 0.04,
        pressure_viscosity: float = 2.2e-8,
        radius: float = REFERENCE_RADIUS,
        slide_to_roll: float = 0.0,
    ) -> Self:
        """Return the line with the given M and L, for a lubricant and a radius [m].

        E' is the reference modulus, as for a point contact. L = 0 does not fix the speed: then
        alpha is 0 and the speed that of L = 10, at the given alpha, or at 2.2e-8/Pa if this is 0.
        InputError if M is not positive, L is negative, or alpha is not positive at L > 0.
        """
        m = positive("moes_m_line", moes_m, "-")
        if not 0.0 <= moes_l < math.inf:
            raise InputError(f"moes_l_line must not be negative [-], not {moes_l!r}")
        modulus, two_u = REFERENCE_MODULUS, twice_speed_number(moes_l, pressure_viscosity)
        return cls(
            load_per_length=m * math.sqrt(two_u) * modulus * radius,
            mean_velocity=0.5 * two_u * modulus * radius / positive("viscosity", viscosity, "Pa s"),
            radius=radius,
            reduced_modulus=modulus,
            viscosity=viscosity,
            pressure_viscosity=pressure_viscosity if moes_l > 0.0 else 0.0,
            slide_to_roll=slide_to_roll,
            si=False,
        )

    @classmethod
    def from_settings(cls, settings: Settings) -> Self:
        """From the groups ``contact`` and ``lubricant`` of a resolved case of a line or a roller.

        The load per length of a roller is its mean. With ``lubricant.thermal_reduction`` the
        viscosity is that of the warmer inlet.
        """
        c = typed(Contact, settings["contact"])
        oil = typed(LubricantGroup, settings["lubricant"])
        if "load_per_length" not in settings["contact"] and not c.is_roller:
            return cls.from_moes(
                c.moes_m_line,
                c.moes_l_line,
                viscosity=oil.viscosity,
                pressure_viscosity=oil.pressure_viscosity,
                slide_to_roll=c.slide_to_roll,
            )
        line = cls(
            load_per_length=c.load / c.length if c.is_roller else c.load_per_length,
            mean_velocity=c.mean_velocity,
            radius=c.radius,
            reduced_modulus=c.reduced_modulus,
            viscosity=oil.viscosity,
            pressure_viscosity=oil.pressure_viscosity,
            slide_to_roll=c.slide_to_roll,
            thermal_conductivities=(
                c.thermal_conductivity,
                c.thermal_conductivity_2 or c.thermal_conductivity,
            ),
            thermal_diffusivities=(
                c.thermal_diffusivity,
                c.thermal_diffusivity_2 or c.thermal_diffusivity,
            ),
        )
        if not oil.thermal_reduction:
            return line
        loading = thermal_loading(
            oil.temperature_viscosity, oil.viscosity, c.mean_velocity, oil.thermal_conductivity
        )
        ratio = thermal_reduction(loading, line.hertz_pressure / c.reduced_modulus, c.slide_to_roll)
        # the film increases at least as viscosity^0.4, which bounds the logarithm of the viscosity
        wanted, low, high = ratio * line.film, 2.5 * math.log(ratio), 0.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            thinner = replace(line, viscosity=oil.viscosity * math.exp(middle))
            low, high = (middle, high) if thinner.film < wanted else (low, middle)
        viscosity = oil.viscosity * math.exp(0.5 * (low + high))
        return replace(line, viscosity=viscosity, thermal_reduction=ratio)

    @property
    def film(self) -> float:
        """Central film of an incompressible lubricant by `moes_film` [m]."""
        return moes_film(self.moes_m, self.moes_l) * self.film_scale

    @property
    def ellipse(self) -> Ellipse:
        """Shape of the dry contact."""
        return LINE

    @property
    def radius_ratio(self) -> float:
        """R_x/R_y [-]: a line is not curved across the motion."""
        return LINE.radius_ratio

    @property
    def load(self) -> float:
        """Load per length w [N/m]; all integrals over a line are per unit length."""
        return self.load_per_length

    @property
    def semi_axes(self) -> tuple[float, float]:
        """Half width b [m], and infinity across the motion."""
        return self.half_width, math.inf

    @property
    def dry_area(self) -> float:
        """Area of the dry contact per length [m]."""
        return 2.0 * self.half_width

    @property
    def equivalent_moes(self) -> tuple[float, float]:
        """M and L [-] of the circle with the same dry inlet, as for an ellipse.

        It has the same alpha_bar, and the same lambda_bar with heights over kernel_ratio b^2/R.
        """
        speed = self.speed_parameter / LINE.kernel_ratio**2
        moes_m = (128.0 * math.pi**3 / (3.0 * speed**3)) ** 0.25
        return moes_m, math.pi * self.alpha_bar / (1.5 * moes_m) ** (1.0 / 3.0)

    @property
    def hertz_radius(self) -> float:
        """Unit of length [m]: the half width b, as the Hertz radius of a point contact."""
        return self.half_width

    @property
    def sliding_speed(self) -> float:
        """Sliding speed abs(u1 - u2) [m/s]."""
        return abs(self.slide_to_roll) * self.mean_velocity

    @property
    def half_width(self) -> float:
        """Half width b of the dry contact [m], b^2 = 8 w R/(pi E')."""
        modulus = math.pi * self.reduced_modulus
        return math.sqrt(8.0 * self.load_per_length * self.radius / modulus)

    @property
    def hertz_pressure(self) -> float:
        """Maximum pressure p_h of the dry contact [Pa], 2 w/(pi b)."""
        return 2.0 * self.load_per_length / (math.pi * self.half_width)

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
        """W = w/(E' R) [-] of a line, w per length."""
        return self.load_per_length / (self.reduced_modulus * self.radius)

    @property
    def material(self) -> float:
        """G = alpha E' [-]."""
        return self.pressure_viscosity * self.reduced_modulus

    @property
    def moes_m(self) -> float:
        """Moes load M = W (2U)^(-1/2) [-] of a line (a point has W2 (2U)^(-3/4))."""
        return self.load_number / math.sqrt(2.0 * self.speed)

    @property
    def moes_l(self) -> float:
        """Moes material number L = G (2U)^(1/4) [-]."""
        return float(self.material * (2.0 * self.speed) ** 0.25)

    @property
    def alpha_bar(self) -> float:
        """Pressure-viscosity number alpha p_h [-], L (M/(2 pi))^(1/2)."""
        return self.pressure_viscosity * self.hertz_pressure

    @property
    def speed_parameter(self) -> float:
        """lambda_bar = 12 eta0 u R^2/(b^3 p_h) [-], 3 pi^2/(8 M^2)."""
        return 3.0 * math.pi**2 / (8.0 * self.moes_m**2)

    @property
    def film_scale(self) -> float:
        """The film thickness that is one in Hertz units, b^2/R [m]; H = h R/b^2."""
        return self.half_width**2 / self.radius

    @property
    def time_scale(self) -> float:
        """The time that is one in Hertz units, b/u [s]; T = t u/b."""
        return self.half_width / self.mean_velocity


AnyContact = OperatingPoint | LineContact


def contact_of(settings: Settings) -> AnyContact:
    """Return the point or line contact of a resolved case; InputError for a roller."""
    if settings["contact"].get("shape") == "line":
        return LineContact.from_settings(settings)
    return OperatingPoint.from_settings(settings)


def scaling_contact(settings: Settings) -> AnyContact:
    """Return the contact whose scales a resolved case uses, a line for a roller."""
    if settings["contact"].get("shape") == "roller":
        return LineContact.from_settings(settings)
    return contact_of(settings)


def formula_film(contact: AnyContact, lubricant: Lubricant) -> float:
    """Central film of a point or line contact by formula [m]."""
    if isinstance(contact, LineContact):
        return central_film(contact, lubricant)
    return film.central_film(contact, lubricant)


def circle_with_same_inlet(
    operating: AnyContact, lubricant: Lubricant, film: float
) -> tuple[float, float]:
    """M and L [-] of the circular contact whose inlet has the same effect on waves.

    It has the same alpha_bar and, with heights scaled so that waves have the same stiffness, the
    same central film H_c = `film` [a^2/R_x]: the side flow of an ellipse acts as a lower viscosity
    (docs/evidence/ellipse). A circle is returned as it is, whatever its film.
    """
    moes_m, moes_l = operating.equivalent_moes
    if operating.radius_ratio == 1.0:
        return moes_m, moes_l
    here = film / operating.ellipse.kernel_ratio
    density = float(lubricant.density_ratio(operating.density_pressure))
    film_ratio = here * density / nijenbanning_venner_moes(moes_m, moes_l)
    ratio = inlet_viscosity_ratio(moes_m, moes_l, film_ratio)
    return moes_m * ratio**-0.75, moes_l * ratio**0.25


def _asymptotes(moes_m: float, moes_l: float) -> tuple[float, float, float, float]:
    """Rigid and elastic, isoviscous and piezoviscous film numbers h/R (2U)^(-1/2) [-]."""
    if not (moes_m > 0.0 and moes_l >= 0.0):
        raise InputError(f"need M > 0 and L >= 0, not M = {moes_m:g}, L = {moes_l:g}")
    return (
        3.0 / moes_m,
        2.62105 * moes_m**-0.2,
        1.28666 * moes_l ** (2 / 3),
        1.31106 * moes_m**-0.125 * moes_l**0.75,
    )


def moes_film(moes_m: float, moes_l: float) -> float:
    """H_c = h_c R/b^2 [-] of a line with an incompressible lubricant, M and L those of a line.

    Moes 1992, Wear 159, 57-66: joins four asymptotes. Divide by the density ratio at p_h for
    a compressible lubricant. The film number of Moes is h/R (2U)^(-1/2) = 8 M H/pi. InputError if M
    is not positive or L is negative.
    """
    rigid_iso, elastic_iso, rigid_piezo, elastic_piezo = _asymptotes(moes_m, moes_l)
    s = (7.0 + 8.0 * math.exp(-2.0 * elastic_iso / rigid_iso)) / 5.0
    isoviscous = rigid_iso ** (7 / 3) + elastic_iso ** (7 / 3)
    piezoviscous = 0.0
    if moes_l > 0.0:
        piezoviscous = (rigid_piezo**-3.5 + elastic_piezo**-3.5) ** (-2 * s / 7)
    h_m = (isoviscous ** (3 * s / 7) + piezoviscous) ** (1 / s)
    return float(h_m * math.pi / (8.0 * moes_m))


def central_film(line: LineContact, lubricant: Lubricant) -> float:
    """Central film thickness h_c [m]: Moes divided by rho(p_h)/rho0."""
    return line.film / float(lubricant.density_ratio(line.density_pressure))


def regime(moes_m: float, moes_l: float) -> str:
    """Name the nearest asymptote of the line, as 'elastic-piezoviscous'.

    'rigid to elastic-...' where the two differ by a factor below 1.25. InputError as `moes_film`.
    """
    rigid_iso, elastic_iso, rigid_piezo, elastic_piezo = _asymptotes(moes_m, moes_l)
    if min(rigid_piezo, elastic_piezo) > max(rigid_iso, elastic_iso):
        softness, viscosity = rigid_piezo / elastic_piezo, "piezoviscous"
    else:
        softness, viscosity = elastic_iso / rigid_iso, "isoviscous"
    if 1.0 / ALIKE < softness < ALIKE:
        return f"rigid to elastic-{viscosity}"
    return f"{'elastic' if softness > 1.0 else 'rigid'}-{viscosity}"


def dowson_higginson(speed: float, material: float, load_number: float) -> float:
    """h_min/R [-] of a line, from U, G and W as in `LineContact`.

    Dowson 1968, Proc. Inst. Mech. Eng. 182 (3A), 151-167, after Dowson & Higginson.
    """
    return float(2.65 * speed**0.7 * material**0.54 * load_number**-0.13)


def estimates(line: LineContact, lubricant: Lubricant) -> list[FilmEstimate]:
    """Return the formulas of a line; the one with alpha as a factor is omitted where alpha is 0."""
    beyond = outside({"M": line.moes_m, "L": line.moes_l}, COMPARED)
    here = regime(line.moes_m, line.moes_l)
    result = [
        FilmEstimate(
            name="Moes, line",
            source="Wear 159 (1992) 57, divided by rho(p_h)/rho0",
            regime="",
            h_c=central_film(line, lubricant),
            h_min=math.nan,
            applies=True,
            bounds=COMPARED,
            outside=beyond,
            note="0.4 to 2.5 % below converged solutions",
        )
    ]
    if line.material > 0.0:
        h_min = dowson_higginson(line.speed, line.material, line.load_number) * line.radius
        fitted = "elastic-piezoviscous"
        result.append(
            FilmEstimate(
                name="Dowson-Higginson",
                source="Proc. Inst. Mech. Eng. 182 (1968) 151",
                regime=fitted,
                h_c=math.nan,
                h_min=h_min,
                applies=here in {fitted, f"rigid to {fitted}"},
                bounds=COMPARED,
                outside=beyond,
                note="0.5 to 2.8 % above converged solutions",
            )
        )
    return result
