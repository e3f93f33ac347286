# SPDX-License-Identifier: BSD-3-Clause
"""The prediction of a resolved case."""

import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

import numpy as np

from pyehl import surfaces
from pyehl.errors import InputError
from pyehl.prediction import spectrum_assumed
from pyehl.prediction.bands import Band
from pyehl.prediction.breakdown import Advice, BelowZero, Borne, advise, below_zero
from pyehl.prediction.by_response import RoughPassage
from pyehl.prediction.cost import tell_cost
from pyehl.prediction.errors import outside_range
from pyehl.prediction.folder import read_contact
from pyehl.prediction.friction import TRACKS, RoughFriction, SecondPassage, broken
from pyehl.prediction.heated import heat_of
from pyehl.prediction.options import Options, unpredictable
from pyehl.prediction.pair import RoughPair
from pyehl.prediction.pair_breakdown import PairAdvice, PairBelowZero, advise_pair, pair_below_zero
from pyehl.prediction.partial import Partial, partial_film, without
from pyehl.prediction.result import Prediction
from pyehl.prediction.second_order import FILM_ENDS
from pyehl.prediction.sides import SecondSurface, Together
from pyehl.prediction.smooth import SmoothContact, hertz_contact, solve_contact, with_layer
from pyehl.prediction.touching import lost_with_the_film, touching
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array

MAX_TRACKS = 10_000

# Why contact at a boundary film is not predicted
OF_TWO = "contact at a boundary film is predicted of one rough surface"
# Why its errors are not known
ELASTIC = "the prediction is of elastic solids: contact.hardness is left out"
OTHER_MODEL = "psd.reduction and psd.smooth are not those that contact is predicted with"


def predict(
    settings: Mapping[str, Mapping[str, Any]],
    text: str = "",
    *,
    tracks: int = TRACKS,
    smooth: str | os.PathLike[str] | None = None,
    surface: surfaces.Topography | None = None,
    second_surface: surfaces.Topography | None = None,
    brief: bool = False,
) -> Prediction:
    """Predict the relative friction of a resolved case, `text` being the same as namelist text.

    `tracks` across the surface, 1 to `MAX_TRACKS`, are for mean and spread; `smooth` is a result
    folder with the smooth contact, in place of a solution on the spot; `surface` and
    `second_surface` are surfaces before their spectrum is cut and off their track, by default made
    as the case says. `brief`:
    mu_r/mu_s and its errors, bit for bit the same, but no tracks, of the bands the shortest alone,
    and no search for what would carry where there is no ratio.

    InputError if the surface is smooth or a single feature, a map is not usable, the conditions
    are outside the model, or there are too many tracks; OSError if a map cannot be opened.
    """
    start = time.perf_counter()
    options = _options(settings, tracks)
    given = {"surface": surface, "second_surface": second_surface}
    groups = surfaces.rough_groups(settings)
    operating = OperatingPoint.from_settings(settings)
    lubricant = Lubricant.from_settings(settings, str(settings["psd"]["viscosity_law"]))
    if smooth is None:
        contact = _smooth_contact(settings, operating, lubricant, options)
    else:
        contact = read_contact(Path(smooth), operating, settings)
        if lubricant.shear.in_flow:
            contact = replace(contact, newtonian=solve_contact(settings).newtonian)
    films = contact
    if options.smooth == "solved" and not float(settings["psd"]["film_thickness"]) > 0.0:
        films = with_layer(settings, contact, lubricant)
    film = films.central_film * operating.film_scale
    known = film if math.isfinite(film) else contact.central_film * operating.film_scale
    alone = []
    for group in groups:
        values = settings[group]
        tile = given[group]
        if tile is None:
            tile = surfaces.from_settings({**settings, "surface": values}, operating, known)
        else:
            tile = surfaces.finished(tile, values)
        if not brief:
            tell_cost(tile, operating, group)
        ratio, kind = float(values["velocity_ratio"]), str(values["filter"])
        conditions = contact, operating, lubricant, options, ratio
        alone.append(RoughPassage(tile, *conditions, groups=(group,), filter_kind=kind))

    # deformed roughness over the smooth film at which the film ends
    ends = FILM_ENDS if options.reduction == "response" else 1.0

    def borne(x: Array, y: Array) -> Array:
        """Deformed roughness at which the film ends [m] at places [m]."""
        a = operating.hertz_radius
        return contact.at(x / a, y / a)[1] * operating.film_scale * ends

    keys = [settings[group] for group in groups]
    tracks = 0 if brief else tracks
    predicted = (_of_pair if len(alone) > 1 else _of_one)(alone, keys, borne, tracks, brief=brief)
    friction, over, bands, below, advise_on, together = predicted
    if friction.status == "predicted" and below.deepest <= 0.0:
        # the positions of the passage have missed it
        friction = broken(friction, below.deepest)
        over, bands = (math.nan, math.nan), []
    advice = advise_on() if friction.status == "film breakdown" and not brief else None
    partial = _partial(settings, alone)
    if partial is not None:
        partial = lost_with_the_film(friction, partial)
        friction, over = touching(friction, partial, over)
        advice = None if friction.status == "predicted" else advice
    return Prediction(
        settings=settings,
        operating=operating,
        lubricant=lubricant,
        options=options,
        velocity_ratio=alone[0].velocity_ratio,
        film=film,
        film_minimum=films.minimum_film * operating.film_scale,
        film_errors=(
            films.central_film_error * operating.film_scale,
            films.minimum_film_error * operating.film_scale,
        ),
        film_source=films.source,
        pressure_maximum=float(films.pressure.max()) * operating.hertz_pressure,
        surface=alone[0].topography,
        friction=friction,
        bands=bands,
        tracks=over,
        seconds=time.perf_counter() - start,
        text=text,
        track_count=tracks,
        below=below,
        advice=advice,
        second=_second(alone, friction, together),
        heat=(partial and partial.heat) or heat_of(settings, contact, lubricant),
        thinning=contact.thinning,
        partial=partial,
        beside=[]
        if brief or any(given.values())
        else spectrum_assumed.beside(
            settings, groups, lambda other: predict(other, smooth=smooth, brief=True)
        ),
    )


def _second(
    alone: Sequence[RoughPassage], friction: RoughFriction, together: Together | None
) -> SecondSurface | None:
    """Give the second rough surface where there is one, and its passage is known."""
    if len(alone) < 2 or friction.second is None:
        return None
    other = alone[1]
    return SecondSurface(other.topography, other.velocity_ratio, friction.second, together)


def _partial(
    settings: Mapping[str, Mapping[str, Any]], alone: Sequence[RoughPassage]
) -> Partial | None:
    """Find the contact of a case with a boundary film; None without one."""
    lubricant, passage = settings["lubricant"], alone[0]
    layer = float(lubricant["boundary_film"])
    if not layer > 0.0:
        return None
    if len(alone) > 1:
        return without(OF_TWO)
    if not passage.options.measured:
        return without(OTHER_MODEL)
    mu = float(lubricant["boundary_friction"])
    found = partial_film(passage, passage.parts(), layer, mu, settings)
    beyond = outside_range(
        passage.operating, passage.velocity_ratio, passage.options, passage.contact.thinning
    )
    if beyond:
        found = found.unknown(f"outside the range of the response by {', '.join(beyond)}")
    if settings["contact"].get("hardness", 0.0) > 0.0:
        note = found.note or ELASTIC
        found = replace(found, load_share_error=math.nan, area_share_error=math.nan, note=note)
    return found


def _of_one(
    alone: Sequence[RoughPassage],
    keys: Sequence[Mapping[str, Any]],
    borne: Borne,
    tracks: int,
    *,
    brief: bool,
) -> tuple[RoughFriction, tuple[float, float], list[Band], BelowZero, Callable[[], Advice], None]:
    """Predict one surface: friction, over tracks, bands, where the film ends, what would carry."""
    passage = alone[0]
    friction, over, bands = passage.run(tracks, brief=brief)
    tile, semi_axes = passage.topography, passage.operating.semi_axes
    below = below_zero(friction.response.deformed, tile.pixel, semi_axes, borne)
    return friction, over, bands, below, lambda: _advice(passage, keys[0], borne), None


def _of_pair(
    alone: Sequence[RoughPassage],
    keys: Sequence[Mapping[str, Any]],
    borne: Borne,
    tracks: int,
    *,
    brief: bool,
) -> tuple[
    RoughFriction,
    tuple[float, float],
    list[Band],
    PairBelowZero,
    Callable[[], PairAdvice],
    Together | None,
]:
    """Predict two surfaces, as `_of_one` does one; last the sum of both if they move together."""
    fronts = [float(group["x_start"]) for group in keys]
    filters = [str(group["filter"]) for group in keys]
    pair = RoughPair((alone[0], alone[1]), (fronts[0], fronts[1]), (filters[0], filters[1]))
    friction, over, bands = pair.run(tracks, brief=brief)
    second = cast("SecondPassage", friction.second)
    deformed = [friction.response.deformed, second.response.deformed]
    share, together = second.touching, pair.as_one
    sum_of_both = None
    if together is not None:
        tile, semi_axes = together.topography, together.operating.semi_axes
        deformed_sum = together.deformed()
        share = below_zero(deformed_sum, tile.pixel, semi_axes, borne).share
        sum_of_both = Together(tile, float(np.std(deformed_sum)))
    below = replace(pair_below_zero(pair, deformed, borne), share=share)
    return friction, over, bands, below, lambda: advise_pair(pair, below, borne), sum_of_both


def _options(settings: Mapping[str, Mapping[str, Any]], tracks: int) -> Options:
    """How the model is read; InputError where nothing is predicted of the case."""
    if not 1 <= tracks <= MAX_TRACKS:
        raise InputError(
            f"tracks = {tracks}: expected 1 to {MAX_TRACKS}; the mean over {MAX_TRACKS} is known "
            "to a hundredth of the spread"
        )
    why = unpredictable(settings)
    if why:
        raise InputError(why)
    options = Options.from_settings(settings)
    as_by_default = Options(positions=options.positions, film_limit=options.film_limit)
    if OperatingPoint.from_settings(settings).radius_ratio != 1.0 and options != as_by_default:
        raise InputError(
            "psd: the model of the paper, and what is between it and the response, is for circular "
            "contacts\nexpected: contact.radius, or the group psd as by default"
        )
    if options.as_in_paper and len(surfaces.rough_groups(settings)) > 1:
        raise InputError(
            "two rough surfaces: the model of the paper (psd.reduction = 'amplitude' with "
            "psd.smooth = 'hertz') knows one\nexpected: psd.reduction = 'response'"
        )
    if not options.as_in_paper and (options.load_balance or options.stiffness == "paper"):
        raise InputError(
            "psd.load_balance and psd.stiffness = 'paper' belong to the model of the paper: "
            "psd.reduction = 'amplitude' with psd.smooth = 'hertz'"
        )
    return options


def _advice(passage: RoughPassage, group: Mapping[str, Any], borne: Borne) -> Advice:
    """Where the film ends, and what of the group ``surface`` would carry."""
    surface, kind = passage.topography, str(group["filter"])
    return advise(
        surface,
        lambda tile: replace(passage, topography=tile).deformed(),
        passage.operating.semi_axes,
        borne,
        lambda tile, shortest: surfaces.filtered(tile, shortest, kind=kind),
        lambda threshold: surfaces.without_spikes(surface, threshold, group),
        lambda tile: replace(passage, topography=tile).known(),
    )


def _smooth_contact(
    settings: Mapping[str, Mapping[str, Any]],
    operating: OperatingPoint,
    lubricant: Lubricant,
    options: Options,
) -> SmoothContact:
    """Pressure and film under the roughness."""
    given = float(settings["psd"]["film_thickness"]) / operating.film_scale
    if options.smooth == "hertz":
        if given > 0.0:
            return hertz_contact(given, "psd.film_thickness")
        formula = central_film(operating, lubricant) / operating.film_scale
        return hertz_contact(formula, "Nijenbanning-Venner-Moes formula over rho(p_h)/rho0")
    contact = solve_contact(settings)
    if given > 0.0:
        scale = given / contact.central_film
        return replace(
            contact,
            film=contact.film * scale,
            central_film=given,
            minimum_film=contact.minimum_film * scale,
            source="psd.film_thickness",
        )
    return contact
