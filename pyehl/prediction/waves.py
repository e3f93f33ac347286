# SPDX-License-Identifier: BSD-3-Clause
"""The film and pressure waves that a rough tile makes in a contact, by its linear response.

The tile is taken apart into plane waves; each becomes a driven wave, which moves with the
roughness, and a free wave, made in the inlet and carried at the mean velocity
(:mod:`pyehl.theory.response`). Both change slowly on their way, so that they are made at a few
stations along the motion and interpolated; the free wave also on a few lines beside the centre
line. Units: lengths along the surface by a, heights by a^2/R, pressures by p_h.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl.prediction.spectrum import Spectrum
from pyehl.prediction.transfer import Transfer
from pyehl.theory.response import edge_gain_parts
from pyehl.theory.transport import free_stiffness, stiffness

__all__ = ["REFINEMENT", "Waves"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Narrow = NDArray[np.complexfloating[Any, Any]]
Single = NDArray[np.float32]

REFINEMENT = 4
"""Points per pixel along the motion at which the free wave is tabulated."""


@dataclass(frozen=True, slots=True)
class Waves:
    """Film (less by) and pressure (more by) of driven and free waves as tiles, single precision.

    On lines of their own in place of the columns of the tile the driven waves are as fine as the
    free ones.
    """

    driven: Single  # over station (n, nx, ny/stride, 2): film, pressure
    free: Single | None  # the same (n, REFINEMENT nx, ny/stride, 2); None without free waves
    # What is added to the free waves beside the centre line, over line, as `free`
    off_centre: Single | None
    stride: int  # every so many-th column of the tile is there
    bent: bool  # as in :class:`Transfer`
    # Pressure alone that fades beside the centre line (`edge_gain_fading`); None where none does
    beyond: Waves | None = None

    @classmethod
    def of(
        cls,
        spectrum: Spectrum,
        transfer: Transfer,
        central_film: float,
        velocity_ratio: float,
        stride: int = 1,
        lines: Array | None = None,
    ) -> Waves:
        """Make the tiles of all waves in a contact with a film H_c [a^2/R].

        On the columns of the tile, or on lines Y (n,) [a].
        """
        qx, qy = spectrum.qx[:, np.newaxis], spectrum.qy[np.newaxis, :]
        stiffening = transfer.stiffening
        film = stiffening * central_film
        gain, more = edge_gain_parts(qx, qy, film, transfer.ellipticity)
        k, k_free = stiffness(spectrum.q), free_stiffness(qx, qy, velocity_ratio)
        narrow = spectrum.single()
        across = None if lines is None else narrow.on_lines(lines)
        # a linear interpolation between the points dims a wave by this on average
        step = spectrum.qx * (np.pi / REFINEMENT / spectrum.qx[-1])
        bright = (1.0 / (1.0 - np.square(step) / 12.0)).astype(np.float32)[:, np.newaxis]

        def made(gain: Array, beyond: Waves | None, *, films: bool = True) -> Waves:
            """Waves with so many times the pressure of the half-space; `films`: and with films."""
            scale = stiffening * gain
            of_driven, of_free = ((part * scale).astype(np.float32) for part in (k, k_free))

            def tiles(waves: list[tuple[Narrow, Narrow]], refinement: int) -> Single:
                columns = spectrum.shape[1] // stride if lines is None else lines.size
                shape = spectrum.shape[0] * refinement, columns, 2
                found = np.zeros((len(waves), *shape), dtype=np.float32)
                for place, pair in zip(found, waves, strict=True):
                    for i in (0, 1) if films else (1,):
                        place[..., i] = narrow.tile(pair[i], refinement, stride, across)
                return found

            def free(waves: list[Complex]) -> Single:
                lit = (t.astype(np.complex64) * bright for t in waves)
                return tiles([(t, -of_free * t) for t in lit], REFINEMENT)

            driven = [
                (t, of_driven * (1 - t)) for t in (t.astype(np.complex64) for t in transfer.driven)
            ]
            if lines is not None:
                driven = [(t * bright, pressure * bright) for t, pressure in driven]
            return cls(
                tiles(driven, 1 if lines is None else REFINEMENT),
                free(transfer.free) if transfer.free else None,
                free(transfer.off_centre) if transfer.off_centre else None,
                stride,
                transfer.bent,
                beyond,
            )

        return made(gain, None if more is None else made(more, None, films=False))
