# SPDX-License-Identifier: BSD-3-Clause
"""The prediction of a resolved case."""

import math
import os
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from pyehl import surfaces
from pyehl.errors import InputError
from pyehl.prediction import spectrum_assumed
from pyehl.prediction.breakdown import (
    BelowZero,
    Sustained,
    advise,
    below_zero,
    of_model,
    sustained_by,
)
from pyehl.prediction.cost import report_cost
from pyehl.prediction.folder import read_contact
from pyehl.prediction.friction import TRACKS, RoughFriction, broken
from pyehl.prediction.mixed_lubrication import mixed_film, with_contact
from pyehl.prediction.model import Model, RoughSurface
from pyehl.prediction.options import ModelOptions, unpredictable
from pyehl.prediction.passage_friction import Outcome, run
from pyehl.prediction.result import Prediction
from pyehl.prediction.second_surface import Together
from pyehl.prediction.smooth import SmoothContact, hertz_contact, solve_contact, with_layer
from pyehl.prediction.thermal import heat_of
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

MAX_TRACKS = 10_000
"""The mean over as many is known to a hundredth of the spread."""


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
    and no search for a cut-off with which there is a ratio.

    InputError if the surface is smooth or a single feature, a map is not usable, the conditions
    are outside the model, or there are too many tracks; OSError if a map cannot be opened.
    """
    start = time.perf_counter()
    options = _options(settings, tracks)
    operating = OperatingPoint.from_settings(settings)
    lubricant = Lubricant.from_settings(settings, str(settings["psd"]["viscosity_law"]))
    contact = _contact(settings, operating, lubricant, options, smooth)
    films = contact
    if options.smooth == "solved" and not float(settings["psd"]["film_thickness"]) > 0.0:
        films = with_layer(settings, contact, lubricant)
    film = films.central_film if math.isfinite(films.central_film) else contact.central_film
    given = {"surface": surface, "second_surface": second_surface}
    rough = _surfaces(settings, given, operating, film * operating.film_scale, brief=brief)
    model = Model(rough, contact, operating, lubricant, options)
    tracks = 0 if brief else tracks
    waves = None if model.merged else model.components()
    outcome = run(model, tracks, brief=brief, waves=waves)
    sustained = sustained_by(model)
    below, together = _below(model, outcome.friction, sustained)
    if outcome.friction.status == "predicted" and below.deepest <= 0.0:
        # the positions of the passage have missed it
        outcome = Outcome(broken(outcome.friction, below.deepest))
    ended = outcome.friction.status == "film breakdown"
    mixed = mixed_film(model, waves or [], settings, films)
    if mixed is not None:
        outcome, mixed = with_contact(outcome, mixed)
    advice = None
    if ended and not brief and outcome.friction.status != "predicted":
        advice = advise(model, below, sustained, _spike_removal(settings, model))
    return Prediction(
        settings=settings,
        model=model,
        films=films,
        outcome=outcome,
        below=below,
        seconds=time.perf_counter() - start,
        text=text,
        track_count=tracks,
        advice=advice,
        together=together,
        mixed=mixed,
        heat=(mixed and mixed.heat) or heat_of(settings, contact, lubricant),
        beside=[]
        if brief or any(given.values())
        else spectrum_assumed.beside(
            settings,
            surfaces.rough_groups(settings),
            lambda other: predict(other, smooth=smooth, brief=True),
        ),
    )


def _surfaces(
    settings: Mapping[str, Mapping[str, Any]],
    given: Mapping[str, surfaces.Topography | None],
    operating: OperatingPoint,
    film: float,
    *,
    brief: bool,
) -> tuple[RoughSurface, ...]:
    """Make the rough surfaces of a resolved case, whose film is h_c [m]."""
    rough, groups = [], surfaces.rough_groups(settings)
    beside = 0 if any(given.values()) else spectrum_assumed.number(settings, groups)
    for group in groups:
        values = settings[group]
        tile = given[group]
        if tile is None:
            tile = surfaces.from_settings({**settings, "surface": values}, operating, film)
        else:
            tile = surfaces.finished(tile, values)
        if not brief:
            report_cost(tile, operating, group, beside)
        ratio, front = float(values["velocity_ratio"]), float(values["x_start"])
        rough.append(RoughSurface(tile, ratio, front, str(values["filter"]), (group,)))
    return tuple(rough)


def _below(
    model: Model, friction: RoughFriction, sustained: Sustained
) -> tuple[BelowZero, Together | None]:
    """Find where the film ends, and the sum of two surfaces where they move together."""
    below = of_model(model, [response.deformed for response in friction.responses], sustained)
    if len(model.surfaces) == 1:
        return below, None
    if model.merged is None:
        return replace(below, share=friction.ended), None
    tile, deformed = model.merged.surfaces[0].topography, model.merged.deformed()
    of_sum = below_zero([tile], deformed, model.operating.semi_axes, sustained)
    together = Together(tile, float(np.std(deformed[0])))
    return replace(below, share=of_sum.share), together


def _spike_removal(
    settings: Mapping[str, Mapping[str, Any]], model: Model
) -> Callable[[float], surfaces.Topography] | None:
    """Give what removes the spikes of one map beyond a threshold."""
    if len(model.surfaces) > 1:
        return None
    (one,) = model.surfaces
    group = settings[one.groups[0]]
    return lambda threshold: surfaces.without_spikes(one.topography, threshold, group)


def _options(settings: Mapping[str, Mapping[str, Any]], tracks: int) -> ModelOptions:
    """How the model is read; InputError where nothing is predicted of the case."""
    if not 1 <= tracks <= MAX_TRACKS:
        raise InputError(
            f"tracks = {tracks}: expected 1 to {MAX_TRACKS}; the mean over {MAX_TRACKS} is known "
            "to a hundredth of the spread"
        )
    why = unpredictable(settings)
    if why:
        raise InputError(why)
    options = ModelOptions.from_settings(settings)
    as_by_default = ModelOptions(positions=options.positions, film_limit=options.film_limit)
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


def _contact(
    settings: Mapping[str, Mapping[str, Any]],
    operating: OperatingPoint,
    lubricant: Lubricant,
    options: ModelOptions,
    folder: str | os.PathLike[str] | None,
) -> SmoothContact:
    """Pressure and film under the roughness, of a result folder if there is one."""
    if folder is not None:
        contact = read_contact(Path(folder), operating, settings)
        if lubricant.shear.in_flow:
            contact = replace(contact, newtonian=solve_contact(settings).newtonian)
        return contact
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
