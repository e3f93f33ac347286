# SPDX-License-Identifier: BSD-3-Clause
"""Elastohydrodynamically lubricated point contacts with rough surfaces, and their friction.

A case is a namelist file; the program ``ehl`` and this package solve it with the same compiled
library and write the same result folder::

    import pyehl

    p = pyehl.predict("case.nml", "surface.seed=3")
    case = pyehl.Case.read("case.nml", "grid.points=257")
    with pyehl.Solver.open(case) as solver:
        solver.run()
        pressure = solver.field("P")
    data = pyehl.load("out")
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pyehl.api import predict
    from pyehl.case import Case
    from pyehl.errors import EhlError, FileError, InputError
    from pyehl.prediction.of_case import Prediction
    from pyehl.results import load
    from pyehl.solver import Solver

__all__ = [
    "Case",
    "EhlError",
    "FileError",
    "InputError",
    "Prediction",
    "Solver",
    "load",
    "predict",
]
__version__ = "0.1.0"

_HOMES = {
    "Case": "case",
    "EhlError": "errors",
    "FileError": "errors",
    "InputError": "errors",
    "Prediction": "prediction.of_case",
    "Solver": "solver",
    "load": "results",
    "predict": "api",
}


def __getattr__(name: str) -> Any:  # noqa: ANN401 (a module, class or function)
    """Import on first use: ``import pyehl`` alone loads neither NumPy nor the extension."""
    if name in _HOMES:
        return getattr(import_module(f"pyehl.{_HOMES[name]}"), name)
    raise AttributeError(f"module 'pyehl' has no attribute {name!r}")


def __dir__() -> list[str]:
    """Name what there is to use, also what is not imported yet."""
    return sorted({*globals(), *__all__})
