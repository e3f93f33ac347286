# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl plot``: pictures of a result folder."""

from __future__ import annotations

import argparse
from pathlib import Path

from pyehl.errors import InputError
from pyehl.plots.folder import FORMATS, UNITS, made, plot
from pyehl.plots.movie import SUFFIXES, movie
from pyehl.plots.style import DPI
from pyehl.results import load

__all__ = ["add_arguments", "execute"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl plot``."""
    parser.add_argument(
        "folder", metavar="DIR", type=Path, help="result folder of pyehl run or predict"
    )
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=Path, help="where to write (default: the folder)"
    )
    parser.add_argument(
        "--units",
        choices=UNITS,
        default="auto",
        help="of the EHL fields (default: SI when the case was given in SI)",
    )
    parser.add_argument("--format", choices=FORMATS, default="png", help="default: png")
    parser.add_argument("--dpi", type=int, default=DPI, help=f"dots per inch (default: {DPI})")
    parser.add_argument(
        "--movie",
        nargs="?",
        choices=SUFFIXES,
        const="gif",
        default="",
        help="a movie of the frames of a transient run (output.frame_interval) instead of the "
        "pictures: gif, or mp4 where the program ffmpeg is installed (default: gif)",
    )


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl plot``; 0 when drawn, 1 when a file cannot be written, 2 for bad input."""
    target: Path = args.output or args.folder
    if args.movie:
        data = load(args.folder)
        if data.attrs.get("kind") == "prediction":
            raise InputError(f"{args.folder}: a prediction has no frames to make a movie of")
        written = [movie(data, made(target), args.movie, args.units)]
    else:
        words = {"units": args.units, "format": args.format, "dpi": args.dpi}
        written = [target / f"{name}.{args.format}" for name in plot(args.folder, target, **words)]
    for path in written:
        print(path)
    return 0
