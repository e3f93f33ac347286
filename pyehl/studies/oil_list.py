# SPDX-License-Identifier: BSD-3-Clause
"""The oils that the package knows, and their pictures."""

import os
from pathlib import Path

from pyehl.destination import check_files, check_name
from pyehl.errors import InputError
from pyehl.given import path_of
from pyehl.theory.oils import Oil, known_oils, oil


def lubricants(
    *names: str, temperature: float = 40.0, output: str | os.PathLike[str] | None = None
) -> dict[str, Oil]:
    """Give the oils that `lubricant.name` knows, and draw them if a folder is given.

    Parameters
    ----------
    *names
        Some of them; none: all.
    temperature
        Of the pictures, and two more above it [degC].
    output
        Folder for the pictures, which is made where it is not there; None: nothing is drawn.

    Returns
    -------
    dict
        Oils by name: ``title``, ``source``, ``range`` of the measurements, ``constants`` with their
        places in the source, and ``at(temperature)``, a :class:`pyehl.Lubricant`.

    Raises
    ------
    InputError
        For a name that is not there, with the nearest one; a temperature out of range; a file of
        others with the name of a picture.
    FileError
        If a picture cannot be written.

    Examples
    --------
    >>> import pyehl
    >>> sorted(pyehl.lubricants())
    ['fva3', 'n100', 'pao100']
    >>> oil = pyehl.lubricants("fva3")["fva3"]
    >>> oil.title, f"{oil.at(40.0).pressure_viscosity:.3g}"
    ('FVA reference oil 3, mineral, ISO VG 100', '2.24e-08')
    """
    chosen = {name: oil(name) for name in names or known_oils()}
    at = {name: oil.at(temperature) for name, oil in chosen.items()}
    if output is None:
        return chosen
    folder = Path(path_of(output, "output"))
    check_name(folder)
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: error: this is not a folder\nexpected: a folder for pictures")
    # matplotlib takes long to import
    from pyehl.plots.folder import made  # noqa: PLC0415
    from pyehl.plots.lubricant import draw_oil  # noqa: PLC0415
    from pyehl.plots.style import save  # noqa: PLC0415

    place = made(folder)
    paths = {name: place / f"{name}.png" for name in chosen}
    check_files(paths.values(), "lubricants")
    for name, those in chosen.items():
        limit = those.constant("limiting_coefficient")
        figure = draw_oil(f"{name}: {those.title}", at[name], those.measured, limit)
        save(figure, paths[name], command="lubricants")
    return chosen
