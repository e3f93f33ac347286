# SPDX-License-Identifier: BSD-3-Clause
"""Figure 5: a fractal surface, its spectrum, and the radial mean of the spectrum."""

import math
from dataclasses import dataclass

import numpy as np
import pictures
from conditions import SEED, tile
from piece import Check, Level, References, Result
from runs import Runs

from pyehl.surfaces import Topography, psd_2d, psd_isotropic

NAME = "figure 5"
TITLE = "An artificial fractal surface and its spectrum"


@dataclass(frozen=True, slots=True)
class Spectrum:
    """Surface, its radial mean spectrum (q [rad/m], C_iso [m^4]), rms height and Hurst exponent."""

    surface: Topography
    q: pictures.Array
    c_iso: pictures.Array
    rms: float
    hurst: float


def run(runs: Runs, level: Level) -> Spectrum:
    """Make the surface and its spectrum; the Hurst exponent follows from the slope of C_iso."""
    surface, _ = tile()
    _, _, c2d = psd_2d(surface)
    q, c_iso = psd_isotropic(surface)
    # the first annuli are wide compared with their wavenumber
    straight = (q > 4.0 * q[0]) & (c_iso > 0.0)
    slope = np.polyfit(np.log(q[straight]), np.log(c_iso[straight]), 1)[0]
    rms = math.sqrt(c2d.sum() / (surface.length_x * surface.length_y))
    return Spectrum(surface, q, c_iso, rms, float(-0.5 * slope - 1.0))


def show(data: Spectrum, references: References, level: Level) -> Result:
    """Draw as the paper does, and compare with the inputs of Table 1."""
    rms, hurst = references["table1.rms_height"], references["table1.hurst"]
    checks = [
        Check(
            "rms height from the spectrum, in m (Parseval)", data.rms, rms.value, 1e-3 * rms.value,
            "rounding", f"p. {rms.page}, {rms.where}",
        ),
        Check(
            "Hurst exponent from the slope of C_iso", data.hurst, hurst.value, 0.01,
            "finite width of the annuli", f"p. {hurst.page}, {hurst.where}",
        ),
    ]  # fmt: skip
    notes = [
        f"Seed {SEED}. The paper's own surface is not published: the same inputs give another one."
    ]
    caption = "Surface, its two-dimensional spectrum, its radial mean with the slope -2 - 2H."
    rows = list(zip(data.q, data.c_iso, strict=True))
    figure = pictures.spectrum(data.surface)
    return Result(checks, (("q_rad_per_m", "c_iso_m4"), rows), figure, caption, notes)
