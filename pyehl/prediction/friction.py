# SPDX-License-Identifier: BSD-3-Clause
"""mu_r/mu_s over a passage of a tile."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pyehl.errors import InputError
from pyehl.prediction.contact import Contact, ShearedContact
from pyehl.prediction.flattening import Response, response
from pyehl.prediction.options import Options
from pyehl.prediction.passage import friction_along, working_grid
from pyehl.surfaces import Topography, interpolated
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

__all__ = ["TRACKS", "RoughFriction", "broken", "passed", "predict_friction"]

Array = NDArray[np.float64]

TRACKS = 8
"""Tracks over which mean and spread are taken unless asked for otherwise."""


@dataclass(frozen=True, slots=True)
class RoughFriction:
    """Friction over one passage of the tile."""

    # ``"predicted"``, ``"film breakdown"``, ``"beyond linear response"``, ``"overflow"`` or ``"load
    # lost"``. Unless ``"predicted"`` the ratios are NaN
    status: str
    message: str  # the status in a sentence
    # mean, least and greatest mu_r/mu_s over the passage [-]; the extremes of the trigonometric
    # interpolant through the positions
    mu_ratio: float
    mu_ratio_min: float
    mu_ratio_max: float
    # What half as many positions would miss at the others, relative to the mean: an upper estimate
    # of what the positions leave undecided. NaN for an odd number of them
    position_error: float
    shift: Array  # (n,) how far the tile has moved [m], equally spaced over its length
    passage: Array  # (n,) mu_r/mu_s there [-]
    # Friction coefficient of the smooth contact at the slide-to-roll ratio [-]; without meaning for
    # a Newtonian lubricant
    mu_smooth: float
    film_min: float  # least h_c - rr_d of the tile [m]
    cavitated_share: float  # mean share of the contact where p_s + delta p <= 0 [-]
    cavitated_friction: float  # bound of the share of the friction that comes from there [-]
    # Greatest |integral of delta p|/w over the passage [-], before any load balance
    load_error: float
    response: Response  # delta p and deformed roughness on the grid of the given tile


def predict_friction(
    topography: Topography,
    operating: OperatingPoint,
    lubricant: Lubricant,
    film: float,
    options: Options | None = None,
) -> RoughFriction:
    """mu_r/mu_s over one passage of a rough tile through a contact.

    The pixel [0, 0] of the tile starts at the centre of the contact and moves along x; `film` is
    the smooth central film h_c [m], taken to be the film everywhere in the contact. The status is
    ``"predicted"`` unless the model does not hold, see :mod:`pyehl.prediction`. InputError if the
    film is not positive, or the conditions have no amplitude reduction (L = 0).

    delta p and rr_d belong to the tile and are computed once; only the semi-ellipse and the film
    are met anew at each position, inside the circle alone. Positions are whole pixels of the
    working grid, so that moving the tile is a copy. The ratio along the passage is smooth, because
    the viscosity confines the friction to the middle of the contact (for table 1 a Gaussian of
    standard deviation 0.24 a): its mean over 8 positions of a tile of 2 a is right to 1e-7. A tile
    much shorter than the contact is visited at a stride. A coarse map, or one whose pixels do not
    divide into positions, is first interpolated by its Fourier series.
    """
    options = options or Options()
    if not (math.isfinite(film) and film > 0.0):
        raise InputError(f"film thickness must be positive [m], not {film!r}")
    field = response(topography, operating, options)
    grid = working_grid(topography, operating, options.positions)
    work = field if grid is topography else response(grid, operating, options)
    with np.errstate(over="ignore", invalid="ignore"):
        contact = Contact(
            work,
            grid.pixel,
            operating=operating,
            lubricant=lubricant,
            film=film,
            options=options,
        )
        passage = friction_along(contact, grid.shape[0], options.positions)

    status, message = "predicted", "full film throughout the passage"
    if contact.thinnest <= 0.0:
        status = "film breakdown"
        message = (
            f"deformed roughness reaches {film - contact.thinnest:.3g} m in a film of "
            f"{film:.3g} m: no full film, no ratio"
        )
    elif not np.all(np.isfinite(passage[1])):
        if options.load_balance and contact.imbalance >= 1.0:
            status, message = "load lost", "the roughness pressure exceeds the load"
        else:
            status, message = "overflow", "the viscosity at p_s + delta p is not a number"
    outcome = status, message
    return passed(contact, outcome, passage, pixel=grid.pixel[0], film_unit=1.0, response=field)


def passed(
    contact: ShearedContact,
    outcome: tuple[str, str],
    passage: tuple[NDArray[np.int_], Array, float],
    *,
    pixel: float,
    film_unit: float,
    response: Response,
) -> RoughFriction:
    """Put together what a contact has met in a passage, with its status and message.

    `passage` is what :func:`pyehl.prediction.passage.friction_along` gives; a pixel along the
    motion and the unit of films are in m.
    """
    steps, ratios, error = passage
    status, message = outcome
    mean = least = greatest = math.nan
    if status == "predicted":
        fine = interpolated(ratios, 8)
        mean, least, greatest = (float(v) for v in (ratios.mean(), fine.min(), fine.max()))
    return RoughFriction(
        status=status,
        message=message,
        mu_ratio=mean,
        mu_ratio_min=least,
        mu_ratio_max=greatest,
        position_error=error,
        shift=np.asarray(steps * pixel, dtype=np.float64),
        passage=ratios,
        mu_smooth=contact.mu_smooth(),
        film_min=float(contact.thinnest) * film_unit,
        cavitated_share=contact.cavitated / max(1, contact.count * contact.points),
        cavitated_friction=contact.cavitated_bound(least) if status == "predicted" else math.nan,
        load_error=contact.imbalance,
        response=response,
    )


def broken(friction: RoughFriction, film: float) -> RoughFriction:
    """Return a prediction whose film ends between its positions: least film [m], no ratio."""
    return replace(
        friction,
        status="film breakdown",
        message=f"deformed roughness reaches {-film:.3g} m through the film: no full film",
        mu_ratio=math.nan,
        mu_ratio_min=math.nan,
        mu_ratio_max=math.nan,
        position_error=math.nan,
        film_min=film,
        cavitated_friction=math.nan,
    )
