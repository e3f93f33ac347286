# SPDX-License-Identifier: BSD-3-Clause
"""Checks of `stress.py`: results against those of stricter runs, fields against conditions."""

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
"""Status of a run that was to end after so many steps, all of which converged."""
UNKNOWN_ERROR = 0.03
"""Difference allowed where a result comes without an estimate of its error."""
# What a result is, by the kind of problem, and the estimate of its error
RESULTS = {"smooth": ("H_c", "H_c_error_grid")}
HELD = 0.01
"""Share of the layer by which the film of a touching node may differ from it."""
LOAD = 1e-4
"""Error of the load and of the load share as summed here; these are sums over the same nodes."""
MIN_ERROR = 1e-3
"""Share of the load that any load share may be off by."""


def judge(row: Row, strict: Mapping[str, Any]) -> None:
    """Compare a result with that of the stricter run; wrong if they differ by more than its error.

    Where the mean has no estimate of its error, or there is no mean yet, the allowed difference is
    `UNKNOWN_ERROR`.
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
        # the same steps, solved more strictly: the mean may just not have settled
        other = strict.get("last_mu_ratio_mean")
    if other is None:
        return
    row["difference"] = abs(value / other - 1.0) if other else math.inf
    row["wrong"] = row.get("wrong", False) or row["difference"] > row["allowed"]


def judge_share(row: dict[str, Any], name: str, reported: Mapping[str, Any]) -> None:
    """Set `name` of a row to the load share of another run, and `wrong` if its error is exceeded.

    Where no error is stated, `UNKNOWN_ERROR` is allowed.
    """
    value, other = row["contact_load_share"], reported.get("contact_load_share")
    row[name] = other
    if None in (value, other):
        return
    stated = row["contact_load_share_error"]
    allowed = UNKNOWN_ERROR if stated is None else max(stated, MIN_ERROR)
    row["wrong"] = row["wrong"] or abs(value - other) > allowed


def broken(folder: Path) -> str:
    """Say what conditions of contact the last fields of a result folder break; '' if none.

    Film and pressure are those of the folder, the density is that of the Python side.
    """
    data = load(folder)
    settings = settings_of(data)
    point = OperatingPoint.from_settings(settings)
    pressure, film = data["P"].to_numpy(), data["H"].to_numpy()
    oil = Lubricant.from_settings(settings)
    layer = settings["lubricant"]["boundary_film"] / point.film_scale
    mass = oil.density_ratio(pressure * point.hertz_pressure) * film / layer
    touching = (pressure > 0.0) & (mass <= 1.0 + HELD)
    cell = float(data["X"][1] - data["X"][0]) * float(data["Y"][1] - data["Y"][0])
    last = "history_" if "history_load_share" in data else "contact_"
    share = pressure[touching].sum() / pressure.sum()
    reported = float(data[f"{last}load_share"].to_numpy().flat[-1])
    given = data[f"{last.removeprefix('contact_')}mass_defect"].to_numpy().flat[-1]
    carried = pressure.sum() * cell / (2.0 * np.pi / 3.0) + float(data["load_beyond"])
    conditions = {
        "P >= 0": pressure.min() >= 0.0,
        "film of the layer": mass.min() >= 1.0 - HELD,
        "load": abs(carried - 1.0) <= LOAD,
        "load share": abs(share - reported) <= LOAD,
        "N <= 0": given >= -HELD,
    }
    return ", ".join(name for name, holds in conditions.items() if not holds)
