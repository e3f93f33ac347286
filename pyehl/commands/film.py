# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl film``: film formulas side by side for a case."""

import argparse
import json

from pyehl.api import film
from pyehl.commands.arguments import add_case_arguments


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_case_arguments(parser)
    parser.add_argument("--json", action="store_true", help="print JSON, in SI units")


def execute(args: argparse.Namespace) -> int:
    result = film(args.case, args.overrides)
    print(json.dumps(result.summary, indent=2) if args.json else result)
    return 0
