# SPDX-License-Identifier: BSD-3-Clause
"""Height maps from files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl.surfaces.tile import MAX_PIXELS, Topography

__all__ = ["read_map"]

Array = NDArray[np.float64]

# Heights, pixels and tiles outside these bands [m] are unit mistakes
RMS_BAND = (1e-10, 1e-4)
PIXEL_BAND = (1e-10, 1e-3)


def read_map(
    path: str | Path, length_x: float | None = None, length_y: float | None = None
) -> Topography:
    """Height map from a file, mean removed.

    Parameters
    ----------
    path
        ``.npy`` (never pickled), text (``.txt``, ``.csv``, ``.dat``, ``.asc``: one x per line, y
        along the line, separated by blanks, commas or semicolons), heights in m; or any format
        that the package SurfaceTopography reads, which then also gives units and size.
    length_x, length_y
        Size of the tile [m]. Needed for ``.npy`` and text; other formats carry their own, and a
        length given here replaces it.

    Raises
    ------
    OSError
        If the file cannot be opened.
    ValueError
        If it is no matrix of numbers, has holes, is too large, or its heights or pixels are so
        large or small that the unit must be wrong.
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"{path}: no such height map")
    suffix = path.suffix.lower()
    if suffix == ".npy":
        heights = _read_npy(path)
    elif suffix in (".txt", ".csv", ".dat", ".asc", ".xyz", ""):
        heights = _read_text(path)
    else:
        heights, size_x, size_y = _read_instrument(path)
        length_x = size_x if length_x is None else length_x
        length_y = size_y if length_y is None else length_y
    if length_x is None or length_y is None:
        raise ValueError(f"{path}: length_x and length_y [m] are needed, the file has no size")
    topography = Topography(heights, length_x, length_y, str(path))
    _check_plausible(topography)
    centred = np.ascontiguousarray(heights - heights.mean())
    return Topography(centred, length_x, length_y, str(path))


def _read_npy(path: Path) -> Array:
    try:
        # mapped, so that the header is checked before the data are read
        raw = np.load(path, mmap_mode="r", allow_pickle=False)
    except (ValueError, EOFError) as error:
        raise ValueError(f"{path}: not a readable .npy file of numbers: {error}") from None
    if raw.ndim != 2:
        raise ValueError(f"{path}: heights must be a matrix (nx, ny), not of shape {raw.shape}")
    if raw.dtype.kind not in "fiu":
        raise ValueError(f"{path}: heights must be real numbers, not {raw.dtype}")
    if raw.size > MAX_PIXELS:
        raise ValueError(f"{path}: {raw.size} heights, more than {MAX_PIXELS}")
    return np.array(raw, dtype=float, order="C")


def _read_text(path: Path) -> Array:
    if path.stat().st_size > 32 * MAX_PIXELS:
        raise ValueError(f"{path}: the file is too large for a map of {MAX_PIXELS} heights")
    rows: list[Array] = []
    with path.open(encoding="utf-8", errors="replace") as lines:
        for number, line in enumerate(lines, 1):
            text = line.partition("#")[0].replace(";", " ").replace(",", " , ")
            words = text.split()
            # "1,2 3,4" would otherwise be read as four heights
            commas = words.count(",")
            if not words:
                continue
            numbers = [w for w in words if w != ","]
            if commas and commas not in (len(numbers) - 1, len(numbers)):
                raise ValueError(
                    f"{path}:{number}: commas and blanks both separate the numbers; if the comma "
                    "is a decimal comma, write a point"
                )
            try:
                row = np.array([float(w) for w in numbers])
            except ValueError as error:
                raise ValueError(f"{path}:{number}: {error}") from None
            if rows and row.size != rows[0].size:
                raise ValueError(
                    f"{path}:{number}: {row.size} heights, but {rows[0].size} in the lines above"
                )
            rows.append(row)
    if not rows:
        raise ValueError(f"{path}: no heights in the file")
    return np.array(rows)


def _read_instrument(path: Path) -> tuple[Array, float, float]:
    try:
        from SurfaceTopography import read_topography  # noqa: PLC0415
    except ImportError:
        raise ValueError(
            f"{path}: files of this kind are read by the package SurfaceTopography, which is not "
            "installed: pip install SurfaceTopography, or save the heights in m as .npy"
        ) from None
    scan = read_topography(str(path)).to_unit("m")
    masked: np.ma.MaskedArray[Any, np.dtype[np.float64]]
    masked = np.ma.asarray(scan.heights(), dtype=float)
    size_x, size_y = scan.physical_sizes
    return np.asarray(masked.filled(np.nan), dtype=float), float(size_x), float(size_y)


def _check_plausible(topography: Topography) -> None:
    """Refuse what can only be a mistake of units."""
    rms = topography.rms_height
    if not RMS_BAND[0] <= rms <= RMS_BAND[1]:
        raise ValueError(
            f"{topography.origin}: rms height {rms:.3g} m is outside {RMS_BAND[0]:g} ... "
            f"{RMS_BAND[1]:g} m; are the heights in m?"
        )
    for name, pixel in zip(("length_x", "length_y"), topography.pixel, strict=True):
        if not PIXEL_BAND[0] <= pixel <= PIXEL_BAND[1]:
            raise ValueError(
                f"{topography.origin}: {name} gives a pixel of {pixel:.3g} m, outside "
                f"{PIXEL_BAND[0]:g} ... {PIXEL_BAND[1]:g} m; is the length in m?"
            )
