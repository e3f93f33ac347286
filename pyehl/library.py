# SPDX-License-Identifier: BSD-3-Clause
"""Functions of the compiled library; `pyehl.solver` has its solvers.

Arrays are float64 of shape (nx, ny) in Fortran order, first index X. Pressures are scaled by the
Hertz pressure p_h, lengths by the Hertz radius a, films and deflections by a^2/R.
"""

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from pyehl.errors import check
from pyehl.extension import functions
from pyehl.types import Array


def returned(value: bytes) -> str:
    """Text that the extension returned, without the blanks at its end."""
    return value.decode(errors="replace").rstrip()


def check_memory(what: str, size: float) -> None:
    """Raise NoMemoryError, with the bytes needed and free, before an allocation that would fail.

    The machine, the control groups of the process and its address space limit the free memory.
    """
    check(*functions.needs_memory(what.encode(errors="replace"), size))


def free_bytes(root: str = "") -> float:
    """Free memory [bytes]; `root` is the folder of /proc and /sys."""
    return functions.memory_left(os.fsencode(root))


def checkpoint_case(results: str | os.PathLike[str]) -> Path:
    """Case file of the transient run of a result folder, to resume it.

    ``surface.npy`` and ``second_surface.npy`` are beside it for surfaces whose heights Python
    passed. InputError if there is no checkpoint.
    """
    path, status, message = functions.checkpoint_case(os.fsencode(results))
    check(status, message)
    return Path(os.fsdecode(path.rstrip()))


def version() -> str:
    """Version of the compiled library."""
    return returned(functions.about()[0])


def build() -> str:
    """Compiler of the compiled library and its options, without paths and warnings."""
    words = returned(functions.about()[1]).split(" ")
    # the path after a lone -I or -J is a separate word
    left_out = {
        i + shift
        for i, word in enumerate(words)
        for shift in range(2 if word in ("-I", "-J") else 1)
        if word.startswith(("-I", "-J", "-W", "-fpre-include", "-fdiagnostics"))
    }
    return " ".join(word for i, word in enumerate(words) if i not in left_out)


@dataclass(frozen=True, slots=True)
class Deflection:
    """A deflection: values (nx, ny), mean seconds of an application, bytes of the engine."""

    values: Array
    seconds: float
    bytes: float


def deflection(
    pressure: ArrayLike,
    hx: float,
    hy: float,
    engine: str = "mlmi",
    *,
    mirror: bool = False,
    accuracy: float = 1e-4,
    threads: int = 1,
    repeats: int = 1,
) -> Deflection:
    """Elastic deflection W = (2/pi^2) iint P dX' dY'/r, P (nx, ny) constant over cells.

    The integral of Zhang et al. 2019, eq. 2, in Hertz units: P by p_h, lengths and mesh sizes by a,
    W by a^2/R. The engine is 'mlmi' or 'fft'; `mirror`: the rows are those with Y >= 0 of a
    pressure that is symmetric in Y; `accuracy` is the maximum error of 'mlmi' relative to the
    maximum deflection; `threads` are OpenMP threads, and `repeats` applications are for timing.
    InputError if the engine does not exist or does not support the grid.
    """
    p = np.asfortranarray(pressure, dtype=np.float64)
    w = np.empty(p.shape, order="F")
    seconds, size, status, message = functions.deflection(
        engine.encode(), p, w, hx, hy, int(mirror), accuracy, threads, repeats
    )
    check(status, message)
    return Deflection(w, seconds, size)
