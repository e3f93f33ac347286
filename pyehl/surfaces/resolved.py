# SPDX-License-Identifier: BSD-3-Clause
"""A case that ``ehl`` reads: resolved, with surfaces that have to be prepared beside it."""

import os
from pathlib import Path

import numpy as np

from pyehl.case import Case, files_of
from pyehl.destination import check_files, made_by, mark, new_file
from pyehl.surfaces.in_memory import as_map
from pyehl.surfaces.of_case import GROUPS
from pyehl.surfaces.solver_surface import for_solver
from pyehl.surfaces.tile import Topography


def write_resolved(
    case: Case, path: str | os.PathLike[str], inputs: tuple[str | os.PathLike[str], ...] = ()
) -> list[Path]:
    """Write a resolved case, and prepared surfaces as .npy beside it; gives all files.

    InputError if a file is in the way, or one of `inputs`; else as `for_solver`.
    """
    path = Path(path)
    tiles = {group: path.with_name(f"{path.stem}_{group}.npy") for group in GROUPS}
    inputs = (*inputs, *files_of(case.resolve()))
    check_files([path], "check", inputs)
    check_files(
        tiles.values(),
        "check",
        inputs,
        known=lambda tile: path.is_file() and made_by(path, f"'{tile.absolute()}'"),
    )
    written = [path]
    for group, tile in tiles.items():
        made = for_solver(case.resolve(), group)
        if made.heights is None:
            continue
        with new_file(tile) as fresh:
            np.save(fresh, made.heights)
        written.append(tile)
        if made.options:
            case = case.with_options(*made.options)
        surface = case[group]
        x, y = (float(surface[f"tile_{axis}"] or surface[f"length_{axis}"]) for axis in "xy")
        ready = as_map(Topography(made.heights, (x, y)), group)
        ready[f"{group}.file"] = str(tile.absolute())
        # what the heights have taken in
        done = {"finish": "none", "track": 0.0, "ra": 0.0, "rq": 0.0}
        ready |= {f"{group}.{k}": value for k, value in done.items() if surface[k] != value}
        ready[f"{group}.tile_mirrored"] = surface["tile_mirrored"]
        case = case.with_options(ready)
    with new_file(path) as fresh:
        fresh.write_text(f"! {mark('check')}\n{case.text}", encoding="utf-8")
    return written
