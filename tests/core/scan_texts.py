# SPDX-License-Identifier: BSD-3-Clause
"""Heights as text, and a comparison of a file that is read with them."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
import scipy.ndimage

from pyehl.surfaces import read_scan

NX, NY, STEP = 20, 14, 1.5
SIZE = (NX * STEP * 1e-6, NY * STEP * 1e-6)
MISSING = ((5, 3), (0, 7), (19, 7), (19, 13))


def smooth() -> np.ndarray:
    """Heights [um], rms 50 nm: no line is straight."""
    z = scipy.ndimage.gaussian_filter(np.random.default_rng(1).normal(size=(NX, NY)), 1.5)
    return np.round(0.05 * z / z.std(), 5)


Z = smooth()


def lines(
    separator: str = "\t", word: str | None = None, *, decimal: str = ".", quoted: bool = False
) -> list[str]:
    """Lines along x; a word replaces some points."""
    done = []
    for j in range(NY):
        cells = [f"{v:.5f}".replace(".", decimal) for v in Z[:, j]]
        if word is not None:
            cells = [word if (i, j) in MISSING else cell for i, cell in enumerate(cells)]
        done.append(separator.join(f'"{cell}"' if quoted else cell for cell in cells))
    return done


def write(path: Path, text: Sequence[str], encoding: str = "utf-8", end: str = "\n") -> Path:
    path.write_bytes((end.join(text) + end).encode(encoding))
    return path


def check(path: Path, missing: Sequence[tuple[int, int]] = (), **keys: object) -> str:
    """Shape, size and heights of the file are those of `Z`; returns the note."""
    scan = read_scan(path, **keys)
    assert scan.heights.shape == (NX, NY)
    assert (scan.length_x, scan.length_y) == pytest.approx(SIZE, rel=1e-9)
    assert [tuple(place) for place in np.argwhere(np.isnan(scan.heights))] == sorted(missing)
    there = np.isfinite(scan.heights)
    assert scan.heights[there] == pytest.approx(1e-6 * Z[there], abs=1e-14)
    return scan.note


GWYDDION = ["# Channel: Z", "# Width: 30 µm", "# Height: 21 µm", "# Value units: µm"]


def points(scale: float = 1.0, form: str = "{:.6g};{:.6g};{:.5f}") -> list[str]:
    """List of x, y and z, positions in other units."""
    return [
        form.format(scale * STEP * i, scale * STEP * j, Z[i, j])
        for j in range(NY)
        for i in range(NX)
    ]
