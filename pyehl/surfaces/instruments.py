# SPDX-License-Identifier: BSD-3-Clause
"""Files of instruments, by the package SurfaceTopography (extra ``surfaces``)."""

import io
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

import numpy as np

from pyehl.errors import EhlError, InputError
from pyehl.surfaces.memory import check_pixels
from pyehl.types import Array

INSTALL = "pip install 'pyehl[surfaces]', or pip install SurfaceTopography"

Sizes = tuple[float | None, float | None]
# Heights, size, whether it is periodic, name of the channel, note
Foreign = tuple[Array, Sizes, bool, str, str]


class UnknownFormatError(InputError):
    """A file is of no format that SurfaceTopography knows, or lacks the unit of its size."""


def read_instrument(path: Path, channel: str = "") -> Foreign:
    """Heights (nx, ny) [m] of one channel of an instrument file, NaN where missing.

    The channel is a name, or a number from 1; empty: the file's first height channel. Also the size
    of the file [m] or (None, None), whether it says that the map is periodic, the name of the
    channel, and a note that heights were taken in m, for a file that names neither a size nor a
    unit.

    InputError if the package is missing, the file is of no kind that it knows, has no such
    channel, is a profile along a line, or has a size without a unit.
    """
    try:
        from SurfaceTopography.IO import open_topography  # noqa: PLC0415 (heavy, and optional)
    except ImportError:
        raise InputError(
            f"{path}: files of instruments are read by the package SurfaceTopography, which is "
            f"not installed: {INSTALL}; or save the heights in m as .npy"
        ) from None
    try:
        # every reader has errors of its own, for files that are damaged, too
        with _unheard(), open_topography(str(path)) as reader:
            picked = _pick(path, list(reader.channels), reader.default_channel, channel)
            check_pixels(str(path), tuple(picked.nb_grid_pts))
            name = str(picked.name)
            sized = picked.physical_sizes is not None
            scan = picked.topography(**({} if sized else {"physical_sizes": (1.0, 1.0)}))
    except (EhlError, OSError):
        raise
    except Exception as error:
        reason = str(error).strip().partition("\n")[0] or type(error).__name__
        kind = InputError
        if isinstance(error, LookupError | TypeError | AttributeError):
            reason = "it is damaged, or not of the format that it seems to be of"
        if type(error).__name__ == "CannotDetectFileFormat":
            kind, reason = UnknownFormatError, "it is of no format that SurfaceTopography knows"
        raise kind(
            f"{path}: cannot be read as a height map: {reason}; save the heights in m as .npy "
            "or text, and give surface.length_x and surface.length_y"
        ) from None
    note = ""
    if scan.unit is not None:
        scan = scan.to_unit("m")
    elif sized:
        raise UnknownFormatError(
            f"{path}: the file names no unit of its size and heights; save its heights in m as "
            ".npy or text, and give surface.length_x and surface.length_y"
        )
    else:
        note = "the file names no unit: its heights are taken in m"
    masked: Any = np.ma.asarray(scan.heights(), dtype=float)
    heights = np.ascontiguousarray(masked.filled(np.nan), dtype=np.float64)
    size: Sizes = (None, None)
    if sized:
        size = (float(scan.physical_sizes[0]), float(scan.physical_sizes[1]))
    return heights, size, bool(scan.is_periodic), name, note


@contextmanager
def _unheard() -> Iterator[None]:
    """Keep what readers warn of, log and print off the terminal: they try one format by another."""
    nowhere = io.StringIO()
    with warnings.catch_warnings(), redirect_stdout(nowhere), redirect_stderr(nowhere):
        warnings.simplefilter("ignore")
        yield


def _pick(path: Path, channels: list[Any], default: Any, wanted: str) -> Any:  # noqa: ANN401
    listing = ", ".join(f"{n} '{c.name}'" for n, c in enumerate(channels, 1))
    if not wanted:
        # the library's default is mostly, not always, the first that can serve
        serving = [c for c in channels if c.dim == 2 and c.is_height_channel]
        picked = default if default in serving or not serving else serving[0]
    else:
        named = [c for c in channels if str(c.name) == wanted]
        if not named and wanted.isdigit() and 1 <= int(wanted) <= len(channels):
            named = [channels[int(wanted) - 1]]
        if not named:
            raise InputError(
                f"{path}: surface.channel = '{wanted}': there is no such channel\n"
                f"expected: one of the channels {listing}, by name or number"
            )
        picked = named[0]
    if picked.dim == 1:
        raise InputError(
            f"{path}: channel '{picked.name}' is a profile along a line; a contact needs the map "
            f"of an area; the channels are {listing}"
        )
    if picked.dim != 2 or not picked.is_height_channel:
        raise InputError(
            f"{path}: channel '{picked.name}' is not a height map; the channels are {listing}"
        )
    return picked
