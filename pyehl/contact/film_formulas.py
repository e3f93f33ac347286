# SPDX-License-Identifier: BSD-3-Clause
"""Film thickness of a case by closed formulas: the summary and the page of ``pyehl film``."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pyehl import display, schema, surfaces
from pyehl.surfaces.pair import composite_rms, sum_of
from pyehl.theory import film, line_contact, starvation, stribeck
from pyehl.theory.line_contact import AnyContact, LineContact, contact_of, formula_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.moes_film import regime
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Settings

# Largest x_inlet at which a contact with zero pressure at the border counts as flooded [a]
FLOODED = -2.0


@dataclass(frozen=True, slots=True, repr=False)
class FilmThickness:
    """Film thickness of a case by closed formulas; its repr is the page of ``pyehl film``.

    Attributes
    ----------
    summary
        Output of ``pyehl film --json``: conditions, Moes and Hertz numbers, `formulas` and, for a
        rough surface, its rms height and film ratio.
    """

    summary: dict[str, Any]

    @property
    def formulas(self) -> list[dict[str, Any]]:
        """One dict for each formula, with h_c_m and h_min_m [m]."""
        result: list[dict[str, Any]] = self.summary["formulas"]
        return result

    def __repr__(self) -> str:
        """Return the summary as a page of text."""
        return report(self.summary)

    def _repr_html_(self) -> str:
        """Return a table of the formulas, for notebooks."""
        rows = {
            f"{f['name']}, {name} [nm]": f[f"{name}_m"] * 1e9
            for f in self.formulas
            for name in ("h_c", "h_min")
            if f["applies"] and f[f"{name}_m"] is not None
        }
        return display.table("Film thickness by formulas", rows)


def left_out(settings: Settings, lubricant: Lubricant) -> list[str]:
    """List keys of a resolved case that change the film but do not enter the formulas."""
    result = []
    grid, boundary = (
        settings.get("grid", {}),
        float(settings["lubricant"].get("boundary_film", 0.0)),
    )
    position, layer = _inlet(settings)
    if position > 0.0 and settings["contact"].get("shape") == "line":
        result.append("inlet.position: there is no formula of a starved line")
    starved = max(position, layer) > 0.0
    if grid.get("border") == "zero" and float(grid["x_inlet"]) > FLOODED and not starved:
        result.append(
            f"grid.x_inlet = {float(grid['x_inlet']):g}: the formulas are for flooded inlets"
        )
    if lubricant.shear.in_flow:
        law = lubricant.shear.law
        result.append(f"lubricant.shear_law = '{law}': the formulas are for a Newtonian flow")
    if settings.get("duty"):
        result.append("&duty: the formulas are for the steady case, without its duty")
    if boundary > 0.0:
        result.append(f"lubricant.boundary_film = {boundary:g}: the formulas are for a full film")
    return result


def _inlet(settings: Settings) -> tuple[float, float]:
    """Position of the meniscus [a] and oil layer [a^2/R] of a starved inlet."""
    inlet = settings.get("inlet", {})
    return float(inlet.get("position_hertz", 0.0)), float(inlet.get("film_hertz", 0.0))


def sheet(settings: Settings) -> dict[str, Any]:
    """Return all that ``pyehl film`` reports of a resolved case, as plain numbers in SI units.

    Inputs, Moes and Hertz numbers, one record per formula, for a rough surface h_c over its rms
    height, and for a waviness in a circular contact theta_2 with eq. 16. An ellipse rotated against
    the motion has no formulas, so its summary has no film.
    """
    operating, lubricant = contact_of(settings), Lubricant.from_settings(settings)
    line = "_line" if isinstance(operating, LineContact) else ""
    films, results = _films(settings, operating, lubricant), _rough_groups(settings)
    size: dict[str, Any] = {"load_N": operating.load}
    groups = {}
    if isinstance(operating, LineContact):
        size = {"shape": "line", "load_per_length_N_per_m": operating.load_per_length}
        regime_of = line_contact.regime(operating.moes_m, operating.moes_l)
    else:
        groups = {"g_v": operating.viscosity_parameter, "g_e": operating.elasticity_parameter}
        regime_of = regime(operating.moes_m, operating.moes_l, operating.ellipse)
    result: dict[str, Any] = {
        "kind": "film",
        "schema_version": schema.VERSION,
        **size,
        "mean_velocity_m_per_s": operating.mean_velocity,
        "radius_m": operating.radius,
        "reduced_modulus_Pa": operating.reduced_modulus,
        "viscosity_Pa_s": operating.viscosity,
        "pressure_viscosity_per_Pa": operating.pressure_viscosity,
        "viscosity_ambient_Pa_s": lubricant.viscosity,
        "thermal_reduction": operating.thermal_reduction,
        "si": operating.si,
        f"moes_m{line}": operating.moes_m,
        f"moes_l{line}": operating.moes_l,
        "U": operating.speed,
        "G": operating.material,
        "W": operating.load_number,
        "alpha_bar": operating.alpha_bar,
        "hertz_radius_m": operating.hertz_radius,
        "hertz_pressure_Pa": operating.hertz_pressure,
        "film_scale_m": operating.film_scale,
        "speed_parameter": operating.speed_parameter,
        **groups,
        "left_out": left_out(settings, lubricant),
        "regime": regime_of,
        "formulas": [_record(f, operating.film_scale) for f in films],
    }
    if isinstance(operating, OperatingPoint) and operating.radius_ratio != 1.0:
        result["radius_ratio"] = operating.radius_ratio
        result["ellipticity"] = operating.ellipse.ellipticity
        result["semi_axis_y_m"] = operating.semi_axis_y
        result["angle_deg"] = float(settings["contact"]["angle"])
    kinds = [str(surface["kind"]) for surface in results]
    result["surface"] = " and ".join(kinds) or "smooth"
    return result | _of_surfaces(settings, operating, lubricant, films) if films else result


def _rough_groups(settings: Settings) -> list[Mapping[str, Any]]:
    return [settings[group] for group in surfaces.rough_groups(settings)]


def _films(
    settings: Settings, operating: AnyContact, lubricant: Lubricant
) -> list[film.FilmEstimate]:
    """Films by the formulas, and by those of starvation; none for a rotated ellipse."""
    position, layer = _inlet(settings)
    if isinstance(operating, LineContact):
        films = line_contact.estimates(operating, lubricant)
        if layer > 0.0:
            density = float(lubricant.density_ratio(operating.density_pressure))
            h_c = line_contact.central_film(operating, lubricant)
            layer *= operating.film_scale
            films.append(starvation.line_estimate(layer / density, h_c))
        return films
    if float(settings["contact"]["angle"]) != 0.0 and operating.radius_ratio != 1.0:
        return []
    films = film.estimates(operating, lubricant)
    h_min = (f.h_min for f in films if f.applies and math.isfinite(f.h_min))
    starved = starvation.estimate(
        position,
        layer,
        (film.central_film(operating, lubricant), next(h_min, math.nan)),
        operating.film_scale,
        float(lubricant.density_ratio(operating.density_pressure)),
        operating.ellipse.ellipticity,
    )
    return [*films, starved] if starved else films


def _of_surfaces(
    settings: Settings,
    operating: AnyContact,
    lubricant: Lubricant,
    films: Sequence[film.FilmEstimate],
) -> dict[str, Any]:
    """Rms height and film ratio of rough surfaces; theta_2 of a waviness in a circular contact."""
    result: dict[str, Any] = {}
    both = _rough_groups(settings)
    kinds = {str(surface["kind"]) for surface in both}
    h_c = formula_film(operating, lubricant)
    # in a line contact, harmonic heights given over the film do not determine an rms height
    unknown = {*surfaces.FEATURES, *(("harmonic",) if operating.ellipse.is_line else ())}
    if both and not kinds & unknown:
        tiles = [
            surfaces.from_settings({**settings, "surface": surface}, operating, h_c)
            for surface in both
        ]
        together = sum_of(both, tiles, operating.hertz_radius) if len(tiles) == 2 else None
        result["rms_height_m"] = sigma = composite_rms(tiles, together)
        central = h_c if operating.ellipse.is_line else films[0].h_c
        result["lambda_ratio_central"] = central / sigma if sigma > 0.0 else None
    waves = len(both) == 1 and kinds == {"harmonic"} and operating.moes_l > 0.0
    if waves and isinstance(operating, OperatingPoint) and operating.radius_ratio == 1.0:
        (surface,) = both
        amplitude = surfaces.harmonic_amplitude(surfaces.one_rough(settings), operating, h_c)
        wavelength = min(float(surface["wavelength_x"]), float(surface["wavelength_y"]))
        of = operating.moes_m, operating.moes_l, wavelength, h_c / amplitude
        theta, outside = float(stribeck.theta_2(*of)), stribeck.in_range(*of)
        if surface["wavelength_x"] != surface["wavelength_y"]:
            outside.append("eq. 16 is for equal wavelengths along X and Y")
        result["theta_2"] = theta
        result["mu_ratio_eq_16"] = float(stribeck.relative_friction(theta))
        result["theta_2_outside"] = outside
    return result


def _record(formula: film.FilmEstimate, scale: float) -> dict[str, Any]:
    """Return the record of a formula, with films in metres and over a scale [m]."""
    h_c, h_min = (h if math.isfinite(h) else None for h in (formula.h_c, formula.h_min))
    return {
        "name": formula.name,
        "source": formula.source,
        "regime": formula.regime,
        "applies": formula.applies,
        "h_c_m": h_c,
        "h_min_m": h_min,
        "H_c": None if h_c is None else h_c / scale,
        "H_min": None if h_min is None else h_min / scale,
        "range": {name: list(bounds) for name, bounds in formula.bounds.items()},
        "outside": list(formula.outside),
        "note": formula.note,
    }


def _heat(v: Mapping[str, Any]) -> list[str]:
    """Return the effect of shear heating of the inlet, in one line or none."""
    if v["thermal_reduction"] == 1.0:
        return []
    return [
        f"    of the inlet; {v['viscosity_ambient_Pa_s']:.5g} Pa s before shear heating, by which "
        f"the film is {v['thermal_reduction']:.4f} of the isothermal one (Gupta et al. 1992)"
    ]


def _of_shape(v: Mapping[str, Any]) -> tuple[str, str, str]:
    """Return the letter of the axis, the load with its unit, and the regime groups, if any."""
    if v.get("shape") == "line":
        return "b", f"{v['load_per_length_N_per_m']:12.5g} N/m", ""
    groups = f"      g_V = {v['g_v']:.4g}, g_E = {v['g_e']:.4g}"
    return "a", f"{v['load_N']:12.5g} N", groups


def _cell(value: float | None, width: int, digits: int) -> str:
    """Format a film to a width, with the digits of its column unless they would all be zero."""
    if value is None:
        return f"{'-':>{width}}"
    if value >= 10.0 ** (width - digits - 2):
        return f"{value:{width}.5g}"  # a gap to the column before
    return f"{value:{width}.{digits}f}" if value >= 1e-3 else f"{value:{width}.2e}"


def report(values: Mapping[str, Any]) -> str:
    """Return the page that ``pyehl film`` prints, from the summary of `pyehl.film`."""
    v = values
    line = v.get("shape") == "line"
    moes_m, moes_l = ("moes_m_line", "moes_l_line") if line else ("moes_m", "moes_l")
    origin = "" if v["si"] else "  (made from M and L with the radius and modulus of a steel ball)"
    if not v["si"] and v[moes_l] == 0.0:
        origin = "  (made from M with the radius, modulus and speed of a steel ball)"
    along, across = "R  ", []
    axes = [f"  contact radius       a      {v['hertz_radius_m'] * 1e3:12.5g} mm"]
    axis, load, groups = _of_shape(v)
    if line:
        axes = [f"  half width           b      {v['hertz_radius_m'] * 1e3:12.5g} mm"]
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
            axes.append(f"  both rotated by             {v['angle_deg']:12.5g} deg")
    lines = [
        f"{'Line contact' if line else 'Contact'}{origin}",
        f"  load                 w      {load}",
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
        f"  Moes load            M      {v[moes_m]:12.5g}      U = {v['U']:.4g}",
        f"  Moes material        L      {v[moes_l]:12.5g}      G = {v['G']:.4g}",
        f"  alpha p_h            a_bar  {v['alpha_bar']:12.5g}      W = {v['W']:.4g}",
        f"  speed parameter             {v['speed_parameter']:12.5g}{groups}",
        f"  regime                      {v['regime']}",
        "",
        "Dry contact (Hertz)",
        f"  maximum pressure     p_h    {v['hertz_pressure_Pa'] * 1e-9:12.5g} GPa",
        *axes,
        f"  film unit            {axis}^2/{along:4} {v['film_scale_m'] * 1e6:12.5g} um",
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
