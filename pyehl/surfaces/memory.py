# SPDX-License-Identifier: BSD-3-Clause
"""Whether a surface fits into the memory, before it is read or made."""

import logging

from pyehl import library
from pyehl.errors import NoMemoryError

WORKING_COPIES, PREDICTION_COPIES = 12, 28
"""Arrays of the size of the map that its preparation holds at once, and of the size of a made tile
that a prediction does, spectra included."""
LARGE = 1e9
"""Bytes from which on the need is reported."""

_LOG = logging.getLogger(__name__)


def check_pixels(
    origin: str,
    pixels: tuple[int, int],
    tiles: int = 1,
    *,
    copies: int = WORKING_COPIES,
    way: str = "a part of the map, in a file of its own",
) -> None:
    """Refuse a surface that the memory that is free cannot hold while it is worked on.

    A map (nx, ny), called `origin`, of which a tile has `tiles` times as many pixels (4:
    mirrored), and so many copies are held at once; `way` says what would do. NoMemoryError with
    the bytes needed and free.
    """
    need = 8.0 * pixels[0] * pixels[1] * tiles * copies
    images = " with their mirror images" if tiles > 1 else ""
    what = f"{origin}: work on {pixels[0]} x {pixels[1]} heights{images}"
    try:
        library.check_memory(what, need)
    except NoMemoryError as error:
        raise NoMemoryError(f"{error}\nexpected: {way}") from None
    if need > LARGE:
        _LOG.info("%s takes up to %.1f GB of memory", what, need / 1e9)
