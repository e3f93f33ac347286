# SPDX-License-Identifier: BSD-3-Clause
"""What ``summary.json`` holds of a prediction; units and meanings are in :mod:`pyehl.schema`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyehl import library, schema
from pyehl.destination import finite
from pyehl.prediction.bands import records
from pyehl.prediction.deformed import deformed_surface
from pyehl.prediction.errors import cutoff_error
from pyehl.prediction.mixed_lubrication import NO_FRICTION, contact_numbers
from pyehl.prediction.second_surface import (
    composite_rms,
    findings_of,
    second_summary,
    statistics,
)
from pyehl.theory.friction import absolute_friction

if TYPE_CHECKING:
    from pyehl.prediction.result import Prediction


def summary_of(prediction: Prediction) -> dict[str, Any]:
    """Give the summary of a prediction; None for a number that does not exist."""
    f, o = prediction.friction, prediction.operating
    tiles = [one.topography for one in prediction.surfaces]
    layer = float(prediction.settings["lubricant"]["boundary_film"]) / o.film_scale
    together = prediction.together.tile if prediction.together else None
    sigma = composite_rms(tiles, together)
    lacking = prediction.mixed is not None and prediction.mixed.lacks_friction
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
        "pressure_viscosity_note": library.alpha_origin(prediction.text),
        "shear_law": prediction.lubricant.shear.law,
        "slide_to_roll": o.slide_to_roll,
        **absolute_friction(
            o, prediction.lubricant, prediction.film, f.mu_smooth, f.mu_ratio, prediction.heat
        ),
        **({"mu_note": NO_FRICTION} if lacking else {}),
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
            together=prediction.together,
        ),
        **contact_numbers(prediction.mixed, layer, known=prediction.is_known),
        "cavitated_share": f.cavitated_share,
        "cavitated_friction": f.cavitated_friction,
        "load_error": f.load_error,
        "moes_m": o.moes_m,
        "moes_l": o.moes_l,
        "si": o.si,
        "hertz_radius_m": o.hertz_radius,
        "hertz_pressure_Pa": o.hertz_pressure,
        "film_scale_m": o.film_scale,
        "bands": records(prediction.bands),
        "spectrum_beside": list(prediction.beside) or None,
        "wall_seconds": prediction.seconds,
    }
    if o.radius_ratio != 1.0:
        values |= {"radius_ratio": o.radius_ratio, "semi_axis_y_m": o.semi_axis_y}
        values["ellipticity"] = o.ellipse.ellipticity
    found = {key: finite(value) for key, value in values.items()}
    return found | {"assessment": library.conclude(found).assessment}
