# SPDX-License-Identifier: BSD-3-Clause
"""Text of ``pyehl bearing`` and ``pyehl gear``."""

import math
from collections.abc import Iterable, Mapping
from typing import Any

import pandas as pd

from pyehl.machines.bearing import STATIC_PRESSURE
from pyehl.machines.contact import OUTSIDE
from pyehl.machines.equilibrium import BALL

# Columns that are printed: label, factor, digits; a factor of 0 for text
SHOWN: dict[str, tuple[str, float, int]] = {
    "element": ("element", 0.0, 0),
    "ring": ("ring", 0.0, 0),
    "azimuth_deg": ("azimuth", 1.0, 0),
    "s_m": ("s [mm]", 1e3, 3),
    "load_share": ("share", 1.0, 3),
    "slide_to_roll": ("SRR", 1.0, 3),
    "load_N": ("load [N]", 1.0, 1),
    "hertz_pressure_Pa": ("p_h [GPa]", 1e-9, 3),
    "ellipticity": ("kappa", 1.0, 2),
    "moes_m": ("M", 1.0, 1),
    "moes_l": ("L", 1.0, 2),
    "h_c_m": ("h_c [nm]", 1e9, 1),
    "h_c_error_m": ("+- [nm]", 1e9, 1),
    "h_min_m": ("h_min [nm]", 1e9, 1),
    "lambda_ratio": ("Lambda", 1.0, 2),
    "h_min_rough_m": ("rough [nm]", 1e9, 1),
    "mu": ("mu", 1.0, 4),
    "flash_temperature_K": ("flash [K]", 1.0, 1),
    "status": ("status", 0.0, 0),
}
# Totals that are printed: label, factor, format, unit
SUMS: dict[str, tuple[str, float, str, str]] = {
    "load_max_N": ("most loaded element", 1.0, ".1f", "N"),
    "load_max_Z_over_F": ("  times Z/F", 1.0, ".3f", ""),
    "contact_angle_free_deg": ("contact angle without load", 1.0, ".2f", "deg"),
    "cage_speed_per_min": ("speed of the cage", 1.0, ".1f", "1/min"),
    "centrifugal_force_N": ("centrifugal force (omitted)", 1.0, ".2f", "N"),
    "contact_ratio": ("contact ratio", 1.0, ".3f", ""),
    "working_angle_deg": ("working pressure angle", 1.0, ".3f", "deg"),
    "normal_force_N": ("normal force", 1.0, ".1f", "N"),
    "hertz_pressure_max_Pa": ("maximum pressure", 1e-9, ".3f", "GPa"),
    "h_min_m": ("minimum film", 1e9, ".1f", "nm"),
    "rms_height_m": ("rms height of both surfaces", 1e9, ".1f", "nm"),
    "lambda_ratio_min": ("minimum Lambda", 1.0, ".2f", ""),
    "sliding_torque_N_m": ("torque of sliding", 1e3, ".2f", "N mm"),
    "rolling_torque_N_m": ("torque of rolling", 1e3, ".2f", "N mm"),
    "torque_N_m": ("torque of the contacts", 1e3, ".2f", "N mm"),
    "loss_factor": ("loss factor H_V", 1.0, ".4f", ""),
    "mu_mean": ("mean coefficient of friction", 1.0, ".4f", ""),
    "sliding_power_W": ("power of sliding", 1.0, ".1f", "W"),
    "rolling_power_W": ("power of rolling", 1.0, ".1f", "W"),
    "efficiency": ("efficiency of the mesh", 100.0, ".3f", "%"),
}
# Entries that need a friction coefficient, which a Newtonian oil does not give
FRICTION = ("sliding_torque_N_m", "torque_N_m", "mu_mean", "sliding_power_W", "efficiency")
NOTES = 4


def report(kind: str, table: pd.DataFrame, summary: Mapping[str, Any]) -> str:
    """Return table and totals of a machine element as text."""
    lines = [pd.DataFrame(cells(kind, table)).to_string(index=False), ""]
    lines += [f"{label:<30}{text}".rstrip() for label, text in sums(table, summary).items()]
    return "\n".join([*lines, *notes_of(table, summary)])


def cells(kind: str, table: pd.DataFrame) -> dict[str, list[str]]:
    """Return the printed columns as text, by their labels."""
    return {
        label: [_cell(value, factor, digits) for value in table[name]]
        for name, (label, factor, digits) in SHOWN.items()
        if name in table and not (kind == "bearing" and name == "slide_to_roll")
    }


def notes_of(table: pd.DataFrame, summary: Mapping[str, Any]) -> list[str]:
    """Return the notes, with the omitted losses last."""
    notes = _together(str(note) for note in table["note"] if isinstance(note, str) and note)
    result = [*notes[:NOTES], *([f"and {len(notes) - NOTES} more"] if len(notes) > NOTES else [])]
    result = [f"note       {note}" for note in result]
    if summary["hertz_pressure_max_Pa"] > STATIC_PRESSURE[BALL]:
        result.append("steel      yields: the static limit of bearings is 4.2 GPa (ISO 76)")
    if summary.get("lambda_ratio_min", math.inf) < 1.0 and "h_min_rough_m" not in table:
        result.append(
            "solids     minimum Lambda below 1: solid contact, whose friction is not included"
        )
    return [*result, f"omitted    {summary['left_out']}"]


def sums(table: pd.DataFrame, summary: Mapping[str, Any]) -> dict[str, str]:
    """Return the totals of a machine element as text, by their labels."""
    result = {}
    for name, (label, factor, form, unit) in SUMS.items():
        value = summary.get(name)
        if value is None or (name == "rms_height_m" and value == 0.0):
            continue
        result[label] = f"{value * factor:{form}} {unit}".rstrip()
        if math.isnan(value):
            missing = "a contact has no result"
            if name in FRICTION and table["h_c_m"].notna().all():
                missing = "give a lubricant.shear_law"
            result[label] = f"not reported: {missing}"
    return result


def _together(notes: Iterable[str]) -> list[str]:
    """Merge the notes: each formula once, with all the ranges that are exceeded."""
    result: dict[str, dict[str, None]] = {}
    for note in notes:
        for part in note.split("; "):
            name, outside, numbers = part.partition(OUTSIDE)
            result.setdefault(name + outside, {}).update(dict.fromkeys(numbers.split(", ")))
    return [start + ", ".join(numbers) for start, numbers in result.items()]


def _cell(value: Any, factor: float, digits: int) -> str:  # noqa: ANN401 (a number or a word)
    if factor == 0.0:
        return str(value)
    if pd.isna(value):
        return "-"
    return "line" if math.isinf(value) else f"{value * factor:.{digits}f}"
