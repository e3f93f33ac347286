# SPDX-License-Identifier: BSD-3-Clause
"""Groups of a case other than lubricant and surfaces, key by key.

The single definition of unit, allowed values, default and meaning of a key. For some keys 0 means
"not given". Fields that are not keys are set when a case is completed.
"""

from dataclasses import dataclass
from typing import NamedTuple

from pyehl.case.key import numbers, path, real, truth, whole, word


class Profile(NamedTuple):
    """Profile of one body of a roller; lengths in m."""

    kind: str
    crown_radius: float
    log_amplitude: float
    chamfer_length: float
    chamfer_drop: float
    places: tuple[float, ...]
    drops: tuple[float, ...]


@dataclass(slots=True)
class Contact:
    """``&contact``: the operating point, by its Moes numbers or in SI units."""

    shape: str = word(
        "point",
        "point|line|roller",
        "point contact, infinite line contact, or roller of finite length, each with its own keys",
    )
    moes_m: float = real(1000.0, "-", "(0, 1e6]", "Moes load parameter M")
    moes_l: float = real(10.0, "-", "[0, 100]", "Moes material parameter L")
    moes_m_line: float = real(
        20.0, "-", "(0, 1e4]", "Moes load parameter M of a line, w/(E' R) (2U)^(-1/2)"
    )
    moes_l_line: float = real(10.0, "-", "[0, 100]", "Moes material parameter L of a line")
    radius_ratio: float = real(
        1.0,
        "-",
        "[0.004, 250]",
        "R_x/R_y of an elliptical contact, with M and L defined by R_x; 1: round",
    )
    load: float = real(600.0, "N", "(0, 1e5]", "load")
    load_per_length: float = real(
        2e5, "N/m", "(0, 1e9]", "load per length of an infinite line contact"
    )
    mean_velocity: float = real(0.84, "m/s", "(0, 200]", "mean velocity of the two surfaces")
    radius: float = real(
        0.018, "m", "[1e-5, 10]", "reduced radius of a round or line contact, or of a roller"
    )
    radius_x: float = real(
        0.0, "m", "0 or [1e-5, 1000]", "reduced radius in the plane of the motion; 0: radius"
    )
    radius_y: float = real(
        0.0, "m", "0 or [1e-5, 1000]", "reduced radius across the motion; required with radius_x"
    )
    reduced_modulus: float = real(
        2.26e11, "Pa", "[1e4, 2e12]", "E' with 2/E' = sum of (1 - nu^2)/E over the bodies"
    )
    hardness: float = real(
        0.0,
        "Pa",
        "0 or [1e5, 1e12]",
        "maximum pressure that the solids sustain, with boundary_film; 0: no limit",
    )
    angle: float = real(
        0.0,
        "deg",
        "[-90, 90]",
        "angle by which an elliptical contact is rotated counter-clockwise from the motion",
    )
    slide_to_roll: float = real(
        0.02,
        "-",
        "[-2, 2]",
        "slide-to-roll ratio (u1 - u2)/u; follows from a given velocity_ratio of a surface",
    )
    rough_surface: int = whole(
        1,
        "[1, 2]",
        "body with the roughness of &surface; the other body has that of &second_surface",
    )
    thermal_conductivity: float = real(
        46.0,
        "W/(m K)",
        "[0.1, 500]",
        "thermal conductivity of the solids, for frictional heating",
    )
    thermal_diffusivity: float = real(
        1.25e-5,
        "m^2/s",
        "[1e-8, 1e-3]",
        "thermal diffusivity of the solids, for frictional heating",
    )
    thermal_conductivity_2: float = real(
        0.0, "W/(m K)", "0 or [0.1, 500]", "thermal conductivity of body 2; 0: thermal_conductivity"
    )
    thermal_diffusivity_2: float = real(
        0.0, "m^2/s", "0 or [1e-8, 1e-3]", "thermal diffusivity of body 2; 0: thermal_diffusivity"
    )
    length: float = real(0.0, "m", "0 or [1e-5, 10]", "length of a roller")
    profile: str = word(
        "none",
        "none|crown|logarithmic|chamfer|file",
        "profile of body 1 of a roller, or of both bodies together",
    )
    crown_radius: float = real(
        0.0, "m", "0 or [1e-4, 1e6]", "radius of a crown, with the drop y^2/(2 crown_radius)"
    )
    log_amplitude: float = real(
        0.0,
        "m",
        "0 or [1e-10, 1e-2]",
        "amplitude of a logarithmic profile, with the drop -log_amplitude ln(1 - (2y/length)^2)",
    )
    chamfer_length: float = real(0.0, "m", "0 or [1e-7, 1]", "length of the chamfer at each end")
    chamfer_drop: float = real(
        0.0, "m", "0 or [1e-9, 1]", "drop of the chamfer at the end of the roller"
    )
    profile_file: str = path("table of y and drop, two columns in m separated by a comma")
    misalignment: float = real(0.0, "rad", "[-0.1, 0.1]", "angle between the axes of a roller")
    profile_2: str = word(
        "none", "none|crown|logarithmic|chamfer|file", "profile of body 2, added to that of body 1"
    )
    crown_radius_2: float = real(0.0, "m", "0 or [1e-4, 1e6]", "crown_radius of body 2")
    log_amplitude_2: float = real(0.0, "m", "0 or [1e-10, 1e-2]", "log_amplitude of body 2")
    chamfer_length_2: float = real(0.0, "m", "0 or [1e-7, 1]", "chamfer_length of body 2")
    chamfer_drop_2: float = real(0.0, "m", "0 or [1e-9, 1]", "chamfer_drop of body 2")
    profile_file_2: str = path("profile_file of body 2")
    profile_y: tuple[float, ...] = numbers("m", "positions in profile_file; not for input")
    profile_drop: tuple[float, ...] = numbers("m", "drops of profile_file; not for input")
    profile_y_2: tuple[float, ...] = numbers("m", "positions in profile_file_2; not for input")
    profile_drop_2: tuple[float, ...] = numbers("m", "drops of profile_file_2; not for input")
    si: bool = True
    """Whether load, mean_velocity, radius and reduced_modulus apply, else moes_m and moes_l."""
    round: bool = True
    """Whether `radius` applies, else radius_x and radius_y."""

    @property
    def is_line(self) -> bool:
        """Whether the contact is an infinite line."""
        return self.shape == "line"

    @property
    def is_roller(self) -> bool:
        """Whether the contact is a roller of finite length."""
        return self.shape == "roller"

    def of_body(self, body: int) -> Profile:
        """Profile of a body, 1 or 2: kind, its numbers, places and drops of its table [m]."""
        end = "_2" if body == 2 else ""
        names = ("profile", "crown_radius", "log_amplitude", "chamfer_length", "chamfer_drop")
        result = (getattr(self, f"{name}{end}") for name in (*names, "profile_y", "profile_drop"))
        return Profile(*result)

    @property
    def is_cylinder(self) -> bool:
        """Whether it has one radius, and no curvature across the motion except a profile."""
        return self.is_line or self.is_roller


@dataclass(slots=True)
class Bodies:
    """``&bodies``: both bodies; if a key is given, they define reduced radii and modulus."""

    radius_x1: float = real(
        0.0,
        "m",
        "[-1e3, 1e3]",
        "radius of body 1 in the plane of the motion; negative: concave, 0: flat",
    )
    radius_y1: float = real(0.0, "m", "[-1e3, 1e3]", "radius of body 1 across the motion")
    radius_x2: float = real(0.0, "m", "[-1e3, 1e3]", "radius of body 2 in the plane of the motion")
    radius_y2: float = real(0.0, "m", "[-1e3, 1e3]", "radius of body 2 across the motion")
    modulus_1: float = real(2.06e11, "Pa", "[1e3, 2e12]", "Young's modulus of body 1")
    modulus_2: float = real(2.06e11, "Pa", "[1e3, 2e12]", "Young's modulus of body 2")
    poisson_1: float = real(0.3, "-", "[-0.5, 0.5]", "Poisson's ratio of body 1")
    poisson_2: float = real(0.3, "-", "[-0.5, 0.5]", "Poisson's ratio of body 2")
    given: bool = False
    """Whether a key of the group is given."""


@dataclass(slots=True)
class Inlet:
    """``&inlet``: a starved inlet."""

    position: float = real(
        0.0, "m", "[0, 10]", "position of the meniscus ahead of the centre, with P = 0; 0: flooded"
    )
    position_hertz: float = real(
        0.0, "a", "0 or [1.05, 1e4]", "position of the meniscus in Hertz radii"
    )
    film: float = real(
        0.0, "m", "[0, 0.01]", "oil layer that arrives on both surfaces together; 0: flooded"
    )
    film_hertz: float = real(0.0, "a^2/R", "[0, 1e4]", "oil layer that arrives, in Hertz units")
    passages: int = whole(
        1,
        "[1, 1000]",
        "successive contacts: the oil that one leaves is the inlet layer of the next",
    )
    replenishment: float = real(
        0.0,
        "-",
        "[0, 1]",
        "share of the oil missing from inlet.film that flows back between passages",
    )

    @property
    def is_starved(self) -> bool:
        """Whether the case has a starved inlet."""
        return max(self.position_hertz, self.film_hertz) > 0.0


@dataclass(slots=True)
class Grid:
    """``&grid``: the domain in Hertz radii a and its finest grid."""

    points: int = whole(
        513,
        "[17, 4097]",
        "nodes along X: an even number up to 32, times a power of 2, plus 1; default 1025 in a "
        "smooth contact where the expected error of H_c on 513 exceeds 5 %; in a smooth, steady, "
        "flooded contact with kappa > 4 and no boundary film 128 per a up to 4 a, fewer (161 to "
        "385) where this error is at most 0.5 %",
    )
    points_y: int = whole(
        0,
        "0 or [9, 40961]",
        "nodes along Y, coarsened as often as points; default: points in a contact that remains "
        "round, otherwise from the shape of the cells",
    )
    x_inlet: float = real(-2.5, "a", "[-1e4, -1.05]", "inlet boundary X; default from M and L")
    x_outlet: float = real(1.5, "a", "[1.05, 1e4]", "outlet boundary X; default from M and L")
    y_extent: float = real(
        2.0,
        "a",
        "[0.03, 1e4]",
        "side boundaries Y = -y_extent and y_extent; default from M, L and the ellipse",
    )
    border: str = word(
        "zero",
        "flooded|zero",
        "pressure at the border: that of a fully flooded contact, or P = 0; default: P = 0 "
        "for a roller, a rotated ellipse, a duty or a starved inlet, otherwise flooded below "
        "M = 500, above kappa = 4 and for an infinite line",
    )
    target_error: float = real(
        0.0, "-", "0 or [1e-5, 0.1]", "required relative error of H_c; 0: solve on the given points"
    )
    max_points: int = whole(
        2049, "[17, 8193]", "maximum number of nodes per side that target_error may choose"
    )


@dataclass(slots=True)
class Time:
    """``&time``: the transient run of a moving surface."""

    scheme: str = word(
        "narrow",
        "narrow|paper",
        "wedge and squeeze terms: together along the characteristic, or separately",
    )
    tolerance: float = real(
        0.001,
        "-",
        "[1e-8, 0.5]",
        "relative change of the period mean of mu_r/mu_s below which a run stops",
    )
    max_periods: int = whole(
        0, "[0, 100000]", "maximum number of periods, of the slower of two surfaces; 0: 36"
    )
    start: str = word(
        "front",
        "front|prediction",
        "roughness enters behind a front, or fills the contact from the start as predicted",
    )
    skip_start: bool = truth(True, "skip the steps before the roughness is near the contact")
    estimate_error: bool = truth(
        True, "also run on the next coarser grid, for the grid error of mu_ratio"
    )
    steps: int = whole(0, "[0, 10000000]", "number of steps; 0: until the mean has settled")


@dataclass(slots=True)
class Duty:
    """``&duty``: quantities that change with time; the others are those of the case."""

    file: str = path("table over time: names with units, then a line for each time")
    interpolation: str = word("linear", "linear|cubic", "interpolation between two times")
    periodic: bool = truth(False, "the last time is also the first time of the next period")
    periods: int = whole(3, "[1, 1000]", "periods to run; results are those of the last period")
    time_step: float = real(
        1.0,
        "-",
        "[0.01, 4]",
        "time step, relative to the time in which the mean velocity, or a faster rough surface, "
        "moves one mesh size",
    )
    target_error: float = real(
        0.0,
        "-",
        "0 or [1e-5, 0.1]",
        "required relative error of h_c and h_min due to the time steps, accumulated over one "
        "transit of the contact; 0: none",
    )
    time: tuple[float, ...] = numbers("s", "times")
    load: tuple[float, ...] = numbers("N", "load; for an infinite line contact per length [N/m]")
    u1: tuple[float, ...] = numbers("m/s", "velocity of body 1, together with u2")
    u2: tuple[float, ...] = numbers("m/s", "velocity of body 2")
    mean_velocity: tuple[float, ...] = numbers("m/s", "mean velocity; negative: reversed")
    slide_to_roll: tuple[float, ...] = numbers("-", "slide-to-roll ratio")
    radius_x: tuple[float, ...] = numbers("m", "reduced radius in the plane of the motion")
    radius_y: tuple[float, ...] = numbers("m", "reduced radius across the motion")
    viscosity: tuple[float, ...] = numbers("Pa s", "viscosity at the inlet")
    inlet_film: tuple[float, ...] = numbers(
        "m", "oil layer that arrives, if the case has inlet.film"
    )


DUTY_LISTS = (
    *("time", "load", "u1", "u2", "mean_velocity", "slide_to_roll"),
    *("radius_x", "radius_y", "viscosity", "inlet_film"),
)
"""Keys of ``&duty`` that take as many numbers as there are times."""


@dataclass(slots=True)
class Solver:
    """``&solver``: how the equations are solved."""

    deflection: str = word(
        "mlmi", "mlmi|fft", "evaluation of the elastic deflection; default fft for a line"
    )
    coarsening: str = word(
        "auto",
        "auto|classical|alcouffe",
        "transfers between grids in time steps: bilinear, or conductance-weighted (Galerkin)",
    )
    symmetry: str = word(
        "auto", "auto|full", "auto: solve half the domain where the problem is symmetric in Y"
    )
    cycle: str = word(
        "auto",
        "auto|W|V|F",
        "multigrid cycle; auto: F, the second cycle V, for a smooth contact, V for time steps "
        "and for one row of nodes",
    )
    accuracy: float = real(
        0.1,
        "-",
        "[1e-6, 1]",
        "required algebraic error as a share of the discretisation error; from 0.1 on a wide "
        "contact (kappa > 4) without solid contact needs only 0.5 after eight cycles",
    )
    max_cycles: int = whole(
        30,
        "[1, 10000]",
        "maximum number of cycles per level; multiplied by 3 with a boundary film or an oil "
        "layer, by 4 for rollers, by 10 where the meniscus of a line is sought or in a time step "
        "with damped changes",
    )
    threads: int = whole(1, "[1, 256]", "OpenMP threads; results do not depend on their number")


@dataclass(slots=True)
class Psd:
    """``&psd``: the friction prediction from the spectrum of the surface."""

    reduction: str = word(
        "response",
        "response|amplitude",
        "amplitude ratio of a wave: complex response, or real as in the paper",
    )
    smooth: str = word(
        "solved",
        "solved|hertz",
        "smooth contact: solved, or semi-ellipse and uniform film as in the paper",
    )
    film_thickness: float = real(
        0.0,
        "m",
        "[0, 1e-3]",
        "central film; 0: solved, or with smooth = 'hertz' from the Nijenbanning-Venner-Moes "
        "formula",
    )
    film_limit: float = real(
        0.0, "m", "[0, 1e-3]", "film below which the share of the contact area is reported; 0: none"
    )
    wavelength_convention: str = word(
        "components",
        "components|wavevector|pattern",
        "definition of the wavelength of a component, for reduction = 'amplitude'",
    )
    stiffness: str = word("exact", "exact|paper", "stiffness of the half-space")
    viscosity_law: str = word(
        "",
        "roelands|barus|dicke|yasutomi|doolittle|table|",
        "viscosity under pressure; default: the law of &lubricant",
    )
    load_balance: bool = truth(False, "rebalance the pressure so that it sustains the load")
    positions: int = whole(0, "[0, 4096]", "positions of the surface in one passage; 0: automatic")


@dataclass(slots=True)
class Output:
    """``&output``: the files that are written."""

    fields: bool = truth(True, "write the fields X, Y, P, H")
    frame_interval: float = real(
        0.0,
        "a/u",
        "[0, 1000]",
        "time between frames of P and H that a transient run keeps; 0: none",
    )
    checkpoint_interval: float = real(
        30.0, "s", "[0, 1e6]", "wall time between saved states of a transient run; 0: none"
    )
