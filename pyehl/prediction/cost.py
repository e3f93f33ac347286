# SPDX-License-Identifier: BSD-3-Clause
"""What a prediction takes, said before it begins, and the part of a large map that is enough."""

import logging
import math

from pyehl import lengths
from pyehl.prediction.model import PIXEL_POINTS
from pyehl.prediction.spectrum import WORKING_PIXELS
from pyehl.surfaces import Topography
from pyehl.theory.operating import OperatingPoint

LOG = logging.getLogger(__name__)

PER_PIXEL = 1.5e-5
"""Seconds per pixel of the tile that is worked on, of one core of 2020, to a factor of two."""
PER_POINT = 1e-4
"""And per point of the contact."""
REPORTED = 10.0
"""Seconds from which on they are reported."""
BRIEF = 0.36
"""Share of the time that a prediction without tracks and bands takes, as those with other spectra
are that stand beside one with a finish: 0.3 to 0.4 with cases/finish.nml and a gear flank."""
SMALL = 0.02
"""Contacts along each side of a map that has to be repeated very often."""
ENOUGH = 3.0
"""Contacts, along each side, of a part that is offered in place of a larger map."""


def seconds_of(tile: Topography, operating: OperatingPoint) -> float:
    """Seconds that the prediction of a tile takes, to a factor of two."""
    sides = list(zip(tile.shape, tile.size, operating.semi_axes, strict=True))
    pixels = math.prod(max(n, size / a * WORKING_PIXELS) for n, size, a in sides)
    # points in the contact, no fewer than tiles across the motion
    a = operating.hertz_radius
    points = math.pi * a * operating.semi_axis_y / min(a / PIXEL_POINTS, *tile.size) ** 2
    return PER_PIXEL * pixels + PER_POINT * points


def report_cost(
    tile: Topography, operating: OperatingPoint, group: str = "surface", beside: int = 0
) -> None:
    """Describe what a large tile takes, and which part of its map is enough.

    `beside` is the number of brief predictions of other spectra.
    """
    seconds = seconds_of(tile, operating) * (1.0 + BRIEF * beside)
    if seconds < REPORTED:
        return
    made = tile.preparation
    images = 2 if made is not None and made.options.edges == "mirror" else 1
    # as it lies in the contact: along the motion, across it
    own = [size / images for size in tile.size]
    contacts = [size / (2.0 * a) for size, a in zip(own, operating.semi_axes, strict=True)]
    text = (
        f"{tile.origin}: {tile.shape[0]} x {tile.shape[1]} pixels"
        f"{', mirror images included,' if images > 1 else ''} take about {_time(seconds)}"
    )
    if max(contacts) > 2.0 * ENOUGH:
        text += f"; the map is {contacts[0]:.0f} x {contacts[1]:.0f} contacts long and wide"
        text += _part(tile, operating, own, seconds, group)
    elif max(contacts) < SMALL:
        text += (
            f"; the map is {lengths.size(own[0], own[1], 3)} and the contact "
            f"{lengths.length(2.0 * operating.hertz_radius, 2)} long: a larger map takes less"
        )
    LOG.info(text)


def _part(
    tile: Topography, operating: OperatingPoint, own: list[float], seconds: float, group: str
) -> str:
    """Offer the middle of a map as read, where it was not turned."""
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
    """Seconds, minutes or hours, to a digit."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * size:
            return f"{float(f'{seconds / size:.1g}'):g} {unit}"
    return f"{float(f'{seconds:.1g}'):g} s"
