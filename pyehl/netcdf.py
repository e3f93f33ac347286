# SPDX-License-Identifier: BSD-3-Clause
"""A result folder as one netCDF file.

netCDF-3 (64-bit offset), which xarray, MATLAB, Octave, ParaView and ncview open; units and names
after the CF conventions. Planes are stored (Y, X), the last index fastest, as those tools expect.
"""

import os
from pathlib import Path

import xarray as xr

from pyehl import results
from pyehl.destination import check_files, mark, new_file
from pyehl.given import path_of


def export(folder: str | os.PathLike[str], path: str | os.PathLike[str] | None = None) -> Path:
    """Write a result folder as netCDF-3.

    The file holds what `pyehl.load` gives, under the same names, without empty tables and
    attributes without a value.

    Parameters
    ----------
    folder
        Result folder.
    path
        File to write, which may replace one of `export`; default ``results.nc`` in the folder.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        If `folder` is not a result folder, or `path` is a file that `export` did not write.
    FileError
        If the file cannot be written.

    Examples
    --------
    >>> import pyehl
    >>> solved = pyehl.solve("cases/quick.nml", {"grid.points": 65}, output="out/exported")
    >>> pyehl.export("out/exported").name
    'results.nc'
    """
    data = results.load(folder)
    path = (
        Path(path_of(folder, "folder")) / "results.nc"
        if path is None
        else Path(path_of(path, "path"))
    )
    check_files([path], "export")
    data = data.drop_vars([name for name in data.variables if data[name].size == 0])
    data = data.transpose(*reversed(list(data.dims)))
    scalars = {
        name: int(value) if isinstance(value, bool) else value
        for name, value in data.attrs.items()
        if value != ""
    }
    head = {"Conventions": "CF-1.8", "title": "pyehl results", "source": mark("export")}
    data.attrs = head | scalars
    write_netcdf(path, data)
    return path


def write_netcdf(path: Path, data: xr.Dataset) -> None:
    """Write a Dataset as netCDF-3, whole or not at all; FileError if it cannot be written."""
    with new_file(path) as partial:
        data.to_netcdf(partial, format="NETCDF3_64BIT", engine="scipy")
