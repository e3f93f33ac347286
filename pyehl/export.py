# SPDX-License-Identifier: BSD-3-Clause
"""A result folder as one netCDF file.

netCDF-3 (64-bit offset), which xarray, MATLAB, Octave, ParaView and ncview open; units and names
after the CF conventions. Planes are stored (Y, X), the last index fastest, as those tools expect.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from scipy.io import netcdf_file

from pyehl import results
from pyehl.errors import FileError, InputError

__all__ = ["export"]


def export(folder: str | os.PathLike[str], path: str | os.PathLike[str] | None = None) -> Path:
    """Write a result folder as netCDF-3.

    Parameters
    ----------
    folder
        Result folder.
    path
        File to write, replaced when it is there; default ``results.nc`` in the folder.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        If `folder` is not a result folder.
    FileError
        If the file cannot be written.
    """
    try:
        result = results.read(folder)
    except FileNotFoundError as error:
        raise InputError(str(error)) from error
    path = Path(folder) / "results.nc" if path is None else Path(path)
    partial = path.with_name(f"{path.name}.partial-{os.getpid()}")
    try:
        _write(result, partial)
        partial.replace(path)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise FileError(f"{path}: cannot write: {error.strerror or error}") from error
    return path


def _write(result: results.Result, path: Path) -> None:
    with netcdf_file(path, "w", version=2) as file:
        file.Conventions = "CF-1.8"
        file.title = "pyehl results"
        for name, value in result.summary.items():
            if isinstance(value, bool):
                setattr(file, name, np.int32(value))
            elif isinstance(value, float):
                setattr(file, name, np.float64(value))
            elif isinstance(value, str | int) and value != "":
                setattr(file, name, value)
        for name, variable in (result.coords | result.variables).items():
            values, dims = variable.values.T, variable.dims[::-1]
            if 0 in values.shape:
                continue
            for dim, length in zip(dims, values.shape, strict=True):
                if dim not in file.dimensions:
                    file.createDimension(dim, length)
            stored = file.createVariable(name, "f8", dims)
            stored[:] = values
            stored.units = variable.units
            stored.long_name = variable.long_name
