# SPDX-License-Identifier: BSD-3-Clause
"""What a prediction leaves: its summary, its folder, and a folder with the smooth contact under it.

Units and meanings of the summary are in :mod:`pyehl.schema`.
"""

from __future__ import annotations

import json
import logging
import math
import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyehl import namelist, schema
from pyehl.arrays import read_array, write_csv
from pyehl.assessment import assess
from pyehl.destination import Destination, finite, write_json
from pyehl.errors import InputError
from pyehl.prediction.bands import cutoff_error, records
from pyehl.prediction.friction import deformed_surface
from pyehl.prediction.mixed_lubrication import NO_FRICTION, contact_numbers
from pyehl.prediction.second_surface import (
    SECOND,
    composite_rms,
    findings_of,
    second_summary,
    statistics,
)
from pyehl.prediction.smooth import SmoothContact, contact_of
from pyehl.prediction.smooth_case import smooth_case
from pyehl.reasons import alpha_note
from pyehl.theory.friction import absolute_friction
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.shear import ShearLaw
from pyehl.types import Settings

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
        "pressure_viscosity_note": alpha_note(prediction.settings),
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
    return found | {"assessment": assess(found).text}


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
    """Give the place of the result of a prediction, to check it before there is one."""
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
    """Add the pictures to a result folder that is written; one that fails is a warning."""
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


def read_contact(
    folder: str | Path, operating: OperatingPoint, settings: Settings
) -> SmoothContact:
    """Pressure and film from a result folder, of a smooth contact or under a transient run.

    InputError if it is not the folder of a converged solution of the same contact: M and L, ratio
    of the radii along and across the motion, the law that the flow obeys, lubricant and border of
    the domain. The grid may be another.
    """
    folder = Path(folder)
    try:
        of_folder = namelist.values((folder / "case.nml").read_text(encoding="utf-8"))
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        rough = (folder / "P_smooth.npy").is_file()
        names = ("X", "Y", "P_smooth", "H_smooth") if rough else ("X", "Y", "P", "H")
        x, y, pressure, film = (read_array(folder / f"{n}.npy") for n in names)
    except (OSError, ValueError) as error:
        why = error.strerror if isinstance(error, OSError) and error.strerror else error
        raise InputError(f"{folder}: not a result folder with fields ({why})") from error
    if summary["status"] != "converged":
        raise InputError(f"{folder}: not a solution, its status is '{summary['status']}'")
    for name, here in (("moes_m", operating.moes_m), ("moes_l", operating.moes_l)):
        there = summary[name]
        if not math.isclose(there, here, rel_tol=1e-4):
            raise InputError(f"{folder}: {name} is {there:.6g} there and {here:.6g} in the case")
    there, here = float(summary.get("radius_ratio") or 1.0), operating.radius_ratio
    if not math.isclose(there, here, rel_tol=1e-4):
        raise InputError(f"{folder}: radius_ratio is {there:.6g} there and {here:.6g} in the case")
    angle = float(of_folder["contact"]["angle"])
    if here != 1.0 and angle != 0.0:
        raise InputError(f"{folder}: contact.angle is {angle:g} there and 0 in the case")
    flows = _flow(of_folder), _flow(settings)
    if flows[0] != flows[1]:
        raise InputError(f"{folder}: the flow is {flows[0]} there and {flows[1]} in the case")
    _check_same(folder, of_folder, settings)
    if (summary.get("contact_load_share") or 0.0) > 0.0:
        raise InputError(
            f"{folder}: its bodies touch at the boundary film\nexpected: the contact solved with "
            "lubricant.boundary_film = 0"
        )
    return contact_of(summary, (x, y), pressure, film, f"smooth contact in {folder}")


def _check_same(folder: Path, of_folder: Settings, settings: Settings) -> None:
    """Refuse the contact of a folder whose lubricant or border is not that of a case."""
    there, here = (namelist.values(smooth_case(groups)) for groups in (of_folder, settings))
    names = [("grid", "border"), *(("lubricant", key) for key in here["lubricant"])]
    for group, key in names:
        both = there[group].get(key), here[group][key]
        numbers = [v for v in both if isinstance(v, float)]
        same = math.isclose(*numbers, rel_tol=1e-4) if len(numbers) == 2 else both[0] == both[1]
        if not same:
            words = ["not set" if v is None else namelist.word(v) for v in both]
            raise InputError(
                f"{folder}: {group}.{key} is {words[0]} there and {words[1]} in the case"
            )


def _flow(settings: Settings) -> str:
    """Law of the flow in words, with all that it depends on."""
    law = ShearLaw.from_settings(settings)
    if not law.in_flow:
        return "newtonian"
    exponent = f" with exponent {law.carreau_exponent:g}" if law.law == "carreau" else ""
    slip = abs(float(settings["contact"]["slide_to_roll"]))
    return f"{law.law} at {law.scale:g} Pa{exponent}, slide_to_roll {slip:g},"
