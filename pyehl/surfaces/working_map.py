# SPDX-License-Identifier: BSD-3-Clause
"""A map while it is prepared: its heights, and what each step did to them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pyehl.errors import InputError
from pyehl.surfaces import areal
from pyehl.surfaces.options import Options
from pyehl.surfaces.reading import Scan
from pyehl.surfaces.record import Record, Step

__all__ = ["WorkingMap"]

Array = NDArray[np.float64]

LARGEST = 1e6
"""Largest height [m] that is not taken for damage."""


def _largest(z: Array) -> float:
    """Largest height by its modulus, of those that are there; without copies."""
    most = float(np.fmax.reduce(z, axis=None, initial=0.0))
    return max(most, -float(np.fmin.reduce(z, axis=None, initial=0.0)))


class WorkingMap:
    """A map that is being prepared, with the record of the steps so far.

    Heights `z` (nx, ny) [m], NaN where there is none; `pixel` size along x and y [m]; the number
    of heights that the map as read lacks is `missing`. `keep`: the heights of `scan` must stay as
    they are. InputError if a height cannot be one in metres.
    """

    def __init__(self, scan: Scan, *, keep: bool) -> None:
        self.z = scan.heights
        self.scan = scan
        self.origin = scan.origin
        if math.isinf(_largest(self.z)):
            # an infinite height is none
            self.z = np.where(np.isinf(self.z), np.nan, self.z)
        largest = _largest(self.z)
        if largest > LARGEST:
            raise InputError(
                f"{scan.origin}: a height of {largest:.3g} m: expected heights in metres"
            )
        self.missing = self.z.size - int(np.count_nonzero(np.isfinite(self.z)))
        nx, ny = scan.heights.shape
        self.pixel = (scan.length_x / nx, scan.length_y / ny)
        self.steps: list[Step] = []
        self._last: areal.Extent | None = None
        self._kept = scan.heights if keep else None

    def own(self) -> Array:
        """Heights that may be changed in place."""
        shared = self._kept is not None and np.may_share_memory(self.z, self._kept)
        if shared or not self.z.flags.writeable:
            self.z = self.z.copy()
        return self.z

    def begin(self) -> None:
        """Note how rough the map is before a step that works in place."""
        self._last = self._last or areal.extent(self.z, self.pixel)

    def do(
        self,
        name: str,
        value: str,
        heights: Array,
        why: str = "given",
        *,
        changed: int = 0,
        pixel: tuple[float, float] | None = None,
        note: str = "",
    ) -> None:
        """Record a step; its result is what the next one works on."""
        before = self._last or areal.extent(self.z, self.pixel)
        # the same heights, even if only their edges are looked at or their images are added
        same = heights is self.z and name == "edges"
        self.z = heights
        self.pixel = pixel or self.pixel
        self._last = before if same else areal.extent(self.z, self.pixel)
        self.steps.append(Step(name, value, why, changed, before, self._last, note))

    def record(self, options: Options) -> Record:
        """Tell what was done, in numbers."""
        scan, images = self.scan, 2 if options.edges == "mirror" else 1
        nx, ny = (images * n for n in self.z.shape)
        return Record(
            file=scan.origin,
            channel=scan.channel,
            is_array=scan.is_array,
            pixels=(scan.heights.shape[0], scan.heights.shape[1]),
            size=(scan.length_x, scan.length_y),
            size_from=scan.size_from,
            missing=self.missing,
            note=scan.note,
            detrend=options.detrend,
            edges=options.edges,
            tile_pixels=(nx, ny),
            tile_size=(nx * self.pixel[0], ny * self.pixel[1]),
            steps=tuple(self.steps),
        )
