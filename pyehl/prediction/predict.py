# SPDX-License-Identifier: BSD-3-Clause
"""The prediction of a resolved case: its cost, the case itself, and the case with other spectra.

Ra and Rq do not determine a spectrum. If one of them or a finish is given, the case is also
predicted with other roll-offs.
"""

import logging
import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from pyehl import blas, lengths, surfaces
from pyehl.case.duty import refuse_duty
from pyehl.contact.result_folder import read_contact
from pyehl.contact.smooth import (
    SmoothContact,
    heat_of,
    hertz_contact,
    solve_contact,
    with_boundary_film,
)
from pyehl.errors import InputError
from pyehl.prediction.breakdown import (
    BelowZero,
    Sustained,
    advise,
    below_zero,
    of_model,
    sustained_by,
    ways_into_range,
)
from pyehl.prediction.friction import (
    BEYOND,
    TRACKS,
    Outcome,
    RoughFriction,
    broken,
    run,
    with_contact,
)
from pyehl.prediction.mixed_lubrication import mixed_film
from pyehl.prediction.model import PIXEL_POINTS, Model, ModelOptions, RoughSurface
from pyehl.prediction.result import Prediction
from pyehl.prediction.spectrum import WORKING_PIXELS
from pyehl.prediction.summary import Together
from pyehl.surfaces import FEATURES, Topography, rough_groups
from pyehl.theory.line_contact import AnyContact, contact_of, formula_film
from pyehl.theory.lubricant import Lubricant
from pyehl.types import Settings

LENGTHS = (30e-6, 100e-6, 0.0)
"""Alternative wavelengths of roll-offs [m]; 0: none, waves as long as the tile."""


def spectrum_assumed(group: Mapping[str, Any]) -> bool:
    """Whether a group of a case gives Ra, Rq or a finish, so that its spectrum is assumed."""
    if group.get("kind") != "fractal":
        return False
    named = str(group.get("finish", "none")) != "none"
    return named or bool(group.get("ra", 0.0)) or bool(group.get("rq", 0.0))


def other_spectra_count(groups: Mapping[str, Any], names: Sequence[str]) -> int:
    """Count the predictions that `other_spectra` makes."""
    return len(LENGTHS) if any(spectrum_assumed(groups[name]) for name in names) else 0


def other_spectra(
    settings: Settings, groups: Sequence[str], predict: Callable[[Settings], "Prediction"]
) -> list[dict[str, Any]]:
    """Predict the case with other roll-offs for all surfaces whose spectrum is assumed."""
    changed = [name for name in groups if spectrum_assumed(settings[name])]
    if not changed:
        return []
    results = []
    for length in LENGTHS:
        roll = 2.0 * math.pi / length if length else 0.0
        other = {
            name: {**values, "rolloff_wavenumber": roll} if name in changed else values
            for name, values in settings.items()
        }
        result = predict(other)
        known = result.friction.status == "predicted"
        results.append(
            {
                "rolloff_wavelength_m": length or None,
                "status": result.friction.status,
                "h_min_rough_m": result.friction.film_min if known else None,
                "mu_ratio": result.mu_ratio if known else None,
                "film_m": result.below.deepest if result.below else None,
            }
        )
    return results


LOG = logging.getLogger(__name__)

PER_PIXEL = 1.5e-5
"""Seconds per pixel of the resampled tile, on one core of 2020, to a factor of two."""
PER_POINT = 1e-4
"""The same per point of the contact."""
REPORTED = 10.0
"""Time above which it is reported [s]."""
BRIEF = 0.36
"""Time of a prediction without tracks and with one band, as for other spectra, over that with all:
0.3 to 0.4 with cases/finish.nml and a gear flank."""
SMALL = 0.02
"""Length and width of a map over those of the contact below which a larger map is recommended."""
ENOUGH = 3.0
"""Length of a part that is suggested in place of a larger map, over that of the contact."""


def seconds_of(tile: Topography, operating: AnyContact) -> float:
    """Time of the prediction of a tile [s], to a factor of two."""
    a = operating.hertz_radius
    sides = list(zip(tile.shape, tile.size, (a, a * operating.ellipse.side), strict=True))
    pixels = math.prod(max(n, size / a * WORKING_PIXELS) for n, size, a in sides)
    # points in the contact, not farther apart than the sides of the tile
    area = operating.dry_area * (tile.length_y if operating.ellipse.is_line else 1.0)
    points = area / min(a / PIXEL_POINTS, *tile.size) ** 2
    return PER_PIXEL * pixels + PER_POINT * points


def report_cost(
    tile: Topography, operating: AnyContact, group: str = "surface", others: int = 0
) -> None:
    """Log the time for a large tile, and suggest a sufficient part of its map, or a larger map.

    `others`: number of brief predictions with other spectra.
    """
    seconds = seconds_of(tile, operating) * (1.0 + BRIEF * others)
    if seconds < REPORTED:
        return
    made = tile.preparation
    images = 2 if made is not None and made.options.edges == "mirror" else 1
    # over the length and the width of the contact
    own = [size / images for size in tile.size]
    contacts = [size / (2.0 * a) for size, a in zip(own, operating.semi_axes, strict=True)]
    text = (
        f"{tile.origin}: {tile.shape[0]} x {tile.shape[1]} pixels"
        f"{', mirror images included,' if images > 1 else ''} take about {_time(seconds)}"
    )
    if max(contacts) > 2.0 * ENOUGH:
        wide = (
            "contacts long"
            if operating.ellipse.is_line
            else f"x {contacts[1]:.0f} contacts long and wide"
        )
        text += f"; the map is {contacts[0]:.0f} {wide}"
        text += _part(tile, operating, own, seconds, group)
    elif max(contacts) < SMALL:
        text += (
            f"; the map is {lengths.size(own[0], own[1], 3)} and the contact "
            f"{lengths.length(2.0 * operating.hertz_radius, 2)} long: a larger map takes less time"
        )
    LOG.info(text)


def _part(
    tile: Topography, operating: AnyContact, own: list[float], seconds: float, group: str
) -> str:
    """Suggest the middle of a map as read, unless it was rotated."""
    made = tile.preparation
    if made is None or made.options.rotate % 360.0 != 0.0:
        return ""
    share, options = 1.0, []
    for k, (name, size, a) in enumerate(zip("xy", own, operating.semi_axes, strict=True)):
        want = 2.0 * ENOUGH * a
        if size <= want:
            continue
        share *= want / size
        low = made.options.crop[2 * k] + 0.5 * (size - want)
        options.append(f"{group}.crop_{name}_min={low:.4g}")
        options.append(f"{group}.crop_{name}_max={low + want:.4g}")
    side = lengths.length(2.0 * ENOUGH * operating.hertz_radius, 2)
    return (
        f". A part of {ENOUGH:.0f} contacts ({side}) takes about {_time(share * seconds)}: "
        f"{', '.join(options)}"
    )


def _time(seconds: float) -> str:
    """Format a time in seconds, minutes or hours, to one digit."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * size:
            return f"{float(f'{seconds / size:.1g}'):g} {unit}"
    return f"{float(f'{seconds:.1g}'):g} s"


def unpredictable(settings: Settings) -> str:
    """Say why a resolved case has no prediction; '' if it has one."""
    if oblique(settings):
        return oblique(settings)
    groups = rough_groups(settings)
    if not groups:
        return "surface.kind = 'smooth': a prediction needs a rough surface"
    for group in groups:
        kind = str(settings[group]["kind"])
        if kind in FEATURES:
            return (
                f"{group}.kind = {kind!r}: a single feature passes once. A prediction is the mean "
                "friction of roughness that fills the contact\nexpected: 'pyehl run', or "
                f"{group}.kind = 'harmonic', 'map' or 'fractal'"
            )
    return ""


def oblique(settings: Settings) -> str:
    """Say why an ellipse has no response; '' if it is a circle, or contact.angle is 0."""
    angle = float(settings["contact"].get("angle", 0.0))
    if angle == 0.0 or contact_of(settings).radius_ratio == 1.0:
        return ""
    return (
        f"contact.angle = {angle:g}: the response of an elliptical contact is known only for "
        "an axis along the motion, not for an inlet that is oblique on the centre line\n"
        "expected: contact.angle = 0 (at 90 degrees with the radii exchanged), or 'pyehl run'"
    )


MAX_TRACKS = 10_000
"""Maximum number of tracks: the error of their mean is a hundredth of the spread."""


@blas.one_thread()
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
    """Predict the relative friction of a resolved case, also given as namelist `text`.

    `tracks` across the surface, 1 to `MAX_TRACKS`, are for mean and spread, not used for a line;
    `smooth` is a result folder with the smooth contact, otherwise `psd.smooth` applies; `surface`
    and `second_surface` are surfaces before their spectrum is cut and before they are moved to
    their track, by default those of the case. `brief`: mu_r/mu_s and its errors, bit for bit the
    same, but no tracks, only the band of the shortest waves, no search for a cut-off with which
    there is a ratio, and no other spectra.

    InputError if the surface is smooth or a single feature, a map is not usable, the conditions
    are outside the model, or the number of tracks is out of range; OSError if a map cannot be
    opened; EhlError if the smooth contact does not converge.
    """
    start = time.perf_counter()
    refuse_duty(settings)
    options = _options(settings, tracks)
    operating = contact_of(settings)
    lubricant = Lubricant.from_settings(settings, str(settings["psd"]["viscosity_law"]))
    contact = _contact(settings, operating, lubricant, options, smooth)
    films = contact
    if options.smooth == "solved" and not float(settings["psd"]["film_thickness"]) > 0.0:
        films = with_boundary_film(settings, contact, lubricant)
    film = films.central_film if math.isfinite(films.central_film) else contact.central_film
    given = {"surface": surface, "second_surface": second_surface}
    rough = _surfaces(settings, given, operating, film * operating.film_scale, brief=brief)
    model = Model(rough, contact, operating, lubricant, options)
    # all tracks of a strip pass through the contact at once
    tracks = 0 if brief or operating.ellipse.is_line else tracks
    waves = None if model.merged else model.components()
    outcome = run(model, tracks, brief=brief, waves=waves)
    if outcome.friction.status == BEYOND and not brief:
        message = outcome.friction.message + ways_into_range(model)
        outcome = outcome._replace(friction=replace(outcome.friction, message=message))
    sustained = sustained_by(model)
    below, together = _below(model, outcome.friction, sustained)
    if outcome.friction.status == "predicted" and below.deepest <= 0.0:
        # a breakdown between the positions of the passage
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
        else other_spectra(
            settings,
            surfaces.rough_groups(settings),
            lambda other: predict(other, smooth=smooth, brief=True),
        ),
    )


def _surfaces(
    settings: Mapping[str, Mapping[str, Any]],
    given: Mapping[str, surfaces.Topography | None],
    operating: AnyContact,
    film: float,
    *,
    brief: bool,
) -> tuple[RoughSurface, ...]:
    """Make the rough surfaces of a resolved case with a film h_c [m]."""
    rough, groups = [], surfaces.rough_groups(settings)
    others = 0 if any(given.values()) else other_spectra_count(settings, groups)
    for group in groups:
        values = settings[group]
        tile = given[group]
        if tile is None:
            tile = surfaces.from_settings({**settings, "surface": values}, operating, film)
        else:
            tile = surfaces.finished(tile, values)
        if not brief:
            report_cost(tile, operating, group, others)
        ratio, front = float(values["velocity_ratio"]), float(values["x_start"])
        rough.append(RoughSurface(tile, ratio, front, str(values["filter"]), (group,)))
    return tuple(rough)


def _below(
    model: Model, friction: RoughFriction, sustained: Sustained
) -> tuple[BelowZero, Together | None]:
    """Find where the film breaks down, and the sum of two surfaces that move together."""
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
    """Give a function that removes the spikes of a map above a threshold."""
    if len(model.surfaces) > 1:
        return None
    (one,) = model.surfaces
    group = settings[one.groups[0]]
    return lambda threshold: surfaces.without_spikes(one.topography, threshold, group)


def _options(settings: Mapping[str, Mapping[str, Any]], tracks: int) -> ModelOptions:
    """Read the options of the model; InputError if the case has no prediction."""
    if not 1 <= tracks <= MAX_TRACKS:
        raise InputError(
            f"tracks = {tracks}: expected 1 to {MAX_TRACKS}; the mean over {MAX_TRACKS} has an "
            "error of a hundredth of the spread"
        )
    why = unpredictable(settings)
    if why:
        raise InputError(why)
    options = ModelOptions.from_settings(settings)
    as_by_default = ModelOptions(positions=options.positions, film_limit=options.film_limit)
    if contact_of(settings).radius_ratio != 1.0 and options != as_by_default:
        raise InputError(
            "psd: the model of the paper, and mixtures of it with the response, are for circular "
            "contacts\nexpected: contact.radius, or the group psd as by default"
        )
    if options.as_in_paper and len(surfaces.rough_groups(settings)) > 1:
        raise InputError(
            "two rough surfaces: the model of the paper (psd.reduction = 'amplitude' with "
            "psd.smooth = 'hertz') is for one\nexpected: psd.reduction = 'response'"
        )
    if not options.as_in_paper and (options.load_balance or options.stiffness == "paper"):
        raise InputError(
            "psd.load_balance and psd.stiffness = 'paper' belong to the model of the paper: "
            "psd.reduction = 'amplitude' with psd.smooth = 'hertz'"
        )
    return options


def _contact(
    settings: Mapping[str, Mapping[str, Any]],
    operating: AnyContact,
    lubricant: Lubricant,
    options: ModelOptions,
    folder: str | os.PathLike[str] | None,
) -> SmoothContact:
    """Pressure and film of the smooth contact, from a result folder if one is given."""
    if folder is not None:
        contact = read_contact(Path(folder), operating, settings)
        if lubricant.shear.in_flow:
            contact = replace(contact, newtonian=solve_contact(settings).newtonian)
        return contact
    given = float(settings["psd"]["film_thickness"]) / operating.film_scale
    if options.smooth == "hertz":
        if given > 0.0:
            return hertz_contact(given, "psd.film_thickness")
        formula = formula_film(operating, lubricant) / operating.film_scale
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
