# SPDX-License-Identifier: BSD-3-Clause
"""Friction of a model over a passage, over its tracks, and by bands of wavelengths."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from pyehl.prediction.bands import Band, joining, known_by_cut_off, remedies_of
from pyehl.prediction.contact import HertzContact
from pyehl.prediction.friction import (
    BEYOND,
    LARGEST_RATIO,
    TRACKS,
    RoughFriction,
    film_levels,
    outcome,
    passed,
)
from pyehl.prediction.model import PIXEL_POINTS, Components, Model
from pyehl.prediction.moving_tile import Component
from pyehl.prediction.options import KNOWN_RATIO, model_error
from pyehl.prediction.relative_positions import Passage, Positions
from pyehl.prediction.rough_contact import RoughContact
from pyehl.prediction.spectrum import longer_waves
from pyehl.surfaces import track_offsets


class Outcome(NamedTuple):
    """Friction over a passage, mean and spread over tracks (NaN: none), and what bands add."""

    friction: RoughFriction
    tracks: tuple[float, float] = (math.nan, math.nan)
    bands: Sequence[Band] = ()


def run(
    model: Model, tracks: int = TRACKS, *, brief: bool = False, waves: Components | None = None
) -> Outcome:
    """Friction over the passage, mean and spread over the tracks, and what each band adds.

    `brief`: of the bands the shortest alone, and without a search for what would help where
    the linear response ends. No tracks: NaN for mean and spread. `waves`: if they were made.
    """
    if model.merged is not None:
        together = run(model.merged, tracks, brief=brief)
        alone = together.friction
        both = tuple(model.responses())
        friction = replace(alone, responses=both, shifts=alone.shifts * 2)
        return together._replace(friction=friction)
    waves = waves or model.components()
    positions = model.positions(waves)
    with np.errstate(over="ignore", invalid="ignore"):
        contact = model.rough_contact(waves)
        limit = model.options.film_limit / model.operating.film_scale
        left = [(w.spectrum.power, np.abs(w.at_centre())) for w in waves]
        contact.watch(film_levels(limit, left, [w.velocity_ratio for w in waves]))
        passage = positions.passage(contact.friction, model.options.positions, LARGEST_RATIO)
        found = _result(model, contact, waves, passage, brief=brief)
        if found.status != "predicted":
            return Outcome(found)
        ratios = _over_tracks(model, contact, waves, positions, tracks, found.mu_ratio)
        bands = _bands(model, waves, found.mu_ratio, brief=brief)
    over = (float(np.mean(ratios)), float(np.std(ratios))) if tracks else (math.nan, math.nan)
    return Outcome(found, over, bands)


def _over_tracks(
    model: Model,
    contact: RoughContact | HertzContact,
    waves: Components,
    positions: Positions,
    tracks: int,
    first: float,
) -> list[float]:
    """mu_r/mu_s on so many tracks, `first` on that of the case."""
    offsets = [track_offsets(one.topography, tracks) if tracks else [] for one in model.in_order]
    if len(waves) == 1:
        pixel = model.surfaces[0].topography.length_y / waves[0].spectrum.shape[1]
        stride = model.stride_of(waves[0].spectrum, PIXEL_POINTS)
        moved = [(d, round(d / (stride * pixel)) * stride) for d in offsets[0]]
        return [
            first if d == 0.0 else positions.short_mean(contact.friction, track)
            for d, track in moved
        ]
    # on both, in opposite order
    a = model.operating.hertz_radius
    pairs = [(offsets[0][k] / a, offsets[1][-k % tracks] / a) for k in range(tracks)]
    # sorted: the same for either order of the surfaces
    return sorted(
        positions.short_mean(model.rough_contact(waves, tracks=pair).friction)
        if any(pair)
        else first
        for pair in pairs
    )


def mean(model: Model, waves: Components | None = None) -> float:
    """mu_r/mu_s over a few positions [-]; NaN where the film ends."""
    if model.merged is not None:
        return mean(model.merged)
    waves = waves or model.components()
    with np.errstate(over="ignore", invalid="ignore"):
        return model.positions(waves).short_mean(model.rough_contact(waves).friction)


def known(model: Model) -> bool:
    """Whether the error of the ratio is; that of the paper never is, and is not asked for."""
    return model.options.as_in_paper or math.isfinite(model_error(mean(model)))


def run_and_below(model: Model, *shortest: float) -> tuple[RoughFriction, list[float]]:
    """Friction in brief, and mu_r/mu_s without the waves shorter than some lengths [a].

    The latter over a few positions each, and none where friction is not predicted.
    """
    if model.merged is not None:
        return run_and_below(model.merged, *shortest)
    waves = model.components()
    found = run(model, 0, brief=True, waves=waves).friction
    if found.status != "predicted":
        return found, []
    limits = [2.0 * math.pi / length for length in shortest]
    with np.errstate(over="ignore", invalid="ignore"):
        return found, [below(model, waves, [limit] * len(waves)) for limit in limits]


def below(model: Model, waves: Components, limits: Sequence[float]) -> float:
    """mu_r/mu_s of the waves with |q| below a limit [1/a] of each surface, in order.

    On as few pixels as they need.
    """
    kept, powers = [], []
    for wave, limit in zip(waves, limits, strict=True):
        spectrum = wave.spectrum
        few, index = longer_waves(spectrum, limit, model.operating.ellipse.ellipticity)
        powers.append(np.where(spectrum.q < limit, spectrum.power, 0.0))
        parts = few, wave.transfer.kept(index), wave.edge.below(limit)
        kept.append(Component(*parts, wave.velocity_ratio))
    return model.positions(kept).short_mean(model.rough_contact(kept, powers).friction)


def _result(
    model: Model,
    contact: RoughContact | HertzContact,
    waves: Components,
    passage: Passage,
    *,
    brief: bool,
) -> RoughFriction:
    status, message = outcome(contact, passage.ratios, load_balance=model.options.load_balance)
    if status == BEYOND and not brief:
        message += _ways_into_range(model, waves)
    return passed(
        contact,
        (status, message),
        passage,
        film_unit=model.operating.film_scale,
        shifts=tuple(passage.shifts[model.order.index(k)] for k in range(len(waves))),
        responses=tuple(model.responses(waves)),
    )


def _ways_into_range(model: Model, waves: Components) -> str:
    """Say what would bring the ratio into the range of the model; '' for nothing."""
    if first := remedies(model):
        return "; " + ", ".join(f"first {option}" for option in first)
    return known_by_cut_off(
        [(" and ".join(f"{g}.shortest_wavelength" for g in s.groups)) for s in model.surfaces],
        [wave.spectrum for wave in waves],
        model.order,
        model.operating.hertz_radius,
        lambda limits: below(model, waves, limits),
        lambda numbers, shortest: _within_range(model.without_shorter(numbers, shortest)),
    )


def _within_range(model: Model) -> bool:
    found = run(model, 0, brief=True).friction
    return found.status == "predicted" and found.mu_ratio <= KNOWN_RATIO


def remedies(model: Model) -> list[str]:
    """Options that take form and line offsets off maps: cuts of waves would take them too."""
    return [
        option.replace("surface.", f"{one.groups[0]}.")
        for one in model.surfaces
        for option in remedies_of(one.topography)
    ]


def _bands(model: Model, waves: Components, total: float, *, brief: bool) -> list[Band]:
    """Return what each octave, or the last one alone, adds when it joins all longer ones."""
    parts = [
        (w.spectrum.q, w.spectrum.power, np.abs(w.at_centre()), np.abs(w.pressure_at_centre()))
        for w in waves
    ]
    q, power, deformed, pressure = (
        np.concatenate([part.ravel() for part in of_all]) for of_all in zip(*parts, strict=True)
    )
    return joining(
        (q, power, deformed, pressure),
        lambda limit: below(model, waves, [limit] * len(waves)),
        total,
        model.operating,
        brief=brief,
    )
