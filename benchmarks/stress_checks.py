# SPDX-License-Identifier: BSD-3-Clause
"""Checks of `stress.py`: results against stricter runs, fields against the contact conditions."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from pyehl.results import load, settings_of
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Row

ENDED = "ended at its number of steps"
"""Status of a run with a fixed number of steps, all of which converged."""
UNKNOWN_ERROR = 0.03
"""Allowed difference for a result without an error estimate."""
# Result that is compared, by the kind of problem, and its error estimate
RESULTS = {"smooth": ("H_c", "H_c_error_grid")}
FILM_TOLERANCE = 0.01
"""Relative difference allowed between the film of a node in contact and the boundary film, and how
far below zero the mass defect may be."""
LOAD_TOLERANCE = 1e-4
"""Difference allowed of load and load share, which are sums over the same nodes here and there."""
MIN_ERROR = 1e-3
"""Difference of a load share that is always allowed, whatever its stated error."""


def judge(row: Row, strict: Mapping[str, Any]) -> None:
    """Compare a result with that of the stricter run; wrong if they differ by more than its error.

    The allowed relative difference is at least 1e-3. Without a mean, or without its error estimate,
    the allowed difference is `UNKNOWN_ERROR`.
    """
    name, error = RESULTS.get(row["family"], ("mu_ratio", "mu_ratio_error"))
    value, other = row[name], strict.get(name)
    if row["outcome"] == ENDED:
        value, other = row["last_mu_ratio"], strict.get("last_mu_ratio")
    row["strict_status"] = strict.get("status")
    if value is None:
        return
    estimate = row[error]
    row["allowed"] = UNKNOWN_ERROR if not estimate else max(estimate / abs(value), 1e-3)
    if other is None and name == "mu_ratio":
        # with the same steps, solved more strictly, the mean may just not have settled
        other = strict.get("last_mu_ratio_mean")
    if other is None:
        return
    row["difference"] = abs(value / other - 1.0) if other else math.inf
    row["wrong"] = row.get("wrong", False) or row["difference"] > row["allowed"]


def judge_share(row: dict[str, Any], name: str, reported: Mapping[str, Any]) -> None:
    """Set `name` of a row to the load share of another run, and `wrong` if its error is exceeded.

    Without a stated error the allowed difference is `UNKNOWN_ERROR`.
    """
    value, other = row["contact_load_share"], reported.get("contact_load_share")
    row[name] = other
    if None in (value, other):
        return
    stated = row["contact_load_share_error"]
    allowed = UNKNOWN_ERROR if stated is None else max(stated, MIN_ERROR)
    row["wrong"] = row["wrong"] or abs(value - other) > allowed


def broken(folder: Path) -> str:
    """List the contact conditions that the last fields of a result folder violate; '' if none.

    Film and pressure are read from the folder; the density is computed in Python.
    """
    data = load(folder)
    settings = settings_of(data)
    point = OperatingPoint.from_settings(settings)
    pressure, film = data["P"].to_numpy(), data["H"].to_numpy()
    oil = Lubricant.from_settings(settings)
    layer = settings["lubricant"]["boundary_film"] / point.film_scale
    mass = oil.density_ratio(pressure * point.hertz_pressure) * film / layer
    touching = (pressure > 0.0) & (mass <= 1.0 + FILM_TOLERANCE)
    cell = float(data["X"][1] - data["X"][0]) * float(data["Y"][1] - data["Y"][0])
    last = "history_" if "history_load_share" in data else "contact_"
    share = pressure[touching].sum() / pressure.sum()
    reported = float(data[f"{last}load_share"].to_numpy().flat[-1])
    given = data[f"{last.removeprefix('contact_')}mass_defect"].to_numpy().flat[-1]
    carried = pressure.sum() * cell / (2.0 * np.pi / 3.0) + float(data["load_beyond"])
    conditions = {
        "P >= 0": pressure.min() >= 0.0,
        "boundary film": mass.min() >= 1.0 - FILM_TOLERANCE,
        "load": abs(carried - 1.0) <= LOAD_TOLERANCE,
        "load share": abs(share - reported) <= LOAD_TOLERANCE,
        "N <= 0": given >= -FILM_TOLERANCE,
    }
    return ", ".join(name for name, holds in conditions.items() if not holds)
