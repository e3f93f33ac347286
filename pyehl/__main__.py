# SPDX-License-Identifier: BSD-3-Clause
"""The program ``pyehl``, and ``python -m pyehl``."""

import atexit
import gc
import os
import sys

from pyehl.cli import main

GC_THRESHOLD = 500_000
"""New objects before a run of the garbage collector: figures hold many long-lived objects."""


def program() -> int:
    """Run the command line as a program; returns its exit status."""
    # products of small matrices are slower on several threads
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    gc.set_threshold(GC_THRESHOLD)
    # no collection at exit: the operating system frees the memory
    atexit.register(gc.freeze)
    return main()


if __name__ == "__main__":
    sys.exit(program())
