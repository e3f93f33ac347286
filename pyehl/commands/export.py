# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl export``: a result folder as netCDF."""

import argparse

from pyehl.netcdf import export


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="DIR", help="result folder")
    parser.add_argument("-o", "--output", metavar="FILE.nc", help="default: DIR/results.nc")


def execute(args: argparse.Namespace) -> int:
    print(export(args.folder, args.output))
    return 0
