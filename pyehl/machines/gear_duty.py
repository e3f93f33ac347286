# SPDX-License-Identifier: BSD-3-Clause
"""The duty of a pair of teeth: operating conditions of its contact along the path of contact."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pyehl.arrays import write_csv
from pyehl.case import resolved_case
from pyehl.machines.contact import LINE, Film
from pyehl.machines.gear import GearPair
from pyehl.types import Array

CSV, CASE = "duty.csv", "duty.nml"
FILES = (CSV, CASE)
"""The table, and a case of smooth flanks with that duty, for ``pyehl run``."""


def has_duty(pair: GearPair) -> bool:
    """Whether all contacts have the same shape, so that one case can describe them."""
    return len({one.shape for one in pair.contacts}) == 1


def table(pair: GearPair) -> dict[str, Array]:
    """Columns of the table by name and unit, (stations,)."""
    contacts = pair.contacts
    path = np.array([place["s_m"] for place in pair.places])
    slide = np.array([one.slide_to_roll for one in contacts])
    mean = np.array([one.mean_velocity for one in contacts])
    load = np.array([one.load for one in contacts])
    columns = {"time [s]": (path - path[0]) / (pair.mesh.base[0] * pair.angular_velocity)}
    if contacts[0].shape == LINE:
        columns["load [N/m]"] = load / contacts[0].length
    else:
        columns["load [N]"] = load
    columns["u1 [m/s]"] = mean * (1.0 + 0.5 * slide)
    columns["u2 [m/s]"] = mean * (1.0 - 0.5 * slide)
    columns["radius_x [m]"] = np.array([one.radius for one in contacts])
    return columns


def write_duty(folder: Path, pair: GearPair, films: Sequence[Film]) -> None:
    """Write the table, and the case of the most loaded contact with that duty."""
    columns = table(pair)
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    write_csv(folder / CSV, list(columns), rows)
    largest = max(films, key=lambda film: film.contact.load)
    keys = {f"duty.{name.split()[0]}": tuple(values) for name, values in columns.items()}
    case = resolved_case(largest.text).smooth().with_options(keys)
    (folder / CASE).write_text(case.text, encoding="utf-8")
