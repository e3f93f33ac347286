# SPDX-License-Identifier: BSD-3-Clause
"""The result folder of a prediction."""

from __future__ import annotations

import csv
import json
import os
import shutil
import tempfile
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pyehl.prediction.result import Prediction

__all__ = ["write"]


def write(
    prediction: Prediction,
    folder: str | Path,
    *,
    draw: Callable[[Prediction, Path], None] | None = None,
) -> None:
    """Write the result folder, whole or not at all.

    Files: ``case.nml`` (resolved), ``summary.json``, ``passage.csv``, ``spectrum.csv``,
    ``bands.csv`` and, first index along x: ``x.npy`` (nx,), ``y.npy`` (ny,), ``surface.npy``,
    ``deformed.npy`` [m], ``delta_p.npy`` [Pa], (nx, ny); `draw` may add pictures
    to the folder.

    Raises
    ------
    FileExistsError
        If the folder holds something other than an earlier result.
    OSError
        If it cannot be written.
    """

    def fill(target: Path) -> None:
        (target / "case.nml").write_text(prediction.case_text.rstrip() + "\n", encoding="utf-8")
        _write_files(prediction, target)
        if draw is not None:
            draw(prediction, target)

    _write_folder(Path(folder), fill)


def _write_files(prediction: Prediction, target: Path) -> None:
    text = json.dumps(prediction.summary, indent=2, allow_nan=False)
    (target / "summary.json").write_text(text + "\n", encoding="utf-8")
    for name, columns in prediction.tables.items():
        _write_csv(target / f"{name}.csv", tuple(columns), zip(*columns.values(), strict=True))
    for name, values in prediction.arrays.items():
        np.save(target / f"{name}.npy", values)


def _write_csv(
    path: Path, names: Sequence[str], rows: Iterable[Sequence[float] | NDArray[np.float64]]
) -> None:
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(names)
        writer.writerows([repr(float(value)) for value in row] for row in rows)


def _write_folder(folder: Path, write: Callable[[Path], None]) -> None:
    """Fill a new folder beside `folder`, then put it in its place."""
    folder = Path(os.path.abspath(folder))
    if folder.exists():
        if not folder.is_dir():
            raise FileExistsError(f"{folder}: exists and is not a folder")
        if any(folder.iterdir()) and not (folder / "summary.json").is_file():
            raise FileExistsError(f"{folder}: not empty and not a result folder; choose another")
    folder.parent.mkdir(parents=True, exist_ok=True)
    fresh = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent))
    try:
        write(fresh)
        # mkdtemp makes private folders; results are as open as the user's other files
        mask = os.umask(0)
        os.umask(mask)
        fresh.chmod(0o777 & ~mask)
        if folder.exists():
            old = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent))
            folder.rename(old / "old")
            fresh.rename(folder)
            shutil.rmtree(old)
        else:
            fresh.rename(folder)
    except BaseException:
        shutil.rmtree(fresh, ignore_errors=True)
        raise
