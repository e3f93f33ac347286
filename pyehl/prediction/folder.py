# SPDX-License-Identifier: BSD-3-Clause
"""The result folder of a prediction."""

import gc
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import numpy as np

from pyehl.arrays import write_csv
from pyehl.destination import Destination, write_json
from pyehl.prediction.result import Prediction
from pyehl.prediction.sides import SECOND

TABLES = ("passage", "spectrum", "bands")
ARRAYS = ("x", "y", "surface", "deformed", "delta_p")
ARRAYS_OF_TWO = tuple(f"{SECOND}{name}" for name in ARRAYS)
PICTURES = ("surface_spectrum", "roughness", "passage")
PICTURES_OF_SECOND = ("second_surface_spectrum", "second_roughness")


def destination(
    folder: str | os.PathLike[str],
    *,
    inputs: Iterable[str | os.PathLike[str]] = (),
    force: bool = False,
) -> Destination:
    """Give the place of the result of a prediction, to check it before there is one."""
    names = [f"{name}.csv" for name in TABLES] + [f"{name}.npy" for name in ARRAYS + ARRAYS_OF_TWO]
    names += [f"{name}.png" for name in PICTURES + PICTURES_OF_SECOND]
    names += ["case.nml", "summary.json"]
    return Destination(folder, "prediction", tuple(names), tuple(inputs), force=force)


def write(prediction: Prediction, place: Destination, *, plots: bool = False) -> None:
    """Write the result folder, whole or not at all.

    Files: ``case.nml`` (resolved), ``summary.json``, ``passage.csv``, ``spectrum.csv``,
    ``bands.csv`` and, first index along x: ``x.npy`` (nx,), ``y.npy`` (ny,), ``surface.npy``,
    ``deformed.npy`` [m], ``delta_p.npy`` [Pa], (nx, ny), of a second rough surface the same as
    ``second_x.npy`` and so on; with `plots` the pictures. InputError if
    the folder holds something other than an earlier prediction; FileError if it cannot be written.
    """
    with place.fresh() as folder:
        text = prediction.case_text.rstrip() + "\n"
        (folder / "case.nml").write_text(text, encoding="utf-8")
        for name, columns in prediction.tables.items():
            rows = zip(*columns.values(), strict=True)
            write_csv(folder / f"{name}.csv", tuple(columns), rows)
        for name, values in prediction.arrays.items():
            np.save(folder / f"{name}.npy", values)
        if plots:
            with _uncollected():
                # matplotlib takes longer to import than the prediction takes to compute
                from pyehl.plots.figures import prediction_figures  # noqa: PLC0415
                from pyehl.plots.folder import save_all  # noqa: PLC0415

                parts = prediction.summary, prediction.arrays, prediction.tables
                save_all(prediction_figures(*parts), folder)
        files = sorted(["summary.json", *(path.name for path in folder.iterdir())])
        write_json(folder / "summary.json", prediction.summary | {"files": files})


@contextmanager
def _uncollected() -> Iterator[None]:
    """Collect no garbage meanwhile: matplotlib makes many objects, and nearly all are in use."""
    running = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if running:
            gc.enable()
