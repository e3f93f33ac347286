# SPDX-License-Identifier: BSD-3-Clause
"""The prediction of a case, with all that went into it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from pyehl import surfaces
from pyehl.prediction.bands import Band, contributions
from pyehl.prediction.friction import RoughFriction, over_tracks, predict_friction
from pyehl.prediction.options import Options
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

__all__ = ["Prediction", "predict"]

NEWTONIAN_NOTE = (
    "Newtonian: the ratio is the limit of vanishing sliding; shear thinning at a real "
    "slide-to-roll ratio brings it close to 1, see lubricant.shear_law"
)
STRESS_NOTE = "ratio of friction coefficients at the given slide-to-roll ratio"


@dataclass(frozen=True, slots=True)
class Prediction:
    """A prediction with all that went into it.

    Attributes
    ----------
    settings
        The resolved case.
    operating, lubricant, options
        The operating point, the lubricant with the viscosity law used, and how the model was read.
    film
        Smooth central film h_c [m].
    film_source
        Where h_c is from, in words.
    surface
        The undeformed roughness.
    friction
        mu_r/mu_s over the passage, delta p and deformed roughness.
    bands
        What each octave of wavelengths adds.
    tracks
        Mean and standard deviation of the passage mean over the tracks of the tile, see
        :func:`pyehl.prediction.over_tracks`.
    """

    settings: Mapping[str, Mapping[str, Any]]
    operating: OperatingPoint
    lubricant: Lubricant
    options: Options
    film: float
    film_source: str
    surface: surfaces.Topography
    friction: RoughFriction
    bands: Sequence[Band]
    tracks: tuple[float, float]

    @property
    def thins(self) -> bool:
        """Whether the shear stress is another than the Newtonian one."""
        return self.lubricant.shear.law != "newtonian" and self.operating.sliding_speed > 0.0

    def summary(self) -> dict[str, Any]:
        """Return what ``summary.json`` holds: numbers in SI units, null where there is none."""
        f, o, s = self.friction, self.operating, self.surface
        values: dict[str, Any] = {
            "kind": "prediction",
            "status": f.status,
            "message": f.message,
            "mu_ratio": f.mu_ratio,
            "mu_ratio_min": f.mu_ratio_min,
            "mu_ratio_max": f.mu_ratio_max,
            "position_error": f.position_error,
            "mu_ratio_tracks": self.tracks[0],
            "mu_ratio_tracks_spread": self.tracks[1],
            "positions": int(f.passage.size),
            "note": STRESS_NOTE if self.thins else NEWTONIAN_NOTE,
            "mu_smooth": f.mu_smooth if self.thins else None,
            "wavelength_convention": self.options.wavelength_convention,
            "phase_lag": self.options.phase_lag,
            "stiffness": self.options.stiffness,
            "viscosity_law": self.lubricant.viscosity_law,
            "roelands_z": self.lubricant.roelands_z or None,
            "load_balance": self.options.load_balance,
            "shear_law": self.lubricant.shear.law,
            "slide_to_roll": o.slide_to_roll,
            "h_c": self.film,
            "h_c_source": self.film_source,
            "h_min": f.film_min,
            "lambda_ratio": self.film / s.rms_height if s.rms_height > 0.0 else None,
            "surface": s.origin,
            "seed": s.seed,
            "pixels": list(s.shape),
            "length_x": s.length_x,
            "length_y": s.length_y,
            "rms_height": s.rms_height,
            "rms_deformed": float(np.std(f.response.deformed)),
            "rms_pressure": float(np.std(f.response.pressure)),
            "cavitated_share": f.cavitated_share,
            "cavitated_friction": f.cavitated_friction,
            "load_error": f.load_error,
            "moes_m": o.moes_m,
            "moes_l": o.moes_l,
            "si": o.si,
            "hertz_radius": o.hertz_radius,
            "hertz_pressure": o.hertz_pressure,
            "film_scale": o.film_scale,
            "bands": [asdict(band) for band in self.bands],
            "wall_seconds": f.seconds,
        }
        return {key: _finite(value) for key, value in values.items()}


def predict(settings: Mapping[str, Mapping[str, Any]]) -> Prediction:
    """Predict the relative friction of a resolved case.

    Parameters
    ----------
    settings
        Mapping of groups to mappings of keys to values, every key present.

    Raises
    ------
    ValueError
        If the surface is smooth, a map is not usable, or the conditions are outside the model.
    OSError
        If a map cannot be opened.
    """
    operating = OperatingPoint.from_settings(settings)
    lubricant = Lubricant.from_settings(settings, str(settings["psd"]["viscosity_law"]))
    options = Options.from_settings(settings)
    given = float(settings["psd"]["film_thickness"])
    if given > 0.0:
        h_c, source = given, "psd.film_thickness"
    else:
        h_c = central_film(operating, lubricant)
        source = "Nijenbanning-Venner-Moes formula over rho(p_h)/rho0"
    surface = surfaces.from_settings(settings, operating, h_c)
    friction = predict_friction(surface, operating, lubricant, h_c, options)
    bands = contributions(surface, operating, lubricant, h_c, options)
    tracks = over_tracks(surface, operating, lubricant, h_c, options)
    return Prediction(
        settings, operating, lubricant, options, h_c, source, surface, friction, bands, tracks
    )


def _finite(value: object) -> object:
    """Return the value with null for what JSON cannot say."""
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, list):
        return [_finite(item) for item in value]
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    return value
