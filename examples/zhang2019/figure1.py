# SPDX-License-Identifier: BSD-3-Clause
"""Figure 1: the flow of the prediction, with the fields of one surface at each step."""

from dataclasses import dataclass

import numpy as np
import pictures
import scipy.fft
from conditions import CASE, MODELS, SEED
from pictures import Step
from piece import Check, Level, References, Result
from runs import Runs

from pyehl.case import Case
from pyehl.prediction.predict import predict
from pyehl.prediction.result import Prediction
from pyehl.theory.amplitude import component_amplitude_ratio

Array = pictures.Array

NAME = "figure 1"
TITLE = "Flow of the prediction"


@dataclass(frozen=True, slots=True)
class Flow:
    """Predictions of one surface by the paper's model and ours, and the steps of the former.

    `without_phase` is the largest height over the rms height of the surface that has only the
    moduli of the components, as in eq. 10 as printed.
    """

    paper: Prediction
    ours: Prediction
    spectrum: Array
    ratio: Array
    stress: Array
    without_phase: float


def run(runs: Runs, level: Level) -> Flow:
    """Predict the surface of the seed by both models, and compute the fields of the steps."""
    paper, ours = (
        predict(case.resolve(), case.text, brief=True)
        for case in (
            Case.from_text(CASE + MODELS[model], f"surface.seed={SEED}", origin="figure 1")
            for model in ("paper", "response")
        )
    )
    tile, point, oil = paper.surface, paper.operating, paper.lubricant
    nx, ny = tile.shape
    amplitude = scipy.fft.fftshift(np.abs(scipy.fft.fft2(tile.heights, norm="forward")))
    qx, qy = (
        scipy.fft.fftshift(2.0 * np.pi * scipy.fft.fftfreq(n, length / n))
        for n, length in ((nx, tile.length_x), (ny, tile.length_y))
    )
    ratio = component_amplitude_ratio(
        qx[:, None], qy[None, :], point.hertz_radius, point.moes_m, point.moes_l
    )
    # the tile with its pixel (0, 0) at the centre of the contact
    at = np.ix_(np.arange(-nx // 2, nx // 2) % nx, np.arange(-ny // 2, ny // 2) % ny)
    places = [
        np.arange(-n // 2, n // 2) * pixel / point.hertz_radius
        for n, pixel in zip(tile.shape, tile.pixel, strict=True)
    ]
    r2 = places[0][:, None] ** 2 + places[1][None, :] ** 2
    smooth = point.hertz_pressure * np.sqrt(np.maximum(0.0, 1.0 - r2))
    response = paper.friction.response
    rough = np.maximum(smooth + response.pressure[at], 0.0)
    film = paper.film - response.deformed[at]
    stress = oil.viscosity_ratio(rough) / oil.viscosity_ratio(smooth) * paper.film / film
    peak = np.fft.ifft2(np.abs(np.fft.fft2(tile.heights - tile.heights.mean()))).real
    return Flow(paper, ours, np.log10(np.maximum(amplitude, 1e-14)), ratio,
                np.where(r2 < 1.0, stress, np.nan), float(peak.max() / peak.std()))  # fmt: skip


def show(data: Flow, references: References, level: Level) -> Result:
    """Draw the fields of the steps, with the resulting friction."""
    tile, response = data.paper.surface, data.paper.friction.response
    steps = [
        Step("roughness $rr$", tile.heights * 1e9, "nm", signed=True),
        Step("components $|rr_q|$ (eq. 9)", data.spectrum, "$\\log_{10}$ of m", signed=False),
        Step("$A_d/A_i$ of each (eq. 10)", data.ratio, "", signed=False),
        Step("pressure $\\delta p$ (eqs 11, 12)", response.pressure * 1e-6, "MPa",
                            signed=True),
        Step("deformed roughness $rr^d$", response.deformed * 1e9, "nm", signed=True),
        Step("stress $\\tau_r/\\tau_s$ (eqs 13, 14)", data.stress, "", signed=False),
    ]  # fmt: skip
    caption = (
        f"The steps as fields of the surface of seed {SEED}: they give mu_r/mu_s = "
        f"{data.paper.mu_ratio:.3f} by the paper's model over a passage, {data.ours.mu_ratio:.3f} "
        "by ours, whose A_d/A_i is complex and depends on the slip."
    )
    rows = [
        (name, p.mu_ratio, p.surface.rms_height, float(np.std(p.friction.response.deformed)),
         float(np.std(p.friction.response.pressure)))
        for name, p in (("paper", data.paper), ("response", data.ours))
    ]  # fmt: skip
    # Parseval, with the amplitudes of step 2
    total = float(np.sqrt(np.sum(10.0 ** (2.0 * data.spectrum))))
    checks = [
        Check(
            "rms height from the components, in m (Parseval)", total,
            references["table1.rms_height"].value, 1e-12, "rounding, and 1e-14 for each component",
            "p. 4, Table 1",
        ),
    ]  # fmt: skip
    factor = 16.0
    notes = [
        "Eqs 9 and 12 both print the factor 4/(NxNy). Only a single factor 1/(NxNy) restores the "
        f"surface, as the check shows; as printed it would become {factor:g}/(NxNy) = "
        f"{factor / np.prod(tile.shape):.2g} times as high. Eq. 10 prints |rr_q|: without its "
        f"phase this surface is one symmetric peak, {data.without_phase:.0f} times as high as its "
        f"rms height; it is {np.abs(tile.heights).max() / tile.rms_height:.1f} times that with it."
    ]
    return Result(
        checks,
        (("model", "mu_ratio", "rms_height_m", "rms_deformed_m", "rms_pressure_Pa"), rows),
        pictures.flow(steps),
        caption,
        notes,
        alone=data.paper.seconds + data.ours.seconds,
        paper_seconds=f"{references['time.prediction'].value:g} s for each time step",
    )
