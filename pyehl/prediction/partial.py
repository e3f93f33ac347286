# SPDX-License-Identifier: BSD-3-Clause
"""Partial film: where the deformed roughness would come nearer than the layer on the surfaces.

The film of the response, at one position of the tile after another, must not be thinner than the
layer (``lubricant.boundary_film``; under pressure it is compressed as the lubricant is). A pressure
p_c of contact lifts it. It bends the surfaces as if the roughness r were r - p_c/K there, K being
the stiffness of the half-space, and the fluid flattens that as it does any roughness. So the loss
of film falls by T p_c/K and the pressure rises by T p_c, T by the response for waves that move with
the lubricant as the films of touching nodes do. For waves as long as the contact T is near zero:
what contact carries there the fluid no longer does, and the mean film remains that of the inlet.

It is thicker where contact would otherwise carry more than the load, and by what the layer gives. A
column of lubricant that a peak has passed has the film of the layer at least. So the layer gives
each the most that it has lacked on the way through the contact, on which peaks that slip pass it
one after the other, and all films are thicker by the mean s of that:

    s = < max(0, h_b - h_least - s) >,   h_least the least film of the column on its way.

Compared with the full simulation in docs/evidence/partial.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import scipy

from pyehl.prediction.by_response import Parts, RoughPassage
from pyehl.prediction.heated import HeatOf, mean_heat
from pyehl.prediction.obstacle import Compliance, lifted
from pyehl.prediction.second_order import film_left, loss_at
from pyehl.prediction.smooth import circle_of, zone_of
from pyehl.prediction.spectrum import Spectrum
from pyehl.prediction.transfer import Transfer
from pyehl.prediction.wavy_contact import missing, slipped
from pyehl.surfaces import Topography
from pyehl.theory.heat import Heat
from pyehl.theory.transport import stiffness
from pyehl.types import Array, Indices, Mask, Settings

HOLD = 0.01
"""Bodies touch where the film exceeds the layer by less than this share, as in the solver."""
POSITIONS = 16
"""Positions of the tile over its passage."""
HEATED = 4
"""Of these, in which the temperature is computed."""
# Film [a^2/R] outside of the contact, where nothing is to make heat
OPEN = 1.0
# Error of the film at which bodies touch, of the rms height of the deformed surface
# (docs/evidence/partial)
FILM = 0.45
# Of waves that the fluid flattens nearly whole, as much is taken to be left: half and twice of it
# change no digit of the contact in docs/howto/mixed.md
LEAST_LEFT = 0.02
# Error of the film that the layer gives, over the layer
GIVEN_TO = 1e-4
# Length of the periodic box of pressures over that of the contact
BOX = 1.25
# Points of the shortest waves, the share of the variance that shorter ones may have, and the
# fewest and most points per shorter semi-axis
POINTS_OF_WAVE, SHORTER, POINTS = 8, 1e-3, (60.0, 128.0)

UNRESOLVED = "waves are too short for the points of the prediction"
UNSOLVED = "the contact of the prediction is not solved"


@dataclass(frozen=True, slots=True)
class Partial:
    """A partial film over the passage of a tile: means, but of the film, and errors; NaN: none."""

    load_share: float  # share of the load where bodies touch [-]
    load_share_error: float
    area_share: float  # their area there over that of the dry contact [-]
    area_share_error: float
    film_min: float  # least film [m]
    film_min_error: float
    # Friction over that of the smooth contact [-], and coefficient of the latter, both with the
    # layer; NaN where bodies touch and its friction is not known
    friction: float
    friction_error: float
    mu_smooth: float
    shift: Array  # (n,) how far the tile has moved [m]
    passage: Array  # (n,) friction there
    note: str  # why an error or all numbers are not there; ''
    lost: bool = False  # whether bodies touch, and no number of that is known
    heat: Heat | None = None  # what the heat makes of friction where bodies touch

    @property
    def touches(self) -> bool:
        """Whether bodies touch."""
        return self.load_share > 0.0

    def unknown(self, note: str) -> Partial:
        """Give the same where its numbers are not known, and why: none where bodies may touch."""
        if self.load_share == 0.0 == self.load_share_error:
            return self
        return replace(without(note), mu_smooth=self.mu_smooth, lost=self.lost or self.touches)

    @property
    def lacks_friction(self) -> bool:
        """Whether bodies touch and the friction there is not known."""
        return self.touches and not math.isfinite(self.friction)


def without(note: str) -> Partial:
    """Nothing, and why."""
    n, nothing = math.nan, np.zeros(0)
    return Partial(n, n, n, n, n, n, n, n, n, nothing, nothing, note)


def partial_film(
    passage: RoughPassage, parts: Parts, layer: float, friction: float, settings: Settings
) -> Partial:
    """Find the partial film over a passage of a tile, with a layer [m], of a resolved case.

    Its errors are by a film that is thicker and thinner by its error.

    `friction`: coefficient of friction of the layer [-]; 0: not known.
    """
    grid, spectrum, transfer, _ = parts
    o = passage.operating
    left = np.abs(transfer.at_centre(spectrum, passage.velocity_ratio))
    power = spectrum.power * np.square(left)
    points = POINTS_OF_WAVE / _shortest(spectrum, power)
    contact = _Contact(passage, parts, min(max(points, POINTS[0]), POINTS[1]), layer, friction)
    # what the smooth film may be off, where that is more: bodies touch where it is least
    of_smooth = np.nan_to_num(passage.contact.minimum_film_error)
    margin = max(FILM * math.sqrt(float(power.sum())), float(of_smooth))
    levels = [_Level(film) for film in (0.0, margin, -margin)]
    steps = np.arange(POSITIONS) * (grid.shape[0] // POSITIONS)
    with np.errstate(over="ignore", invalid="ignore"):
        if not all(contact.add(int(step), levels) for step in steps):
            return without(UNSOLVED)
        smooth = contact.smooth_friction()
        heat = contact.heat(steps[:: POSITIONS // HEATED], settings)
    known = points <= 2.0 * POINTS[1]

    def told(values: list[list[float]]) -> tuple[float, float]:
        """Mean at the film itself, and its error by the others and by the positions."""
        mean, *others = (float(np.mean(part)) for part in values)
        error = max(abs(other - mean) for other in others) + abs(np.mean(values[0][::2]) - mean)
        return mean, float(error)

    load, area = told([level.load for level in levels]), told([level.area for level in levels])
    ratio = told([[value / smooth for value in level.stress] for level in levels])
    least = [level.least * o.film_scale for level in levels]
    found = Partial(
        *load,
        *area,
        least[0],
        # bodies touch to HOLD
        max(HOLD * least[0], *(abs(film - least[0]) for film in least[1:])),
        *ratio,
        contact.coefficient(smooth),
        np.asarray(steps * grid.pixel[0], dtype=float),
        np.array(levels[0].stress) / smooth,
        "",
        heat=heat,
    )
    return found if known else found.unknown(UNRESOLVED)


def _shortest(spectrum: Spectrum, power: Array) -> float:
    """Wavelength [a] below which waves have hardly any of a power."""
    order = np.argsort(spectrum.q, axis=None)[::-1]
    beyond = np.cumsum(power.ravel()[order]) > SHORTER * power.sum()
    return 2.0 * math.pi / float(spectrum.q.ravel()[order[int(np.argmax(beyond))]])


class _Level:
    """What the positions have where all films are thicker by a length [a^2/R]."""

    def __init__(self, thicker: float) -> None:
        self.thicker, self.least = thicker, math.inf
        self.load: list[float] = []
        self.area: list[float] = []
        self.stress: list[float] = []


class _Contact:
    """The points of a contact with a layer, so many per shorter semi-axis."""

    def __init__(
        self, passage: RoughPassage, parts: Parts, points: float, layer: float, friction: float
    ) -> None:
        grid, spectrum, transfer, edge = parts
        self.passage, o = passage, passage.operating
        self.stride = passage.stride_of(spectrum, points)
        self.rough = passage.on_points(spectrum, transfer, edge, self.stride)
        self.layer = layer / o.film_scale
        # of the stress of the layer over its pressure, as `ShearedContact.stress` has stresses
        unit = 1.0 if self.rough.thins else passage.lubricant.viscosity * o.sliding_speed
        known = friction > 0.0 and o.sliding_speed > 0.0
        self.rubbing = friction * o.hertz_pressure / unit if known else math.nan
        # films that were scaled to the extrapolated central film lack something at the sides
        self.film = self.rough.film + missing(passage.contact, self.rough.film, self.rough.lowest)
        self.way = self._way()
        self.load = float(self.rough.pressure.sum(where=self.rough.inside))
        self.whole_load = o.load / (o.hertz_pressure * self.rough.area)
        self._bend(self._around(grid))
        # pressure, film and where bodies touch at each position, of the film itself
        self.found: dict[int, tuple[Array, Array, Mask]] = {}

    def _way(self) -> Indices:
        """Points by which peaks have slipped past a column since the inlet (m, n)."""
        rough = self.rough
        ratio = self.passage.velocity_ratio
        way = slipped(rough.x[:, np.newaxis], rough.across, ratio, bent=True)
        return np.rint(way / (self.stride * rough.pixel[0])).astype(int)

    def _given(self, lack: Array) -> float:
        """Film that the layer gives [a^2/R], by what each point lacks of the layer (m, n)."""
        most = lack.copy()
        direction = 1 if self.passage.velocity_ratio > 1.0 else -1
        for step in range(1, int(np.abs(self.way).max()) + 1):
            # peaks that are faster than the lubricant are ahead of where they met it
            met = np.full_like(lack, -np.inf)
            ahead, here = slice(step, None), slice(None, -step)
            met[here if direction > 0 else ahead] = lack[ahead if direction > 0 else here]
            passed = np.abs(self.way) >= step
            most[passed] = np.maximum(most, met)[passed]
        of_all = most[self.rough.inside]
        low, high = 0.0, max(0.0, float(of_all.max()))
        while high - low > GIVEN_TO * self.layer:
            middle = 0.5 * (low + high)
            enough = float(np.maximum(of_all - middle, 0.0).mean()) <= middle
            low, high = (low, middle) if enough else (middle, high)
        return high

    def _around(self, grid: Topography) -> Spectrum:
        """Roughness on a box around the contact."""
        rough, o = self.rough, self.passage.operating
        box = [scipy.fft.next_fast_len(math.ceil(BOX * n), real=True) for n in rough.film.shape]
        firsts = rough.rows[0], rough.columns[0]
        rows, columns = (
            (first + self.stride * np.arange(n)) % size
            for first, n, size in zip(firsts, box, grid.shape, strict=True)
        )
        lengths = [n * self.stride * p for n, p in zip(box, rough.pixel, strict=True)]
        heights = grid.heights[np.ix_(rows, columns)] / o.film_scale
        return Spectrum.of(heights, lengths[0], lengths[1])

    def _bend(self, around: Spectrum) -> None:
        """Find what pressures of contact make of film and pressure."""
        passage, o, lubricant = self.passage, self.passage.operating, self.passage.lubricant
        transfer = Transfer.of(
            around,
            zone_of(passage.contact, o, lubricant),
            circle_of(passage.contact, o, lubricant),
            1.0,
            at_amplitude=lubricant.shear.weighs_flow,
            mesh=passage.mesh,
        )
        left = np.maximum(np.abs(transfer.at_centre(around, 1.0)), LEAST_LEFT)
        left[0, 0] = 0.0
        k = transfer.stiffening * stiffness(around.q)
        k[0, 0] = math.inf
        self.lifting = Compliance(left / k, around.shape)
        self.raising = Compliance(left, around.shape)

    def _floor(self, pressure: Array) -> Array:
        """Film of the layer under pressures [p_h]."""
        p = np.maximum(pressure, 0.0) * self.passage.operating.hertz_pressure
        return self.layer / self.passage.lubricant.density_ratio(p)

    def add(self, shift: int, levels: list[_Level]) -> bool:
        """Add what a position has to levels; False: it is not solved."""
        rough, held = self.rough, None
        change = rough.change(shift).astype(float)
        linear = rough.pressure + change[..., 1]
        floor = self._floor(linear)
        borne = self.film * loss_at(floor / self.film)
        for level in levels:
            loss = change[..., 0] - level.thicker
            loss -= self._given(floor - self.film * film_left(loss / self.film))
            gap = np.where(rough.inside, borne - loss, np.inf)
            held = lifted(gap, self.lifting, self.layer, self.load, held)
            if held is None:
                return False
            film = np.maximum(self.film * film_left((loss - held.lift) / self.film), floor)
            pressure = np.maximum(linear + self.raising(held.pressure), 0.0)
            touching = self._touching(pressure, film, floor)
            self.found.setdefault(shift, (pressure, film, touching))
            carried = float(pressure.sum(where=rough.inside))
            level.load.append(float(pressure.sum(where=touching)) / carried)
            level.area.append(np.count_nonzero(touching) / rough.points)
            level.stress.append(self._stress(pressure, film, touching))
            level.least = min(level.least, float(film.min(where=rough.inside, initial=math.inf)))
        return True

    def _touching(self, pressure: Array, film: Array, floor: Array) -> Mask:
        return self.rough.inside & (film <= (1.0 + HOLD) * floor) & (pressure > 0.0)

    def _stress(self, pressure: Array, film: Array, touching: Mask) -> float:
        """Sum of the shear stress; NaN where that of the layer is not known.

        The layer rubs by its share of the load, whatever the points of friction carry.
        """
        stress, inside = self.rough.stress(pressure, film), self.rough.inside
        flowing = float(stress.sum(where=inside & ~touching))
        if not touching.any():
            return flowing
        share = float(pressure.sum(where=touching) / pressure.sum(where=inside))
        return flowing + self.rubbing * self.whole_load * share

    def heat(self, steps: Indices, settings: Settings) -> Heat | None:
        """Heat of sliding at some positions: of friction a mean, of the rises the greatest.

        None where bodies do not touch, or the friction of the layer is not known.
        """
        if not any(touching.any() for _, _, touching in self.found.values()):
            return None
        if not math.isfinite(self.rubbing):
            return None
        heat_of = HeatOf(settings, self.passage.lubricant, self.rough.x, self.rough.y)
        found = [self.found[int(step)] for step in steps]
        inside = self.rough.inside
        # what is outside of the points of friction makes no heat
        return mean_heat(
            [heat_of(np.where(inside, p, 0.0), np.where(inside, h, OPEN), t) for p, h, t in found],
            [self._stress(*state) for state in found],
        )

    def smooth_friction(self) -> float:
        """Sum of the shear stress of the smooth contact."""
        pressure = self.rough.pressure
        floor = self._floor(pressure)
        film = np.maximum(self.film, floor)
        touching = self._touching(pressure, film, floor)
        return self._stress(pressure, film, touching)

    def coefficient(self, stress: float) -> float:
        """Coefficient of friction of a sum of shear stress [-]."""
        o = self.passage.operating
        newtonian = self.passage.lubricant.viscosity * o.sliding_speed
        found = stress * self.rough.area / o.load
        return found if self.rough.thins else found * newtonian
