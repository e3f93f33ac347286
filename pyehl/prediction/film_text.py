# SPDX-License-Identifier: BSD-3-Clause
"""What closed formulas say about the film of a case, as a page of text."""

from collections.abc import Mapping
from typing import Any


def _heat(v: Mapping[str, Any]) -> list[str]:
    """Return what shear heating of the inlet does, in one line or none."""
    if v["thermal_reduction"] == 1.0:
        return []
    return [
        f"    of the inlet; {v['viscosity_ambient_Pa_s']:.5g} Pa s before shear heating, by which "
        f"the film is {v['thermal_reduction']:.4f} of the isothermal one (Gupta et al. 1992)"
    ]


def _cell(value: float | None, width: int, digits: int) -> str:
    """Write a film so wide, with the digits of its column unless these are noughts."""
    if value is None:
        return f"{'-':>{width}}"
    return f"{value:{width}.{digits}f}" if value >= 1e-3 else f"{value:{width}.2e}"


def report(values: Mapping[str, Any]) -> str:
    """Return the page that ``pyehl film`` prints, from the summary of a :func:`pyehl.film`."""
    v = values
    origin = "" if v["si"] else "  (made from M and L with the radius and modulus of a steel ball)"
    if not v["si"] and v["moes_l"] == 0.0:
        origin = "  (made from M with the radius, modulus and speed of a steel ball)"
    along, across = "R  ", []
    axes = [f"  contact radius       a      {v['hertz_radius_m'] * 1e3:12.5g} mm"]
    if "radius_ratio" in v:
        along = "R_x"
        across = [
            f"                       R_y    {v['radius_m'] / v['radius_ratio'] * 1e3:12.5g} mm"
            f"    R_x/R_y = {v['radius_ratio']:.5g}"
        ]
        axes = [
            f"  semi-axis, motion    a      {v['hertz_radius_m'] * 1e3:12.5g} mm",
            f"  semi-axis, across    b      {v['semi_axis_y_m'] * 1e3:12.5g} mm"
            f"    b/a = {v['ellipticity']:.5g}",
        ]
        if v["angle_deg"]:
            axes.append(f"  both turned by              {v['angle_deg']:12.5g} deg")
    lines = [
        f"Contact{origin}",
        f"  load                 w      {v['load_N']:12.5g} N",
        f"  mean velocity        u      {v['mean_velocity_m_per_s']:12.5g} m/s",
        f"  reduced radius       {along}    {v['radius_m'] * 1e3:12.5g} mm",
        *across,
        f"  reduced modulus      E'     {v['reduced_modulus_Pa'] * 1e-9:12.5g} GPa"
        "    2/E' = sum (1 - nu^2)/E",
        f"  viscosity            eta0   {v['viscosity_Pa_s']:12.5g} Pa s",
        *_heat(v),
        f"  pressure-viscosity   alpha  {v['pressure_viscosity_per_Pa'] * 1e9:12.5g} 1/GPa",
        "",
        "Dimensionless",
        f"  Moes load            M      {v['moes_m']:12.5g}      U = {v['U']:.4g}",
        f"  Moes material        L      {v['moes_l']:12.5g}      G = {v['G']:.4g}",
        f"  alpha p_h            a_bar  {v['alpha_bar']:12.5g}      W = {v['W']:.4g}",
        f"  speed parameter             {v['speed_parameter']:12.5g}"
        f"      g_V = {v['g_v']:.4g}, g_E = {v['g_e']:.4g}",
        f"  regime                      {v['regime']}",
        "",
        "Dry contact (Hertz)",
        f"  maximum pressure     p_h    {v['hertz_pressure_Pa'] * 1e-9:12.5g} GPa",
        *axes,
        f"  film unit            a^2/{along:4} {v['film_scale_m'] * 1e6:12.5g} um",
        "",
    ]
    if not v["formulas"]:
        return "\n".join([*lines, "Film thickness: the formulas need an axis along the motion"])
    lines.append(
        f"Film thickness {'h_c [um]':>23}{'h_min [um]':>12}{'H_c':>11}{'H_min':>11}   range"
    )
    notes = [f"  left out: {text}" for text in v["left_out"]]
    for f in v["formulas"]:
        films = [None if f[name] is None else f[name] * 1e6 for name in ("h_c_m", "h_min_m")]
        cells = [_cell(film, width, 4) for film, width in zip(films, (10, 12), strict=True)]
        cells += [_cell(f[name], 11, 5) for name in ("H_c", "H_min")]
        place = "OUTSIDE" if f["outside"] else "inside"
        if not f["applies"]:
            place = f"for {f['regime']} contacts"
        lines.append(f"{'>' if f['applies'] else ' '} {f['name']:<26}{''.join(cells)}   {place}")
        if f["applies"]:
            known = (f"{k} = {low:g} ... {high:g}" for k, (low, high) in f["range"].items())
            texts = f["note"], *(f["outside"] or [f"inside {', '.join(known)}"])
            notes.extend(f"  {f['name']}: {text}" for text in texts if text)
    if notes:
        lines += ["", *notes]
    if "rms_height_m" in v:
        lines += [
            "",
            f"Surface ({v['surface']})",
            f"  rms height           sigma  {v['rms_height_m'] * 1e6:12.5g} um",
        ]
        if v["lambda_ratio_central"] is not None:
            lines.append(f"  h_c/sigma                   {v['lambda_ratio_central']:12.5g}")
    if "theta_2" in v:
        flag = ("OUTSIDE" if v["theta_2_outside"] else "inside") + " the range of eq. 16"
        lines += [
            f"  theta_2                     {v['theta_2']:12.5g}      {flag}",
            f"  mu_r/mu_s by eq. 16         {v['mu_ratio_eq_16']:12.5g}      "
            "Newtonian, vanishing sliding",
            *(f"    {text}" for text in v["theta_2_outside"]),
        ]
    return "\n".join(lines)
