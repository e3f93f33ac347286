# SPDX-License-Identifier: BSD-3-Clause
"""Elastohydrodynamically lubricated point contacts with rough surfaces, and their friction.

A case is a namelist file; the program ``ehl`` and this package solve it with the same compiled
library and write the same result folder::

    case = pyehl.Case.read("case.nml")
    with pyehl.Solver.open(case) as solver:
        solver.run()
        pressure = solver.field("P")
    results = pyehl.load("out")
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pyehl.case import Case
    from pyehl.results import load
    from pyehl.solver import Solver

__all__ = ["Case", "Solver", "load"]
__version__ = "0.1.0"

_HOMES = {"Case": "pyehl.case", "Solver": "pyehl.solver", "load": "pyehl.results"}


def __getattr__(name: str) -> Any:  # noqa: ANN401 (a module, class or function)
    """Import on first use: ``import pyehl`` alone loads neither NumPy nor the extension."""
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'pyehl' has no attribute {name!r}")
