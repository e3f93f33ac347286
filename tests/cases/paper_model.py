# SPDX-License-Identifier: BSD-3-Clause
"""The model of Zhang et al. 2019, section 3, for one tile: short calls for tests."""

from dataclasses import replace

from pyehl.contact.smooth import hertz_contact
from pyehl.prediction import Band, ModelOptions, Response, RoughFriction
from pyehl.prediction.friction import run
from pyehl.prediction.model import Model
from pyehl.surfaces import Topography
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint


def passage(
    tile: Topography,
    operating: OperatingPoint,
    oil: Lubricant,
    film: float,
    options: ModelOptions | None = None,
) -> Model:
    """A tile in a semi-ellipse of pressure and a uniform film [m]."""
    read = replace(options or ModelOptions(), reduction="amplitude", smooth="hertz")
    contact = hertz_contact(film / operating.film_scale, "given")
    return Model.of_one(tile, contact, operating, oil, read, 1.01)


def predict_friction(
    tile: Topography,
    operating: OperatingPoint,
    oil: Lubricant,
    film: float,
    options: ModelOptions | None = None,
) -> RoughFriction:
    """Friction over a passage."""
    return run(passage(tile, operating, oil, film, options), 0, brief=True)[0]


def contributions(
    tile: Topography, operating: OperatingPoint, oil: Lubricant, film: float
) -> list[Band]:
    """Contribution of each octave."""
    return run(passage(tile, operating, oil, film), 0)[2]


def response(
    tile: Topography, operating: OperatingPoint, options: ModelOptions | None = None
) -> Response:
    """Pressure and deformed roughness of a tile in a film of one metre."""
    return predict_friction(tile, operating, Lubricant(), 1.0, options).response
