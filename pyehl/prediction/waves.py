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

from pyehl.prediction.response import Transfer
from pyehl.prediction.spectrum import Spectrum
from pyehl.theory.transport import free_stiffness, stiffness
from pyehl.types import Array, Complex, Single

Narrow = NDArray[np.complexfloating[Any, Any]]

REFINEMENT = 4
"""Points per pixel along the motion at which the free wave is tabulated."""


@dataclass(frozen=True, slots=True)
class WaveTiles:
    """Film (less by) and pressure (more by) of driven and free waves as tiles, single precision.

    On lines of their own in place of the columns of the tile the driven waves are as fine as the
    free ones.
    """

    driven: Single  # over station (n, nx, ny/stride, 2): film, pressure
    free: Single | None  # the same (n, REFINEMENT nx, ny/stride, 2); None without free waves
    # What is added to the free waves beside the centre line, over line, as waves along the motion
    # (n, 2, ny/stride, nx//2 + 1); None without free waves
    off_centre: Narrow | None
    stride: int  # every so many-th column of the tile is there
    bent: bool  # as in :class:`Transfer`

    @classmethod
    def of(
        cls,
        spectrum: Spectrum,
        transfer: Transfer,
        central_film: float,
        velocity_ratio: float,
        stride: int = 1,
        lines: Array | None = None,
    ) -> WaveTiles:
        """Make the tiles of all waves in a contact with a film H_c [a^2/R].

        On the columns of the tile, or on lines Y (n,) [a].
        """
        qx, qy = spectrum.qx[:, np.newaxis], spectrum.qy[np.newaxis, :]
        gain = transfer.gain(qx, qy, central_film)
        k = (stiffness(spectrum.q) * gain).astype(np.float32)
        k_free = (free_stiffness(qx, qy, velocity_ratio) * gain).astype(np.float32)
        narrow = spectrum.single()
        across = None if lines is None else narrow.on_lines(lines)
        # a linear interpolation between the points dims a wave by this on average
        step = spectrum.qx * (np.pi / REFINEMENT / spectrum.qx[-1])
        bright = (1.0 / (1.0 - np.square(step) / 12.0)).astype(np.float32)[:, np.newaxis]

        def tiles(waves: list[tuple[Narrow, Narrow]], refinement: int) -> Single:
            columns = spectrum.shape[1] // stride if lines is None else lines.size
            shape = spectrum.shape[0] * refinement, columns, 2
            found = np.empty((len(waves), *shape), dtype=np.float32)
            for place, pair in zip(found, waves, strict=True):
                for i, factor in enumerate(pair):
                    place[..., i] = narrow.tile(factor, refinement, stride, across)
            return found

        def lit(waves: list[Complex]) -> list[Narrow]:
            return [t.astype(np.complex64) * bright for t in waves]

        def free(waves: list[Complex], pressures: list[Complex]) -> list[tuple[Narrow, Narrow]]:
            if not pressures:
                return [(t, -k_free * t) for t in lit(waves)]
            given = [-one for one in lit([gain * p for p in pressures])]
            return list(zip(lit(waves), given, strict=True))

        def off_centre() -> Narrow:
            return np.array(
                [
                    [narrow.along(factor, REFINEMENT, stride, across) for factor in pair]
                    for pair in free(transfer.off_centre, on_lines)
                ]
            )

        on_stations: list[Complex] = []
        on_lines: list[Complex] = []
        if transfer.pressed:
            on_stations, on_lines = transfer.free_pressures(qx, qy, velocity_ratio)

        driven = [(t, k * (1 - t)) for t in (t.astype(np.complex64) for t in transfer.driven)]
        if lines is not None:
            driven = [(t * bright, pressure * bright) for t, pressure in driven]
        return cls(
            tiles(driven, 1 if lines is None else REFINEMENT),
            tiles(free(transfer.free, on_stations), REFINEMENT) if transfer.free else None,
            off_centre() if transfer.off_centre else None,
            stride,
            transfer.bent,
        )

    def beside(
        self, columns: NDArray[np.int32], line: NDArray[np.int32], part: Single
    ) -> Single | None:
        """Free waves that are added on columns beside the centre line (REFINEMENT nx, n, 2).

        Parts (2, n) of lines off the centre and of those after them. None without free waves.
        """
        if self.free is None or self.off_centre is None:
            return None
        weights = part[..., np.newaxis, np.newaxis]
        waves = weights[0] * self.off_centre[line, :, columns]
        waves += weights[1] * self.off_centre[line + 1, :, columns]
        found = np.fft.irfft(waves, n=self.free.shape[1])
        return np.ascontiguousarray(found.T.swapaxes(1, 2))
