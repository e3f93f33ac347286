# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl compare``: compare results with a table of references."""

import argparse

from pyehl.errors import EXIT_FAILED, EXIT_OK, InputError
from pyehl.rigs.reading import read_rig
from pyehl.studies.compare import SHIPPED, compare, read_reference, read_results
from pyehl.studies.rig_comparison import compared, lines


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.description = (
        "Compare a result or a study with a table of reference values: deviations, pass or fail. "
        "Exit status: 0 all within their tolerances, 1 at least one outside, 2 bad input. Or "
        "compare a study with measurements of a rig: deviations per decade."
    )
    parser.add_argument("results", metavar="DIR", help="result folder, folder of a study, or CSV")
    parser.add_argument(
        "reference",
        metavar="REFERENCE.csv",
        nargs="?",
        help=f"table of references, or one that comes with pyehl: {', '.join(SHIPPED)}",
    )
    parser.add_argument(
        "--partial", action="store_true", help="a study need not have all rows of the table"
    )
    parser.add_argument(
        "--measured",
        metavar="FILE",
        help="file of a rig (PCS EHD or MTM, or a table with units) in place of a reference",
    )
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing but failures")


def execute(args: argparse.Namespace) -> int:
    if (args.reference is None) == (args.measured is None):
        raise InputError("expected a table of references, or --measured FILE")
    if args.measured is not None:
        print("\n".join(lines(compared(read_results(args.results), read_rig(args.measured)))))
        return EXIT_OK
    table, results = read_reference(args.reference), read_results(args.results)
    result = compare(results, table)
    line = 0
    for deviation in result.deviations:
        if args.quiet and deviation.passed:
            continue
        if deviation.line != line:
            line = deviation.line
            print(f"{table.name}:{line}: {deviation.case or 'all results'}")
        print(f"   {deviation}")
    if not args.quiet:
        passed = sum(deviation.passed for deviation in result.deviations)
        rows = len(table.rows) - len(result.missing)
        print(
            f"{passed} of {len(result.deviations)} values pass; {rows} of {len(table.rows)} rows "
            "of the table have results"
        )
    incomplete = results.many and result.missing and not args.partial
    if incomplete:
        first = result.missing[0]
        keys = ", ".join(f"{key}={value}" for key, value in first.keys.items())
        print(
            f"FAIL: {len(result.missing)} rows of the table have no result, the first in line "
            f"{first.line} ({keys}); --partial allows that"
        )
    return EXIT_OK if result.passed and not incomplete else EXIT_FAILED
