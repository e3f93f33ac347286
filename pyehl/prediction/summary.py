# SPDX-License-Identifier: BSD-3-Clause
"""Summary and fields of a prediction by name; units and meanings are in :mod:`pyehl.schema`."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean
from typing import TYPE_CHECKING, Any

import numpy as np

from pyehl import schema
from pyehl.assessment import assess
from pyehl.destination import finite
from pyehl.prediction.friction import NO_FRICTION, MixedFilm, RoughFriction, film_share
from pyehl.prediction.response import Response
from pyehl.prediction.spectrum import Spectrum, cutoff_error, records
from pyehl.reasons import alpha_note
from pyehl.surfaces import Topography
from pyehl.surfaces.pair import composite_rms, correlation
from pyehl.theory.friction import absolute_friction
from pyehl.types import Array

if TYPE_CHECKING:
    from pyehl.prediction.result import Prediction


RMS_DEFORMED_ERROR, INCREASE_RMS_ERROR, INCREASE_ERROR = 0.13, 0.05, 0.15
"""Relative errors against the full simulation (docs/evidence/thinning)."""
SECOND = "second_"
"""Prefix of the names of the second surface."""


@dataclass(frozen=True, slots=True)
class Together:
    """The sum of two surfaces that move together."""

    tile: Topography  # undeformed
    deformed_rms: float  # [m]


def arrays(tile: Topography, response: Response, prefix: str = "") -> dict[str, Array]:
    """Coordinates (nx,), (ny,) [m], heights [m] and response (nx, ny) of a surface."""
    nx, ny = tile.shape
    result = {
        "x": np.arange(nx, dtype=float) * tile.pixel[0],
        "y": np.arange(ny, dtype=float) * tile.pixel[1],
        "surface": np.asfortranarray(tile.heights),
        "deformed": np.asfortranarray(response.deformed),
        "delta_p": np.asfortranarray(response.pressure),
    }
    return {prefix + name: values for name, values in result.items()}


def statistics(tile: Topography, response: Response, prefix: str = "") -> dict[str, Any]:
    """Numbers of a surface for a summary."""
    made = tile.preparation
    result = {
        "surface": tile.origin,
        "surface_preparation": made.record.summary if made else None,
        "seed": tile.seed,
        "pixels": list(tile.shape),
        "length_x_m": tile.length_x,
        "length_y_m": tile.length_y,
        "rms_height_m": tile.rms_height,
        "rms_deformed_m": float(np.std(response.deformed)),
        "rms_pressure_Pa": float(np.std(response.pressure)),
    }
    return {prefix + name: value for name, value in result.items()}


def second_summary(
    tiles: Sequence[Topography],
    response: Response,
    velocity_ratio: float,
    together: Topography | None,
) -> dict[str, Any]:
    """Return the entries of a summary for the second of two surfaces, and for both.

    `together`: their sum if they move together.
    """
    slopes = [_slope(tile) for tile in tiles]
    return {
        "second_velocity_ratio": velocity_ratio,
        **statistics(tiles[1], response, SECOND),
        "surface_rms_m": composite_rms(tiles, together),
        "surface_slope": _slope(together) if together else math.hypot(*slopes),
        "surface_correlation": correlation(tiles[0], tiles[1], together),
    }


def findings_of(tiles: Sequence[Topography]) -> str | None:
    """Name findings on the maps other than roughness; None if there are none."""
    kinds = [
        finding.kind
        for tile in tiles
        if tile.preparation is not None
        for finding in tile.preparation.record.findings
    ]
    return ", ".join(dict.fromkeys(kinds)) or None


def _slope(tile: Topography) -> float:
    """Rms slope [-]."""
    waves = Spectrum.of(tile.heights, *tile.size)
    return math.sqrt(float((np.square(waves.q) * waves.power).sum()))


def deformed_surface(
    friction: RoughFriction,
    film_minimum: float,
    film_limit: float,
    velocity_ratios: Sequence[float],
    *,
    known: bool,
    together_rms: float | None = None,
) -> dict[str, Any]:
    """Give the entries of a summary on the deformed surface.

    Minimum film of the smooth contact and film limit in m; `known`: whether the errors are known,
    which requires the measured model and a case in its range; `together_rms`: rms height of the sum
    of two deformed surfaces that move together [m]. Unknown numbers are NaN.
    """
    of_each = [float(np.std(response.deformed)) for response in friction.responses]
    deformed = of_each[0]
    of_all = together_rms if together_rms is not None else math.hypot(*of_each)
    ratio = film_minimum / of_all if of_all > 0.0 else math.nan
    rms, increase = friction.increase_rms, friction.increase_max
    share, share_error = friction.below_limit, friction.below_limit_error
    if friction.status != "predicted":
        rms = increase = share = share_error = math.nan
    values = {
        "h_min_rough_m": (friction.film_min, film_share(*velocity_ratios) * of_all),
        "rms_deformed_m": (deformed, RMS_DEFORMED_ERROR * deformed),
        "lambda_ratio_deformed": (ratio, RMS_DEFORMED_ERROR * ratio),
        "p_rise_rms_Pa": (rms, INCREASE_RMS_ERROR * rms),
        "p_rise_max_Pa": (increase, INCREASE_ERROR * increase),
        "film_below_limit_share": (share, share_error),
    }
    result: dict[str, Any] = {"film_limit_m": film_limit or None}
    for name, (value, error) in values.items():
        reported = known and math.isfinite(value)
        result |= {name: value, error_name(name): error if reported else math.nan}
    return result


def error_name(name: str) -> str:
    """Give the name of the error of a quantity, with 'error' before the unit."""
    for unit in ("_m", "_Pa", "_share"):
        if name.endswith(unit):
            return f"{name.removesuffix(unit)}_error{unit.replace('_share', '')}"
    return f"{name}_error"


def deformed_surfaces(rows: Sequence[Mapping[str, Any]]) -> dict[str, float | None]:
    """Give the same entries over the summaries of several surfaces.

    Means, the maximum pressure increase, the minimum film, and the largest of each error. None for
    an entry that one of the surfaces does not have.
    """
    names = (
        "lambda_ratio_deformed",
        "rms_deformed_m",
        "p_rise_rms_Pa",
        "p_rise_max_Pa",
        "h_min_rough_m",
        "film_below_limit_share",
    )
    over = {"p_rise_max_Pa": max, "h_min_rough_m": min}
    result: dict[str, float | None] = {}
    for name in names:
        for key, of_all in ((name, over.get(name, fmean)), (error_name(name), max)):
            numbers = [row.get(key) for row in rows]
            result[key] = None if None in numbers else of_all(float(str(v)) for v in numbers)
    return result


def contact_numbers(mixed: MixedFilm | None, boundary: float, *, known: bool) -> dict[str, Any]:
    """Give the entries of a summary on contact at a boundary film [a^2/R]; none without one.

    `known`: whether the case lies in the range in which the response was measured.
    """
    if mixed is None:
        return {}
    film = {"h_min_rough_error_m": mixed.film_min_error if known else math.nan}
    return {
        **(film if mixed.touches else {}),
        "boundary_film": boundary,
        "contact_load_share": mixed.load_share,
        "contact_load_share_error": mixed.load_share_error,
        "contact_load_share_error_note": mixed.note,
        "contact_area_share": mixed.area_share,
        "contact_area_share_error": mixed.area_share_error,
    }


def summary_of(prediction: Prediction) -> dict[str, Any]:
    """Give the summary of a prediction; None for a number that does not exist."""
    f, o = prediction.friction, prediction.operating
    tiles = [one.topography for one in prediction.surfaces]
    boundary = float(prediction.settings["lubricant"]["boundary_film"]) / o.film_scale
    together = prediction.together.tile if prediction.together else None
    sigma = composite_rms(tiles, together)
    missing = prediction.mixed is not None and prediction.mixed.friction_unknown
    rough = max(f.pressure_max, prediction.pressure_maximum) if f.status == "predicted" else None
    values: dict[str, Any] = {
        "kind": "prediction",
        "schema_version": schema.VERSION,
        "status": f.status,
        "message": f.message,
        "mu_ratio": f.mu_ratio,
        "mu_ratio_model_error": prediction.model_error,
        "mu_ratio_error_note": prediction.why_no_error,
        "mu_ratio_cutoff_error": cutoff_error(prediction.bands),
        "outside_range": prediction.outside_range,
        "mu_ratio_min": f.mu_ratio_min,
        "mu_ratio_max": f.mu_ratio_max,
        "position_error": f.position_error,
        "mu_ratio_tracks": prediction.tracks[0],
        "mu_ratio_tracks_spread": prediction.tracks[1],
        "tracks": prediction.track_count,
        "film_below_zero_share": prediction.below.share,
        "film_breakdown": prediction.advice.summary if prediction.advice else None,
        "positions": int(f.passage.size),
        "note": prediction.note,
        "reduction": prediction.options.reduction,
        "smooth": prediction.options.smooth,
        "velocity_ratio": prediction.velocity_ratio,
        "wavelength_convention": prediction.options.wavelength_convention,
        "stiffness": prediction.options.stiffness,
        "viscosity_law": prediction.lubricant.viscosity_law,
        "roelands_z": prediction.lubricant.roelands_z or None,
        "load_balance": prediction.options.load_balance,
        "pressure_viscosity_note": alpha_note(prediction.settings),
        "shear_law": prediction.lubricant.shear.law,
        "slide_to_roll": o.slide_to_roll,
        **absolute_friction(
            o, prediction.lubricant, prediction.film, f.mu_smooth, f.mu_ratio, prediction.heat
        ),
        **({"mu_note": NO_FRICTION} if missing else {}),
        "thermal_reduction": o.thermal_reduction,
        "h_c_m": prediction.film,
        "h_c_error_m": prediction.films.central_film_error * o.film_scale,
        "h_c_source": prediction.film_source,
        "h_min_m": prediction.film_minimum,
        "h_min_error_m": prediction.films.minimum_film_error * o.film_scale,
        "p_max_Pa": prediction.pressure_maximum,
        "p_max_rough_Pa": rough,
        "lambda_ratio": prediction.film_minimum / sigma if sigma > 0.0 else None,
        "lambda_ratio_central": prediction.film / sigma if sigma > 0.0 else None,
        **statistics(tiles[0], f.responses[0]),
        "surface_findings": findings_of(tiles),
        **(
            second_summary(tiles, f.responses[1], prediction.velocity_ratios[1], together)
            if len(tiles) > 1
            else {}
        ),
        **deformed_surface(
            f,
            prediction.film_minimum,
            prediction.options.film_limit,
            prediction.velocity_ratios,
            known=prediction.is_known,
            together_rms=prediction.together.deformed_rms if prediction.together else None,
        ),
        **contact_numbers(prediction.mixed, boundary, known=prediction.is_known),
        "cavitated_share": f.cavitated_share,
        "cavitated_friction": f.cavitated_friction,
        "load_error": f.load_error,
        ("moes_m_line" if o.ellipse.is_line else "moes_m"): o.moes_m,
        ("moes_l_line" if o.ellipse.is_line else "moes_l"): o.moes_l,
        "si": o.si,
        "hertz_radius_m": o.hertz_radius,
        "hertz_pressure_Pa": o.hertz_pressure,
        "film_scale_m": o.film_scale,
        "bands": records(prediction.bands),
        "spectrum_beside": list(prediction.beside) or None,
        # after the bands, which are computed above if they were not before
        "wall_seconds": prediction.seconds + prediction.outcome.bands_seconds,
    }
    if o.ellipse.is_line:
        values["shape"] = "line"
    elif o.radius_ratio != 1.0:
        values |= {"radius_ratio": o.radius_ratio, "semi_axis_y_m": o.semi_axes[1]}
        values["ellipticity"] = o.ellipse.ellipticity
    result = {key: finite(value) for key, value in values.items()}
    return result | {"assessment": assess(result).text}
