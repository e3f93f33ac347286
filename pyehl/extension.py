# SPDX-License-Identifier: BSD-3-Clause
"""The compiled extension, imported here and nowhere else."""

from __future__ import annotations

try:
    from pyehl._core import ehl_f2py_functions as functions
    from pyehl._core import ehl_f2py_solver as ehl
except ImportError as error:  # pragma: no cover
    raise ImportError(
        "the compiled part of pyehl is not here. Install the package (pip install .) and run "
        "outside of the source folder, or use 'python -P'."
    ) from error

__all__ = ["ehl", "functions", "text_of"]


def text_of(value: bytes) -> str:
    """Text that the extension returned, without the blanks at its end."""
    return value.decode(errors="replace").rstrip()
