# SPDX-License-Identifier: BSD-3-Clause
"""How much a prediction depends on a spectrum that is assumed: Ra and Rq say nothing of it."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from pyehl import lengths
from pyehl.case.surfaces import FINISHES
from pyehl.types import Settings

if TYPE_CHECKING:
    from pyehl.prediction.result import Prediction

LENGTHS = (30e-6, 100e-6, 0.0)
"""Wavelengths of roll-offs that are tried [m]; 0: none, waves as long as the tile."""


def assumed(group: Mapping[str, Any]) -> bool:
    """Whether a group of a case gives Ra, Rq or a finish, and its spectrum is no measured one."""
    if group.get("kind") != "fractal":
        return False
    named = str(group.get("finish", "none")) != "none"
    return named or bool(group.get("ra", 0.0)) or bool(group.get("rq", 0.0))


def number(groups: Mapping[str, Any], names: Sequence[str]) -> int:
    """Count the predictions that `beside` makes."""
    return len(LENGTHS) if any(assumed(groups[name]) for name in names) else 0


def beside(
    settings: Settings, groups: Sequence[str], predict: Callable[[Settings], "Prediction"]
) -> list[dict[str, Any]]:
    """Predict the case with other roll-offs, of all surfaces whose spectrum is assumed."""
    changed = [name for name in groups if assumed(settings[name])]
    if not changed:
        return []
    found = []
    for length in LENGTHS:
        roll = 2.0 * math.pi / length if length else 0.0
        other = {
            name: {**values, "rolloff_wavenumber": roll} if name in changed else values
            for name, values in settings.items()
        }
        result = predict(other)
        known = result.friction.status == "predicted"
        found.append(
            {
                "rolloff_wavelength_m": length or None,
                "status": result.friction.status,
                "h_min_rough_m": result.friction.film_min if known else None,
                "mu_ratio": result.mu_ratio if known else None,
                "film_m": result.below.deepest if result.below else None,
            }
        )
    return found


def report(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return the lines that ``pyehl predict`` prints."""
    if not rows:
        return []
    typical = (f"{k} {lengths.length(f.rolloff, most='um')}" for k, f in FINISHES.items())
    lines = [
        f"spectrum   not determined by Ra; typical roll-offs: {', '.join(typical)};",
        "           with a roll-off of the spectrum at",
    ]
    for row in rows:
        where = "none" if row["rolloff_wavelength_m"] is None else (
            lengths.length(row["rolloff_wavelength_m"], most="um")
        )  # fmt: skip
        if row["status"] == "predicted":
            what = f"minimum film {lengths.length(row['h_min_rough_m'])}, "
            what += f"mu_r/mu_s {row['mu_ratio']:.4g}"
        else:
            what = str(row["status"])
            if (film := row["film_m"]) is not None and film < 0.0:
                what += f", {lengths.length(-film)} higher than the film sustains"
        lines.append(f"           {where + ':':8} {what}")
    return lines
