# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl report``: one HTML page about a result."""

import argparse

from pyehl.reports.folder import report


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "folder",
        metavar="DIR",
        help="folder of run, predict, stribeck, sweep, bearing, gear or response",
    )
    parser.add_argument("-o", "--output", metavar="FILE.html", help="default: DIR/report.html")
    parser.add_argument(
        "--stress",
        nargs="?",
        const=True,
        metavar="OUT",
        help="stress below the surface: computed, or from a folder of pyehl stress (default: that "
        "in DIR/stress, if there is one)",
    )
    parser.add_argument(
        "--pdf",
        action="store_true",
        help="also print it as PDF, with an installed Chromium or Chrome",
    )


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl report``; 0 written, 1 not written, 2 bad input."""
    path = report(args.folder, args.output, stress=args.stress, pdf=args.pdf)
    print(path)
    if args.pdf:
        print(path.with_suffix(".pdf"))
    return 0
