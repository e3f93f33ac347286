# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl surface``: the surface of a case as a height map."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from pyehl.case import Case
from pyehl.commands.arguments import add_case_arguments
from pyehl.errors import FileError, InputError
from pyehl.surfaces import from_settings
from pyehl.theory.operating import OperatingPoint

__all__ = ["add_arguments", "execute"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl surface``."""
    add_case_arguments(parser)
    parser.add_argument(
        "-o", "--output", required=True, type=Path, metavar="MAP.npy", help="file to write"
    )


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl surface``."""
    settings = Case.read(args.case, args.overrides).resolve()
    if settings["surface"]["kind"] != "fractal":
        raise InputError(
            "pyehl surface: the case has no fractal surface\nexpected: surface.kind = 'fractal'"
        )
    # the film is the scale of harmonic patterns alone
    made = from_settings(settings, OperatingPoint.from_settings(settings), film=0.0)
    heights = np.asfortranarray(made.heights)
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
