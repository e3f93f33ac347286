# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl bearing``: film of every contact of a rolling bearing."""

import argparse

from pyehl.commands.machine import add_machine_arguments, execute_machine


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_machine_arguments(parser, "Every element of a rolling bearing on both rings")


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl bearing``; returns 0 done, 1 a contact has no result, 130 interrupted."""
    return execute_machine(args, "bearing", ("ball_bearing", "roller_bearing"))
