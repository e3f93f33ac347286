# SPDX-License-Identifier: BSD-3-Clause
"""A prediction with its inputs, and its result folder."""

from __future__ import annotations

import json
import logging
import math
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyehl import display, namelist
from pyehl.arrays import write_csv
from pyehl.contact.sheared import thins
from pyehl.contact.smooth import SmoothContact
from pyehl.destination import Destination, write_json
from pyehl.prediction.breakdown import Advice, BelowZero
from pyehl.prediction.friction import (
    NO_FRICTION,
    TRACKS,
    MixedFilm,
    Outcome,
    RoughFriction,
    meaning,
)
from pyehl.prediction.model import (
    FILM_ELLIPTICITY,
    Model,
    ModelOptions,
    RoughSurface,
    model_error,
    why_no_error,
)
from pyehl.prediction.spectrum import BAND_COLUMNS, Band
from pyehl.prediction.summary import (
    SECOND,
    Together,
    arrays,
    summary_of,
)
from pyehl.surfaces import Topography, psd_isotropic
from pyehl.theory.amplitude import component_amplitude_ratio
from pyehl.theory.heat import Heat
from pyehl.theory.line_contact import AnyContact
from pyehl.theory.lubricant import Lubricant
from pyehl.types import Array, Settings

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes


LOG = logging.getLogger(__name__)

TABLES = ("passage", "spectrum", "bands")
ARRAYS = ("x", "y", "surface", "deformed", "delta_p")
ARRAYS_OF_TWO = tuple(f"{SECOND}{name}" for name in ARRAYS)
PICTURES = ("surface_spectrum", "roughness", "passage")
PICTURES_OF_SECOND = ("second_surface_spectrum", "second_roughness")


def destination(
    folder: str | os.PathLike[str],
    *,
    inputs: Iterable[str | os.PathLike[str]] = (),
    force: bool = False,
) -> Destination:
    """Give the destination of a prediction, so that it can be checked in advance."""
    names = [f"{name}.csv" for name in TABLES] + [f"{name}.npy" for name in ARRAYS + ARRAYS_OF_TWO]
    names += [f"{name}.png" for name in PICTURES + PICTURES_OF_SECOND]
    names += ["case.nml", "summary.json"]
    return Destination(folder, "prediction", tuple(names), tuple(inputs), force=force)


def write(prediction: Prediction, place: Destination) -> None:
    """Write the result folder, whole or not at all.

    Files: ``case.nml`` (resolved), ``summary.json``, ``passage.csv``, ``spectrum.csv``,
    ``bands.csv`` and, first index along x: ``x.npy`` (nx,), ``y.npy`` (ny,), ``surface.npy``,
    ``deformed.npy`` [m], ``delta_p.npy`` [Pa], (nx, ny), of a second rough surface the same as
    ``second_x.npy`` and so on. InputError if the folder holds something other than an earlier
    prediction; FileError if it cannot be written.
    """
    with place.fresh() as folder:
        text = prediction.case_text.rstrip() + "\n"
        (folder / "case.nml").write_text(text, encoding="utf-8")
        for name, columns in prediction.tables.items():
            rows = zip(*columns.values(), strict=True)
            write_csv(folder / f"{name}.csv", tuple(columns), rows)
        for name, values in prediction.arrays.items():
            np.save(folder / f"{name}.npy", values)
        files = sorted(["summary.json", *(path.name for path in folder.iterdir())])
        write_json(folder / "summary.json", prediction.summary | {"files": files})


def draw(prediction: Prediction, folder: str | os.PathLike[str]) -> None:
    """Add the pictures to a written result folder; a picture that fails causes a warning."""
    folder = Path(folder)
    summary = prediction.summary
    drawn = []
    # matplotlib takes longer to import than the prediction takes to compute
    from pyehl.plots.figures import prediction_pictures  # noqa: PLC0415
    from pyehl.plots.style import save  # noqa: PLC0415

    pictures = prediction_pictures(summary, prediction.arrays, prediction.tables)
    for name, picture in pictures.items():
        path = folder / f"{name}.png"
        try:
            drawn.append(save(picture(), path).name)
        except Exception as error:
            LOG.warning("%s: not drawn: %s", path, error or type(error).__name__)
    written = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    write_json(folder / "summary.json", written | {"files": sorted([*written["files"], *drawn])})


@dataclass(frozen=True, slots=True, repr=False)
class Prediction:
    """A prediction with its inputs.

    Attributes
    ----------
    settings
        The resolved case.
    model
        Its rough surfaces, smooth contact, operating point, lubricant and options.
    films
        The smooth contact with the boundary film of the case, whose films and maximum pressure are
        reported.
    outcome
        Friction over the passage with delta p and deformed roughness, mean and spread over tracks,
        and contribution of each octave of wavelengths.
    below
        Where the film breaks down, and on which share of the contact.
    seconds
        Wall time of the prediction, tracks included. The bands are computed when they are first
        asked for, for instance by `summary`, whose ``wall_seconds`` includes them.
    text
        The resolved case as namelist text; '' if only its settings are known.
    track_count
        Number of tracks.
    advice
        With the status ``"film breakdown"``: its place, and a suggested cut-off.
    together
        The sum of two surfaces that move together; None for other surfaces.
    mixed
        Contact at a boundary film; None without one.
    heat
        Effect of the frictional heat on friction; None: no effect.
    beside
        Predictions with other spectra, if Ra, Rq or a finish is given.

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
    def operating(self) -> AnyContact:
        """The operating point."""
        return self.model.operating

    @property
    def lubricant(self) -> Lubricant:
        """The lubricant with the viscosity law used."""
        return self.model.lubricant

    @property
    def options(self) -> ModelOptions:
        """The options of the model."""
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
        """Contribution of each octave of wavelengths."""
        return self.outcome.bands

    @property
    def film(self) -> float:
        """Smooth central film h_c [m]."""
        return self.films.central_film * self.operating.film_scale

    @property
    def film_minimum(self) -> float:
        """Smooth minimum film h_min [m]; NaN if it is not known."""
        return self.films.minimum_film * self.operating.film_scale

    @property
    def film_source(self) -> str:
        """Source of h_c as text."""
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
        """Description of `mu_ratio`."""
        return meaning(self.lubricant, self.operating)

    @property
    def mu_ratio(self) -> float:
        """Mean mu_r/mu_s over the passage [-]; NaN unless the status is ``"predicted"``."""
        return self.friction.mu_ratio

    @property
    def velocity_ratios(self) -> list[float]:
        """Velocity ratios of the rough surfaces."""
        return [one.velocity_ratio for one in self.surfaces]

    @property
    def outside_range(self) -> list[str]:
        """Names of quantities outside the range in which the response was measured."""
        return self.model.outside_range()

    @property
    def model_error(self) -> float:
        """Estimated error of `mu_ratio` due to the model [-]; NaN if it is not known."""
        if self.why_no_error:
            return math.nan
        if self.mixed and self.mixed.touches:
            return self.mixed.friction_error
        kappa = self.operating.ellipse.ellipticity
        return model_error(self.mu_ratio, thins=self.lubricant.shear.in_flow, ellipticity=kappa)

    @property
    def why_no_error(self) -> str:
        """Why `model_error` is not known; '' if it is known."""
        if self.mixed and self.mixed.friction_unknown:
            return NO_FRICTION
        alone = thins(self.lubricant, self.operating) and not self.lubricant.shear.in_flow
        return why_no_error(
            self.mu_ratio, self.outside_range, self.options, friction_alone_thins=alone
        )

    @property
    def is_known(self) -> bool:
        """Whether the errors of film and pressure over the roughness are known for such a case."""
        return self.options.measured and not self.model.outside_range(FILM_ELLIPTICITY)

    @property
    def case_text(self) -> str:
        """The resolved case as namelist text."""
        return self.text or namelist.text_of(self.settings)

    @property
    def arrays(self) -> dict[str, Array]:
        """Arrays x (nx,), y (ny,), surface, deformed [m] and delta_p [Pa] (nx, ny)."""
        result: dict[str, Array] = {}
        for prefix, one, response in zip(
            ("", SECOND), self.surfaces, self.friction.responses, strict=False
        ):
            result |= arrays(one.topography, response, prefix)
        return result

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
        """Content of ``summary.json``; None for a number that does not exist."""
        return summary_of(self)
