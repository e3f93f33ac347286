# SPDX-License-Identifier: BSD-3-Clause
"""The verb ``pyehl predict``: relative friction of a rough contact from its spectrum."""

from __future__ import annotations

import argparse
import csv
import json
import math
import os
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import f90nml
import numpy as np
from numpy.typing import NDArray

from pyehl import amplitude, film, psd_model, topography
from pyehl.operating import Lubricant, OperatingPoint

__all__ = ["Prediction", "add_arguments", "execute", "predict"]

NEWTONIAN_NOTE = (
    "Newtonian: the ratio is the limit of vanishing sliding; shear thinning at a real "
    "slide-to-roll ratio brings it close to 1, see psd.friction"
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
        :func:`pyehl.psd_model.over_tracks`.
    """

    settings: Mapping[str, Mapping[str, Any]]
    operating: OperatingPoint
    lubricant: Lubricant
    options: psd_model.Options
    film: float
    film_source: str
    surface: topography.Topography
    friction: psd_model.RoughFriction
    bands: Sequence[psd_model.Band]
    tracks: tuple[float, float]

    def summary(self) -> dict[str, Any]:
        """Return what ``summary.json`` holds: numbers in SI units, null where there is none."""
        f, o, s = self.friction, self.operating, self.surface
        newtonian = self.options.friction == "newtonian"
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
            "note": self._note(),
            "mu_smooth": None if newtonian else f.mu_smooth,
            "wavelength_convention": self.options.wavelength_convention,
            "phase_lag": self.options.phase_lag,
            "stiffness": self.options.stiffness,
            "viscosity_law": self.lubricant.viscosity_law,
            "roelands_z": self.lubricant.roelands_z or None,
            "load_balance": self.options.load_balance,
            "friction": self.options.friction,
            "slide_to_roll": self.options.slide_to_roll,
            "eyring_stress": self.options.eyring_stress,
            "limiting_coefficient": self.options.limiting_coefficient,
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

    def _note(self) -> str:
        return NEWTONIAN_NOTE if self.options.friction == "newtonian" else STRESS_NOTE

    def report(self) -> str:
        """Return the lines that ``pyehl predict`` prints."""
        f, s = self.friction, self.surface
        lines = [
            f"surface     {s.origin}: rms {s.rms_height * 1e6:.4g} um, "
            f"{s.shape[0]} x {s.shape[1]} pixels, "
            f"{s.length_x * 1e3:.4g} x {s.length_y * 1e3:.4g} mm",
            f"film        h_c = {self.film * 1e6:.4g} um ({self.film_source}), "
            f"least {f.film_min * 1e6:.4g} um",
            f"model       {self.lubricant.viscosity_law} viscosity, {self.options.stiffness} "
            f"stiffness, wavelength of a component by {self.options.wavelength_convention}, "
            f"{self.options.friction} friction"
            + (f", lag {self.options.phase_lag:g} deg" if self.options.phase_lag > 0.0 else "")
            + (", load balanced" if self.options.load_balance else ""),
        ]
        if f.status == "predicted":
            lines += [
                f"mu_r/mu_s   {f.mu_ratio:.3f} over the passage, {f.mu_ratio_min:.3f} ... "
                f"{f.mu_ratio_max:.3f}   [{f.passage.size} positions, {f.seconds * 1e3:.1f} ms]",
                f"            {self._note()}",
            ]
            mean, spread = self.tracks
            lines.append(f"            {mean:.3f} +- {spread:.3f} over all tracks of the tile")
            if self.options.friction != "newtonian":
                lines.append(f"mu_s        {f.mu_smooth:.4f}")
            strongest = sorted(self.bands, key=lambda band: -abs(band.rise))[:3]
            parts = ", ".join(
                f"{b.rise:+.4f} from {b.longest * 1e6:.0f} to {b.shortest * 1e6:.0f} um"
                for b in strongest
            )
            lines.append(f"rise        {parts}")
        lines.append(f"status      {f.status}: {f.message}")
        if f.cavitated_share > 0.0:
            lines.append(
                f"            p_s + delta p <= 0 on {f.cavitated_share:.2g} of the contact (rim), "
                f"at most {f.cavitated_friction:.1g} of the friction"
            )
        return "\n".join(lines)

    def write(
        self, folder: str | Path, *, plots: bool = True, case_text: str | None = None
    ) -> None:
        """Write the result folder, whole or not at all.

        Files: ``case.nml`` (resolved), ``summary.json``, ``passage.csv``, ``spectrum.csv``,
        ``bands.csv`` and, first index along x: ``x.npy`` (nx,), ``y.npy`` (ny,), ``surface.npy``,
        ``deformed.npy`` [m], ``delta_p.npy`` [Pa], (nx, ny); with `plots` the pictures as PNG.
        `case_text` is the resolved namelist; without it the settings are written as one.

        Raises
        ------
        FileExistsError
            If the folder holds something other than an earlier result.
        OSError
            If it cannot be written.
        """
        groups = {group: dict(keys) for group, keys in self.settings.items()}
        text = case_text or str(f90nml.Namelist(groups))

        def fill(target: Path) -> None:
            (target / "case.nml").write_text(text.rstrip() + "\n", encoding="utf-8")
            self._write_files(target, plots=plots)

        _write_folder(Path(folder), fill)

    def _write_files(self, target: Path, *, plots: bool) -> None:
        f, s = self.friction, self.surface
        text = json.dumps(self.summary(), indent=2, allow_nan=False)
        (target / "summary.json").write_text(text + "\n", encoding="utf-8")
        passage = zip(f.shift, f.passage, strict=True)
        _write_csv(target / "passage.csv", ("shift_m", "mu_ratio"), passage)
        q, c_iso = topography.psd_isotropic(s)
        o = self.operating
        ratio = amplitude.component_amplitude_ratio(
            q,
            0.0,
            o.hertz_radius,
            o.moes_m,
            o.moes_l,
            convention=self.options.wavelength_convention,
        )
        _write_csv(
            target / "spectrum.csv",
            ("q_rad_per_m", "c_iso_m4", "amplitude_ratio_along_x"),
            zip(q, c_iso, ratio, strict=True),
        )
        names = tuple(psd_model.Band.__dataclass_fields__)
        _write_csv(
            target / "bands.csv", names, ([getattr(b, n) for n in names] for b in self.bands)
        )
        np.save(target / "x.npy", np.arange(s.shape[0]) * s.pixel[0])
        np.save(target / "y.npy", np.arange(s.shape[1]) * s.pixel[1])
        np.save(target / "surface.npy", np.asfortranarray(s.heights))
        np.save(target / "deformed.npy", np.asfortranarray(f.response.deformed))
        np.save(target / "delta_p.npy", np.asfortranarray(f.response.pressure))
        if plots:
            # matplotlib takes longer to import than the prediction takes to compute
            from pyehl import plot  # noqa: PLC0415

            plot.save_prediction(self, target)


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
    options = psd_model.Options.from_settings(settings)
    given = float(settings["psd"]["film_thickness"])
    if given > 0.0:
        h_c, source = given, "psd.film_thickness"
    else:
        h_c = film.central_film(operating, lubricant)
        source = "Nijenbanning-Venner-Moes formula over rho(p_h)/rho0"
    surface = topography.from_settings(settings, operating, h_c)
    friction = psd_model.predict_friction(surface, operating, lubricant, h_c, options)
    bands = psd_model.contributions(surface, operating, lubricant, h_c, options)
    tracks = psd_model.over_tracks(surface, operating, lubricant, h_c, options)
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


def _write_csv(
    path: Path, names: Sequence[str], rows: Iterable[Sequence[float] | NDArray[np.float64]]
) -> None:
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(names)
        writer.writerows([repr(float(value)) for value in row] for row in rows)


def _write_folder(folder: Path, write: Callable[[Path], None]) -> None:
    """Fill a new folder beside `folder`, then put it in its place."""
    folder = Path(os.path.abspath(folder))
    if folder.exists():
        if not folder.is_dir():
            raise FileExistsError(f"{folder}: exists and is not a folder")
        if any(folder.iterdir()) and not (folder / "summary.json").is_file():
            raise FileExistsError(f"{folder}: not empty and not a result folder; choose another")
    folder.parent.mkdir(parents=True, exist_ok=True)
    fresh = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent))
    try:
        write(fresh)
        # mkdtemp makes private folders; results are as open as the user's other files
        mask = os.umask(0)
        os.umask(mask)
        fresh.chmod(0o777 & ~mask)
        if folder.exists():
            old = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent))
            folder.rename(old / "old")
            fresh.rename(folder)
            shutil.rmtree(old)
        else:
            fresh.rename(folder)
    except BaseException:
        shutil.rmtree(fresh, ignore_errors=True)
        raise


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl predict``."""
    # the reader is compiled, and this module is importable without it
    from pyehl.case import add_case_arguments  # noqa: PLC0415

    add_case_arguments(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, help="result folder")
    parser.add_argument(
        "--plots",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="draw the pictures (default: yes)",
    )


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl predict``; 0 predicted, 1 no prediction is possible, 2 bad input."""
    from pyehl.case import Case  # noqa: PLC0415

    case = Case.read(args.case, args.overrides)
    try:
        prediction = predict(case.resolve())
        prediction.write(args.output, plots=args.plots, case_text=case.text)
    except (ValueError, FileExistsError, FileNotFoundError) as error:
        print(f"{args.case}: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"{args.output}: {error}", file=sys.stderr)
        return 1
    print(prediction.report())
    print(f"results     {args.output}")
    return 0 if prediction.friction.status == "predicted" else 1
