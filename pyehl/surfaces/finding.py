# SPDX-License-Identifier: BSD-3-Clause
"""What one finding about a map is, and the steps between its lines."""

from dataclasses import dataclass

import numpy as np

from pyehl.surfaces.holes import MAD_TO_SIGMA
from pyehl.types import Array

SAMPLES = 512
"""Points of a line, at the most, that its offset is found by."""


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that is no roughness."""

    kind: str  # 'form', 'line offsets', 'stitching step', 'dust', 'spikes'
    text: str  # what it is, how large and where
    remedy: str  # option of a case that takes it off, 'surface.key=value'; '' if there is none
    # Where it is on the map (x_min, x_max, y_min, y_max) [m]; empty: everywhere
    places: tuple[tuple[float, float, float, float], ...] = ()

    def report(self) -> str:
        """Describe it in one line."""
        return f"{self.kind}: {self.text}" + (f"; {self.remedy}" if self.remedy else "")

    @property
    def summary(self) -> dict[str, object]:
        """Return what ``summary.json`` holds of it."""
        return {
            "kind": self.kind,
            "text": self.text,
            "remedy": self.remedy or None,
            "places_m": [list(place) for place in self.places],
        }


def line_steps(z: Array, axis: int, parts: int = 1) -> tuple[Array, float]:
    """Median steps (parts, n - 1) from a line to the next along an axis, and their scatter.

    The scatter of single steps about the median of their line, as a standard deviation.
    """
    lines = np.moveaxis(z, axis, 0)
    steps, deviations = [], []
    for k in range(parts):
        a, b = k * lines.shape[1] // parts, (k + 1) * lines.shape[1] // parts
        part = lines[:, a : b : max(1, (b - a) // SAMPLES)]
        difference = np.diff(part, axis=0)
        median = np.median(difference, axis=1)
        steps.append(median)
        deviations.append(np.median(np.abs(difference - median[:, np.newaxis])))
    return np.array(steps), MAD_TO_SIGMA * float(np.median(deviations))
