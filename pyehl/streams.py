# SPDX-License-Identifier: BSD-3-Clause
"""Standard output of the program."""

import os
import sys


def mute() -> None:
    """Discard standard output, so that its buffer does not raise an error at the end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
