# SPDX-License-Identifier: BSD-3-Clause
"""Arguments that several subcommands share."""

import argparse

from pyehl.given import TYPED


def add_case_arguments(parser: argparse.ArgumentParser, *, optional: bool = False) -> None:
    """Case file and --set options, the same for every subcommand that takes a case."""
    parser.add_argument(
        "case", metavar="CASE.nml", nargs="?" if optional else None, help="case file"
    )
    add_overrides(parser, "of the case")


def add_overrides(parser: argparse.ArgumentParser, where: str) -> None:
    """Option --set, which replaces values."""
    parser.add_argument(
        "--set",
        dest="overrides",
        action="append",
        type=f"{TYPED}{{}}".format,
        default=[],
        metavar="GROUP.KEY=VALUE",
        help=f"replace a value {where}; may be repeated",
    )


def add_force(parser: argparse.ArgumentParser) -> None:
    """Option --force of commands that write a folder."""
    parser.add_argument(
        "--force", action="store_true", help="accept a folder with other files and keep them"
    )
