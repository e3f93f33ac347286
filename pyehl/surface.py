# SPDX-License-Identifier: BSD-3-Clause
"""The verb ``pyehl surface``, and the surface that a run needs from Python.

The solver reads maps and makes harmonic patterns itself. A fractal surface is made here, by the
generator that the prediction uses too: the same seed is the same surface everywhere.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pyehl.errors import FileError, InputError

if TYPE_CHECKING:
    from pyehl.case import Case

__all__ = ["add_arguments", "execute", "made_heights"]


def made_heights(case: Case) -> NDArray[np.float64] | None:
    """Heights [m] of a fractal surface, shape (nx, ny); None for every other kind."""
    settings = case.resolve()
    if settings["surface"]["kind"] != "fractal":
        return None
    from pyehl import topography  # noqa: PLC0415 (most runs need none)
    from pyehl.operating import OperatingPoint  # noqa: PLC0415

    # The film is the scale of harmonic patterns alone
    made = topography.from_settings(settings, OperatingPoint.from_settings(settings), film=0.0)
    return np.asfortranarray(made.heights, dtype=np.float64)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl surface``."""
    from pyehl.case import add_case_arguments  # noqa: PLC0415 (case imports this module)

    add_case_arguments(parser)
    parser.add_argument(
        "-o", "--output", required=True, type=Path, metavar="MAP.npy", help="file to write"
    )


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl surface``."""
    from pyehl.case import Case  # noqa: PLC0415

    heights = made_heights(Case.read(args.case, args.overrides))
    if heights is None:
        raise InputError(
            "pyehl surface: the case has no fractal surface\nexpected: surface.kind = 'fractal'"
        )
    partial = args.output.with_name(f"{args.output.name}.partial")
    try:
        with partial.open("wb") as stream:
            np.save(stream, heights)
        partial.replace(args.output)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise FileError(f"{args.output}: cannot write: {error.strerror or error}") from error
    print(args.output)
    return 0
