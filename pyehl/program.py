# SPDX-License-Identifier: BSD-3-Clause
"""The command ``ehl`` of a wheel: the program is replaced by its build for this processor."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from pyehl.errors import InputError
from pyehl.processor import suffix

__all__ = ["main"]


def main() -> None:
    """Run the program ``ehl`` in place of this process, with the same arguments.

    It is the same build as that of the extension, so that both give the same bits.
    """
    try:
        program = Path(__file__).with_name("bin") / f"ehl{suffix()}"
    except InputError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    os.execv(program, [str(program), *sys.argv[1:]])
