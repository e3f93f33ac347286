# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl predict``: relative friction of a rough contact from its spectrum."""

import argparse
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pyehl import lengths
from pyehl.api import predict
from pyehl.case.surfaces import FINISHES
from pyehl.commands.arguments import add_case_arguments, add_force
from pyehl.conclusion import conclude
from pyehl.prediction.friction import TRACKS
from pyehl.prediction.result import Prediction, draw
from pyehl.prediction.summary import error_name
from pyehl.surfaces import Topography


def report(prediction: Prediction) -> str:
    """Return the lines that ``pyehl predict`` prints."""
    f, values = prediction.friction, prediction.summary
    lines = []
    for name, one in zip(("surface", "second"), prediction.surfaces, strict=False):
        tile = one.topography
        lines += tile.preparation.record.report() if tile.preparation else []
        lines.append(_surface(name, tile))
    lines.append(f"model      {_model(prediction)}")
    if f.status == "predicted":
        lines += _deformed(values)
        ratio = f"mu_r/mu_s from {f.mu_ratio_min:.3f} to {f.mu_ratio_max:.3f}"
        lines += [
            f"passage    {ratio if math.isfinite(f.mu_ratio) else values['mu_ratio_error_note']}"
            f"   [{f.passage.size} positions, {values['wall_seconds'] * 1e3:.0f} ms]",
            f"           {values['note']}",
        ]
        if values["mu"] is not None:
            lines.append(f"           mu: {values['mu_note']}")
        strongest = sorted(prediction.bands, key=lambda band: -abs(band.increase))[:3]
        parts = ", ".join(
            f"{b.increase:+.4f} {lengths.waves(b.longest, b.shortest)}" for b in strongest
        )
        if parts:
            lines.append(f"increase   {parts}")
    lines += _other_spectra(prediction.beside)
    if prediction.advice:
        lines += prediction.advice.report()
    if f.cavitated_share > 0.0:
        line = f"edge       p_s + delta p <= 0 on {f.cavitated_share:.2g} of the contact"
        if math.isfinite(f.cavitated_friction):
            line += f", at most {f.cavitated_friction:.1g} of the friction"
        lines.append(line)
    return "\n".join([*lines, str(conclude(values))])


def _other_spectra(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Describe the predictions with other roll-offs."""
    if not rows:
        return []
    typical = (f"{k} {lengths.length(f.rolloff, max_unit='um')}" for k, f in FINISHES.items())
    lines = [
        f"spectrum   not determined by Ra; typical roll-offs: {', '.join(typical)};",
        "           with a roll-off of the spectrum at",
    ]
    for row in rows:
        where = "none" if row["rolloff_wavelength_m"] is None else (
            lengths.length(row["rolloff_wavelength_m"], max_unit="um")
        )  # fmt: skip
        if row["status"] == "predicted":
            what = f"minimum film {lengths.length(row['h_min_rough_m'])}, "
            what += f"mu_r/mu_s {row['mu_ratio']:.4g}"
        else:
            what = str(row["status"])
            if (film := row["film_m"]) is not None and film < 0.0:
                what += f", {lengths.length(-film)} higher than the film sustains"
        lines.append(f"           {where + ':':8} {what}")
    return lines


def _with_error(values: Mapping[str, Any], name: str, factor: float) -> str:
    """Format a number of a summary with its error, both times a factor."""
    error = values[error_name(name)]
    text = f"{values[name] * factor:.3g}"
    # to one digit, without a power of ten
    return text if error is None else f"{text} +- {float(f'{error * factor:.1g}'):g}"


def _surface(name: str, tile: Topography) -> str:
    return (
        f"{name:11}{tile.origin}: rms {lengths.length(tile.rms_height, 4)}, "
        f"{tile.shape[0]} x {tile.shape[1]} pixels, {lengths.size(*tile.size, 4)}"
    )


def _deformed(values: Mapping[str, Any]) -> list[str]:
    """Describe the deformed surface."""
    unit = lengths.unit_of(values["rms_deformed_m"])
    surface = [f"rms {_with_error(values, 'rms_deformed_m', lengths.UNITS[unit])} {unit}"]
    for words, name in (("pressure rms", "p_rise_rms_Pa"), ("maximum increase", "p_rise_max_Pa")):
        if values[name] is not None:
            surface.append(f"{words} {_with_error(values, name, 1e-6)} MPa")
    film = []
    if values["lambda_ratio_deformed"] is not None:
        film.append(f"h_min over its rms {_with_error(values, 'lambda_ratio_deformed', 1.0)}")
    if values["film_below_limit_share"] is not None:
        film.append(
            f"{_with_error(values, 'film_below_limit_share', 100.0)} % of the contact below "
            f"{lengths.length(values['film_limit_m'], 4)}"
        )
    return [
        f"deformed   {', '.join(surface)} (model)",
        *(f"           {', '.join(film)} (model)" for _ in film[:1]),
    ]


def _model(prediction: Prediction) -> str:
    options = prediction.options
    words = [f"{prediction.lubricant.viscosity_law} viscosity"]
    if options.reduction == "response":
        ratios = " and ".join(f"{one.velocity_ratio:g}" for one in prediction.surfaces)
        words.append(f"complex response at velocity ratio {ratios}")
    else:
        words.append(f"real amplitude ratio, wavelengths by {options.wavelength_convention}")
    words.append(f"smooth contact {prediction.film_source}")
    if options.stiffness == "paper":
        words.append("stiffness of the paper")
    if options.load_balance:
        words.append("load balanced")
    words.append(f"{prediction.lubricant.shear.law} shear stress")
    return ", ".join(words)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_case_arguments(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, help="result folder")
    add_force(parser)
    parser.add_argument(
        "--tracks",
        type=int,
        default=TRACKS,
        metavar="N",
        help=f"tracks across the surface, for mean and spread of mu_r/mu_s (default: {TRACKS})",
    )
    parser.add_argument(
        "--smooth",
        metavar="DIR",
        help="result folder with the smooth contact (default: solved first)",
    )
    parser.add_argument(
        "--plots",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="draw the pictures (default: yes)",
    )


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl predict``; 0 predicted, 1 no prediction is possible, 2 bad input."""
    prediction = predict(
        args.case,
        args.overrides,
        smooth=args.smooth,
        tracks=args.tracks,
        output=args.output,
        force=args.force,
        plots=False,
    )
    print(report(prediction), flush=True)
    if args.plots:
        draw(prediction, args.output)
    print(f"results    {args.output}")
    return 0 if prediction.friction.status == "predicted" else 1
