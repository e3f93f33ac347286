# SPDX-License-Identifier: BSD-3-Clause
"""The pattern of one wavelength that stands for a surface on a Stribeck curve.

theta_2 is that of Zhang et al. 2019, section 4.2, made for a pattern of one wavelength. For another
surface it is taken for the pattern cos(2 pi x/wavelength) cos(2 pi y/wavelength) with the same rms
height (A_i = 2 sigma) and the same mean wavenumber, which is 2 sqrt(2) pi/wavelength; for two rough
surfaces for one with the power of both.
"""

import math
from dataclasses import dataclass

import numpy as np
import scipy

from pyehl import surfaces
from pyehl.theory.line_contact import AnyContact
from pyehl.types import Settings


@dataclass(frozen=True, slots=True)
class Pattern:
    """The pattern of one wavelength that stands for a surface: rms height and wavelength [m]."""

    rms_height: float
    wavelength: float


SMOOTH = Pattern(0.0, math.inf)


def pattern(settings: Settings, operating: AnyContact, film: float) -> Pattern:
    """Give the pattern that theta_2 is taken for, of a resolved case with a rough surface.

    `film` is the central film [m], of which the amplitude of harmonic roughness may be a share.
    """
    if settings["surface"]["kind"] == "harmonic":
        lengths = [float(settings["surface"][f"wavelength_{axis}"]) for axis in "xy"]
        amplitude = surfaces.harmonic_amplitude(settings, operating, film)
        return Pattern(0.5 * amplitude, min(lengths) * operating.hertz_radius)
    tile = surfaces.from_settings(settings, operating, film)
    qx, qy = surfaces.wavenumbers(tile)
    power = np.abs(scipy.fft.rfft2(tile.heights)) ** 2
    power[0, 0] = 0.0
    # the half of the spectrum that is not there has the same power
    last = -1 if tile.shape[1] % 2 == 0 else None
    power[:, 1:last] *= 2.0
    mean = float((np.hypot(qx, qy) * power).sum() / power.sum())
    return Pattern(tile.rms_height, 2.0 * math.sqrt(2.0) * math.pi / mean)


def kept_pattern(
    settings: Settings, operating: AnyContact, film: float, kept: dict[str, Pattern]
) -> Pattern:
    """Give the pattern of the rough surface of a case; of two that of both together.

    A surface that knows nothing of the contact is made once.
    """
    found = []
    for group in surfaces.rough_groups(settings):
        alone = {**settings, "surface": settings[group]}
        name = str(sorted(settings[group].items(), key=str))
        if settings[group]["kind"] == "harmonic" or name not in kept:
            kept[name] = pattern(alone, operating, film)
        found.append(kept[name])
    if len(found) == 1:
        return found[0]
    variance = sum(part.rms_height**2 for part in found)
    if not variance > 0.0:
        return SMOOTH
    # the mean wavenumber is that of the power of both
    number = sum(part.rms_height**2 / part.wavelength for part in found) / variance
    return Pattern(math.sqrt(variance), 1.0 / number)
