# SPDX-License-Identifier: BSD-3-Clause
"""Stress below the surface in a few lines."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr

NOTES = "surface_note", "cycle_note"


def text(data: xr.Dataset) -> str:
    """Lines that ``pyehl stress`` prints."""
    return "\n".join(f"{name:10} {words}" for name, words in facts(data))


def facts(data: xr.Dataset) -> list[tuple[str, str]]:
    """Name and words of each result."""
    si = "principal_shear_max_Pa" in data
    unit, length = ("MPa", "um") if si else ("p_h", "a")

    def stress_of(name: str) -> float:
        return float(data[f"{name}_Pa"]) * 1e-6 if si else float(data[name])

    def length_of(name: str) -> float:
        return float(data[f"{name}_m"]) * 1e6 if si else float(data[name])

    def quantity(name: str, end: str = "") -> str:
        depth = length_of(f"{name}{end}_depth")
        return f"{stress_of(name + end):.4g} {unit} at a depth of {depth:.3g} {length}"

    def percent(name: str, over: str) -> str:
        return f"{100.0 * float(data[name]) / float(data[over]):.2g} %"

    body = f"Poisson ratio {data.attrs['poisson']:g}; {data.attrs['friction_note']}"
    error = percent("principal_shear_max_error", "principal_shear_max")
    found = [
        (f"body {data.attrs['body']}", body),
        ("shear", f"{quantity('principal_shear_max')} (principal shear, +- {error})"),
        ("von Mises", quantity("von_mises_max")),
    ]
    if "ratio_to_smooth" in data:
        words = f"{quantity('principal_shear_max', '_smooth')}; rough over smooth "
        words += f"{float(data.ratio_to_smooth):.3f}; {data.attrs['instants']} instants"
        found.append(("smooth", words))
    layer = f"the layer down to {length_of('near_surface_depth'):.3g} {length}"
    words = f"{stress_of('near_surface_shear'):.4g} {unit} in {layer}"
    if "near_surface_shear_error" in data:
        at_edge, inner = (
            percent(f"{name}_error", name)
            for name in ("near_surface_shear", "near_surface_shear_inner")
        )
        words += f", +- {at_edge} ({inner} within 0.6 semi-axes)"
    found.append(("near", words))
    if "near_surface_share" in data:
        words = (
            f"{100.0 * float(data.near_surface_share):.3g} % of {layer} is above the given shear"
        )
        if "near_surface_share_smooth" in data:
            words += f" (smooth: {100.0 * float(data.near_surface_share_smooth):.3g} %)"
        found.append(("above", words))
    if "shear_amplitude" in data:
        k = int(data.shear_amplitude.values.argmax())
        row = data.isel(Z=k)
        depth = float(row.z_m) * 1e6 if si else float(row.Z)
        amplitude = float(row.shear_amplitude_Pa) * 1e-6 if si else float(row.shear_amplitude)
        words = f"{amplitude:.4g} {unit} of the deviator over the passage, at {depth:.3g} {length}"
        found.append(("amplitude", words))
    found += [("note", data.attrs[name]) for name in NOTES if name in data.attrs]
    if "fatigue_stress_Pa" in data:
        words = f"{float(data.fatigue_stress_Pa) * 1e-6:.4g} MPa, "
        words += f"{float(data.fatigue_ratio):.3f} of the fatigue limit in torsion"
        found.append(("fatigue", words))
    if "kappa" in data:
        words = f"{float(data.kappa):.3g} by Lambda^1.3 (ISO 281, for comparison)"
        found.append(("kappa", words))
    if "a_iso" in data:
        factor = float(data.a_iso)
        known = f"{factor:.3g}" if math.isfinite(factor) else "not defined below kappa = 0.1"
        found.append(("a_ISO", known))
    return found
