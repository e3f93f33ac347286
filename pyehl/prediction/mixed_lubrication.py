# SPDX-License-Identifier: BSD-3-Clause
"""Solid contact where the predicted film would be thinner than the boundary film.

The film predicted by the response must not, at any position of the tile, be thinner than the
boundary film (``lubricant.boundary_film``; it is as compressible as the lubricant). A
contact pressure p_c increases the film. It deforms the surfaces as if the roughness r were r -
p_c/K, K being the stiffness of the half-space, and the fluid flattens this difference like any
roughness. So the loss of film decreases by T p_c/K and the pressure increases by T p_c, where T
is the response to waves that move with the lubricant, as the films of nodes in contact do. For
waves as long as the contact T is near zero: solid contact then relieves the fluid of load, and the
mean film remains that of the inlet.

The mean film is thicker if contact would otherwise sustain more than the load, and because of the
mass defect of the boundary film. A column of lubricant that a peak has passed has at least the
thickness of the boundary film. So its mass defect is the largest deficit during its passage, in
which sliding peaks pass it one after the other, and all films are thicker by the mean s of the mass
defects:

    s = < max(0, h_b - h_min - s) >,   h_min the minimum film of the column during its passage.

Without roughness this differs from the solution of the smooth contact, in which the boundary film
reduces the film from the inlet. The uniform change of film with which this model has the load share
of that solution is the error of the films, and the reference of the friction is the smooth contact
with this change. docs/evidence/partial compares the model with the full simulation.

:func:`mixed_film` returns means over the passage of a tile, their errors, and the reason if one is
missing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
import scipy

from pyehl.contact.heat import HeatOf, mean_heat
from pyehl.contact.smooth import SmoothContact
from pyehl.prediction.friction import MixedFilm
from pyehl.prediction.model import FILM_ELLIPTICITY, Components, Model
from pyehl.prediction.moving_tile import slipped
from pyehl.prediction.response import film_left, loss_at
from pyehl.prediction.rough_contact import RoughContact, missing
from pyehl.prediction.spectrum import Spectrum
from pyehl.surfaces import Topography
from pyehl.theory.elastic_contact import Compliance, SolidContact, contact_pressures
from pyehl.theory.heat import Heat
from pyehl.theory.transport import stiffness
from pyehl.types import Array, Indices, Mask, Settings

HOLD = 0.01
"""Bodies touch where the film exceeds the boundary film by less than this fraction, as in the
solver (``fortran/reynolds/boundary_film.f90``)."""
OPEN = 1.0
"""Film outside of the contact [a^2/R]; any value serves, since there is no heat without
pressure."""
MIN_LEFT = 0.02
"""Minimum amplitude ratio of waves, some of which the fluid flattens nearly completely: half and
twice this value change no digit of the contact in docs/howto/mixed.md."""
DEFECT_TOLERANCE = 1e-4
"""Error of the film increase by the mass defect, over the boundary film: far below HOLD."""
SHARE, FARTHEST = 1e-3, 1.0
"""Tolerance of the load share of a smooth contact, and the largest change of film over its minimum
film, in the search for the change that gives this share."""
BOX = 1.25
"""Length of the periodic box of pressures over that of the contact: 1.1 and 2 change the load share
in docs/howto/mixed.md by 2 and 4 % of itself, a tenth of its error."""


@dataclass(slots=True)
class Level:
    """Results at all positions with the films increased by a length [a^2/R]."""

    thicker: float
    minimum: float = math.inf  # film [a^2/R]
    # At each position: shares of the load and of the area in solid contact, sum of the shear stress
    load: list[float] = field(default_factory=list)
    area: list[float] = field(default_factory=list)
    stress: list[float] = field(default_factory=list)


class MixedContact:
    """A rough contact with a boundary film [m], on `points` points per shorter semi-axis.

    The heights of its rough surface are on a `grid`; `friction` is that of the boundary film [-],
    0: not known.
    """

    def __init__(
        self,
        model: Model,
        waves: Components,
        grid: Topography,
        points: float,
        boundary: float,
        friction: float,
    ) -> None:
        self.model, o = model, model.operating
        (wave,) = waves
        self.velocity_ratio = wave.velocity_ratio
        self.tile = model.pixel_tile(wave, points)
        self.stride = self.tile.stride
        self.rough = RoughContact.on_pixels(model.contact, o, model.lubricant, self.tile)
        self.boundary = boundary / o.film_scale
        # stress of the boundary film over its pressure, in the unit of `ShearedContact.stress`
        unit = 1.0 if self.rough.thins else model.lubricant.viscosity * o.sliding_speed
        known = friction > 0.0 and o.sliding_speed > 0.0
        self.rubbing = friction * o.hertz_pressure / unit if known else math.nan
        # films scaled to the extrapolated central film need a correction at the sides
        self.film = self.rough.film + missing(model.contact, self.rough.film, self.rough.lowest)
        self.slip_path = self._slip_path()
        self.load = float(self.rough.pressure.sum(where=self.rough.inside))
        self.whole_load = o.load / (o.hertz_pressure * self.rough.area)
        self._bend(self._around(grid))
        # pressure, film and nodes in contact at each position, for the films without a change
        self.solutions: dict[int, tuple[Array, Array, Mask]] = {}

    def _slip_path(self) -> Indices:
        """Distance by which peaks have passed a column since the inlet [points] (m, n)."""
        rough = self.rough
        way = slipped(rough.x[:, np.newaxis], rough.across, self.velocity_ratio, bent=True)
        return np.rint(way / (self.stride * self.tile.pixel[0])).astype(int)

    def _mass_defect(self, deficit: Array) -> float:
        """Film increase by the mass defect of the boundary film [a^2/R]; deficit (m, n)."""
        maximum = deficit.copy()
        direction = 1 if self.velocity_ratio > 1.0 else -1
        for step in range(1, int(np.abs(self.slip_path).max()) + 1):
            # peaks that are faster than the lubricant are now ahead of the column that they passed
            met = np.full_like(deficit, -np.inf)
            ahead, here = slice(step, None), slice(None, -step)
            met[here if direction > 0 else ahead] = deficit[ahead if direction > 0 else here]
            passed = np.abs(self.slip_path) >= step
            maximum[passed] = np.maximum(maximum, met)[passed]
        of_all = maximum[self.rough.inside]
        low, high = 0.0, max(0.0, float(of_all.max()))
        while high - low > DEFECT_TOLERANCE * self.boundary:
            middle = 0.5 * (low + high)
            enough = float(np.maximum(of_all - middle, 0.0).mean()) <= middle
            low, high = (low, middle) if enough else (middle, high)
        return high

    def _around(self, grid: Topography) -> Spectrum:
        """Roughness on a box around the contact."""
        rough, tile, o = self.rough, self.tile, self.model.operating
        box = [scipy.fft.next_fast_len(math.ceil(BOX * n), real=True) for n in rough.film.shape]
        if rough.strip:
            # the strip is periodic
            box[1] = rough.film.shape[1]
        firsts = tile.rows[0], tile.columns[0]
        rows, columns = (
            (first + self.stride * np.arange(n)) % size
            for first, n, size in zip(firsts, box, grid.shape, strict=True)
        )
        lengths = [n * self.stride * p for n, p in zip(box, tile.pixel, strict=True)]
        heights = grid.heights[np.ix_(rows, columns)] / o.film_scale
        return Spectrum.of(heights, lengths[0], lengths[1])

    def _bend(self, around: Spectrum) -> None:
        """Find the response of film and pressure to contact pressures."""
        slow = replace(self.model.surfaces[0], velocity_ratio=1.0)
        (transfer,) = replace(self.model, surfaces=(slow,)).transfers([around])
        left = np.maximum(np.abs(transfer.at_centre(around, 1.0)), MIN_LEFT)
        left[0, 0] = 0.0
        k = transfer.stiffening * stiffness(around.q)
        k[0, 0] = math.inf
        self.lifting = Compliance(left / k, around.shape)
        self.raising = Compliance(left, around.shape)

    def _floor(self, pressure: Array) -> Array:
        """Thickness of the boundary film under pressures [p_h]."""
        p = np.maximum(pressure, 0.0) * self.model.operating.hertz_pressure
        return self.boundary / self.model.lubricant.density_ratio(p)

    def add(self, shift: int, levels: list[Level]) -> bool:
        """Add a position to all levels; False: it has no solution."""
        rough, held = self.rough, None
        change = rough.change((shift, 0)).astype(float)
        for level in levels:
            held, (pressure, film, touching) = self._state(change, level.thicker, held)
            if held is None:
                return False
            self.solutions.setdefault(shift, (pressure, film, touching))
            level.load.append(self._share(pressure, touching))
            level.area.append(np.count_nonzero(touching) / rough.points)
            level.stress.append(self._stress(pressure, film, touching))
            level.minimum = min(
                level.minimum, float(film.min(where=rough.inside, initial=math.inf))
            )
        return True

    def _state(
        self, change: Array, thicker: float, held: SolidContact | None
    ) -> tuple[SolidContact | None, tuple[Array, Array, Mask]]:
        """Contact pressure, and pressure, film and nodes in contact (m, n), for changed films.

        `change` (m, n, 2): loss of film and pressure increase; `thicker`: increase of all films;
        `held`: the contact pressure of a similar state, to start from. None: no solution.
        """
        linear = self.rough.pressure + change[..., 1]
        floor = self._floor(linear)
        loss = change[..., 0] - thicker
        loss -= self._mass_defect(floor - self.film * film_left(loss / self.film))
        sustained = self.film * loss_at(floor / self.film)
        gap = np.where(self.rough.inside, sustained - loss, np.inf)
        held = contact_pressures(gap, self.lifting, self.boundary, self.load, held)
        lift, more = (0.0, 0.0) if held is None else (held.lift, self.raising(held.pressure))
        film = np.maximum(self.film * film_left((loss - lift) / self.film), floor)
        pressure = np.maximum(linear + more, 0.0)
        return held, (pressure, film, self._touching(pressure, film, floor))

    def _share(self, pressure: Array, touching: Mask) -> float:
        """Share of the load at the boundary film."""
        whole = float(pressure.sum(where=self.rough.inside))
        return float(pressure.sum(where=touching)) / whole

    def film_off(self, share: float) -> float:
        """Increase of all films [a^2/R] with which the smooth contact has a load share.

        To the tolerance SHARE; NaN if no change up to FARTHEST gives it, or the share is not known.
        """
        farthest = FARTHEST * self.rough.lowest
        low, high, off = -farthest, farthest, 0.0
        while math.isfinite(share) and (result := self._of_smooth(off)) is not None:
            left = self._share(result[0], result[2]) - share
            if abs(left) <= SHARE:
                return off
            if high - low < DEFECT_TOLERANCE * self.boundary:
                return off if -farthest < low < high < farthest else math.nan
            low, high = (off, high) if left > 0.0 else (low, off)
            off = 0.5 * (low + high)
        return math.nan

    def _of_smooth(self, thicker: float) -> tuple[Array, Array, Mask] | None:
        """Pressure, film and nodes in contact without roughness; None: no solution."""
        held, state = self._state(np.zeros((*self.film.shape, 2)), thicker, None)
        return None if held is None else state

    def _touching(self, pressure: Array, film: Array, floor: Array) -> Mask:
        return self.rough.inside & (film <= (1.0 + HOLD) * floor) & (pressure > 0.0)

    def _stress(self, pressure: Array, film: Array, touching: Mask) -> float:
        """Sum of the shear stress, for the boundary film from its load share; NaN: not known."""
        stress, inside = self.rough.stress(pressure, film), self.rough.inside
        flowing = float(stress.sum(where=inside & ~touching))
        if not touching.any():
            return flowing
        return flowing + self.rubbing * self.whole_load * self._share(pressure, touching)

    def heat(self, steps: Indices, settings: Settings) -> Heat | None:
        """Frictional heating at some positions: mean effect on friction, maximum temperature rises.

        None without solid contact, or if the friction of the boundary film is not known.
        """
        touches = any(touching.any() for _, _, touching in self.solutions.values())
        if not (touches and math.isfinite(self.rubbing)):
            return None
        heat_of = HeatOf(settings, self.model.lubricant, self.rough.x, self.rough.y)
        result = [self.solutions[int(step)] for step in steps]
        inside = self.rough.inside
        # heat is generated only at the points of friction
        return mean_heat(
            [heat_of(np.where(inside, p, 0.0), np.where(inside, h, OPEN), t) for p, h, t in result],
            [self._stress(*state) for state in result],
        )

    def smooth_friction(self, off: float) -> float:
        """Sum of the shear stress of the smooth contact, with solid contact for a change of films.

        `off`: result of `film_off`; if it is NaN solid contact follows from the unchanged film. NaN
        if the friction of the boundary film is needed and not known.
        """
        pressure = self.rough.pressure
        film = np.maximum(self.film, self._floor(pressure))
        touching = self._touching(pressure, film, self._floor(pressure))
        if math.isfinite(off) and (state := self._of_smooth(off)) is not None:
            pressure, _, touching = state
        return self._stress(pressure, film, touching)


POSITIONS = 16
"""Positions of the tile over its passage: 32 and 64 change the load share in docs/howto/mixed.md by
0.2 % of itself. The change by using every second one is part of the errors."""
TEMPERATURE_POSITIONS = 4
"""Number of these for the temperature: 8 and 16 change mu of such contacts by 0.03 %."""
TOUCHING_FILM_ERROR = 0.45
"""Error of the film at which solid contact begins, over the rms height of the deformed surface
(docs/evidence/partial)."""
WAVE_POINTS, SHORTER, CONTACT_POINTS = 8, 1e-3, (60.0, 128.0)
"""Points per shortest wave, as many as a grid needs to resolve it; fraction of the variance that
shorter waves may have; minimum and maximum number of points per shorter semi-axis: the minimum is
that without a boundary film, and the time increases with its square."""

# Why contact at a boundary film is not predicted, or its errors are not known
OF_TWO = "contact at a boundary film is predicted for a single rough surface"
OTHER_MODEL = "contact is not predicted with these psd.reduction and psd.smooth"
ELASTIC = "the prediction assumes elastic solids: contact.hardness is ignored"
UNRESOLVED = "waves are too short for the points of the prediction"
UNSOLVED = "the contact of the prediction is not solved"
NO_SMOOTH = "no film has the load share of the smooth contact, by which the error is known"


def mixed_film(
    model: Model, waves: Components, settings: Settings, smooth: SmoothContact
) -> MixedFilm | None:
    """Predict the mixed lubrication of a resolved case; None without a boundary film.

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
    """Predict the mixed lubrication over a passage of one tile, with a boundary film [m].

    Its errors follow from films increased and decreased by their error; they are not known if the
    smooth contact `with_boundary_film` is not known.
    """
    (grid,), (wave,), o = model.grids(), waves, model.operating
    friction = float(settings["lubricant"]["boundary_friction"])
    power = wave.spectrum.power * np.square(np.abs(wave.at_centre()))
    points = WAVE_POINTS / _shortest(wave.spectrum, power)
    within = min(max(points, CONTACT_POINTS[0]), CONTACT_POINTS[1])
    contact = MixedContact(model, waves, grid, within, boundary, friction)
    # or the error of the minimum smooth film if that is larger: there solid contact begins
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
        # solid contact is defined to a relative film HOLD
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
    """Mean for the unchanged film, and its error from the changed films and from the positions."""
    mean, *others = (float(np.mean(part)) for part in values)
    error = max(abs(other - mean) for other in others) + abs(np.mean(values[0][::2]) - mean)
    return mean, float(error)


def _shortest(spectrum: Spectrum, power: Array) -> float:
    """Wavelength [a] below which waves have a fraction SHORTER of a power."""
    order = np.argsort(spectrum.q, axis=None)[::-1]
    beyond = np.cumsum(power.ravel()[order]) > SHORTER * power.sum()
    return 2.0 * math.pi / float(spectrum.q.ravel()[order[int(np.argmax(beyond))]])
