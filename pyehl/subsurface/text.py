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
    si = "principal_shear_max_Pa" in data

    def told(name: str, end: str = "") -> str:
        if si:
            stress_text = f"{float(data[f'{name}{end}_Pa']) * 1e-6:.4g} MPa"
            depth = f"{float(data[f'{name}{end}_depth_m']) * 1e6:.3g} um"
        else:
            stress_text = f"{float(data[f'{name}{end}']):.4g} p_h"
            depth = f"{float(data[f'{name}{end}_depth']):.3g} a"
        return f"{stress_text} at a depth of {depth}"

    error = float(data.principal_shear_max_error) / float(data.principal_shear_max)
    lines = [
        f"body {data.attrs['body']}     Poisson ratio {data.attrs['poisson']:g}; "
        f"{data.attrs['friction_note']}",
        f"shear      {told('principal_shear_max')} (principal shear, +- {100.0 * error:.2g} %)",
        f"von Mises  {told('von_mises_max')}",
    ]
    if "ratio_to_smooth" in data:
        lines.append(
            f"smooth     {told('principal_shear_max', '_smooth')}; rough over smooth "
            f"{float(data.ratio_to_smooth):.3f}; {data.attrs['instants']} instants"
        )
    near = data.near_surface_shear_Pa * 1e-6 if si else data.near_surface_shear
    layer = data.near_surface_depth_m * 1e6 if si else data.near_surface_depth
    unit, length = ("MPa", "um") if si else ("p_h", "a")
    line = f"near       {float(near):.4g} {unit} in the layer down to {float(layer):.3g} {length}"
    if "near_surface_shear_error" in data:
        errors = [
            100.0 * float(data[f"{name}_error"] / data[name])
            for name in ("near_surface_shear", "near_surface_shear_inner")
        ]
        line += f", +- {errors[0]:.2g} % ({errors[1]:.2g} % within 0.8 semi-axes)"
    lines.append(line)
    if "shear_amplitude" in data:
        k = int(data.shear_amplitude.values.argmax())
        amplitude = data.shear_amplitude_Pa[k] * 1e-6 if si else data.shear_amplitude[k]
        place = float(data.z_m[k] * 1e6 if si else data.Z[k])
        lines.append(
            f"amplitude  {float(amplitude):.4g} {unit} of the deviator over the passage, at "
            f"{place:.3g} {length}"
        )
    lines += [f"note       {data.attrs[n]}" for n in NOTES if n in data.attrs]
    if "near_surface_share" in data:
        lines.append(
            f"near       {100.0 * float(data.near_surface_share):.3g} % of the volume down to "
            f"{float(data.near_surface_depth_m) * 1e6:.3g} um is above the given shear"
            + (
                f" (smooth: {100.0 * float(data.near_surface_share_smooth):.3g} %)"
                if "near_surface_share_smooth" in data
                else ""
            )
        )
    if "fatigue_stress_Pa" in data:
        lines.append(
            f"fatigue    {float(data.fatigue_stress_Pa) * 1e-6:.4g} MPa, "
            f"{float(data.fatigue_ratio):.3f} of the fatigue limit in torsion"
        )
    if "kappa" in data:
        lines.append(f"kappa      {float(data.kappa):.3g} by Lambda^1.3 (ISO 281, for comparison)")
    if "a_iso" in data:
        factor = float(data.a_iso)
        known = f"{factor:.3g}" if math.isfinite(factor) else "not defined below kappa = 0.1"
        lines.append(f"a_ISO      {known}")
    return "\n".join(lines)
