# SPDX-License-Identifier: BSD-3-Clause
"""Film thickness formulas of circular contacts, and the verb ``pyehl film``."""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pyehl import stribeck
from pyehl.operating import Lubricant, OperatingPoint

__all__ = [
    "FilmEstimate",
    "add_arguments",
    "central_film",
    "chittenden",
    "estimates",
    "execute",
    "hamrock_dowson",
    "nijenbanning_venner_moes",
    "report",
    "sheet",
]

# Conditions of the numerical cases behind the Hamrock-Dowson formulas (J. Lubr. Technol. 99,
# 1977, 264): 34 cases, speed over nearly two decades, load over one, bronze to silicon nitride.
HAMROCK_DOWSON_RANGE = {
    "U": (1.68e-12, 5.05e-11),
    "W": (1.10e-7, 1.11e-6),
    "G": (2.3e3, 6.8e3),
}
# Conditions over which the asymptotic formula was compared with converged solutions here
NIJENBANNING_RANGE = {"M": (20.0, 2000.0), "L": (5.0, 15.0)}


@dataclass(frozen=True, slots=True)
class FilmEstimate:
    """What one formula gives.

    Attributes
    ----------
    name, source
        The formula and where it is from.
    h_c, h_min
        Central and minimum film thickness [m]; NaN where the formula gives none.
    outside
        Conditions outside the range of the formula, in words; empty when inside.
    note
        What is known of its accuracy.
    """

    name: str
    source: str
    h_c: float
    h_min: float
    outside: tuple[str, ...]
    note: str


def hamrock_dowson(speed: float, material: float, load_number: float) -> tuple[float, float]:
    """h_c/R and h_min/R [-] of a circular contact.

    Hamrock & Dowson 1977, J. Lubr. Technol. 99, 264-276, ellipticity 1.

    Parameters
    ----------
    speed, material, load_number
        U = eta0 u/(E' R), G = alpha E', W2 = w/(E' R^2) [-], u the mean velocity.
    """
    # ellipticity k = 1
    h_c = 2.69 * speed**0.67 * material**0.53 * load_number**-0.067 * (1 - 0.61 * math.exp(-0.73))
    h_min = 3.63 * speed**0.68 * material**0.49 * load_number**-0.073 * (1 - math.exp(-0.68))
    return h_c, h_min


def chittenden(speed: float, material: float, load_number: float) -> tuple[float, float]:
    """h_c/R and h_min/R [-] of a circular contact.

    Chittenden, Dowson, Dunn & Taylor 1985, Proc. R. Soc. Lond. A 397, 245-269 and 271-294.

    Parameters
    ----------
    speed, material, load_number
        U = eta0 u/(E' R), G = alpha E', W2 = w/(E' R^2) [-], u the mean velocity.
    """
    common = speed**0.68 * material**0.49 * load_number**-0.073
    return 4.31 * common * (1 - math.exp(-1.23)), 3.68 * common * (1 - math.exp(-0.67))


def nijenbanning_venner_moes(moes_m: float, moes_l: float) -> float:
    """H_c = h_c R/a^2 [-] of a circular contact with an incompressible lubricant.

    Nijenbanning, Venner & Moes 1994, Wear 176, 217-229, for R_x = R_y: the rigid-isoviscous,
    elastic-isoviscous, rigid-piezoviscous and elastic-piezoviscous asymptotes, joined. Divide by
    the density ratio at p_h for a compressible lubricant.

    Raises
    ------
    ValueError
        If M is not positive or L is negative.
    """
    if not (moes_m > 0.0 and moes_l >= 0.0):
        raise ValueError(f"need M > 0 and L >= 0, not M = {moes_m:g}, L = {moes_l:g}")
    rigid_iso = 145.0 * 1.796 ** (-15 / 7) * moes_m**-2
    elastic_iso = 3.18 * 1.63 ** (-14 / 25) * moes_m ** (-2 / 15)
    rigid_piezo = 1.29 * 1.691 ** (-2 / 3) * moes_l ** (2 / 3)
    elastic_piezo = 1.48 * 1.63 ** (-7 / 20) * moes_m ** (-1 / 12) * moes_l**0.75
    flat = 1.8
    s = 1.5 * (1.0 + math.exp(-1.2 * elastic_iso / rigid_iso))
    isoviscous = rigid_iso**1.5 + (elastic_iso**-4 + flat**-4) ** (-3 / 8)
    piezoviscous = 0.0
    if moes_l > 0.0:
        piezoviscous = (rigid_piezo**-8 + elastic_piezo**-8) ** (-s / 8)
    h_m = (isoviscous ** (2 * s / 3) + piezoviscous) ** (1 / s)
    # from the Moes film number h/R (2U)^(-1/2) to h R/a^2
    return float(h_m * (1.5 * moes_m) ** (-2 / 3))


def central_film(operating: OperatingPoint, lubricant: Lubricant) -> float:
    """Central film thickness h_c [m]: Nijenbanning-Venner-Moes over rho(p_h)/rho0.

    Within 0.8 % of converged solutions for 500 <= M <= 2000, 5 <= L <= 15.
    """
    h = nijenbanning_venner_moes(operating.moes_m, operating.moes_l)
    return h * operating.film_scale / float(lubricant.density_ratio(operating.hertz_pressure))


def _outside(
    values: Mapping[str, float], bounds: Mapping[str, tuple[float, float]]
) -> tuple[str, ...]:
    return tuple(
        f"{name} = {values[name]:.4g} outside {low:g} ... {high:g}"
        for name, (low, high) in bounds.items()
        if not low <= values[name] <= high
    )


def estimates(operating: OperatingPoint, lubricant: Lubricant) -> list[FilmEstimate]:
    """All formulas at an operating point."""
    point = (operating.speed, operating.material, operating.load_number)
    ugw = dict(zip(("U", "G", "W"), point, strict=True))
    ml = {"M": operating.moes_m, "L": operating.moes_l}
    radius = operating.radius
    hd_outside = _outside(ugw, HAMROCK_DOWSON_RANGE)
    hd = hamrock_dowson(*point)
    ch = chittenden(*point)
    return [
        FilmEstimate(
            "Nijenbanning-Venner-Moes",
            "Wear 176 (1994) 217, divided by rho(p_h)/rho0",
            central_film(operating, lubricant),
            math.nan,
            _outside(ml, NIJENBANNING_RANGE),
            "within 0.8 % of converged solutions for M = 500-2000, 2 % down to M = 20",
        ),
        FilmEstimate(
            "Hamrock-Dowson",
            "J. Lubr. Technol. 99 (1977) 264",
            hd[0] * radius,
            hd[1] * radius,
            hd_outside,
            "at M = 1000, L = 10: h_c 8 % too high, h_min 76 % too high",
        ),
        FilmEstimate(
            "Chittenden et al.",
            "Proc. R. Soc. A 397 (1985) 245",
            ch[0] * radius,
            ch[1] * radius,
            hd_outside,
            "range judged as that of Hamrock-Dowson; h_min as far off",
        ),
    ]


def sheet(settings: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """All that ``pyehl film`` says, as plain numbers in SI units.

    Parameters
    ----------
    settings
        A resolved case: mapping of groups to mappings of keys to values.

    Returns
    -------
    dict
        Inputs, Moes and Hertz numbers, one record per formula, and for a rough surface the
        Lambda ratio and (harmonic only) theta_2 with eq. 16.
    """
    operating = OperatingPoint.from_settings(settings)
    lubricant = Lubricant.from_settings(settings)
    films = estimates(operating, lubricant)
    h_c = films[0].h_c
    result: dict[str, Any] = {
        "load": operating.load,
        "mean_velocity": operating.mean_velocity,
        "radius": operating.radius,
        "reduced_modulus": operating.reduced_modulus,
        "viscosity": operating.viscosity,
        "pressure_viscosity": operating.pressure_viscosity,
        "si": operating.si,
        "moes_m": operating.moes_m,
        "moes_l": operating.moes_l,
        "U": operating.speed,
        "G": operating.material,
        "W": operating.load_number,
        "alpha_bar": operating.alpha_bar,
        "hertz_radius": operating.hertz_radius,
        "hertz_pressure": operating.hertz_pressure,
        "film_scale": operating.film_scale,
        "speed_parameter": operating.speed_parameter,
        "formulas": [
            {
                "name": f.name,
                "source": f.source,
                "h_c": f.h_c,
                "h_min": f.h_min if math.isfinite(f.h_min) else None,
                "H_c": f.h_c / operating.film_scale,
                "H_min": f.h_min / operating.film_scale if math.isfinite(f.h_min) else None,
                "outside": list(f.outside),
                "note": f.note,
            }
            for f in films
        ],
    }
    surface = settings["surface"]
    kind = str(surface["kind"])
    result["surface"] = kind
    if kind != "smooth":
        # imported here: a smooth contact needs no FFT
        from pyehl import topography  # noqa: PLC0415

        rough = topography.from_settings(settings, operating, h_c)
        result["rms_height"] = rough.rms_height
        result["lambda_ratio"] = h_c / rough.rms_height if rough.rms_height > 0.0 else None
    if kind == "harmonic":
        amplitude = topography.harmonic_amplitude(settings, operating, h_c)
        wavelength = min(float(surface["wavelength_x"]), float(surface["wavelength_y"]))
        ratio = h_c / amplitude
        theta = float(stribeck.theta_2(operating.moes_m, operating.moes_l, wavelength, ratio))
        outside = stribeck.in_range(operating.moes_m, operating.moes_l, wavelength, ratio)
        if surface["wavelength_x"] != surface["wavelength_y"]:
            outside.append("eq. 16 is for equal wavelengths along X and Y")
        result["theta_2"] = theta
        result["mu_ratio_eq_16"] = float(stribeck.relative_friction(theta))
        result["theta_2_outside"] = outside
    return result


def report(values: Mapping[str, Any]) -> str:
    """Return the page that ``pyehl film`` prints, from the record of :func:`sheet`."""
    v = values
    origin = "" if v["si"] else "  (made from M and L with the radius and modulus of a steel ball)"
    lines = [
        f"Contact{origin}",
        f"  load                 w      {v['load']:12.5g} N",
        f"  mean velocity        u      {v['mean_velocity']:12.5g} m/s",
        f"  reduced radius       R      {v['radius'] * 1e3:12.5g} mm",
        f"  reduced modulus      E'     {v['reduced_modulus'] * 1e-9:12.5g} GPa"
        "    2/E' = sum (1 - nu^2)/E",
        f"  viscosity            eta0   {v['viscosity']:12.5g} Pa s",
        f"  pressure-viscosity   alpha  {v['pressure_viscosity'] * 1e9:12.5g} 1/GPa",
        "",
        "Dimensionless",
        f"  Moes load            M      {v['moes_m']:12.5g}      U = {v['U']:.4g}",
        f"  Moes material        L      {v['moes_l']:12.5g}      G = {v['G']:.4g}",
        f"  alpha p_h            a_bar  {v['alpha_bar']:12.5g}      W = {v['W']:.4g}",
        f"  speed parameter             {v['speed_parameter']:12.5g}",
        "",
        "Dry contact (Hertz)",
        f"  maximum pressure     p_h    {v['hertz_pressure'] * 1e-9:12.5g} GPa",
        f"  contact radius       a      {v['hertz_radius'] * 1e3:12.5g} mm",
        f"  film unit            a^2/R  {v['film_scale'] * 1e6:12.5g} um",
        "",
        f"Film thickness {'h_c [um]':>23}{'h_min [um]':>12}{'H_c':>11}{'H_min':>11}   range",
    ]
    notes = []
    for f in v["formulas"]:
        h_min = f"{f['h_min'] * 1e6:12.4f}" if f["h_min"] is not None else f"{'-':>12}"
        big = f"{f['H_min']:11.5f}" if f["H_min"] is not None else f"{'-':>11}"
        inside = "OUTSIDE" if f["outside"] else "inside"
        lines.append(
            f"  {f['name']:<26}{f['h_c'] * 1e6:10.4f}{h_min}{f['H_c']:11.5f}{big}   {inside}"
        )
        notes.append(f"  {f['name']}: {f['note']}")
        notes.extend(f"  {f['name']}: {text}" for text in f["outside"])
    lines += ["", *notes]
    if "rms_height" in v:
        lines += [
            "",
            f"Surface ({v['surface']})",
            f"  rms height           sigma  {v['rms_height'] * 1e6:12.5g} um",
        ]
        if v["lambda_ratio"] is not None:
            lines.append(f"  Lambda = h_c/sigma          {v['lambda_ratio']:12.5g}")
    if "theta_2" in v:
        flag = ("OUTSIDE" if v["theta_2_outside"] else "inside") + " the range of eq. 16"
        lines += [
            f"  theta_2                     {v['theta_2']:12.5g}      {flag}",
            f"  mu_r/mu_s by eq. 16         {v['mu_ratio_eq_16']:12.5g}      "
            "Newtonian, vanishing sliding",
            *(f"    {text}" for text in v["theta_2_outside"]),
        ]
    return "\n".join(lines)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl film``."""
    # the reader is compiled, and this module is importable without it
    from pyehl.case import add_case_arguments  # noqa: PLC0415

    add_case_arguments(parser)
    parser.add_argument("--json", action="store_true", help="print JSON, in SI units")


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl film``; 0 when well, 2 for bad input."""
    from pyehl.case import Case  # noqa: PLC0415

    settings = Case.read(args.case, args.overrides).resolve()
    try:
        values = sheet(settings)
    except (ValueError, OSError) as error:
        print(f"{args.case}: {error}", file=sys.stderr)
        return 2
    print(json.dumps(values, indent=2) if args.json else report(values))
    return 0
