# SPDX-License-Identifier: BSD-3-Clause
"""The prediction of a resolved case."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl import surfaces
from pyehl.errors import InputError
from pyehl.prediction.breakdown import Advice, SmoothFilm, advise, below_zero
from pyehl.prediction.by_response import RoughPassage
from pyehl.prediction.friction import TRACKS, broken
from pyehl.prediction.heated import heat_of
from pyehl.prediction.options import Options, unpredictable
from pyehl.prediction.result import Prediction
from pyehl.prediction.smooth import SmoothContact, hertz_contact, read_contact, solve_contact
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

__all__ = ["predict"]

Array = NDArray[np.float64]

MAX_TRACKS = 10_000


def predict(
    settings: Mapping[str, Mapping[str, Any]],
    text: str = "",
    *,
    tracks: int = TRACKS,
    smooth: str | os.PathLike[str] | None = None,
    surface: surfaces.Topography | None = None,
    brief: bool = False,
) -> Prediction:
    """Predict the relative friction of a resolved case, `text` being the same as namelist text.

    `tracks` across the surface, 1 to `MAX_TRACKS`, are for mean and spread; `smooth` is a result
    folder with the smooth contact, in place of a solution on the spot; `surface` is the surface
    before its spectrum is cut and off its track, by default made as the case says. `brief`:
    mu_r/mu_s and its errors, bit for bit the same, but no tracks, of the bands the shortest alone,
    and no search for what would carry where there is no ratio.

    InputError if the surface is smooth or a single feature, a map is not usable, the conditions
    are outside the model, or there are too many tracks; OSError if a map cannot be opened.
    """
    start = time.perf_counter()
    options = _options(settings, tracks)
    settings = surfaces.one_rough(settings)
    operating = OperatingPoint.from_settings(settings)
    operating.need_round("the prediction")
    lubricant = Lubricant.from_settings(settings, str(settings["psd"]["viscosity_law"]))
    velocity_ratio = float(settings["surface"]["velocity_ratio"])
    if smooth is None:
        contact = _smooth_contact(settings, operating, lubricant, options)
    else:
        contact = read_contact(Path(smooth), operating)
    film = contact.central_film * operating.film_scale
    if surface is None:
        surface = surfaces.from_settings(settings, operating, film)
    else:
        surface = surfaces.finished(surface, settings["surface"])
    passage = RoughPassage(surface, contact, operating, lubricant, options, velocity_ratio)
    friction, over, bands = passage.run(0 if brief else tracks, brief=brief)

    def smooth_film(x: Array, y: Array) -> Array:
        """Smooth film [m] at places [m]."""
        a = operating.hertz_radius
        return contact.at(x / a, y / a)[1] * operating.film_scale

    below = below_zero(
        friction.response.deformed, surface.pixel, operating.hertz_radius, smooth_film
    )
    advice = None
    if friction.status == "predicted" and below.deepest <= 0.0:
        # the positions of the passage have missed it
        friction = broken(friction, below.deepest)
        over, bands = (math.nan, math.nan), []
    if friction.status == "film breakdown" and not brief:
        advice = _advice(passage, settings["surface"], smooth_film)
    return Prediction(
        settings=settings,
        operating=operating,
        lubricant=lubricant,
        options=options,
        velocity_ratio=velocity_ratio,
        film=film,
        film_minimum=contact.minimum_film * operating.film_scale,
        film_source=contact.source,
        surface=surface,
        friction=friction,
        bands=bands,
        tracks=over,
        seconds=time.perf_counter() - start,
        text=text,
        track_count=0 if brief else tracks,
        below=below,
        advice=advice,
        heat=heat_of(settings, contact, lubricant),
    )


def _options(settings: Mapping[str, Mapping[str, Any]], tracks: int) -> Options:
    """How the model is read; InputError where nothing is predicted of the case."""
    if not 1 <= tracks <= MAX_TRACKS:
        raise InputError(
            f"--tracks {tracks}: expected 1 to {MAX_TRACKS}; the mean over {MAX_TRACKS} is known "
            "to a hundredth of the spread"
        )
    why = unpredictable(settings)
    if why:
        raise InputError(why)
    options = Options.from_settings(settings)
    if not options.as_in_paper and (options.load_balance or options.stiffness == "paper"):
        raise InputError(
            "psd.load_balance and psd.stiffness = 'paper' belong to the model of the paper: "
            "psd.reduction = 'amplitude' with psd.smooth = 'hertz'"
        )
    return options


def _advice(passage: RoughPassage, group: Mapping[str, Any], smooth_film: SmoothFilm) -> Advice:
    """Where the film ends, and what of the group ``surface`` would carry."""
    surface, kind = passage.topography, str(group.get("filter", "sharp"))
    return advise(
        surface,
        lambda tile: replace(passage, topography=tile).deformed(),
        passage.operating.hertz_radius,
        smooth_film,
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
