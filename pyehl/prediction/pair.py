# SPDX-License-Identifier: BSD-3-Clause
"""Friction of two rough surfaces that pass a contact at speeds of their own.

To first order each surface is deformed as if the other one were smooth, at its own velocity ratio;
film and pressure of both add up. Of second order are products of waves of both
(:mod:`pyehl.prediction.second_order`), and the waves leak as those of the amplitude of both. The
result does not depend on which of the two is the first.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from pyehl.prediction.bands import Band, joining
from pyehl.prediction.by_response import RoughPassage
from pyehl.prediction.carrying import known_by_cut_off
from pyehl.prediction.contact import Response
from pyehl.prediction.deformed import film_levels
from pyehl.prediction.edge import Edge
from pyehl.prediction.errors import model_error
from pyehl.prediction.friction import (
    BEYOND,
    LARGEST_RATIO,
    RoughFriction,
    SecondPassage,
    outcome,
    passed,
)
from pyehl.prediction.meeting import Meeting, as_one
from pyehl.prediction.pair_contact import PairContact, PairParts
from pyehl.prediction.passage import longer_waves, working_grid
from pyehl.prediction.smooth import circle_of, zone_of
from pyehl.prediction.spectrum import Spectrum
from pyehl.prediction.transfer import Transfer
from pyehl.surfaces import Topography, filtered, track_offsets
from pyehl.types import Array

PairWaves = list[tuple[Spectrum, Transfer]]


@dataclass(frozen=True)
class RoughPair:
    """Two rough tiles in a contact; each with what it would be alone."""

    of: tuple[RoughPassage, RoughPassage]
    fronts: tuple[float, float]  # where the tiles begin at the same time, along the motion [a]
    filters: tuple[str, str] = ("sharp", "sharp")  # how their spectra are cut

    @cached_property
    def order(self) -> tuple[int, int]:
        """Order in which the two are summed, by their numbers.

        The faster one first, else by where it begins, size and heights.
        """

        def key(k: int) -> tuple[float, ...] | tuple[object, ...]:
            tile = self.of[k].topography
            heights = np.ascontiguousarray(tile.heights).tobytes()
            return (-self.of[k].velocity_ratio, self.fronts[k], *tile.size, *tile.shape, heights)

        first = min((0, 1), key=key)
        return first, 1 - first

    @cached_property
    def meeting(self) -> Meeting:
        """The positions in which they meet, in their order."""
        a, (i, j) = self.of[0].operating.hertz_radius, self.order
        first, second = self.of[i], self.of[j]
        return Meeting(
            (first.topography.length_x / a, second.topography.length_x / a),
            (first.velocity_ratio, second.velocity_ratio),
            (self.fronts[i], self.fronts[j]),
        )

    def parts(self) -> PairParts:
        """Components of both tiles on the grids that are worked on, and what becomes of them.

        In their order.
        """
        tiles = [working_grid(part.topography, part.operating, 0) for part in self.of]
        ratios = [self.of[k].velocity_ratio for k in self.order]
        shape = self.of[0].operating.ellipse
        return [
            (spectrum, transfer, Edge.of(spectrum, transfer, ratio, shape))
            for (spectrum, transfer), ratio in zip(self._waves(tiles), ratios, strict=True)
        ]

    def _waves(self, tiles: Sequence[Topography]) -> PairWaves:
        """Components of tiles in place of the two, and what the contact makes of them.

        In the order in which the two are summed.
        """
        one = self.of[0]
        passages = [self.of[k] for k in self.order]
        spectra = [one.spectrum(tiles[k]) for k in self.order]
        moving = [(s, p.velocity_ratio) for s, p in zip(spectra, passages, strict=True)]
        if one.options.reduction == "response":
            o = one.operating
            transfers = Transfer.of_all(
                moving,
                zone_of(one.contact, o, one.lubricant),
                circle_of(one.contact, o, one.lubricant),
                at_amplitude=one.lubricant.shear.weighs_flow,
                mesh=one.mesh,
            )
        else:
            transfers = [one.transfer(spectrum) for spectrum in spectra]
        return list(zip(spectra, transfers, strict=True))

    def _moving(self, parts: PairParts) -> list[tuple[Spectrum, Transfer, float]]:
        return [
            (p[0], p[1], self.of[k].velocity_ratio) for p, k in zip(parts, self.order, strict=True)
        ]

    def _contact(
        self,
        parts: PairParts,
        powers: Sequence[Array] | None = None,
        tracks: tuple[float, float] = (0.0, 0.0),
    ) -> PairContact:
        """Contact of parts; `powers` of the components as the transfers were made for them.

        `tracks`: how far both are moved across the motion [a].
        """
        one, ratios = self.of[0], [self.of[k].velocity_ratio for k in self.order]
        of = one.contact, one.operating, one.lubricant
        return PairContact(*of, parts, ratios, powers=powers, tracks=tracks)

    def responses(self, parts: PairParts | None = None) -> list[Response]:
        """Pressure [Pa] and deformed roughness [m] of each at the centre, on its pixels.

        By the `parts` that were worked with, if they have these pixels.
        """
        tiles = [one.topography for one in self.of]
        shapes = [tiles[k].shape for k in self.order]
        if parts is None or [spectrum.shape for spectrum, _, _ in parts] != shapes:
            waves = self._waves(tiles)
        else:
            waves = [(spectrum, transfer) for spectrum, transfer, _ in parts]
        return [self.of[k].response(*waves[self.order.index(k)]) for k in (0, 1)]

    @cached_property
    def as_one(self) -> RoughPassage | None:
        """Both as one surface where they move together; None where they do not."""
        first, second = (self.of[k] for k in self.order)
        if first.velocity_ratio != second.velocity_ratio:
            return None
        way = self.fronts[self.order[1]] - self.fronts[self.order[0]]
        both = as_one(first.topography, second.topography, way * first.operating.hertz_radius)
        groups = self.of[0].groups + self.of[1].groups
        return None if both is None else replace(first, topography=both, groups=groups)

    def mean(self) -> float:
        """mu_r/mu_s over a few positions [-]; NaN where the film ends."""
        one = self.as_one
        if one is not None:
            return one.mean()
        with np.errstate(over="ignore", invalid="ignore"):
            return self.meeting.short_mean(self._contact(self.parts()).friction)

    def known(self) -> bool:
        """Whether the error of the ratio is."""
        return math.isfinite(model_error(self.mean()))

    def run(
        self, tracks: int = 8, *, brief: bool = False, parts: PairParts | None = None
    ) -> tuple[RoughFriction, tuple[float, float], list[Band]]:
        """Friction over all positions, mean and spread over tracks, and what each band adds.

        The bands are those of the wavelengths of both. `brief`, `parts` and no tracks: as of
        :meth:`RoughPassage.run`. The response of the result is that of the first surface.
        """
        one, meeting = self.of[0], self.meeting
        together = self.as_one
        if together is not None:
            alone, spread, bands = together.run(tracks, brief=brief)
            responses = self.responses()
            second = SecondPassage(responses[1], alone.shift, 0.0)
            return replace(alone, response=responses[0], second=second), spread, bands
        parts = parts or self.parts()
        with np.errstate(over="ignore", invalid="ignore"):
            contact = self._contact(parts)
            left = [(s.power, np.abs(t.at_centre(s, ratio))) for s, t, ratio in self._moving(parts)]
            limit = one.options.film_limit / one.operating.film_scale
            ratios = [p.velocity_ratio for p in self.of]
            contact.watch(film_levels(limit, left, ratios))
            places = meeting.mean(contact.friction, one.options.positions, LARGEST_RATIO)
            found = self._result(contact, parts, places, brief)
            if found.status != "predicted":
                return found, (math.nan, math.nan), []
            ratios = [
                meeting.short_mean(self._contact(parts, tracks=pair).friction)
                if any(pair)
                else found.mu_ratio
                for pair in self._tracks(tracks)
            ]
            bands = self._bands(parts, found.mu_ratio, brief)
        # sorted: the same for either order of the tracks
        over = np.sort(ratios) if tracks else np.array([math.nan])
        return found, (float(over.mean()), float(over.std())), bands

    def _tracks(self, tracks: int) -> list[tuple[float, float]]:
        """Pairs of tracks [a]: equally spaced on both, in opposite order."""
        a = self.of[0].operating.hertz_radius
        one, other = (
            [offset / a for offset in track_offsets(self.of[k].topography, tracks)]
            for k in self.order
        )
        return [(one[k], other[-k % tracks]) for k in range(tracks)]

    def run_and_below(self, *shortest: float) -> tuple[RoughFriction, list[float]]:
        """Friction in brief, and mu_r/mu_s without waves of either shorter than some lengths [a].

        As of :meth:`RoughPassage.run_and_below`.
        """
        one = self.as_one
        if one is not None:
            return one.run_and_below(*shortest)
        parts = self.parts()
        found, _, _ = self.run(0, brief=True, parts=parts)
        if found.status != "predicted":
            return found, []
        limits = [2.0 * math.pi / length for length in shortest]
        with np.errstate(over="ignore", invalid="ignore"):
            return found, [self.below_limits(parts, (limit, limit)) for limit in limits]

    def below_limits(self, parts: PairParts, limits: tuple[float, float]) -> float:
        """mu_r/mu_s of the waves with |q| below a limit [1/a] of each, in their order."""
        kept: PairParts = []
        powers = []
        for (spectrum, transfer, edge), limit in zip(parts, limits, strict=True):
            few, index = longer_waves(spectrum, limit, self.of[0].operating.ellipse.ellipticity)
            powers.append(np.where(spectrum.q < limit, spectrum.power, 0.0))
            kept.append((few, transfer.kept(index), edge.below(limit)))
        return self.meeting.short_mean(self._contact(kept, powers).friction)

    def _bands(self, parts: PairParts, total: float, brief: bool) -> list[Band]:
        """Return what each octave, or the last one alone, adds when it joins all longer ones."""
        waves = [
            (s.q, s.power, np.abs(t.at_centre(s, u)), np.abs(t.pressure_at_centre(s, u)))
            for s, t, u in self._moving(parts)
        ]
        q, power, deformed, pressure = (
            np.concatenate([part.ravel() for part in both]) for both in zip(*waves, strict=True)
        )
        return joining(
            (q, power, deformed, pressure),
            lambda limit: self.below_limits(parts, (limit, limit)),
            total,
            self.of[0].operating,
            brief=brief,
        )

    def _result(
        self,
        contact: PairContact,
        parts: PairParts,
        places: tuple[Array, Array, Array, float],
        brief: bool,
    ) -> RoughFriction:
        o, ratios = self.of[0].operating, places[2]
        status, message = outcome(contact, ratios)
        if status == BEYOND and not brief:
            message += known_by_cut_off(
                [spectrum for spectrum, _, _ in parts],
                self.order,
                o.hertz_radius,
                lambda limits: self.below_limits(parts, limits),
                lambda numbers, length: self.without_shorter(numbers, length).run(0, brief=True)[0],
            )
        responses = self.responses(parts)
        moved = [places[0] * o.hertz_radius, places[1] * o.hertz_radius]
        shifts = [moved[k] for k in self.order]
        touching = contact.touching / (contact.count * contact.points)
        return passed(
            contact,
            (status, message),
            (shifts[0], ratios, places[3]),
            film_unit=o.film_scale,
            response=responses[0],
            second=SecondPassage(responses[1], shifts[1], touching),
            periodic=self.meeting.passages is not None,
        )

    def without_shorter(self, numbers: Sequence[int], shortest: float) -> RoughPair:
        """Return the pair without waves shorter than a length [m] of the surfaces so numbered."""
        first, second = (
            replace(one, topography=filtered(one.topography, shortest, kind=self.filters[k]))
            if k in numbers
            else one
            for k, one in enumerate(self.of)
        )
        return replace(self, of=(first, second))
