# SPDX-License-Identifier: BSD-3-Clause
"""Files of instruments, by the package SurfaceTopography (extra ``surfaces``)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl.surfaces.memory import check_pixels

__all__ = ["read_instrument"]

INSTALL = "pip install 'pyehl[surfaces]', or pip install SurfaceTopography"


def read_instrument(
    path: Path, channel: str = "", *, with_size: bool = False
) -> tuple[NDArray[np.float64], tuple[float | None, float | None], bool, str]:
    """Heights of one channel of an instrument file.

    Parameters
    ----------
    path
        Of the file; its format is known by its content.
    channel
        Name, or number from 1; empty: the file's first height channel.
    with_size
        Whether the caller knows the size, so that a file without one is good enough.

    Returns
    -------
    heights
        (nx, ny) [m], NaN where missing.
    size
        (length_x, length_y) [m]; (None, None) where the file has none.
    is_periodic
        Whether the file says so.
    name
        Of the channel.

    Raises
    ------
    ValueError
        If the package is missing, the file is of no kind that it knows, has no such channel, or
        names no unit.
    """
    try:
        from SurfaceTopography.IO import open_topography  # noqa: PLC0415 (heavy, and optional)
    except ImportError:
        raise ValueError(
            f"{path}: files of instruments are read by the package SurfaceTopography, which is "
            f"not installed: {INSTALL}; or save the heights in m as .npy"
        ) from None
    try:
        # every reader has errors of its own, for files that are damaged, too
        with open_topography(str(path)) as reader:
            picked = _pick(path, list(reader.channels), reader.default_channel, channel)
            check_pixels(str(path), tuple(picked.nb_grid_pts))
            name = str(picked.name)
            sized = picked.physical_sizes is not None
            options: dict[str, Any] = {}
            if not sized and with_size:
                options["physical_sizes"] = (1.0, 1.0)
            scan = picked.topography(**options)
    except OSError:
        raise
    except _UnusableError as error:
        raise ValueError(str(error)) from None
    except Exception as error:
        reason = str(error).strip().partition("\n")[0] or type(error).__name__
        if type(error).__name__ == "CannotDetectFileFormat":
            reason = "it is of no format that SurfaceTopography knows"
        raise ValueError(
            f"{path}: cannot be read as a height map: {reason}; save the heights in m as .npy "
            "or text, and give surface.length_x and surface.length_y"
        ) from None
    if scan.unit is None:
        raise ValueError(
            f"{path}: the file names no unit; save its heights in m as .npy or text, and give "
            "surface.length_x and surface.length_y"
        )
    scan = scan.to_unit("m")
    masked: Any = np.ma.asarray(scan.heights(), dtype=float)
    heights = np.ascontiguousarray(masked.filled(np.nan), dtype=np.float64)
    size: tuple[float | None, float | None] = (None, None)
    if sized:
        size = (float(scan.physical_sizes[0]), float(scan.physical_sizes[1]))
    return heights, size, bool(scan.is_periodic), name


class _UnusableError(Exception):
    """A channel that cannot serve, in words for a person."""


def _pick(path: Path, channels: list[Any], default: Any, wanted: str) -> Any:  # noqa: ANN401
    """Return the channel of a name or number."""
    listing = ", ".join(f"{n} '{c.name}'" for n, c in enumerate(channels, 1))
    if not wanted:
        picked = default
    else:
        named = [c for c in channels if str(c.name) == wanted]
        if not named and wanted.isdigit() and 1 <= int(wanted) <= len(channels):
            named = [channels[int(wanted) - 1]]
        if not named:
            raise _UnusableError(
                f"{path}: surface.channel = '{wanted}': there is no such channel\n"
                f"expected: one of the channels {listing}, by name or number"
            )
        picked = named[0]
    if picked.dim != 2 or not picked.is_height_channel:
        raise _UnusableError(
            f"{path}: channel '{picked.name}' is not a height map; the channels are {listing}"
        )
    return picked
