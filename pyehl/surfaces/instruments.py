# SPDX-License-Identifier: BSD-3-Clause
"""Read files of instruments with the package SurfaceTopography (extra ``surfaces``)."""

import io
import logging
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from pyehl.errors import EhlError, InputError, NoMemoryError
from pyehl.surfaces.arrays import Found, check_pixels
from pyehl.surfaces.variants import data_fields, nms_missing, plain_tmd, plain_x3p

INSTALL = "pip install 'pyehl[surfaces]', or pip install SurfaceTopography"
ADVICE = "; save the heights in m as .npy or text, and give surface.length_x and surface.length_y"
HEAD = 512
"""Number of first bytes that identify the format of a file."""
# Formats without a magic number: their readers accept any file of the right length
UNMARKED = {"nms": ".nms", "hgt": ".hgt"}
# Formats of plain text, which pyehl.surfaces.text_map reads line by line
TEXT = {"asc", "xyz"}
# By suffix, converters of valid files that the package reports as damaged
VARIANTS: dict[str, Callable[[bytes], bytes | None]] = {".x3p": plain_x3p, ".tmd": plain_tmd}
# These libraries log each format that they try and fail; without a handler it goes to the terminal
for _name in ("tifffile", "SurfaceTopography"):
    logging.getLogger(_name).addHandler(logging.NullHandler())


class UnknownFormatError(InputError):
    """SurfaceTopography does not know the format of a file."""


def read_instrument(path: Path, channel: str = "", text: bytes | None = None) -> Found:
    """Read the heights (nx, ny) of one channel of an instrument file, NaN where missing.

    The channel is a name, or a number from 1; empty: the first height channel of the file. `text`
    is the file as plain text in UTF-8, if its lines were read already.

    InputError with the reason of the reader if the package is missing, or the format of the file is
    unknown, or it is damaged, has no such channel, or is a profile along a line.
    """
    try:
        from SurfaceTopography.IO import (  # noqa: PLC0415 (heavy, and optional)
            MagicMatch,
            lookup_reader_by_format,
            readers,
        )
    except ImportError:
        raise InputError(
            f"{path}: files of instruments are read by the package SurfaceTopography, which is "
            f"not installed: {INSTALL}; or save the heights in m as .npy"
        ) from None
    try:
        # NumPy must not warn about damaged files
        with np.errstate(all="ignore"):
            if text is not None:
                return _read(path, lookup_reader_by_format["asc"], io.BytesIO(text), channel)
            return _first(path, _candidates(path, readers, MagicMatch), _source(path), channel)
    except EhlError:
        raise
    except Exception as error:
        if _is_of_the_system(error):
            raise
        raise InputError(
            f"{path}: cannot be read as a height map: {_reason(error)}{ADVICE}"
        ) from None


def _is_of_the_system(error: Exception) -> bool:
    """Whether a file could not be opened or read; readers raise OSError for its contents, too."""
    return isinstance(error, OSError) and error.errno is not None


def _source(path: Path) -> str | io.BytesIO:
    """Path of a file, or its contents converted to the variant that the package reads."""
    plain = VARIANTS.get(path.suffix.lower())
    data = None if plain is None else plain(path.read_bytes())
    return str(path) if data is None else io.BytesIO(data)


def _candidates(path: Path, readers: list[Any], match: Any) -> tuple[list[Any], bool]:  # noqa: ANN401
    """Readers for a file, the likely ones first, and whether its format is known.

    The format is known from its magic number, or assumed from the suffix of the file name.
    """
    with path.open("rb") as stream:
        head = stream.read(HEAD)
    suffix = path.suffix.lower()
    verdicts = {
        reader: reader.can_read(head)
        for reader in readers
        if reader.format() not in TEXT and UNMARKED.get(reader.format(), suffix) == suffix
    }
    sure = [reader for reader, verdict in verdicts.items() if verdict == match.YES]
    if sure:
        return sure, True
    maybe = [reader for reader, verdict in verdicts.items() if verdict != match.NO]
    named = [reader for reader in maybe if suffix.lstrip(".") in reader.file_extensions()]
    return named + [reader for reader in maybe if reader not in named], bool(named)


def _first(
    path: Path, candidates: tuple[list[Any], bool], source: str | io.BytesIO, channel: str
) -> Found:
    """Read with the first reader that succeeds; else raise the error of the most likely one."""
    readers, known = candidates
    reasons: list[str] = []
    for reader in readers:
        if isinstance(source, io.BytesIO):
            source.seek(0)
        try:
            return _read(path, reader, source, channel)
        except EhlError:
            raise
        except Exception as error:
            if _is_of_the_system(error):
                raise
            reasons.append(f"as {reader.name()}: {_reason(error)}")
    if known:
        raise InputError(f"{path}: cannot be read as a height map: {reasons[0]}{ADVICE}")
    raise UnknownFormatError(
        f"{path}: cannot be read as a height map: it is of no format that SurfaceTopography knows"
        f"{ADVICE}"
    )


def _reason(error: Exception) -> str:
    """Return the message of a reader in one line."""
    message = " ".join(str(error).split()).rstrip(".")
    if isinstance(error, KeyError):
        return f"there is no {message} in it" if message else "a part of it is missing"
    if isinstance(error, IndexError):
        return "it ends too early, or a part of it is missing"
    if isinstance(error, TypeError | AttributeError | AssertionError):
        return f"its reader fails ({type(error).__name__}: {message})"
    return message or type(error).__name__


def _read(path: Path, reader_class: Any, source: str | io.BytesIO, channel: str) -> Found:  # noqa: ANN401
    """Read a channel with one reader."""
    with reader_class(source) as reader:
        channels = list(reader.channels)
        if not channels and reader_class.format() == "gwy":
            return _bare(path, channel)
        if not channels:
            raise ValueError("it has no channel of heights")
        picked = _pick(path, channels, reader.default_channel, channel)
        shape = tuple(int(n) for n in picked.nb_grid_pts)
        _check_size(path, shape)
        name = str(picked.name)
        sizes = picked.physical_sizes
        scan = picked.topography(**({"physical_sizes": (1.0, 1.0)} if sizes is None else {}))
        named = scan.unit is not None
        if named:
            scan = scan.to_unit("m")
        masked: Any = np.ma.asarray(scan.heights(), dtype=float)
        result = Found(
            np.ascontiguousarray(masked.filled(np.nan), dtype=np.float64),
            height_unit=1.0 if named else None,
            is_periodic=bool(scan.is_periodic),
            channel=name,
        )
        if sizes is not None:
            x, y = (float(size) for size in scan.physical_sizes)
            result.size, result.size_in_metres, result.ask_lateral_unit = (x, y), named, not named
            result.no_size = "" if named else "the file names no unit of its size and heights"
    if reader_class.format() == "nms" and (missing := nms_missing(path)) is not None:
        result.heights[missing] = np.nan
    return result


def _bare(path: Path, wanted: str) -> Found:
    """Read heights of a Gwyddion file without units; the user must give the lateral unit."""
    fields = data_fields(path.read_bytes())
    other = {name: field.get("si_unit_z") for name, field in fields.items()}
    names = [name for name, unit in other.items() if not unit or not unit[1].get("unitstr")]
    if wanted.isdigit() and wanted not in names and 1 <= int(wanted) <= len(names):
        wanted = names[int(wanted) - 1]
    if not names or (wanted and wanted not in names):
        listing = ", ".join(f"{n} '{name}'" for n, name in enumerate(names, 1)) or "none"
        raise InputError(
            f"{path}: there is no such map of heights\nexpected: one of the channels {listing}"
        )
    name = wanted or names[0]
    field = fields[name]
    shape = int(field["yres"]), int(field["xres"])
    _check_size(path, shape[::-1])
    heights = np.ascontiguousarray(field["data"].reshape(shape).T, dtype=np.float64)
    return Found(
        heights,
        size=(abs(float(field["xreal"])), abs(float(field["yreal"]))),
        size_in_metres=False,
        ask_lateral_unit=True,
        channel=name,
        no_size="the file names no unit of its size and heights",
    )


def _check_size(path: Path, shape: tuple[int, ...]) -> None:
    """Refuse a map that is larger than the memory, or whose header states a wrong size."""
    try:
        check_pixels(str(path), (shape[0], shape[1]))
    except NoMemoryError:
        stored = path.stat().st_size
        if zipfile.is_zipfile(path):
            with zipfile.ZipFile(path) as archive:
                stored = sum(member.file_size for member in archive.infolist())
        if shape[0] * shape[1] > stored:
            raise InputError(
                f"{path}: its header states {shape[0]} x {shape[1]} points, but there are {stored} "
                "bytes in it: it is damaged"
            ) from None
        raise


def _pick(path: Path, channels: list[Any], default: Any, wanted: str) -> Any:  # noqa: ANN401
    listing = ", ".join(f"{n} '{c.name}'" for n, c in enumerate(channels, 1))
    if not wanted:
        # the default of the library is not always a height map
        maps = [c for c in channels if c.dim == 2 and c.is_height_channel]
        picked = default if default in maps or not maps else maps[0]
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
