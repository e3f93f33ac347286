# SPDX-License-Identifier: BSD-3-Clause
"""Partial film: means over the passage of a tile, their errors, and reasons of missing values.

Each position is solved by :mod:`pyehl.prediction.mixed_contact`. Compared with the full simulation
in docs/evidence/partial.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from pyehl.contact.smooth import SmoothContact
from pyehl.prediction.friction import Outcome, RoughFriction, broken, unknown
from pyehl.prediction.mixed_contact import HOLD, Level, MixedContact
from pyehl.prediction.model import FILM_ELLIPTICITY, Components, Model
from pyehl.prediction.spectrum import Spectrum
from pyehl.surfaces import interpolated
from pyehl.theory.heat import Heat
from pyehl.types import Array, Settings

POSITIONS = 16
"""Positions of the tile over its passage: 32 and 64 change the load share in docs/howto/mixed.md by
0.2 % of itself. The change by every second one is part of the errors."""
TEMPERATURE_POSITIONS = 4
"""Of these, in which the temperature is computed: 8 and 16 change mu of such contacts by 0.03 %."""
TOUCHING_FILM_ERROR = 0.45
"""Error of the film at which bodies touch, of the rms height of the deformed surface
(docs/evidence/partial)."""
WAVE_POINTS, SHORTER, CONTACT_POINTS = 8, 1e-3, (60.0, 128.0)
"""Points of the shortest waves, as many as a grid needs to resolve them; the share of the variance
that shorter ones may have; the fewest points per shorter semi-axis, as without a boundary film, and
the most: the time grows with their square."""

# Why contact at a boundary film is not predicted, or its errors are not known
OF_TWO = "contact at a boundary film is predicted of one rough surface"
OTHER_MODEL = "psd.reduction and psd.smooth are not those that contact is predicted with"
ELASTIC = "the prediction is of elastic solids: contact.hardness is left out"
UNRESOLVED = "waves are too short for the points of the prediction"
UNSOLVED = "the contact of the prediction is not solved"
NO_SMOOTH = "no film has the load share of the smooth contact, by which the error is known"
BETWEEN = "the film ends between the positions at which contact is looked for"
NO_FRICTION = (
    "the bodies touch, and the friction there is not known: lubricant.boundary_friction and "
    "sliding are needed"
)


@dataclass(frozen=True, slots=True)
class MixedFilm:
    """A partial film over the passage of a tile: means, but of the film, and errors; NaN: none."""

    note: str = ""  # why an error or all numbers are missing
    load_share: float = math.nan  # share of the load where bodies touch [-]
    load_share_error: float = math.nan
    area_share: float = math.nan  # their area there over that of the dry contact [-]
    area_share_error: float = math.nan
    film_min: float = math.nan  # minimum film [m]
    film_min_error: float = math.nan
    # Friction over that of the smooth contact [-], and coefficient of the latter, both with the
    # boundary film; NaN where bodies touch and its friction is not known
    friction: float = math.nan
    friction_error: float = math.nan
    mu_smooth: float = math.nan
    shift: Array = field(default_factory=lambda: np.zeros(0))  # of the tile (n,) [m]
    passage: Array = field(default_factory=lambda: np.zeros(0))  # (n,) friction there
    lost: bool = False  # whether bodies touch, and no result of that is known
    heat: Heat | None = None  # effect of the heat on friction where bodies touch

    @property
    def touches(self) -> bool:
        """Whether bodies touch."""
        return self.load_share > 0.0

    @property
    def friction_unknown(self) -> bool:
        """Whether bodies touch and the friction there is not known."""
        return self.touches and not math.isfinite(self.friction)

    def unknown(self, note: str) -> MixedFilm:
        """Remove its numbers for a reason: all where bodies may touch."""
        if self.load_share == 0.0 == self.load_share_error:
            return self
        return MixedFilm(note, mu_smooth=self.mu_smooth, lost=self.lost or self.touches)

    def without_errors(self, note: str) -> MixedFilm:
        """Remove its errors for a reason."""
        errors = ("load_share_error", "area_share_error", "film_min_error", "friction_error")
        return replace(self, note=self.note or note, **unknown(*errors))


def mixed_film(
    model: Model, waves: Components, settings: Settings, smooth: SmoothContact
) -> MixedFilm | None:
    """Find the partial film of a resolved case under a model; None without a boundary film.

    `smooth`: the smooth contact with its boundary film.
    """
    boundary = float(settings["lubricant"]["boundary_film"])
    if not boundary > 0.0:
        return None
    if len(model.surfaces) > 1:
        return MixedFilm(OF_TWO)
    if not model.options.measured:
        return MixedFilm(OTHER_MODEL)
    result = partial_film(model, waves, boundary, settings, smooth)
    if beyond := model.outside_range(FILM_ELLIPTICITY):
        result = result.unknown(f"outside the range of the response by {', '.join(beyond)}")
    if settings["contact"].get("hardness", 0.0) > 0.0:
        result = result.without_errors(ELASTIC)
    return result


def partial_film(
    model: Model,
    waves: Components,
    boundary: float,
    settings: Settings,
    with_boundary_film: SmoothContact,
) -> MixedFilm:
    """Find the partial film over a passage of one tile, with a boundary film [m].

    Its errors are by a film that is thicker and thinner by its error; none where the smooth contact
    `with_boundary_film` is not known.
    """
    (grid,), (wave,), o = model.grids(), waves, model.operating
    friction = float(settings["lubricant"]["boundary_friction"])
    power = wave.spectrum.power * np.square(np.abs(wave.at_centre()))
    points = WAVE_POINTS / _shortest(wave.spectrum, power)
    within = min(max(points, CONTACT_POINTS[0]), CONTACT_POINTS[1])
    contact = MixedContact(model, waves, grid, within, boundary, friction)
    # the error of the smooth film, where that is more: bodies touch at its minimum
    of_smooth = np.nan_to_num(model.contact.minimum_film_error)
    margin = max(TOUCHING_FILM_ERROR * math.sqrt(float(power.sum())), float(of_smooth))
    off = (
        contact.film_off(with_boundary_film.load_share)
        if with_boundary_film is not model.contact
        else 0.0
    )
    margin = max(margin, abs(off)) if math.isfinite(off) else margin
    levels = [Level(film) for film in (0.0, margin, -margin)]
    steps = np.arange(POSITIONS) * (grid.shape[0] // POSITIONS)
    with np.errstate(over="ignore", invalid="ignore"):
        if not all(contact.add(int(step), levels) for step in steps):
            return MixedFilm(UNSOLVED)
        smooth = contact.smooth_friction(off)
        heat = contact.heat(steps[:: POSITIONS // TEMPERATURE_POSITIONS], settings)
    load, load_error = _mean([level.load for level in levels])
    area, area_error = _mean([level.area for level in levels])
    ratio, ratio_error = _mean([[value / smooth for value in level.stress] for level in levels])
    minimum = [level.minimum * o.film_scale for level in levels]
    result = MixedFilm(
        load_share=load,
        load_share_error=load_error,
        area_share=area,
        area_share_error=area_error,
        film_min=minimum[0],
        # bodies touch to HOLD
        film_min_error=max(HOLD * minimum[0], *(abs(film - minimum[0]) for film in minimum[1:])),
        friction=ratio,
        friction_error=ratio_error,
        mu_smooth=contact.rough.coefficient(smooth),
        shift=np.asarray(steps * grid.pixel[0], dtype=float),
        passage=np.array(levels[0].stress) / smooth,
        heat=heat,
    )
    if points > 2.0 * CONTACT_POINTS[1]:
        return result.unknown(UNRESOLVED)
    return result if math.isfinite(off) else result.without_errors(NO_SMOOTH)


def _mean(values: list[list[float]]) -> tuple[float, float]:
    """Mean at the film itself, and its error by the other films and by the positions."""
    mean, *others = (float(np.mean(part)) for part in values)
    error = max(abs(other - mean) for other in others) + abs(np.mean(values[0][::2]) - mean)
    return mean, float(error)


def _shortest(spectrum: Spectrum, power: Array) -> float:
    """Wavelength [a] below which waves have hardly any of a power."""
    order = np.argsort(spectrum.q, axis=None)[::-1]
    beyond = np.cumsum(power.ravel()[order]) > SHORTER * power.sum()
    return 2.0 * math.pi / float(spectrum.q.ravel()[order[int(np.argmax(beyond))]])


def with_contact(result: Outcome, mixed: MixedFilm) -> tuple[Outcome, MixedFilm]:
    """Friction where bodies touch, from that of a full film, and known parts of the partial film.

    A prediction without contact, or whose contact is not known, stays as it is.
    """
    friction = result.friction
    if friction.status == "film breakdown" and not mixed.touches:
        # contact is not known where the film ends, and none was found there
        mixed = replace(mixed if mixed.note else MixedFilm(BETWEEN), mu_smooth=mixed.mu_smooth)
        mixed = replace(mixed, lost=True)
    if mixed.lost:
        return Outcome(_lost(friction, mixed), bands=result.bands), mixed
    if not mixed.touches:
        return result, mixed
    fine = interpolated(mixed.passage, 8)
    known = math.isfinite(mixed.friction)
    if friction.status != "predicted":
        # a full film that breaks down has no pressures
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
    """Remove the friction of a full film where bodies touch to an unknown extent."""
    message = f"the bodies touch at the boundary film, and nothing of that is known: {mixed.note}"
    if friction.status != "predicted":
        message = f"{friction.message}; {message}"
    status = "film breakdown" if friction.status == "predicted" else friction.status
    smooth = mixed.mu_smooth if math.isfinite(mixed.mu_smooth) else friction.mu_smooth
    none = broken(friction, math.nan)
    return replace(none, status=status, message=message, mu_smooth=smooth)


def contact_numbers(mixed: MixedFilm | None, boundary: float, *, known: bool) -> dict[str, Any]:
    """Give the numbers of a summary on contact with a boundary film [a^2/R]; nothing without one.

    `known`: whether the case lies in the range that the response was measured in.
    """
    if mixed is None:
        return {}
    film = {"h_min_rough_error_m": mixed.film_min_error if known else math.nan}
    return {
        **(film if mixed.touches else {}),
        "boundary_film": boundary,
        "contact_load_share": mixed.load_share,
        "contact_load_share_error": mixed.load_share_error,
        "contact_load_share_error_note": mixed.note,
        "contact_area_share": mixed.area_share,
        "contact_area_share_error": mixed.area_share_error,
    }
