# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl check``: a case resolved, and how it would be solved."""

from __future__ import annotations

import argparse

from pyehl.case import Case
from pyehl.commands.arguments import add_case_arguments
from pyehl.solver import Solver

__all__ = ["add_arguments", "execute"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl check``."""
    parser.description = "Read and check a case; print it resolved, and the plan. Solve nothing."
    add_case_arguments(parser)


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl check``."""
    case = Case.read(args.case, args.overrides)
    print(case.text)
    with Solver(case) as solver:
        print(solver.describe(predict=False))
    return 0
