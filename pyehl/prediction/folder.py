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

import f90nml
import numpy as np
from numpy.typing import NDArray

from pyehl.prediction.bands import Band
from pyehl.prediction.of_case import Prediction
from pyehl.surfaces import psd_isotropic
from pyehl.theory.amplitude import component_amplitude_ratio

__all__ = ["write"]


def write(
    prediction: Prediction,
    folder: str | Path,
    *,
    case_text: str | None = None,
    draw: Callable[[Prediction, Path], None] | None = None,
) -> None:
    """Write the result folder, whole or not at all.

    Files: ``case.nml`` (resolved), ``summary.json``, ``passage.csv``, ``spectrum.csv``,
    ``bands.csv`` and, first index along x: ``x.npy`` (nx,), ``y.npy`` (ny,), ``surface.npy``,
    ``deformed.npy`` [m], ``delta_p.npy`` [Pa], (nx, ny); `draw` may add pictures
    to the folder. `case_text` is the resolved namelist; without it the settings are written as one.

    Raises
    ------
    FileExistsError
        If the folder holds something other than an earlier result.
    OSError
        If it cannot be written.
    """
    groups = {group: dict(keys) for group, keys in prediction.settings.items()}
    text = case_text or str(f90nml.Namelist(groups))

    def fill(target: Path) -> None:
        (target / "case.nml").write_text(text.rstrip() + "\n", encoding="utf-8")
        _write_files(prediction, target)
        if draw is not None:
            draw(prediction, target)

    _write_folder(Path(folder), fill)


def _write_files(prediction: Prediction, target: Path) -> None:
    f, s = prediction.friction, prediction.surface
    text = json.dumps(prediction.summary(), indent=2, allow_nan=False)
    (target / "summary.json").write_text(text + "\n", encoding="utf-8")
    passage = zip(f.shift, f.passage, strict=True)
    _write_csv(target / "passage.csv", ("shift_m", "mu_ratio"), passage)
    q, c_iso = psd_isotropic(s)
    o = prediction.operating
    ratio = component_amplitude_ratio(
        q,
        0.0,
        o.hertz_radius,
        o.moes_m,
        o.moes_l,
        convention=prediction.options.wavelength_convention,
    )
    _write_csv(
        target / "spectrum.csv",
        ("q_rad_per_m", "c_iso_m4", "amplitude_ratio_along_x"),
        zip(q, c_iso, ratio, strict=True),
    )
    names = tuple(Band.__dataclass_fields__)
    _write_csv(
        target / "bands.csv", names, ([getattr(b, n) for n in names] for b in prediction.bands)
    )
    np.save(target / "x.npy", np.arange(s.shape[0]) * s.pixel[0])
    np.save(target / "y.npy", np.arange(s.shape[1]) * s.pixel[1])
    np.save(target / "surface.npy", np.asfortranarray(s.heights))
    np.save(target / "deformed.npy", np.asfortranarray(f.response.deformed))
    np.save(target / "delta_p.npy", np.asfortranarray(f.response.pressure))


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
