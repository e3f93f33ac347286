# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl plot``: pictures of a result folder."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from pyehl.plots.folder import plot_folder
from pyehl.plots.style import DPI

__all__ = ["add_arguments", "execute"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl plot``."""
    parser.add_argument("folder", type=Path, help="result folder of pyehl run or predict")
    parser.add_argument("-o", "--output", type=Path, help="where the PNG go (default: the folder)")
    parser.add_argument(
        "--units",
        choices=("auto", "si", "hertz"),
        default="auto",
        help="of the EHL fields (default: SI when the case was given in SI)",
    )
    parser.add_argument("--dpi", type=int, default=DPI, help=f"dots per inch (default: {DPI})")


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl plot``; 0 when drawn, 2 when there is nothing to draw."""
    folder: Path = args.folder
    try:
        if not (folder / "summary.json").is_file():
            raise ValueError(f"{folder}: no result folder, it has no summary.json")
        if not 10 <= args.dpi <= 2400:
            raise ValueError(f"--dpi {args.dpi}: 10 ... 2400 dots per inch were expected")
        target: Path = args.output or folder
        target.mkdir(parents=True, exist_ok=True)
        written = plot_folder(folder, target, args.units, args.dpi)
    except (ValueError, KeyError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    for path in written:
        print(path)
    return 0
