# SPDX-License-Identifier: BSD-3-Clause
"""Whether a map fits into the memory of this machine, before it is read."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

__all__ = ["available_bytes", "check_pixels"]

WORKING_COPIES = 12
"""Arrays of the size of the tile that a prediction holds at once, spectra included."""


def available_bytes(root: Path = Path("/")) -> int:
    """Return the memory that this process can use without swapping [bytes].

    What the machine has left, or its control groups if that is less. Files are read below `root`.
    """
    free = _words(root / "proc/meminfo").get("MemAvailable:")
    # elsewhere than on Linux: all of the memory, which is more than there is
    pages = int(os.sysconf("SC_PHYS_PAGES")) * int(os.sysconf("SC_PAGE_SIZE"))
    return min([pages if free is None else 1024 * free, *_left_in_groups(root)])


def _left_in_groups(root: Path) -> Iterator[int]:
    """Give what the limits of the control groups of this process leave [bytes]; file pages go."""
    try:
        lines = (root / "proc/self/cgroup").read_text(encoding="utf-8").splitlines()
    except OSError:
        return
    for line in lines:
        _, kind, path = line.split(":", 2)
        if kind not in ("", "memory"):
            continue
        mount = root / "sys/fs/cgroup" / kind
        limit, used = ("max", "current") if kind == "" else ("limit_in_bytes", "usage_in_bytes")
        for group in (PurePosixPath(path), *PurePosixPath(path).parents):
            place = mount / group.relative_to("/")
            try:
                most, now = (int((place / f"memory.{n}").read_text()) for n in (limit, used))
            except (OSError, ValueError):
                continue  # no such group here, or no limit
            yield most - now + _words(place / "memory.stat").get("inactive_file", 0)


def _words(path: Path) -> dict[str, int]:
    """First words of the lines of a file, with the whole number behind each; none without it."""
    try:
        lines = [line.split() for line in path.read_text(encoding="ascii").splitlines()]
    except OSError:
        return {}
    return {words[0]: int(words[1]) for words in lines if len(words) > 1 and words[1].isdigit()}


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
