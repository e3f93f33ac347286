# SPDX-License-Identifier: BSD-3-Clause
"""Whether a map fits into the memory of this machine, before it is read."""

from __future__ import annotations

import os
from pathlib import Path

__all__ = ["available_bytes", "check_pixels"]

WORKING_COPIES = 12
"""Arrays of the size of the tile that a prediction holds at once, spectra included."""


def available_bytes() -> int:
    """Return the memory that can be used without swapping [bytes]."""
    try:
        for line in Path("/proc/meminfo").read_text(encoding="ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return int(line.split()[1]) * 1024
    except (OSError, ValueError):
        pass
    # elsewhere than on Linux: all of the memory, which is more than there is
    return int(os.sysconf("SC_PHYS_PAGES")) * int(os.sysconf("SC_PAGE_SIZE"))


def check_pixels(origin: str, pixels: tuple[int, int], tiles: int = 1) -> None:
    """Refuse a map that this machine cannot work on.

    Parameters
    ----------
    origin
        Name of the map, for the message.
    pixels
        (nx, ny) of the map.
    tiles
        How many times as many pixels the tile has (4: mirrored).

    Raises
    ------
    ValueError
        With the number of bytes needed and available.
    """
    need = 8 * pixels[0] * pixels[1] * tiles * WORKING_COPIES
    have = available_bytes()
    if need > have:
        raise ValueError(
            f"{origin}: {pixels[0]} x {pixels[1]} heights"
            f"{' with their mirror images' if tiles > 1 else ''} take {need / 2**30:.3g} GiB to "
            f"work on, {have / 2**30:.3g} GiB are available; take a part of the map by "
            "surface.crop_x_min, crop_x_max, crop_y_min, crop_y_max"
        )
