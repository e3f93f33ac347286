# SPDX-License-Identifier: BSD-3-Clause
"""The contacts of a machine element as a table, and its total losses."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from pyehl import display, surfaces
from pyehl.case.machine import Machine
from pyehl.machines.bearing import Bearing
from pyehl.machines.contact import Film
from pyehl.machines.friction import groove_sliding, rolling_force, traction
from pyehl.machines.gear import GearPair
from pyehl.machines.text import report
from pyehl.studies.tasks import FINDINGS, RESULTS
from pyehl.types import Row

FORMULAS = "formulas"
"""Status of a contact whose film is by formulas."""
DONE = FINDINGS | {FORMULAS}
"""Statuses of contacts with a result; film breakdown is one of them."""
COLUMNS = {
    "element": ("-", "number of the rolling element; the first one lies under the radial load"),
    "ring": ("", "inner or outer"),
    "azimuth_deg": ("deg", "angle of the element from the radial load"),
    "contact_angle_deg": ("deg", "contact angle under load"),
    "s_m": (
        "m",
        "position on the path of contact from the pitch point, towards the tip of the pinion",
    ),
    "pinion_angle_deg": ("deg", "rotation of the pinion from the pitch point"),
    "load_share": ("-", "share of the normal force on this pair of teeth"),
    "shape": ("", "ellipse or line"),
    "load_N": ("N", "load of the contact"),
    "length_m": ("m", "length of a line contact"),
    "radius_m": ("m", "reduced radius in the plane of the motion"),
    "mean_velocity_m_per_s": ("m/s", "mean velocity of both surfaces"),
    "slide_to_roll": ("-", "(u1 - u2)/u; body 1 is the pinion"),
    "hertz_pressure_Pa": ("Pa", "p_h"),
    "half_width_m": ("m", "half width of the contact along the motion"),
    "ellipticity": ("-", "semi-axis across the motion over that along it; infinite for a line"),
    "moes_m": ("-", "Moes load M; lines have their own M and L"),
    "moes_l": ("-", "Moes material number L"),
    "regime": ("", "nearest asymptote: rigid or elastic, isoviscous or piezoviscous"),
    "h_c_m": ("m", "central film"),
    "h_c_error_m": ("m", "estimate of its error"),
    "h_min_m": ("m", "minimum film"),
    "h_min_error_m": ("m", "estimate of its error"),
    "lambda_ratio": ("-", "h_min over the composite rms height of both surfaces"),
    "mu": ("-", "coefficient of friction for sliding along the motion"),
    "mu_ratio": ("-", "friction over that of the smooth contact"),
    "h_min_rough_m": ("m", "minimum film of the rough contact"),
    "flash_temperature_K": ("K", "maximum increase of the temperature of the surfaces"),
    "sliding_power_W": ("W", "power of sliding"),
    "rolling_power_W": ("W", "power of rolling resistance"),
    "status": ("", "formulas, converged, predicted, or why there is no result"),
    "note": ("", "caveat or reason"),
}
"""Columns of the table: unit and meaning."""
FOUND = (
    *("h_c_m", "h_c_error_m", "h_min_m", "h_min_error_m", "mu", "mu_ratio", "h_min_rough_m"),
    "flash_temperature_K",
)
"""Columns that a solution or a prediction provides under the same names."""
OPTIONAL = ("length_m", "lambda_ratio", *FOUND[4:])
"""Columns that are omitted where no contact has a value."""
LEFT_OUT = {
    "bearing": "cage, seals, churning, flanges, hysteresis of steel, centrifugal loads, tilting",
    "gear": "churning, bearings, seals, tip relief, dynamic loads, deflection of the teeth",
}
"""Losses and effects that the totals do not include."""


@dataclass(frozen=True, slots=True, repr=False)
class MachineResult:
    """Every contact of a bearing or a gear pair.

    Attributes
    ----------
    kind
        'bearing' or 'gear'.
    table
        A row for each contact; the `COLUMNS` that have values.
    summary
        Totals and extremes, with units in their names; ``left_out``: losses not included.
    """

    kind: str
    table: pd.DataFrame
    summary: dict[str, Any]

    @property
    def complete(self) -> bool:
        """Whether every contact has a result."""
        return bool(self.table["status"].isin(DONE).all())

    @property
    def data(self) -> xr.Dataset:
        """The table as a Dataset over `contact`, with units and the summary as attributes."""
        result = xr.Dataset.from_dataframe(self.table.rename_axis("contact"))
        for name in result.data_vars:
            unit, meaning = COLUMNS[str(name)]
            result[name].attrs = {"long_name": meaning, **({"units": unit} if unit else {})}
        return result.assign_attrs(self.summary)

    def plot(self) -> Any:  # noqa: ANN401 (a figure of matplotlib)
        """Draw film and pressure around the bearing, or along the path of contact."""
        from pyehl.plots.machine import figure  # noqa: PLC0415 (heavy)

        return figure(self.kind, self.table, self.summary)

    def __repr__(self) -> str:
        """Return table and totals as text."""
        return report(self.kind, self.table, self.summary)

    def _repr_html_(self) -> str:
        """Return a table of the totals, for notebooks."""
        return display.table(self.kind, self.summary)


def sigma_of(film: Film) -> float:
    """Composite rms height of the surfaces of a contact [m]; 0 for smooth ones."""
    tiles = [
        surfaces.from_settings(
            {**film.settings, "surface": film.settings[group]}, film.line or film.point, film.h_c
        )
        for group in surfaces.rough_groups(film.settings)
    ]
    return math.hypot(*(tile.rms_height for tile in tiles)) if tiles else 0.0


def row_of(film: Film, sigma: float, done: Row | None, place: Mapping[str, Any]) -> dict[str, Any]:
    """Return the row of a contact; `done` is its row in a study, None: by formulas."""
    contact = film.contact
    row: dict[str, Any] = {
        **place,
        "shape": contact.shape,
        "load_N": contact.load,
        "length_m": contact.length or math.nan,
        "radius_m": contact.radius,
        "mean_velocity_m_per_s": contact.mean_velocity,
        "slide_to_roll": contact.slide_to_roll,
        "hertz_pressure_Pa": film.hertz_pressure,
        "half_width_m": film.half_width,
        "ellipticity": film.ellipticity,
        "moes_m": film.moes[0],
        "moes_l": film.moes[1],
        "regime": film.regime,
        # until there is a result
        **dict.fromkeys(("h_c_m", "h_min_m", "mu"), math.nan),
    }
    if done is None:
        mu, flash = traction(film)
        row |= {
            "h_c_m": film.h_c,
            "h_min_m": film.h_min,
            "mu": mu,
            "flash_temperature_K": flash,
            "status": FORMULAS,
            "note": film.outside,
        }
    else:
        row |= {name: _number(done[name]) for name in FOUND if name in done}
        note = done.get("message") or ""
        row |= {"status": done["status"], "note": "" if done["status"] in RESULTS else note}
    h_c = row["h_c_m"]
    if sigma > 0.0:
        row["lambda_ratio"] = row["h_min_m"] / sigma
    if contact.slide_to_roll == 0.0 and contact.length == 0.0 and "ring" in place:
        sliding_power = groove_sliding(film, h_c) if h_c > 0.0 else math.nan
    else:
        speed = abs(contact.slide_to_roll) * contact.mean_velocity
        sliding_power = row["mu"] * contact.load * speed if speed else 0.0
    row["sliding_power_W"] = sliding_power
    row["rolling_power_W"] = 2.0 * contact.mean_velocity * rolling_force(film)
    return row


def _number(value: Any) -> float:  # noqa: ANN401 (a number or None)
    return math.nan if value is None else float(value)


def table_of(rows: Sequence[Mapping[str, Any]]) -> pd.DataFrame:
    """Return rows as a table, columns in the order of `COLUMNS`."""
    names = [name for name in COLUMNS if any(name in row for row in rows)]
    table = pd.DataFrame([{name: row.get(name) for name in names} for row in rows])
    empty = [name for name in OPTIONAL if name in table and table[name].isna().all()]
    return table.drop(columns=empty)


def summary_of(
    machine: Machine, made: Bearing | GearPair, table: pd.DataFrame, sigma: float
) -> dict[str, Any]:
    """Return the totals of a machine element."""
    kind = "gear" if isinstance(made, GearPair) else "bearing"
    result: dict[str, Any] = {"kind": kind, "machine": machine.kind, "contacts": len(table)}
    result |= made.facts | {"rms_height_m": sigma}
    pressures, minimum = table["hertz_pressure_Pa"], table["h_min_m"]
    result |= {
        "hertz_pressure_max_Pa": float(pressures.max()),
        "h_min_m": float(minimum.min(skipna=False)),
    }
    result["h_c_min_m"] = float(table["h_c_m"].min(skipna=False))
    result["h_c_max_m"] = float(table["h_c_m"].max(skipna=False))
    if sigma > 0.0:
        result["lambda_ratio_min"] = result["h_min_m"] / sigma
    sliding, rolling = table["sliding_power_W"], table["rolling_power_W"]
    if isinstance(made, GearPair):
        result |= _of_pair(made, table)
    else:
        powers = {
            "sliding": float(sliding.sum(skipna=False)),
            "rolling": float(rolling.sum(skipna=False)),
        }
        for name, power in powers.items():
            result[f"{name}_power_W"] = power
            result[f"{name}_torque_N_m"] = power / made.speed
        result["torque_N_m"] = sum(powers.values()) / made.speed
    result["left_out"] = LEFT_OUT[kind]
    return result


def _of_pair(pair: GearPair, table: pd.DataFrame) -> dict[str, float]:
    """Return loss and mean friction of a pair, averaged over the passage of one base pitch.

    The loss of one pair of teeth along the whole path occurs once per base pitch (Ohlendorf 1958,
    as in ISO/TR 14179-2:2001).
    """
    places, pitch = table["s_m"].to_numpy(), pair.mesh.base_pitch

    def mean(values: Any) -> float:  # noqa: ANN401 (n,)
        return float(np.trapezoid(np.asarray(values, dtype=float), places) / pitch)

    speed = (table["slide_to_roll"] * table["mean_velocity_m_per_s"]).abs()
    factor = mean(table["load_N"] * speed) / pair.input_power
    sliding, rolling = mean(table["sliding_power_W"]), mean(table["rolling_power_W"])
    return {
        "loss_factor": factor,
        "mu_mean": sliding / (factor * pair.input_power),
        "sliding_power_W": sliding,
        "rolling_power_W": rolling,
        "efficiency": 1.0 - (sliding + rolling) / pair.input_power,
    }
