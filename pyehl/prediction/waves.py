# SPDX-License-Identifier: BSD-3-Clause
"""The film and pressure waves that a rough tile makes in a contact, by its linear response.

The tile is taken apart into plane waves; each becomes a driven wave, which moves with the
roughness, and a free wave, made in the inlet and carried at the mean velocity
(:mod:`pyehl.theory.response`). Both change slowly on their way, so that they are made at a few
stations along the motion and interpolated; the free wave also at two distances from the centre
line. Units: lengths along the surface by a, heights by a^2/R, pressures by p_h.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pyehl.prediction.spectrum import Spectrum
from pyehl.prediction.transfer import Transfer
from pyehl.theory.response import edge_gain, stiffness

__all__ = ["REFINEMENT", "Waves"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

REFINEMENT = 4
"""Points per pixel along the motion at which the free wave is tabulated."""


@dataclass(frozen=True, slots=True)
class Waves:
    """Film (less by) and pressure (more by) of driven and free waves as tiles.

    Attributes
    ----------
    driven
        Per station (nx, ny/stride, 2): film, pressure.
    free
        Per station (REFINEMENT nx, ny/stride, 2).
    off_centre
        What OFF_CENTRE adds to the free waves (REFINEMENT nx, ny/stride, 2).
    stride
        Every so many-th column of the tile is there. Single precision is enough for waves.
    bent
        As in :class:`Transfer`.
    """

    driven: list[Array]
    free: list[Array]
    off_centre: Array | None
    stride: int
    bent: bool

    @classmethod
    def of(
        cls,
        spectrum: Spectrum,
        transfer: Transfer,
        central_film: float,
        stride: int = 1,
    ) -> Waves:
        """Make the tiles of all waves in a contact with a film H_c [a^2/R]."""
        k = stiffness(spectrum.q) * edge_gain(
            spectrum.qx[:, np.newaxis], spectrum.qy[np.newaxis, :], central_film
        )
        # a linear interpolation between the points dims a wave by this on average
        step = spectrum.qx * (np.pi / REFINEMENT / spectrum.qx[-1])
        bright = (1.0 / (1.0 - np.square(step) / 12.0))[:, np.newaxis]

        def tiles(t: Complex, pressure: Complex, refinement: int) -> Array:
            kept = (
                spectrum.tile(factor, refinement, stride, np.complex64) for factor in (t, pressure)
            )
            return np.stack(list(kept), axis=-1)

        def free(t: Complex) -> Array:
            return tiles(t * bright, -k * (t * bright), REFINEMENT)

        return cls(
            [tiles(t, k * (1.0 - t), 1) for t in transfer.driven],
            [free(t) for t in transfer.free],
            None if transfer.off_centre is None else free(transfer.off_centre),
            stride,
            transfer.bent,
        )
