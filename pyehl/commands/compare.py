# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl compare``: results against a table of references."""

from __future__ import annotations

import argparse

from pyehl.errors import EXIT_FAILED, EXIT_OK, InputError
from pyehl.studies.compare import Comparison, compare, read_results, write_deviations
from pyehl.studies.reference_table import SHIPPED, ReferenceTable, read_reference

__all__ = ["add_arguments", "execute"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl compare``."""
    parser.description = (
        "Compare a result or a study with a table of reference values: deviations, pass or fail. "
        "Exit status: 0 all within their tolerances, 1 not, 2 bad input."
    )
    parser.add_argument("results", metavar="DIR", help="result folder, folder of a study, or CSV")
    parser.add_argument(
        "reference",
        metavar="REFERENCE.csv",
        help=f"table of references, or one that comes with pyehl: {', '.join(SHIPPED)}",
    )
    parser.add_argument(
        "--key",
        action="append",
        default=[],
        metavar="NAME",
        help="a column without a dot that is a key: the result must have its value",
    )
    parser.add_argument(
        "--rtol", type=float, metavar="R", help="relative tolerance of values without one"
    )
    parser.add_argument(
        "--partial", action="store_true", help="a study need not have all rows of the table"
    )
    parser.add_argument("-o", "--output", metavar="FILE.csv", help="write the deviations")
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing but failures")


def report(table: ReferenceTable, found: Comparison, *, quiet: bool) -> str:
    """Return the lines that are printed."""
    lines = []
    case = None
    for d in found.deviations:
        if quiet and d.passed:
            continue
        if d.case != case:
            case = d.case
            lines.append(f"{table.name}:{d.line}: {case or 'all results'}")
        lines.append(f"   {d}")
    if not quiet:
        passed = sum(d.passed for d in found.deviations)
        rows = len(table.rows) - len(found.missing)
        lines.append(
            f"{passed} of {len(found.deviations)} values pass; {rows} of {len(table.rows)} rows "
            "of the table have results"
        )
    return "\n".join(lines)


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl compare``."""
    if args.rtol is not None and not args.rtol >= 0.0:
        raise InputError(f"--rtol {args.rtol}: expected a number that is not negative")
    table = read_reference(args.reference, keys=args.key, rtol=args.rtol)
    results = read_results(args.results)
    found = compare(results, table)
    if args.output is not None:
        write_deviations(args.output, found.deviations)
    told = report(table, found, quiet=args.quiet)
    if told:
        print(told)
    incomplete = results.many and found.missing and not args.partial
    if incomplete:
        first = found.missing[0]
        keys = ", ".join(f"{key}={value}" for key, value in first.keys.items())
        print(
            f"FAIL: {len(found.missing)} rows of the table have no result, the first in line "
            f"{first.line} ({keys}); --partial allows that"
        )
    return EXIT_OK if found.passed and not incomplete else EXIT_FAILED
