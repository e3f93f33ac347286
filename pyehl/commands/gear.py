# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl gear``: film along the path of contact of a gear pair."""

import argparse

from pyehl.commands.machine import add_machine_arguments, execute_machine


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_machine_arguments(parser, "The path of contact of a pair of spur gears")


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl gear``; returns 0 done, 1 a contact has no result, 130 interrupted."""
    return execute_machine(args, "gear", ("spur_gear",))
