# SPDX-License-Identifier: BSD-3-Clause
"""Friction of a model over a passage, its tracks and bands of wavelengths, with its errors.

For a full film, and for solid contact at a boundary film.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from pyehl.contact.sheared import HertzContact, ShearedContact, thins
from pyehl.prediction.bands import Bands, LongerWaves, with_factors
from pyehl.prediction.model import PIXEL_POINTS, Components, Model
from pyehl.prediction.relative_positions import Passage, RelativePositions, TilePositions
from pyehl.prediction.response import Response
from pyehl.prediction.rough_contact import RoughContact
from pyehl.prediction.spectrum import Band
from pyehl.surfaces import interpolated, track_offsets
from pyehl.theory.heat import Heat
from pyehl.theory.line_contact import AnyContact
from pyehl.theory.lubricant import Lubricant
from pyehl.types import Array

BEYOND = "beyond linear response"
"""Status where the ratio is outside of the model."""
STATUSES = ("predicted", "film breakdown", BEYOND, "load lost", "overflow")
"""All statuses of a prediction; only the first one has a ratio."""
TRACKS = 8
"""Default number of tracks for mean and spread."""

MAX_RATIO = 10.0
"""Largest mu_r/mu_s that is reported."""

NEWTONIAN_NOTE = (
    "Newtonian: a ratio at this slip, no absolute coefficient; shear thinning brings it close to "
    "1, see lubricant.shear_law"
)
NEWTONIAN_FLOW_NOTE = (
    "; film and waves are those of a Newtonian flow: where the oil thins in it, too, the ratio is "
    "nearer to 1, see lubricant.flow"
)
STRESS_NOTE = "ratio of friction coefficients at the given slide-to-roll ratio"


# Why solid contact, or the friction of a partial film, is not known
BETWEEN = "the film ends between the positions at which contact is searched for"
NO_FRICTION = (
    "the bodies touch, and the friction there is not known: lubricant.boundary_friction and "
    "sliding are needed"
)


@dataclass(frozen=True, slots=True)
class RoughFriction:
    """Friction over one passage of the rough surfaces."""

    # ``"predicted"``, ``"film breakdown"``, ``"beyond linear response"``, ``"overflow"`` or ``"load
    # lost"``. Unless ``"predicted"`` the ratios are NaN
    status: str
    message: str  # the status in a sentence
    # mean, minimum and maximum mu_r/mu_s over the passage [-]; the extremes of the trigonometric
    # interpolant through the positions
    mu_ratio: float
    mu_ratio_min: float
    mu_ratio_max: float
    # Estimated error due to the number of positions, relative to the mean; NaN: not known. Of one
    # tile that of an interpolation from every second position, of two tiles half the difference of
    # the means over every second position and over the others, or if it is larger the difference
    # from the mean over the lattice before
    position_error: float
    # (n,) displacement of each tile [m], equally spaced over its length; for two rough surfaces
    # over their common period, or without one in the order of a lattice
    shifts: tuple[Array, ...]
    passage: Array  # (n,) mu_r/mu_s there [-]
    # Friction coefficient of the smooth contact at the slide-to-roll ratio [-]; it has no meaning
    # for a Newtonian lubricant
    mu_smooth: float
    film_min: float  # minimum film over the passage [m]; NaN at a film breakdown
    # Pressure increase over the passage: rms within NEAR, maximum within INNER [Pa]
    increase_rms: float
    increase_max: float
    pressure_max: float  # maximum pressure over the passage within INNER [Pa]
    # Mean fraction of the contact with a film below psd.film_limit [-], and its error due to that
    # of the film; NaN without a limit
    below_limit: float
    below_limit_error: float
    cavitated_share: float  # mean fraction of the contact where p_s + delta p <= 0 [-]
    cavitated_friction: float  # bound on the fraction of friction from there [-]
    # Maximum |integral of delta p|/w over the passage [-], before any load balance
    load_error: float
    # Mean fraction of the contact without a film, over the positions [-]
    ended: float
    # delta p and deformed roughness of each surface on the grid of its tile
    responses: tuple[Response, ...]

    @property
    def response(self) -> Response:
        """Response of the (first) surface."""
        return self.responses[0]

    @property
    def shift(self) -> Array:
        """Displacement of the tile of the (first) surface (n,) [m]."""
        return self.shifts[0]


def meaning(lubricant: Lubricant, operating: AnyContact) -> str:
    """Describe mu_r/mu_s."""
    stress = STRESS_NOTE + ("" if lubricant.shear.in_flow else NEWTONIAN_FLOW_NOTE)
    note = stress if thins(lubricant, operating) else NEWTONIAN_NOTE
    return note + lubricant.beyond(operating.hertz_pressure)


def outcome(
    contact: ShearedContact, ratios: Array, *, load_balance: bool = False
) -> tuple[str, str]:
    """Give status and message of a passage from mu_r/mu_s at its positions (n,).

    `load_balance`: the load on the roughness is subtracted from the smooth contact.
    """
    if contact.minimum_film <= 0.0:
        return "film breakdown", too_high(-contact.minimum_film * contact.operating.film_scale)
    if contact.lost or (load_balance and contact.imbalance >= 1.0):
        return "load lost", "the roughness pressure exceeds the load"
    if not np.all(np.isfinite(ratios)):
        return "overflow", "the viscosity at p_s + delta p is not a number"
    mean = float(ratios.mean())
    if mean > MAX_RATIO:
        message = f"pressures that raise mu_r/mu_s to {mean:.3g} are beyond a linear response"
        return BEYOND, message
    return "predicted", "full film throughout the passage"


def too_high(height: float) -> str:
    """Report that the deformed roughness is higher than the film sustains, by a height [m]."""
    much = f"{height * 1e9:.3g} nm"
    return f"the deformed roughness is {much} higher than the film sustains: no full film"


def broken(friction: RoughFriction, sustained: float) -> RoughFriction:
    """Return a prediction whose film breaks down between its positions, without film and ratio.

    `sustained`: minimum of the sustained minus the deformed roughness [m].
    """
    ratios = ("mu_ratio", "mu_ratio_min", "mu_ratio_max", "position_error")
    lost = unknown(*ratios, "film_min", "cavitated_friction")
    return replace(friction, status="film breakdown", message=too_high(-sustained), **lost)


def unknown(*names: str) -> dict[str, Any]:
    """Give NaN by names, for `replace`."""
    return dict.fromkeys(names, math.nan)


ROUGH_FILM_ERROR = 0.35
"""Error of a film over roughness, over the rms height of the deformed roughness
(docs/evidence/thinning)."""
# Slip above which this error is twice as large
MUCH_SLIP = 0.2


def film_share(*velocity_ratios: float) -> float:
    """Error of a film over the rms height of the deformed roughness, at velocity ratios [-]."""
    slips = [abs(ratio - 1.0) for ratio in velocity_ratios]
    return ROUGH_FILM_ERROR * (2.0 if max(slips) > MUCH_SLIP else 1.0)


def film_levels(
    limit: float, waves: Sequence[tuple[Array, Array]], velocity_ratios: Sequence[float]
) -> tuple[float, ...]:
    """Film limit minus its error, the limit, and the limit plus its error; () without a limit.

    For each surface `waves` has the mean square of the components of the roughness, in the square
    of the unit of the limit, and their amplitude ratios in the contact.
    """
    left = sum(float((power * np.square(ratio)).sum()) for power, ratio in waves)
    margin = film_share(*velocity_ratios) * math.sqrt(left)
    return (limit - margin, limit, limit + margin) if limit > 0.0 else ()


@dataclass(frozen=True, slots=True)
class MixedFilm:
    """Mixed lubrication over a passage: means, minimum film and errors; NaN: not known."""

    note: str = ""  # why an error or all numbers are missing
    load_share: float = math.nan  # share of the load in solid contact [-]
    load_share_error: float = math.nan
    area_share: float = math.nan  # area of solid contact over that of the dry contact [-]
    area_share_error: float = math.nan
    film_min: float = math.nan  # minimum film [m]
    film_min_error: float = math.nan
    # Friction over that of the smooth contact [-], and coefficient of friction of the latter, both
    # with the boundary film; NaN if its friction is needed and not known
    friction: float = math.nan
    friction_error: float = math.nan
    mu_smooth: float = math.nan
    shift: Array = field(default_factory=lambda: np.zeros(0))  # of the tile (n,) [m]
    passage: Array = field(default_factory=lambda: np.zeros(0))  # (n,) friction ratio there
    lost: bool = False  # whether there is solid contact of unknown extent
    heat: Heat | None = None  # effect of frictional heating on friction with solid contact

    @property
    def touches(self) -> bool:
        """Whether bodies touch."""
        return self.load_share > 0.0

    @property
    def friction_unknown(self) -> bool:
        """Whether bodies touch and the friction there is not known."""
        return self.touches and not math.isfinite(self.friction)

    def unknown(self, note: str) -> MixedFilm:
        """Remove the numbers for a reason, unless the film is certainly full."""
        if self.load_share == 0.0 == self.load_share_error:
            return self
        return MixedFilm(note, mu_smooth=self.mu_smooth, lost=self.lost or self.touches)

    def without_errors(self, note: str) -> MixedFilm:
        """Remove the errors for a reason."""
        errors = ("load_share_error", "area_share_error", "film_min_error", "friction_error")
        return replace(self, note=self.note or note, **unknown(*errors))


class Outcome(NamedTuple):
    """Friction over a passage, mean and spread over tracks (NaN: none), contributions of bands.

    The latter are computed when they are asked for.
    """

    friction: RoughFriction
    tracks: tuple[float, float] = (math.nan, math.nan)
    bands: Sequence[Band] = ()

    @property
    def bands_seconds(self) -> float:
        """Wall time of the bands [s]; 0 if they are not computed."""
        return self.bands.seconds if isinstance(self.bands, Bands) else 0.0


def with_contact(result: Outcome, mixed: MixedFilm) -> tuple[Outcome, MixedFilm]:
    """Add solid contact to the friction of a full film; returns friction and known contact results.

    A prediction without solid contact, or with unknown contact, does not change.
    """
    friction = result.friction
    if friction.status == "film breakdown" and not mixed.touches:
        # contact is not known at a film breakdown for which none was found
        mixed = replace(mixed if mixed.note else MixedFilm(BETWEEN), mu_smooth=mixed.mu_smooth)
        mixed = replace(mixed, lost=True)
    if mixed.lost:
        return Outcome(_lost(friction, mixed), bands=result.bands), mixed
    if not mixed.touches:
        return result, mixed
    fine = interpolated(mixed.passage, 8)
    known = math.isfinite(mixed.friction)
    if friction.status != "predicted":
        # without a full film these numbers are not known
        numbers = ("increase_rms", "increase_max", "pressure_max", "below_limit")
        friction = replace(friction, **unknown(*numbers, "below_limit_error"))
    friction = replace(
        friction,
        status="predicted",
        message="partial film: the bodies touch at the boundary film",
        mu_ratio=mixed.friction,
        mu_ratio_min=float(fine.min()) if known else math.nan,
        mu_ratio_max=float(fine.max()) if known else math.nan,
        position_error=math.nan,
        shifts=(mixed.shift,),
        passage=mixed.passage,
        mu_smooth=mixed.mu_smooth,
        film_min=mixed.film_min,
        cavitated_friction=math.nan,
    )
    return Outcome(friction, bands=result.bands), mixed


def _lost(friction: RoughFriction, mixed: MixedFilm) -> RoughFriction:
    """Remove the friction of a full film if there is solid contact of unknown extent."""
    message = f"the bodies touch at the boundary film, to an unknown extent: {mixed.note}"
    if friction.status != "predicted":
        message = f"{friction.message}; {message}"
    status = "film breakdown" if friction.status == "predicted" else friction.status
    smooth = mixed.mu_smooth if math.isfinite(mixed.mu_smooth) else friction.mu_smooth
    none = broken(friction, math.nan)
    return replace(none, status=status, message=message, mu_smooth=smooth)


def run(
    model: Model, tracks: int = TRACKS, *, brief: bool = False, waves: Components | None = None
) -> Outcome:
    """Friction over the passage, mean and spread over the tracks, and contribution of each band.

    `brief`: only the band of the shortest waves. Without tracks mean and spread are NaN. `waves`:
    the components, if they are known already.
    """
    if model.merged is not None:
        together = run(model.merged, tracks, brief=brief)
        alone = together.friction
        both = tuple(model.responses())
        friction = replace(alone, responses=both, shifts=alone.shifts * 2)
        return together._replace(friction=friction)
    waves = with_factors(model, waves or model.components())
    positions = model.positions(waves)
    with np.errstate(over="ignore", invalid="ignore"):
        contact = model.rough_contact(waves)
        limit = model.options.film_limit / model.operating.film_scale
        left = [(w.spectrum.power, np.abs(w.at_centre())) for w in waves]
        contact.watch(film_levels(limit, left, [w.velocity_ratio for w in waves]))
        passage = positions.passage(contact, model.options.positions, MAX_RATIO)
        result = _result(model, contact, waves, passage)
        if result.status != "predicted":
            return Outcome(result)
        ratios = _over_tracks(model, contact, waves, positions, tracks, result.mu_ratio)
    over = (float(np.mean(ratios)), float(np.std(ratios))) if tracks else (math.nan, math.nan)
    return Outcome(result, over, Bands(model, waves, contact, result.mu_ratio, brief=brief))


def _over_tracks(
    model: Model,
    contact: RoughContact | HertzContact,
    waves: Components,
    positions: TilePositions | RelativePositions,
    tracks: int,
    first: float,
) -> list[float]:
    """mu_r/mu_s on a number of tracks; `first` is that on the track of the case."""
    offsets = [track_offsets(one.topography, tracks) if tracks else [] for one in model.in_order]
    if isinstance(positions, TilePositions):
        pixel = model.surfaces[0].topography.length_y / waves[0].spectrum.shape[1]
        stride = model.stride_of(waves[0].spectrum, PIXEL_POINTS)
        moved = [(d, round(d / (stride * pixel)) * stride) for d in offsets[0]]
        return [
            first if d == 0.0 else positions.short_mean(contact.ratios, track) for d, track in moved
        ]
    # the tracks of both surfaces, in opposite order
    a = model.operating.hertz_radius
    pairs = [(offsets[0][k] / a, offsets[1][-k % tracks] / a) for k in range(tracks)]
    # sorted, so that the order of the surfaces has no effect
    return sorted(
        positions.short_mean(model.rough_contact(waves, tracks=pair, like=contact).ratios)
        if any(pair)
        else first
        for pair in pairs
    )


def mean(model: Model, waves: Components | None = None) -> float:
    """mu_r/mu_s over a few positions [-]; NaN at a film breakdown."""
    if model.merged is not None:
        return mean(model.merged)
    waves = waves or model.components()
    with np.errstate(over="ignore", invalid="ignore"):
        return model.positions(waves).short_mean(model.rough_contact(waves).ratios)


def run_and_below(model: Model, *shortest: float) -> tuple[RoughFriction, list[float]]:
    """Friction without tracks, and mu_r/mu_s without waves shorter than some lengths [a].

    The latter over a few positions each; empty if friction is not predicted.
    """
    if model.merged is not None:
        return run_and_below(model.merged, *shortest)
    waves = model.components()
    result = run(model, 0, brief=True, waves=waves).friction
    if result.status != "predicted":
        return result, []
    limits = [2.0 * math.pi / length for length in shortest]
    with np.errstate(over="ignore", invalid="ignore"):
        longer = LongerWaves(model, waves)
        return result, [longer.ratio([limit] * len(waves)) for limit in limits]


def _result(
    model: Model, contact: RoughContact | HertzContact, waves: Components, passage: Passage
) -> RoughFriction:
    """Collect the results of a passage."""
    ratios, visited = passage.ratios, max(1, contact.count * contact.points)
    low, share, high = contact.shares() if contact.levels else (math.nan,) * 3
    status, message = outcome(contact, ratios, load_balance=model.options.load_balance)
    p_h = model.operating.hertz_pressure
    mean = minimum = maximum = math.nan
    min_film = math.nan if status == "film breakdown" else contact.min_film()
    if status == "predicted":
        fine = interpolated(ratios, 8) if passage.periodic else ratios
        mean, minimum, maximum = (float(v) for v in (ratios.mean(), fine.min(), fine.max()))
    return RoughFriction(
        status=status,
        message=message,
        mu_ratio=mean,
        mu_ratio_min=minimum,
        mu_ratio_max=maximum,
        position_error=passage.undecided,
        shifts=tuple(passage.shifts[model.order.index(k)] for k in range(len(waves))),
        passage=ratios,
        mu_smooth=contact.mu_smooth(),
        film_min=min_film * model.operating.film_scale,
        increase_rms=contact.increase_rms() * p_h,
        increase_max=contact.max_increase * p_h,
        pressure_max=contact.max_pressure * p_h,
        below_limit=float(share),
        below_limit_error=0.5 * float(high - low),
        cavitated_share=contact.cavitated / visited,
        cavitated_friction=contact.cavitated_bound(minimum) if status == "predicted" else math.nan,
        load_error=contact.imbalance,
        ended=contact.ended / visited,
        responses=tuple(model.responses(waves)),
    )
