# SPDX-License-Identifier: BSD-3-Clause
"""A prediction with all that went into it: summary, fields and tables."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pyehl import display, library, namelist, schema
from pyehl.destination import finite
from pyehl.prediction.bands import BAND_COLUMNS, Band, records
from pyehl.prediction.breakdown import Advice, BelowZero
from pyehl.prediction.deformed import deformed_surface
from pyehl.prediction.errors import cutoff_error, model_error, outside_range, why_no_error
from pyehl.prediction.friction import TRACKS, RoughFriction, meaning, thins
from pyehl.prediction.mixed_lubrication import NO_FRICTION, MixedFilm, contact_numbers
from pyehl.prediction.model import Model, RoughSurface
from pyehl.prediction.options import Options
from pyehl.prediction.passage_friction import Outcome
from pyehl.prediction.second_surface import (
    SECOND,
    Together,
    arrays,
    composite_rms,
    findings_of,
    second_summary,
    statistics,
)
from pyehl.prediction.smooth import SmoothContact
from pyehl.surfaces import Topography, psd_isotropic
from pyehl.theory.amplitude import component_amplitude_ratio
from pyehl.theory.friction import absolute_friction
from pyehl.theory.heat import Heat
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Settings

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes


@dataclass(frozen=True, slots=True, repr=False)
class Prediction:
    """A prediction with all that went into it.

    Attributes
    ----------
    settings
        The resolved case.
    model
        Its rough surfaces, smooth contact, operating point and lubricant, and how it was read.
    films
        The smooth contact with the boundary film of the case, of which films and maximum pressure
        are told.
    outcome
        Friction over the passage with delta p and deformed roughness, mean and spread over tracks,
        and what each octave of wavelengths adds.
    below
        Where the film ends, and on which share of the contact.
    seconds
        Wall time of the whole prediction, tracks and bands included.
    text
        The resolved case as namelist text; '' where only its settings are known.
    track_count
        Number of tracks.
    advice
        With the status ``"film breakdown"``: where the film ends, and what would carry.
    together
        The sum of two surfaces that move so; None: there is none.
    mixed
        Contact at a boundary film; None: the case has none.
    heat
        What the heat of sliding makes of friction; None: nothing.
    beside
        The same with other spectra, where Ra or a finish is given.

    Examples
    --------
    >>> import pyehl
    >>> p = pyehl.predict("cases/table1.nml", "surface.seed=3")
    >>> p.mu_ratio > 1.0, p.summary["status"]
    (True, 'predicted')
    >>> p.data.surface_m.shape
    (256, 256)
    """

    settings: Settings
    model: Model
    films: SmoothContact
    outcome: Outcome
    below: BelowZero
    seconds: float
    text: str = ""
    track_count: int = TRACKS
    advice: Advice | None = None
    together: Together | None = None
    mixed: MixedFilm | None = None
    heat: Heat | None = None
    beside: Sequence[Mapping[str, Any]] = ()

    @property
    def operating(self) -> OperatingPoint:
        """The operating point."""
        return self.model.operating

    @property
    def lubricant(self) -> Lubricant:
        """The lubricant with the viscosity law used."""
        return self.model.lubricant

    @property
    def options(self) -> Options:
        """How the model was read."""
        return self.model.options

    @property
    def surfaces(self) -> tuple[RoughSurface, ...]:
        """The rough surfaces."""
        return self.model.surfaces

    @property
    def surface(self) -> Topography:
        """The undeformed roughness of the (first) surface."""
        return self.surfaces[0].topography

    @property
    def velocity_ratio(self) -> float:
        """Velocity of the (first) rough surface over the mean velocity [-]."""
        return self.surfaces[0].velocity_ratio

    @property
    def friction(self) -> RoughFriction:
        """mu_r/mu_s over the passage, delta p and deformed roughness."""
        return self.outcome.friction

    @property
    def tracks(self) -> tuple[float, float]:
        """Mean and standard deviation of the passage mean over the tracks of the tile."""
        return self.outcome.tracks

    @property
    def bands(self) -> Sequence[Band]:
        """What each octave of wavelengths adds."""
        return self.outcome.bands

    @property
    def film(self) -> float:
        """Smooth central film h_c [m]."""
        return self.films.central_film * self.operating.film_scale

    @property
    def film_minimum(self) -> float:
        """Smooth minimum film h_min [m]; NaN where it is not known."""
        return self.films.minimum_film * self.operating.film_scale

    @property
    def film_source(self) -> str:
        """Where h_c is from, in words."""
        return self.films.source

    @property
    def pressure_maximum(self) -> float:
        """Maximum pressure of the smooth contact [Pa]."""
        return float(self.films.pressure.max()) * self.operating.hertz_pressure

    def __repr__(self) -> str:
        """Give the ratio and the status in one line."""
        return f"Prediction(mu_ratio={self.mu_ratio:.4g}, {self.friction.status!r})"

    def _repr_html_(self) -> str:
        """Draw the summary, for notebooks."""
        rows = {k: v for k, v in self.summary.items() if v is not None and k != "bands"}
        return display.table("Prediction", rows)

    @property
    def note(self) -> str:
        """What `mu_ratio` is."""
        return meaning(self.lubricant, self.operating)

    @property
    def mu_ratio(self) -> float:
        """Mean mu_r/mu_s over the passage [-]; NaN unless the status is ``"predicted"``."""
        return self.friction.mu_ratio

    @property
    def _ratios(self) -> list[float]:
        """Velocity ratios of the rough surfaces."""
        return [one.velocity_ratio for one in self.surfaces]

    @property
    def outside_range(self) -> list[str]:
        """What of the case lies outside the range in which the response was measured; mostly []."""
        thinning = self.model.contact.thinning
        found = [outside_range(self.operating, u, self.options, thinning) for u in self._ratios]
        return list(dict.fromkeys(name for names in found for name in names))

    @property
    def model_error(self) -> float:
        """Error of `mu_ratio` by the model, estimated [-]; NaN where it is not known."""
        if self.why_no_error:
            return math.nan
        if self.mixed and self.mixed.touches:
            return self.mixed.friction_error
        kappa = self.operating.ellipse.ellipticity
        return model_error(self.mu_ratio, thins=self.lubricant.shear.in_flow, ellipticity=kappa)

    @property
    def why_no_error(self) -> str:
        """Why `model_error` is not known; '' where it is."""
        if self.mixed and self.mixed.lacks_friction:
            return NO_FRICTION
        of = self.mu_ratio, self.outside_range, self.options
        alone = thins(self.lubricant, self.operating) and not self.lubricant.shear.in_flow
        return why_no_error(*of, friction_alone_thins=alone)

    @property
    def _known(self) -> bool:
        """Whether the model is one whose errors were measured, and the case in its range."""
        return self.options.measured and not self.outside_range

    @property
    def case_text(self) -> str:
        """The resolved case as namelist text."""
        return self.text or namelist.text_of(self.settings)

    @property
    def arrays(self) -> dict[str, Array]:
        """Arrays x (nx,), y (ny,), surface, deformed [m] and delta_p [Pa] (nx, ny)."""
        found: dict[str, Array] = {}
        for prefix, one, response in zip(
            ("", SECOND), self.surfaces, self.friction.responses, strict=False
        ):
            found |= arrays(one.topography, response, prefix)
        return found

    @property
    def tables(self) -> dict[str, dict[str, Array]]:
        """Columns of the tables ``passage``, ``spectrum`` and ``bands``."""
        f, o, convention = self.friction, self.operating, self.options.wavelength_convention
        shifts = zip(("shift_m", "second_shift_m"), f.shifts, strict=False)
        q, c_iso = psd_isotropic(self.surface)
        ratio = component_amplitude_ratio(
            q, 0.0, o.hertz_radius, *o.equivalent_moes, convention=convention
        )
        return {
            "passage": {**dict(shifts), "mu_ratio": f.passage},
            "spectrum": {"q_rad_per_m": q, "c_iso_m4": c_iso, "amplitude_ratio_along_x": ratio},
            "bands": {
                name: np.array([getattr(band, key) for band in self.bands])
                for key, name in BAND_COLUMNS.items()
            },
        }

    @property
    def data(self) -> xarray.Dataset:
        """Fields, tables and scalars, the same as `pyehl.load` of the folder."""
        # xarray takes longer to import than the prediction takes to compute
        from pyehl.results import prediction_dataset  # noqa: PLC0415

        return prediction_dataset(self.summary, self.case_text, self.arrays, self.tables)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw mu_r/mu_s over the passage on `ax`, or on a new figure; returns the axes."""
        from pyehl.plots.surface import passage  # noqa: PLC0415 (matplotlib, as above)

        f = self.friction
        second = f.shifts[1] if len(f.shifts) > 1 else None
        return passage(f.shift, f.passage, self.surface.length_x, second=second, ax=ax)

    @property
    def summary(self) -> dict[str, Any]:
        """What ``summary.json`` holds; None for a number that does not exist."""
        f, o = self.friction, self.operating
        tiles = [one.topography for one in self.surfaces]
        layer = float(self.settings["lubricant"]["boundary_film"]) / o.film_scale
        together = self.together.tile if self.together else None
        sigma = composite_rms(tiles, together)
        lacking = self.mixed is not None and self.mixed.lacks_friction
        rough = max(f.pressure_max, self.pressure_maximum) if f.status == "predicted" else None
        values: dict[str, Any] = {
            "kind": "prediction",
            "schema_version": schema.VERSION,
            "status": f.status,
            "message": f.message,
            "mu_ratio": f.mu_ratio,
            "mu_ratio_model_error": self.model_error,
            "mu_ratio_error_note": self.why_no_error,
            "mu_ratio_cutoff_error": cutoff_error(self.bands),
            "outside_range": self.outside_range,
            "mu_ratio_min": f.mu_ratio_min,
            "mu_ratio_max": f.mu_ratio_max,
            "position_error": f.position_error,
            "mu_ratio_tracks": self.tracks[0],
            "mu_ratio_tracks_spread": self.tracks[1],
            "tracks": self.track_count,
            "film_below_zero_share": self.below.share,
            "film_breakdown": self.advice.summary if self.advice else None,
            "positions": int(f.passage.size),
            "note": self.note,
            "reduction": self.options.reduction,
            "smooth": self.options.smooth,
            "velocity_ratio": self.velocity_ratio,
            "wavelength_convention": self.options.wavelength_convention,
            "stiffness": self.options.stiffness,
            "viscosity_law": self.lubricant.viscosity_law,
            "roelands_z": self.lubricant.roelands_z or None,
            "load_balance": self.options.load_balance,
            "pressure_viscosity_note": library.alpha_origin(self.text),
            "shear_law": self.lubricant.shear.law,
            "slide_to_roll": o.slide_to_roll,
            **absolute_friction(o, self.lubricant, self.film, f.mu_smooth, f.mu_ratio, self.heat),
            **({"mu_note": NO_FRICTION} if lacking else {}),
            "thermal_reduction": o.thermal_reduction,
            "h_c_m": self.film,
            "h_c_error_m": self.films.central_film_error * o.film_scale,
            "h_c_source": self.film_source,
            "h_min_m": self.film_minimum,
            "h_min_error_m": self.films.minimum_film_error * o.film_scale,
            "p_max_Pa": self.pressure_maximum,
            "p_max_rough_Pa": rough,
            "lambda_ratio": self.film_minimum / sigma if sigma > 0.0 else None,
            "lambda_ratio_central": self.film / sigma if sigma > 0.0 else None,
            **statistics(tiles[0], f.responses[0]),
            "surface_findings": findings_of(tiles),
            **(
                second_summary(tiles, f.responses[1], self._ratios[1], together)
                if len(tiles) > 1
                else {}
            ),
            **deformed_surface(
                f,
                self.film_minimum,
                self.options.film_limit,
                self._ratios,
                known=self._known,
                together=self.together,
            ),
            **contact_numbers(self.mixed, layer, known=self._known),
            "cavitated_share": f.cavitated_share,
            "cavitated_friction": f.cavitated_friction,
            "load_error": f.load_error,
            "moes_m": o.moes_m,
            "moes_l": o.moes_l,
            "si": o.si,
            "hertz_radius_m": o.hertz_radius,
            "hertz_pressure_Pa": o.hertz_pressure,
            "film_scale_m": o.film_scale,
            "bands": records(self.bands),
            "spectrum_beside": list(self.beside) or None,
            "wall_seconds": self.seconds,
        }
        if o.radius_ratio != 1.0:
            values |= {"radius_ratio": o.radius_ratio, "semi_axis_y_m": o.semi_axis_y}
            values["ellipticity"] = o.ellipse.ellipticity
        told = {key: finite(value) for key, value in values.items()}
        return told | {"judgement": library.conclude(told).judgement}
