# SPDX-License-Identifier: BSD-3-Clause
"""Standard output of the program."""

import os
import sys


def mute() -> None:
    """Send standard output nowhere: what is still in its buffer must not raise at the end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
