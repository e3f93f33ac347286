# SPDX-License-Identifier: BSD-3-Clause
"""Steady contacts at instants of a duty, for comparison with its films."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from pyehl import namelist
from pyehl.api import solve
from pyehl.case import Case
from pyehl.errors import InputError
from pyehl.given import check_kind, path_of
from pyehl.results import load, settings_of
from pyehl.theory.line_contact import scaling_contact
from pyehl.types import Array, Settings

VALUES = ("h_c_m", "h_c_error_m", "h_min_m", "h_min_error_m", "p_max_Pa")
"""Results of each contact."""
ENDS = ("x_inlet", "x_outlet", "y_extent")
RADII = ("radius", "radius_x", "radius_y")
SLOWEST = 1e-6
"""Minimum mean velocity of a steady film over that of the case."""


def quasi_static(
    results: xr.Dataset | str | os.PathLike[str], instants: int | Sequence[float] = 9
) -> xr.Dataset:
    """Solve the steady, smooth contact at instants of a duty.

    Each has the load, speeds, radii, viscosity and oil layer of an instant, on the grid of the
    duty: the same nodes in metres, P = 0 at the border. Reversed motion is solved as its mirror
    image.

    Parameters
    ----------
    results
        What `solve` and `load` give for a case with a duty, or its result folder.
    instants
        Number of instants, evenly spaced over the duty (the last period), or times [s]; the nearest
        time steps are used.

    Returns
    -------
    xarray.Dataset
        The results with ``steady_t_s`` [s] and films ``steady_h_c_m``, ``steady_h_min_m`` [m] with
        their errors (grid and domain) ``steady_h_c_error_m`` and ``steady_h_min_error_m``, and
        ``steady_p_max_Pa`` over the dimension ``steady``; NaN where the lubricant is at rest or the
        contact has no solution. `pyehl.plot` draws them.

    Raises
    ------
    InputError
        If the results are not those of a duty, or `instants` are outside of it; if the viscosity
        changes in an inlet with shear heating.

    Examples
    --------
    >>> import pyehl
    >>> duty = {"file": "", "periodic": False, "time": [0.0, 1e-4], "load": [40.0, 30.0]}
    >>> ds = pyehl.solve("cases/duty.nml", {"grid.points": 33, "grid.points_y": 33}, {"duty": duty})
    >>> steady = pyehl.quasi_static(ds, [0.0, 1e-4])
    >>> steady.steady_h_c_m.shape
    (2,)
    """
    data = results if isinstance(results, xr.Dataset) else load(path_of(results, "results"))
    if "history_t_s" not in data:
        raise InputError(
            "results without a duty: nothing changes with time\n"
            "expected: what solve or load gives for a case with &duty"
        )
    settings = settings_of(data)
    if settings["lubricant"].get("thermal_reduction") and "viscosity" in settings["duty"]:
        raise InputError(
            "duty.viscosity with lubricant.thermal_reduction: the steady contact would have "
            "different inlet heating\nexpected: one of the two"
        )
    rows = _rows(data, instants)
    result = [_steady(data, settings, row) for row in rows]
    columns = {"t_s": data.history_t_s.values[rows]}
    columns |= {name: np.array([one[name] for one in result]) for name in VALUES}
    units = {name: name.rpartition("_")[2] for name in columns}
    return data.assign(
        {
            f"steady_{name}": (("steady",), values, {"units": units[name]})
            for name, values in columns.items()
        }
    )


def _rows(data: xr.Dataset, instants: int | Sequence[float]) -> Array:
    """Rows of the history that are nearest to instants."""
    time = data.history_t_s.values
    settings = settings_of(data)["duty"]
    length = settings["time"][-1] - settings["time"][0]
    last = float(time[-1])
    first = max(0.0, last - length)
    if isinstance(instants, int) and not isinstance(instants, bool):
        if instants < 1:
            raise InputError(f"instants = {instants}: expected 1 or more, or times [s]")
        wanted = np.linspace(first, last, instants)
    else:
        check_kind(instants, (list, tuple, np.ndarray), "instants", "a whole number, or times [s]")
        wanted = np.asarray(instants, dtype=np.float64)
        if not np.all((wanted >= -1e-9 * length) & (wanted <= last + 1e-9 * length)):
            raise InputError(f"instants: expected times from 0 to {last:g} s")
    return np.unique([int(np.abs(time - at).argmin()) for at in wanted])


def _steady(data: xr.Dataset, settings: Settings, row: int) -> dict[str, float]:
    """Values of the steady contact at a row of the history."""
    now = {
        name: float(data[f"history_{name}"][row])
        for name in ("load", "speed", "slide", "radius_x", "radius_y", "viscosity")
    }
    if "history_oil_layer" in data:
        now["layer"] = float(data.history_oil_layer[row])
    if abs(now["speed"]) < SLOWEST:
        return dict.fromkeys(VALUES, float("nan"))
    result = solve(_case(settings, now), check=False)
    return {name: float(result[name]) for name in VALUES}


def _case(settings: Settings, now: Mapping[str, float]) -> Case:
    """Make the case of the steady contact with values `now`, relative to those of the case."""
    grid = dict(settings["grid"])
    ends = {key: grid.pop(key) for key in ENDS if key in grid}
    contact = {k: v for k, v in settings["contact"].items() if k not in RADII}
    size = "load_per_length" if contact.get("shape") == "line" else "load"
    contact[size] *= now["load"]
    # the film depends on speed times viscosity
    contact["mean_velocity"] *= abs(now["speed"]) * now["viscosity"]
    contact["slide_to_roll"] = now["slide"] / now["speed"]
    contact |= _radii(settings["contact"], now)
    keys = {"contact": contact, "lubricant": settings["lubricant"], "solver": settings["solver"]}
    if "layer" in now:
        keys["inlet"] = {"film": now["layer"] * scaling_contact(settings).film_scale}
    # the same nodes in metres, P = 0 at the border as under the duty
    scale = scaling_contact(settings).hertz_radius
    scale /= scaling_contact(Case.from_text(namelist.text_of(keys)).resolve()).hertz_radius
    grid |= {"border": "zero", **{key: value * scale for key, value in ends.items()}}
    return Case.from_text(namelist.text_of({**keys, "grid": grid}))


def _radii(contact: Mapping[str, Any], now: Mapping[str, float]) -> dict[str, float]:
    """Radii by key: a round contact becomes elliptical if only one radius changes."""
    if "shape" in contact and contact["shape"] in ("line", "roller"):
        return {"radius": contact["radius"] * now["radius_x"]}
    along, across = (contact.get(key, contact.get("radius")) for key in ("radius_x", "radius_y"))
    return {"radius_x": along * now["radius_x"], "radius_y": across * now["radius_y"]}
