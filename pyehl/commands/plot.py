# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl plot``: pictures of a result folder."""

import argparse
import re
from pathlib import Path

from pyehl.errors import InputError
from pyehl.plots.folder import FORMATS, UNITS, made, plot
from pyehl.plots.movie import FRAME_SECONDS, SUFFIXES, movie
from pyehl.plots.style import DPI
from pyehl.results import load
from pyehl.studies.quasi_static import quasi_static


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "folder",
        metavar="DIR",
        type=Path,
        help="result folder of pyehl run, predict, bearing or gear",
    )
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=Path, help="where to write (default: the folder)"
    )
    parser.add_argument(
        "--units",
        choices=UNITS,
        default="auto",
        help="units of the EHL fields (default: SI when the case was given in SI)",
    )
    parser.add_argument("--format", choices=FORMATS, default="png", help="default: png")
    parser.add_argument("--dpi", type=int, default=DPI, help=f"dots per inch (default: {DPI})")
    parser.add_argument(
        "--width",
        metavar="WIDTH",
        default="",
        help="width of the figures, as 84mm or 3.3in for a column of a journal; letters of 8 "
        "points (default: 85 mm, with panels side by side 175 mm)",
    )
    parser.add_argument(
        "--movie",
        nargs="?",
        choices=SUFFIXES,
        const="gif",
        default="",
        help="a movie of the frames of a transient run (output.frame_interval) instead of the "
        "pictures: gif, or mp4 where the program ffmpeg is installed (default: gif)",
    )
    parser.add_argument(
        "--frame-seconds",
        type=float,
        default=FRAME_SECONDS,
        metavar="S",
        help=f"seconds that a frame of the movie is shown (default: {FRAME_SECONDS:g})",
    )
    parser.add_argument(
        "--steady",
        type=int,
        default=0,
        metavar="N",
        help="solve the steady contact at N instants of a duty, and draw its films beside those of "
        "the duty (default: 0, a line by the film formula)",
    )


def _metres(text: str) -> float:
    """Convert a width to metres; 0 for none. InputError if it is not a length with a unit."""
    match = re.fullmatch(r"\s*(\d+(?:\.\d*)?|\.\d+)\s*(mm|cm|in)\s*", text)
    if match is None:
        if text:
            raise InputError(f"--width {text}: expected a length with mm, cm or in, such as 84mm")
        return 0.0
    return float(match[1]) * {"mm": 1e-3, "cm": 1e-2, "in": 0.0254}[match[2]]


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl plot``; 0 when drawn, 1 when a file cannot be written, 2 for bad input."""
    target: Path = args.output or args.folder
    if args.movie:
        data = load(args.folder)
        if data.attrs.get("kind") == "prediction":
            raise InputError(f"{args.folder}: a prediction has no frames to make a movie of")
        written = [movie(data, made(target), args.movie, args.units, args.frame_seconds)]
    else:
        figures = plot(
            quasi_static(args.folder, args.steady) if args.steady else args.folder,
            target,
            units=args.units,
            format=args.format,
            dpi=args.dpi,
            width=_metres(args.width),
        )
        written = [target / f"{name}.{args.format}" for name in figures]
    for path in written:
        print(path)
    return 0
