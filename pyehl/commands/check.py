# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl check``: a case resolved, and how it would be solved."""

import argparse

from pyehl.api import check
from pyehl.commands.arguments import add_case_arguments


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.description = "Read and check a case; print it resolved, and the plan. Solve nothing."
    add_case_arguments(parser)


def execute(args: argparse.Namespace) -> int:
    print(check(args.case, args.overrides))
    return 0
