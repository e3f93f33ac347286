# SPDX-License-Identifier: BSD-3-Clause
"""The program ``pyehl``, and ``python -m pyehl``."""

import atexit
import gc
import os
import sys

from pyehl.cli import main

MANY = 500_000
"""New objects after which the garbage collector looks for cycles: pictures have many that stay."""


def program() -> int:
    """Run the command line in a process of its own; gives its exit status."""
    # products of small matrices are slower on several threads
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    gc.set_threshold(MANY)
    # at the end there is nothing to collect: the process gives its memory back
    atexit.register(gc.freeze)
    return main()


if __name__ == "__main__":
    sys.exit(program())
