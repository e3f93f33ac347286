# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of a result folder, as files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure

from pyehl import results
from pyehl.destination import check_files
from pyehl.errors import InputError
from pyehl.plots.figures import prediction_figures, solution_figures
from pyehl.plots.movie import movie
from pyehl.plots.style import DPI, save

__all__ = ["FORMATS", "plot_folder", "save_all"]

FORMATS = ("png", "pdf", "svg")


def save_all(
    figures: Mapping[str, Figure], target: Path, suffix: str = "png", dpi: int = DPI
) -> list[Path]:
    """Write figures into a folder under their names; returns their paths.

    Raises
    ------
    InputError
        If another file has one of the names; nothing is written then.
    """
    paths = {name: target / f"{name}.{suffix}" for name in figures}
    check_files(paths.values(), "plot")
    return [save(figure, paths[name], dpi) for name, figure in figures.items()]


def _make(target: Path) -> None:
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"{target}: error: this folder cannot be made\nexpected: another folder"
        ) from error


def plot_folder(
    folder: Path,
    target: Path,
    *,
    units: str = "auto",
    dpi: int = DPI,
    suffix: str = "png",
    moving: str = "",
) -> list[Path]:
    """Write the pictures of a result folder into another; returns their paths.

    Parameters
    ----------
    folder, target
        Result folder, and where the pictures go.
    units
        Of the fields of a solution: 'si', 'hertz', or 'auto' for SI when the case was given in SI.
    dpi
        Dots per inch.
    suffix
        One of :data:`FORMATS`.
    moving
        'gif' or 'mp4': a movie of the frames instead; '': the pictures.

    Raises
    ------
    InputError
        If the folder is not a result folder, or has nothing to draw, or another file has the name
        of a picture.
    FileError
        If a picture cannot be written.
    """
    data = results.load(folder)
    prediction = data.attrs.get("kind") == "prediction"
    if moving:
        if prediction:
            raise InputError(f"{folder}: a prediction has no frames to make a movie of")
        _make(target)
        return [movie(data, target, moving, units)]
    figures = prediction_figures(data) if prediction else solution_figures(data, units)
    if not figures:
        raise InputError(
            f"{folder}: there are no fields to draw: the case has output.fields = .false.\n"
            "expected: a result folder with P.npy and H.npy"
        )
    _make(target)
    return save_all(figures, target, suffix, dpi)
