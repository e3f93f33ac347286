# SPDX-License-Identifier: BSD-3-Clause
"""Relative friction of a rough EHL contact from the spectrum of its surface, without a solver.

Zhang, Biboulet, Venner & Lubrecht 2019 (doi 10.1016/j.triboint.2019.01.028), section 3. Each
Fourier component of the roughness rr is flattened to A_d/A_i of its height (eq. 10), which costs a
pressure delta p (eq. 11); friction is the integral over the Hertz circle of the shear stress at
p_s + delta p in a film h_c - rr_d (eqs 13, 14), with the semi-elliptic p_s of the dry contact.

Readings of the paper
---------------------
* Eq. 10 as printed multiplies the modulus of the component; the phase must be kept, else every
  surface would become a symmetric peak at the origin. The phase is kept here.
* Eqs 9 and 12 both print a factor 4/(Nx Ny); a transform and its inverse carry 1/(Nx Ny) once
  between them, and Parseval holds in m^2.
* The half-space resists a wave of wavenumber |q| by E'|q|/4 per height of flattening
  (``stiffness="exact"``). Eq. 11, pi E'/(sqrt 2 wavelength), is this very number for a
  cos cos pattern of that wavelength, whose |q| is 2 sqrt 2 pi/wavelength. Read with
  wavelength = 2 pi/|q| it is E'|q|/(2 sqrt 2), 41 % too stiff (``stiffness="paper"``).

What happens where the model ends
---------------------------------
* p_s + delta p <= 0: the lubricant cavitates, as P >= 0 demands in the full problem: pressure zero
  and viscosity eta0. The points are counted (`cavitated_share`) and the share of friction at
  stake is bounded (`cavitated_friction`); near the rim p_s vanishes, so a few are normal.
* h_c - rr_d <= 0: the surfaces touch. There is no full film and the model has nothing to say:
  status ``"film breakdown"``, no ratio.
* A viscosity that overflows, or roughness that carries the whole load: status ``"overflow"``,
  ``"load lost"``, no ratio.

What it gives for table 1
-------------------------
For 200 fractal surfaces at the conditions of the paper's table 1 (h_c = 0.2333 um, Roelands, exact
stiffness, components) the ratio is 1.070 +- 0.113 from surface to surface, for the first 20 seeds
1.074. That is where second order puts it: with s = (d ln eta/dp) delta p the mean of exp(s) is
exp(s_rms^2/2). delta p has an rms of 32 MPa and at p_h Roelands has d ln eta/dp = 10.4 1/GPa
(alpha is 22 at ambient pressure), so s_rms = 0.33 and pressure alone gives 1.057; thinner film
under higher pressure adds 0.011 (their correlation is 0.86), the film alone 0.002. The wavelength
conventions ``pattern`` and ``wavevector`` take off 0.003 and 0.013, load balance changes the mean
by -0.002 (single surfaces by up to 2 %), the paper's stiffness adds 0.07, Barus (22 1/GPa at any
pressure) 0.24, both together 0.62: 1.69 +- 0.64.

The spread is not one of surfaces but of tracks. Waves along the motion stay in the same place of
the contact during a passage, and 59 % of the variance is in waves as long as the tile, two contact
radii: a track under a ridge rubs more, one under a valley less, and the next track makes up for it.
Averaged over all tracks the 60 first surfaces give 1.072 +- 0.0016, for a standard deviation of
0.107 between the tracks of one surface: the mean is a property of the spectrum. See
:func:`over_tracks`.

Beside the full simulation
--------------------------
The model is too low. Ten surfaces of table 1 (seeds 1 to 10) were marched through the contact by
the solver of this package, 257 x 257 nodes, mean over one tile, the same track in both. Model and
simulation rank them alike, with a correlation of 0.9997, but the model lies 12.8 % below with
``components``, 13.0 % with ``pattern``, 13.8 % with ``wavevector``, and within 0.6 % of that for
each single surface (the grid error of the simulations is about 3 %). Hence the default. The
paper states 8 % for surfaces of its own.

What is missing is the phase. In the contact the film wave travels at the mean velocity, and it lags
the roughness that it comes from: by 40 degrees at the centre for a pattern of half a radius at
M = 1000, L = 10. What costs pressure is rr - A_d exp(i phi), which is more than rr - A_d: for that
pattern delta p is 0.69 and not 0.50 times what full flattening would take. ``phase_lag`` puts one
angle in for all waves. With 36 degrees the ten surfaces come out 3.7 % below the simulation, with
42.5 degrees on average right, each within 0.7 %, and the pattern with its own 40 degrees 0.9 %
below its simulation instead of 12 %. It is not the default because the lag of other waves and at
other operating points has not been measured.

The ratio of a Newtonian lubricant is the limit of vanishing sliding; its absolute friction
coefficient has no meaning. With an Eyring stress or a limiting stress at a real slide-to-roll ratio
the ratio is close to one.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from pyehl import amplitude
from pyehl.operating import Lubricant, OperatingPoint
from pyehl.topography import MAX_PIXELS, Topography, resampled, shifted, wavenumbers

__all__ = [
    "Band",
    "Options",
    "Response",
    "RoughFriction",
    "contributions",
    "over_tracks",
    "predict_friction",
    "response",
    "stiffness",
]

Array = NDArray[np.float64]

STIFFNESSES = ("exact", "paper")
FRICTIONS = ("newtonian", "eyring", "limiting")

# Fewest positions of an automatic passage, and the error that half of them may make (relative)
# for no more to be added
FIRST_POSITIONS = 8
POSITION_TOLERANCE = 2e-3
MAX_POSITIONS = 4096
# Fewest points per Hertz radius when not all pixels are visited
MIN_SAMPLES = 128
# Pixels per Hertz radius below which a coarse map is interpolated
RADIUS_PIXELS = 48


@dataclass(frozen=True, slots=True)
class Options:
    """How the model is read.

    Attributes
    ----------
    wavelength_convention
        One of :data:`pyehl.amplitude.CONVENTIONS`.
    phase_lag
        How far the film wave of a component lags its roughness [deg], 0 <= phase_lag < 90; the
        paper has 0. Waves with their crests along the motion never lag.
    stiffness
        ``"exact"``: E'|q|/4; ``"paper"``: eq. 11 with wavelength 2 pi/|q|.
    load_balance
        Whether the semi-ellipse gives up the load that delta p carries inside the contact: a
        Hertz contact under the remaining load, p_h and a scaled by its cube root.
    friction
        ``"newtonian"``, ``"eyring"`` (tau_0 asinh(tau_N/tau_0)) or ``"limiting"``
        (tau_L (1 - exp(-tau_N/tau_L)), tau_L = coefficient times pressure; Bair & Winer 1979).
    eyring_stress
        tau_0 [Pa].
    limiting_coefficient
        tau_L/p [-].
    slide_to_roll
        (u1 - u2)/u [-]; without effect on the ratio of a Newtonian lubricant.
    positions
        Positions of the surface over one passage; 0: doubled until mu_r/mu_s is resolved.

    Raises
    ------
    ValueError
        For an unknown word or a number out of range.
    """

    wavelength_convention: str = "components"
    phase_lag: float = 0.0
    stiffness: str = "exact"
    load_balance: bool = False
    friction: str = "newtonian"
    eyring_stress: float = 5e6
    limiting_coefficient: float = 0.06
    slide_to_roll: float = 0.01
    positions: int = 0

    def __post_init__(self) -> None:
        """Check the words and the numbers."""
        for name, value, allowed in (
            ("wavelength_convention", self.wavelength_convention, amplitude.CONVENTIONS),
            ("stiffness", self.stiffness, STIFFNESSES),
            ("friction", self.friction, FRICTIONS),
        ):
            if value not in allowed:
                raise ValueError(f"{name} {value!r}: expected one of {allowed}")
        for name, number in (
            ("eyring_stress", self.eyring_stress),
            ("limiting_coefficient", self.limiting_coefficient),
            ("slide_to_roll", self.slide_to_roll),
        ):
            if not (math.isfinite(number) and number > 0.0):
                raise ValueError(f"{name} must be positive, not {number!r}")
        if not 0.0 <= self.phase_lag < 90.0:
            raise ValueError(f"phase_lag must be 0 <= ... < 90 [deg], not {self.phase_lag!r}")
        if not 0 <= self.positions <= MAX_POSITIONS:
            raise ValueError(f"positions must be 0 ... {MAX_POSITIONS}, not {self.positions!r}")

    @classmethod
    def from_settings(cls, settings: Mapping[str, Mapping[str, Any]]) -> Options:
        """From the group ``psd`` of a resolved case.

        Raises
        ------
        ValueError
            For a value out of range (`slide_to_roll` must be positive here).
        """
        group = settings["psd"]
        return cls(
            wavelength_convention=str(group["wavelength_convention"]),
            phase_lag=float(group["phase_lag"]),
            stiffness=str(group["stiffness"]),
            load_balance=bool(group["load_balance"]),
            friction=str(group["friction"]),
            eyring_stress=float(group["eyring_stress"]),
            limiting_coefficient=float(group["limiting_coefficient"]),
            slide_to_roll=float(group["slide_to_roll"]),
            positions=int(group["positions"]),
        )


@dataclass(frozen=True, slots=True)
class Response:
    """What a loaded contact makes of a rough tile, before it is anywhere in the contact.

    Attributes
    ----------
    pressure
        delta p (nx, ny) [Pa], mean zero.
    deformed
        Deformed roughness rr_d (nx, ny) [m], mean zero, peaks thin the film.
    """

    pressure: Array
    deformed: Array


@dataclass(frozen=True, slots=True)
class RoughFriction:
    """Friction over one passage of the tile.

    Attributes
    ----------
    status
        ``"predicted"``, ``"film breakdown"``, ``"overflow"`` or ``"load lost"``. Unless
        ``"predicted"`` the ratios are NaN.
    message
        The status in a sentence.
    mu_ratio, mu_ratio_min, mu_ratio_max
        mean, least and greatest mu_r/mu_s over the passage [-]; the extremes of the trigonometric
        interpolant through the positions.
    position_error
        What half as many positions would miss at the others, relative to the mean: an upper
        estimate of what the positions leave undecided. NaN for an odd number of them.
    shift
        (n,) how far the tile has moved [m], equally spaced over its length.
    passage
        (n,) mu_r/mu_s there [-].
    mu_smooth
        Friction coefficient of the smooth contact at the slide-to-roll ratio [-]; without meaning
        for a Newtonian lubricant.
    film_min
        Least h_c - rr_d of the tile [m].
    cavitated_share
        Mean share of the contact where p_s + delta p <= 0 [-].
    cavitated_friction
        Bound of the share of the friction that comes from there [-].
    load_error
        Greatest |integral of delta p|/w over the passage [-], before any load balance.
    response
        delta p and deformed roughness on the grid of the given tile.
    seconds
        Wall time of the prediction.
    """

    status: str
    message: str
    mu_ratio: float
    mu_ratio_min: float
    mu_ratio_max: float
    position_error: float
    shift: Array
    passage: Array
    mu_smooth: float
    film_min: float
    cavitated_share: float
    cavitated_friction: float
    load_error: float
    response: Response
    seconds: float


def stiffness(qx: Array, qy: Array, reduced_modulus: float, kind: str = "exact") -> Array:
    """Pressure per height of flattening of a Fourier component [Pa/m], zero at q = 0.

    Parameters
    ----------
    qx, qy
        Wavenumbers [rad/m], broadcast together.
    reduced_modulus
        E' [Pa].
    kind
        ``"exact"``: E'|q|/4, the elastic half-space (Johnson 1985, Contact Mechanics, section
        13.2); ``"paper"``: eq. 11 with wavelength 2 pi/|q|, sqrt 2 times as stiff.

    Raises
    ------
    ValueError
        If the kind is unknown.
    """
    q = np.hypot(qx, qy)
    if kind == "exact":
        return np.asarray(0.25 * reduced_modulus * q)
    if kind == "paper":
        return np.asarray(reduced_modulus * q / (2.0 * math.sqrt(2.0)))
    raise ValueError(f"stiffness {kind!r}: expected one of {STIFFNESSES}")


def response(
    topography: Topography, operating: OperatingPoint, options: Options | None = None
) -> Response:
    """Pressure and deformed roughness of a tile (eqs 9 to 12).

    Parameters
    ----------
    topography
        The tile (nx, ny).
    operating
        Gives a, E', M, L.
    options
        How the model is read: its convention, phase lag and stiffness.

    Raises
    ------
    ValueError
        If the conditions have no amplitude reduction (L = 0).
    """
    options = options or Options()
    qx, qy = wavenumbers(topography)
    ratio = amplitude.component_amplitude_ratio(
        qx,
        qy,
        operating.hertz_radius,
        operating.moes_m,
        operating.moes_l,
        convention=options.wavelength_convention,
    )
    component = scipy.fft.rfft2(topography.heights)
    # the mean height is no roughness: it is taken up by the rigid approach
    component[0, 0] = 0.0
    transfer: NDArray[np.float64] | NDArray[np.complex128] = ratio
    if options.phase_lag > 0.0:
        transfer = ratio * np.exp(1j * math.radians(options.phase_lag) * _direction(qx))
    flattening = stiffness(qx, qy, operating.reduced_modulus, options.stiffness) * (1.0 - transfer)
    shape = topography.shape
    return Response(
        np.asarray(scipy.fft.irfft2(flattening * component, s=shape)),
        np.asarray(scipy.fft.irfft2(transfer * component, s=shape)),
    )


def _direction(qx: Array) -> Array:
    """Sign of q_x, of shape (nx, 1): what turns a lag in time, exp(i phi), into one in space.

    Zero for the shortest wave of an even number of pixels, which has no phase of its own.
    """
    sign = np.sign(qx)
    if qx.shape[0] % 2 == 0:
        sign[qx.shape[0] // 2] = 0.0
    return np.asarray(sign)


class _Contact:
    """The pixels of the Hertz circle and the shear stress integrals over them."""

    def __init__(
        self,
        field: Response,
        pixel: tuple[float, float],
        *,
        operating: OperatingPoint,
        lubricant: Lubricant,
        film: float,
        options: Options,
    ) -> None:
        self.lubricant, self.film, self.options = lubricant, film, options
        self.load = operating.load
        self.circle = math.pi * operating.hertz_radius**2
        self.hertz_pressure = operating.hertz_pressure
        self.sliding = options.slide_to_roll * operating.mean_velocity
        nx, ny = field.pressure.shape
        a = operating.hertz_radius
        i, stride_x = _lattice(a / pixel[0], nx)
        j, stride_y = _lattice(a / pixel[1], ny)
        self.area = pixel[0] * pixel[1] * stride_x * stride_y
        square = (i * pixel[0] / a)[:, np.newaxis] ** 2 + (j * pixel[1] / a)[np.newaxis, :] ** 2
        inside = square < 1.0
        self.radius_squared = square[inside]
        self.index = ((i % nx)[:, np.newaxis] * ny + j % ny)[inside]
        self.pressure, self.deformed = field.pressure, field.deformed
        # every height within |y| < a passes through the contact
        self.thinnest = film - float(field.deformed[:, np.unique(j % ny)].max())
        self.smooth_pressure = self.hertz_pressure * np.sqrt(1.0 - self.radius_squared)
        self.smooth = float(self._stress(self.smooth_pressure, np.array(film)).sum())
        self.cavitated = 0
        self.imbalance = 0.0
        self.count = 0

    def _stress(self, pressure: Array, film: Array) -> Array:
        """Shear stress at a pressure [Pa] in a film [m].

        [Pa]; of a Newtonian oil divided by eta0 and the sliding speed.
        """
        ratio = self.lubricant.viscosity_ratio(pressure) / film
        if self.options.friction == "newtonian":
            return ratio
        newtonian = ratio * (self.lubricant.viscosity * self.sliding)
        if self.options.friction == "eyring":
            tau = self.options.eyring_stress
            return np.asarray(tau * np.arcsinh(newtonian / tau))
        limit = self.options.limiting_coefficient * pressure
        with np.errstate(divide="ignore", invalid="ignore"):
            stress = -limit * np.expm1(-newtonian / limit)
        return cast(Array, np.where(limit > 0.0, stress, 0.0))

    def friction(self, step: int) -> float:
        """Integral of the shear stress over that of the smooth contact, `step` pixels on."""
        if self.thinnest <= 0.0:
            return math.nan
        delta = np.roll(self.pressure, step, axis=0).ravel().take(self.index)
        film = self.film - np.roll(self.deformed, step, axis=0).ravel().take(self.index)
        # times the area of the circle, not of its pixels
        carried = float(delta.mean()) * self.circle / self.load
        self.imbalance = max(self.imbalance, abs(carried))
        if self.options.load_balance:
            if carried >= 1.0:
                return math.nan
            scale = (1.0 - carried) ** (1.0 / 3.0)
            inner = np.maximum(0.0, 1.0 - self.radius_squared / scale**2)
            pressure = (scale * self.hertz_pressure) * np.sqrt(inner) + delta
        else:
            pressure = self.smooth_pressure + delta
        tension = pressure <= 0.0
        lost = int(np.count_nonzero(tension))
        if lost:
            pressure[tension] = 0.0
            self.cavitated += lost
        self.count += 1
        with np.errstate(over="ignore"):
            return float(self._stress(pressure, film).sum()) / self.smooth

    def cavitated_bound(self, least: float) -> float:
        """Bound of the share of friction at cavitated pixels, `least` the least F_r/F_s."""
        if self.cavitated == 0:
            return 0.0
        stress = float(self._stress(np.array(0.0), np.array(self.thinnest)))
        return self.cavitated * stress / (self.count * least * self.smooth)


def _lattice(radius: float, pixels: int) -> tuple[NDArray[np.int_], int]:
    """Pixels of a diameter at which the stress is taken, and their stride.

    All of them unless the tile is much shorter than the contact and finely sampled. Then a stride
    without common divisor with the tile meets each of its pixels in turn, and the contact is still
    met at MIN_SAMPLES points and each pixel of the tile at eight places of it.
    """
    half = int(radius)
    stride = max(1, half // max(MIN_SAMPLES, 4 * pixels))
    while math.gcd(stride, pixels) > 1:
        stride -= 1
    reach = half // stride
    return np.arange(-reach, reach + 1) * stride, stride


def _working_grid(topography: Topography, operating: OperatingPoint, positions: int) -> Topography:
    """Return the tile on a grid that resolves the contact and has room for the positions."""
    nx, ny = topography.shape
    finest = operating.hertz_radius / RADIUS_PIXELS
    want_x = max(nx, math.ceil(topography.length_x / finest))
    want_y = max(ny, math.ceil(topography.length_y / finest))
    multiple = positions or FIRST_POSITIONS * 4
    want_x = multiple * math.ceil(want_x / multiple)
    if want_x * want_y > MAX_PIXELS:
        raise ValueError(
            f"{topography.origin}: a tile of {topography.length_x:.3g} x "
            f"{topography.length_y:.3g} m would need {want_x} x {want_y} pixels to resolve a "
            f"contact of radius {operating.hertz_radius:.3g} m; cut a part out of it"
        )
    return resampled(topography, (want_x, want_y))


def _interpolated(values: Array) -> Array:
    """Trigonometric interpolant of a periodic sequence on eight times as many points."""
    n = values.size
    half = np.fft.rfft(values)
    if n % 2 == 0:
        half[-1] *= 0.5
    return np.asarray(np.fft.irfft(half, 8 * n) * 8.0)


def _undecided(values: Array) -> float:
    """Return what half of the positions would have missed at the others, relative to the mean.

    The interpolant through every second value against the values between: an upper estimate of
    what all of them leave undecided, since the interpolant converges faster than any power.
    """
    if values.size % 2:
        return math.nan
    half = np.fft.rfft(values[::2])
    n = values.size // 2
    if n % 2 == 0:
        half[-1] *= 0.5
    between = np.fft.irfft(half, 2 * n)[1::2] * 2.0
    return float(np.abs(between - values[1::2]).max() / values.mean())


def predict_friction(
    topography: Topography,
    operating: OperatingPoint,
    lubricant: Lubricant,
    film: float,
    options: Options | None = None,
) -> RoughFriction:
    """mu_r/mu_s over one passage of a rough tile through a contact.

    Parameters
    ----------
    topography
        The tile; its pixel [0, 0] starts at the centre of the contact and moves along x.
    operating
        Gives p_h, a, E', M, L.
    lubricant
        Gives the viscosity; the law is the one it carries.
    film
        Smooth central film h_c [m], taken to be the film everywhere in the contact.
    options
        How the model is read.

    Returns
    -------
    RoughFriction
        With status ``"predicted"`` unless the model does not hold, see the module.

    Raises
    ------
    ValueError
        If the film is not positive, or the conditions have no amplitude reduction (L = 0).

    Notes
    -----
    delta p and rr_d belong to the tile and are computed once; only the semi-ellipse and the film
    are met anew at each position, inside the circle alone. Positions are whole pixels of the
    working grid, so that moving the tile is a copy. The ratio along the passage is smooth,
    because the viscosity confines the friction to the middle of the contact (for table 1 a
    Gaussian of standard deviation 0.24 a): its mean over 8 positions of a tile of 2 a is right to
    1e-7. A tile much shorter than the contact is visited at a stride. A coarse map, or one whose
    pixels do not divide into positions, is first interpolated by its Fourier series.
    """
    start = time.perf_counter()
    options = options or Options()
    if not (math.isfinite(film) and film > 0.0):
        raise ValueError(f"film thickness must be positive [m], not {film!r}")
    field = response(topography, operating, options)
    grid = _working_grid(topography, operating, options.positions)
    work = field if grid is topography else response(grid, operating, options)
    with np.errstate(over="ignore", invalid="ignore"):
        contact = _Contact(
            work,
            grid.pixel,
            operating=operating,
            lubricant=lubricant,
            film=film,
            options=options,
        )
        steps, passage, error = _passage(contact, grid.shape[0], options.positions)

    status, message = "predicted", "full film throughout the passage"
    mean = least = greatest = math.nan
    if contact.thinnest <= 0.0:
        status = "film breakdown"
        message = (
            f"deformed roughness reaches {film - contact.thinnest:.3g} m in a film of "
            f"{film:.3g} m: no full film, no ratio"
        )
    elif not np.all(np.isfinite(passage)):
        if options.load_balance and contact.imbalance >= 1.0:
            status, message = "load lost", "the roughness pressure exceeds the load"
        else:
            status, message = "overflow", "the viscosity at p_s + delta p is not a number"
    else:
        fine = _interpolated(passage)
        mean = float(passage.mean())
        least, greatest = float(fine.min()), float(fine.max())
    smooth = math.nan
    if math.isfinite(contact.smooth):
        smooth = contact.smooth * contact.area / operating.load
        if options.friction == "newtonian":
            smooth *= lubricant.viscosity * contact.sliding
    return RoughFriction(
        status=status,
        message=message,
        mu_ratio=mean,
        mu_ratio_min=least,
        mu_ratio_max=greatest,
        position_error=error,
        shift=np.asarray(steps * grid.pixel[0], dtype=np.float64),
        passage=passage,
        mu_smooth=smooth,
        film_min=float(contact.thinnest),
        cavitated_share=contact.cavitated / max(1, contact.count * contact.index.size),
        cavitated_friction=contact.cavitated_bound(least) if status == "predicted" else math.nan,
        load_error=contact.imbalance,
        response=field,
        seconds=time.perf_counter() - start,
    )


def _passage(
    contact: _Contact, pixels: int, positions: int
) -> tuple[NDArray[np.int_], Array, float]:
    """Positions [pixels], ratios there and what they leave undecided at most (relative)."""
    n = positions or FIRST_POSITIONS
    steps = np.arange(n) * (pixels // n)
    ratios = np.array([contact.friction(int(s)) for s in steps])
    while np.all(np.isfinite(ratios)):
        error = _undecided(ratios)
        if positions or error <= POSITION_TOLERANCE or pixels % (2 * n) or 2 * n > MAX_POSITIONS:
            return steps, ratios, error
        spacing = pixels // (2 * n)
        merged = np.empty(2 * n)
        merged[::2] = ratios
        merged[1::2] = [contact.friction(int(s)) for s in steps + spacing]
        n *= 2
        steps, ratios = np.arange(n) * spacing, merged
    return steps, ratios, math.nan


def over_tracks(
    topography: Topography,
    operating: OperatingPoint,
    lubricant: Lubricant,
    film: float,
    options: Options | None = None,
    *,
    tracks: int = 8,
) -> tuple[float, float]:
    """Mean and standard deviation of the passage mean of mu_r/mu_s over the tracks of a tile [-].

    Parameters as :func:`predict_friction`; the tile is moved across the motion by `tracks` equal
    parts of its width. NaN where one of them has no ratio.

    Raises
    ------
    ValueError
        As :func:`predict_friction`, and for less than one track.
    """
    if tracks < 1:
        raise ValueError(f"tracks must be positive, not {tracks!r}")
    ratios = np.array(
        [
            predict_friction(
                shifted(topography, 0.0, k * topography.length_y / tracks),
                operating,
                lubricant,
                film,
                options,
            ).mu_ratio
            for k in range(tracks)
        ]
    )
    return float(ratios.mean()), float(ratios.std())


@dataclass(frozen=True, slots=True)
class Band:
    """What a band of wavelengths adds.

    Attributes
    ----------
    longest, shortest
        The band of wavelengths 2 pi/|q| [m].
    rms_height
        Of the undeformed roughness in the band [m].
    rms_deformed
        Of the deformed roughness in the band [m].
    rms_pressure
        Of delta p in the band [Pa].
    rise
        How much mu_r/mu_s grows when this band joins all the longer ones [-]; NaN where the model
        does not hold.
    """

    longest: float
    shortest: float
    rms_height: float
    rms_deformed: float
    rms_pressure: float
    rise: float


def contributions(
    topography: Topography,
    operating: OperatingPoint,
    lubricant: Lubricant,
    film: float,
    options: Options | None = None,
) -> list[Band]:
    """Which wavelengths the friction comes from, octave by octave from the longest.

    Parameters as :func:`predict_friction`.

    Returns
    -------
    list of Band
        Longest waves first; octaves without any roughness are left out. The rises add up to the
        whole mu_r/mu_s - 1.

    Raises
    ------
    ValueError
        As :func:`predict_friction`.
    """
    options = options or Options()
    qx, qy = wavenumbers(topography)
    q = np.hypot(qx, qy)
    heights = scipy.fft.rfft2(topography.heights - topography.heights.mean())
    # a harmonic pattern has rounding errors in all bands but its own
    present = np.abs(heights) > 1e-10 * np.abs(heights).max()
    lowest = float(q[q > 0.0].min())
    octave = np.full(q.shape, -1)
    octave[q > 0.0] = np.floor(np.log2(q[q > 0.0] / lowest) + 1e-9).astype(int)
    bands: list[Band] = []
    before = 1.0
    for k in range(int(octave.max()) + 1):
        in_band, so_far = octave == k, octave <= k
        if not (in_band & present).any():
            continue
        part = _filtered(topography, heights, in_band)
        field = response(part, operating, options)
        total = predict_friction(
            _filtered(topography, heights, so_far), operating, lubricant, film, options
        )
        bands.append(
            Band(
                longest=2.0 * math.pi / (lowest * 2.0**k),
                shortest=2.0 * math.pi / (lowest * 2.0 ** (k + 1)),
                rms_height=part.rms_height,
                rms_deformed=float(np.std(field.deformed)),
                rms_pressure=float(np.std(field.pressure)),
                rise=total.mu_ratio - before,
            )
        )
        before = total.mu_ratio
    return bands


def _filtered(
    topography: Topography, heights: NDArray[np.complex128], keep: NDArray[np.bool_]
) -> Topography:
    z = scipy.fft.irfft2(heights * keep, s=topography.shape)
    return Topography(np.asarray(z), topography.length_x, topography.length_y, topography.origin)
