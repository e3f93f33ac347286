# SPDX-License-Identifier: BSD-3-Clause
"""The compiled extension in the build for this processor; no other module imports it."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, cast

from pyehl.errors import ExtensionError
from pyehl.processor import suffix

if TYPE_CHECKING:
    from pyehl import _core

try:
    _extension = import_module(f"pyehl._core{suffix()}")
except ImportError as error:  # pragma: no cover
    raise ExtensionError(
        "the compiled part of pyehl is missing. Install the package (pip install .) and run "
        "outside of the source folder, or use 'python -P'."
    ) from error

solvers = cast("_core._Solver", _extension.ehl_f2py_solver)
predicted = cast("_core._Predicted", _extension.ehl_f2py_predicted)
functions = cast("_core._Functions", _extension.ehl_f2py_functions)
surface_functions = cast("_core._Surfaces", _extension.ehl_f2py_surfaces)
cases = cast("_core._Cases", _extension.ehl_f2py_case)
lubricants = cast("_core._Lubricants", _extension.ehl_f2py_lubricant)
