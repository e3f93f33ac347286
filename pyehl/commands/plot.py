# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl plot``: pictures of a result folder."""

from __future__ import annotations

import argparse
from pathlib import Path

from pyehl.errors import EhlError, InputError
from pyehl.plots.folder import FORMATS, plot_folder
from pyehl.plots.movie import SUFFIXES
from pyehl.plots.style import DPI

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
        choices=("auto", "si", "hertz"),
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
    if not 10 <= args.dpi <= 2400:
        raise InputError(f"--dpi {args.dpi}: 10 ... 2400 dots per inch were expected")
    target: Path = args.output or args.folder
    try:
        written = plot_folder(
            args.folder,
            target,
            units=args.units,
            dpi=args.dpi,
            suffix=args.format,
            moving=args.movie,
        )
    except EhlError:
        raise
    except ValueError as error:
        raise InputError(f"{args.folder}: {error}") from error
    for path in written:
        print(path)
    return 0
