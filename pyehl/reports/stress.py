# SPDX-License-Identifier: BSD-3-Clause
"""Stress below the surface in a report."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from pyehl.errors import FileError, InputError
from pyehl.plots.style import png
from pyehl.plots.subsurface import stress_figures
from pyehl.reports import page
from pyehl.reports.page import Block
from pyehl.subsurface.result import facts, stress

FOLDER = "stress"
"""Subfolder of a result in which a report looks for its stress."""
PICTURES = {
    "section": "Principal shear stress on the section y = 0, maximum over time",
    "depth": "Maximum principal shear stress against depth",
}


def stress_of(folder: Path, case: str, given: str | Path | bool | None) -> xr.Dataset | None:
    """Give the stress below a result; None if there is none and none was requested.

    Parameters
    ----------
    folder
        Result folder.
    case
        Its case, which the stress must have as well.
    given
        Folder of `pyehl.stress`; True: compute it; None or False: `FOLDER` in the result folder.

    Raises
    ------
    InputError
        If a folder that was given has no stress, or a folder has that of another case.
    FileError
        If the stress cannot be read.
    """
    if given is True:
        return stress(folder)
    place = folder / FOLDER if given in (None, False) else Path(str(given))
    path = place / "stress.nc"
    if not path.is_file():
        if given in (None, False):
            return None
        raise InputError(f"{place}: no stress.nc\nexpected: a folder that pyehl stress -o wrote")
    try:
        data = xr.load_dataset(path, engine="scipy")
    except (OSError, TypeError, ValueError) as error:
        raise FileError(f"{path}: cannot be read: {error}") from error
    if data.attrs.get("case", "").strip() != case.strip():
        raise InputError(
            f"{place}: stress of another case than {folder}\nexpected: that of pyehl stress "
            f"{folder}"
        )
    return data


def stress_parts(data: xr.Dataset, dpi: int) -> list[Block]:
    """Make the section of a report."""
    rows = facts(data)
    notes = [words for name, words in rows if name == "note"]
    parts = [
        page.heading("Stress below the surface"),
        page.facts({name: words for name, words in rows if name != "note"}),
        *map(page.paragraph, notes),
    ]
    shear = next(words for name, words in rows if name == "shear")
    for name, figure in stress_figures(data).items():
        words = PICTURES[name]
        parts.append(page.picture(png(figure, dpi), f"{words}. {shear}", f"{words}."))
    return parts
