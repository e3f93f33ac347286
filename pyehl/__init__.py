# SPDX-License-Identifier: BSD-3-Clause
"""Elastohydrodynamic lubrication of point and line contacts with rough surfaces, and friction.

A case is a namelist file; the program ``ehl`` and this package solve it with the same compiled
library and write the same result folder::

    import pyehl

    case = pyehl.Case(contact={"moes_m": 200.0, "moes_l": 10.0}, grid={"points": 65})
    ds = pyehl.solve(case)  # xarray.Dataset; float(ds.H_c)
    p = pyehl.predict("case.nml", {"surface.seed": 3})  # p.mu_ratio
    with pyehl.Solver("case.nml") as solver:
        for step in solver:
            print(step)
    data = pyehl.load("out")  # a result folder
    ds = pyehl.sweep("case.nml", {"contact.load": [100.0, 200.0]}, run="predict")
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pyehl.api import check, film, predict, solve
    from pyehl.case import Case
    from pyehl.errors import EhlError, FileError, InputError, NotConverged
    from pyehl.machines.perform import bearing, gear
    from pyehl.measured_response.folder import response
    from pyehl.netcdf import export
    from pyehl.plots.folder import plot
    from pyehl.prediction.result import Prediction
    from pyehl.reports.folder import report
    from pyehl.results import load
    from pyehl.solver import Solver
    from pyehl.studies.curve_run import stribeck
    from pyehl.studies.film_fit import fit_lubricant
    from pyehl.studies.quasi_static import quasi_static
    from pyehl.studies.shear_fit import lubricants
    from pyehl.studies.sweep import sweep
    from pyehl.subsurface.result import stress
    from pyehl.surfaces.tile import Topography
    from pyehl.theory.lubricant import Lubricant
    from pyehl.theory.operating import OperatingPoint

__all__ = [
    "Case",
    "EhlError",
    "FileError",
    "InputError",
    "Lubricant",
    "NotConverged",
    "OperatingPoint",
    "Prediction",
    "Solver",
    "Topography",
    "bearing",
    "check",
    "export",
    "film",
    "fit_lubricant",
    "gear",
    "load",
    "lubricants",
    "plot",
    "predict",
    "quasi_static",
    "report",
    "response",
    "solve",
    "stress",
    "stribeck",
    "sweep",
]
_HOMES = {
    "Case": "case",
    "EhlError": "errors",
    "FileError": "errors",
    "InputError": "errors",
    "Lubricant": "theory.lubricant",
    "NotConverged": "errors",
    "OperatingPoint": "theory.operating",
    "Prediction": "prediction.result",
    "Solver": "solver",
    "Topography": "surfaces.tile",
    "bearing": "machines.perform",
    "check": "api",
    "export": "netcdf",
    "film": "api",
    "fit_lubricant": "studies.film_fit",
    "gear": "machines.perform",
    "load": "results",
    "lubricants": "studies.shear_fit",
    "plot": "plots.folder",
    "predict": "api",
    "quasi_static": "studies.quasi_static",
    "report": "reports.folder",
    "response": "measured_response.folder",
    "solve": "api",
    "stress": "subsurface.result",
    "stribeck": "studies.curve_run",
    "sweep": "studies.sweep",
}


def __getattr__(name: str) -> Any:  # noqa: ANN401 (a module, class or function)
    """Import on first use: ``import pyehl`` alone loads neither NumPy nor the extension."""
    if name in _HOMES:
        return getattr(import_module(f"pyehl.{_HOMES[name]}"), name)
    if name == "__version__":
        return import_module("importlib.metadata").version("pyehl")
    raise AttributeError(f"module 'pyehl' has no attribute {name!r}")


def __dir__() -> list[str]:
    """List the public names, also those that are not imported yet."""
    return sorted({*__all__, *(name for name in globals() if name.startswith("__"))})
