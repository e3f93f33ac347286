# SPDX-License-Identifier: BSD-3-Clause
"""Checks of ``pyehl bench stress --boundary-film``: fields and load shares of contacts."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from pyehl.results import load, settings_of
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

HELD = 0.01
"""Share of the layer by which the film of a touching node may differ from it."""
LOAD = 1e-4
"""Error of the load and of the load share as summed here; these are sums over the same nodes."""
LEAST = 1e-3
"""Share of the load that any load share may be off by."""


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
    told = float(data[f"{last}load_share"].to_numpy().flat[-1])
    given = data[f"{last.removeprefix('contact_')}layer_supply"].to_numpy().flat[-1]
    carried = pressure.sum() * cell / (2.0 * np.pi / 3.0) + float(data["load_beyond"])
    conditions = {
        "P >= 0": pressure.min() >= 0.0,
        "film of the layer": mass.min() >= 1.0 - HELD,
        "load": abs(carried - 1.0) <= LOAD,
        "load share": abs(share - told) <= LOAD,
        "N <= 0": given >= -HELD,
    }
    return ", ".join(name for name, holds in conditions.items() if not holds)


def judge_share(row: dict[str, Any], name: str, told: Mapping[str, Any], unknown: float) -> None:
    """Set `name` of a row to the load share of another run, and `wrong` if its error is exceeded.

    Where no error is stated, `unknown` is allowed.
    """
    value, other = row["contact_load_share"], told.get("contact_load_share")
    row[name] = other
    if None in (value, other):
        return
    stated = row["contact_load_share_error"]
    allowed = unknown if stated is None else max(stated, LEAST)
    row["wrong"] = row["wrong"] or abs(value - other) > allowed
