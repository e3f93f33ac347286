# SPDX-License-Identifier: BSD-3-Clause
"""Contribution of bands of wavelengths to mu_r/mu_s, computed when it is asked for."""

from __future__ import annotations

import time
import weakref
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, ClassVar, overload

import numpy as np

from pyehl import blas
from pyehl.contact.sheared import HertzContact
from pyehl.prediction.model import Components, Model
from pyehl.prediction.moving_tile import Component, WaveFactors
from pyehl.prediction.response import Transfer
from pyehl.prediction.rough_contact import RoughContact
from pyehl.prediction.spectrum import Band, Spectrum, joining, longer_waves
from pyehl.types import Indices

HELD = 1 << 18
"""Largest number of pixels of surfaces whose waves are held in memory for later use, with their
contact some 400 bytes per pixel; those of larger surfaces are computed again."""


def with_factors(model: Model, waves: Components) -> Components:
    """Return components with the factors of their tiles, which several contacts then share.

    Those of large surfaces are unchanged.
    """
    if model.options.as_in_paper or _pixels(waves) > HELD:
        return waves
    film, two = model.contact.central_film, len(waves) > 1
    return [replace(wave, factors=wave.wave_factors(film, on_lines=two)) for wave in waves]


def _pixels(waves: Components) -> int:
    return sum(wave.spectrum.shape[0] * wave.spectrum.shape[1] for wave in waves)


class LongerWaves:
    """mu_r/mu_s of the waves below some limits.

    Successive limits share what depends only on the numbers of pixels. `contact`: that of all waves
    if it is known.
    """

    def __init__(
        self, model: Model, waves: Components, contact: RoughContact | HertzContact | None = None
    ) -> None:
        self._model, self._waves, self._of_all = model, waves, contact
        self._powers = [wave.spectrum.power for wave in waves]
        # for these numbers of pixels
        self._shapes: list[tuple[int, int]] = []
        self._transfers: list[Transfer] = []
        self._factors: list[WaveFactors | None] = []
        self._contact: RoughContact | HertzContact | None = None

    def ratio(self, limits: Sequence[float]) -> float:
        """mu_r/mu_s of the waves with |q| below a limit [1/a] for each surface, in order.

        The waves are on as few pixels as they need.
        """
        model, side = self._model, self._model.operating.ellipse.side
        few = [longer_waves(w.spectrum, q, side) for w, q in zip(self._waves, limits, strict=True)]
        self._share(few)
        kept = [
            Component(spectrum, transfer, wave.edge.below(limit), wave.velocity_ratio, factors)
            for (spectrum, _), transfer, factors, wave, limit in zip(
                few, self._transfers, self._factors, self._waves, limits, strict=True
            )
        ]
        powers = [
            np.where(wave.spectrum.q < limit, power, 0.0)
            for wave, power, limit in zip(self._waves, self._powers, limits, strict=True)
        ]
        self._contact = model.rough_contact(kept, powers, like=self._contact)
        return model.positions(kept).short_mean(self._contact.ratios)

    def _share(self, few: Sequence[tuple[Spectrum, tuple[Indices, Indices]]]) -> None:
        """Compute what depends on the numbers of pixels, if they are new."""
        shapes = [spectrum.shape for spectrum, _ in few]
        if shapes == self._shapes:
            return
        of_all = shapes == [wave.spectrum.shape for wave in self._waves]
        self._shapes, self._contact = shapes, self._of_all if of_all else None
        self._transfers, self._factors = [], []
        film, two = self._model.contact.central_film, len(few) > 1
        for wave, (spectrum, index) in zip(self._waves, few, strict=True):
            same = spectrum.shape == wave.spectrum.shape
            transfer = wave.transfer if same else wave.transfer.kept(index)
            factors = wave.factors if same else None
            if factors is None and not self._model.options.as_in_paper:
                given = spectrum, transfer, film, wave.velocity_ratio
                factors = WaveFactors.of(*given, on_lines=two)
            self._transfers.append(transfer)
            self._factors.append(factors)


class Bands(Sequence[Band]):
    """Contribution of each octave added to all longer waves, computed when it is first asked for.

    `total` is mu_r/mu_s of all waves; `brief`: only of the last octave. The waves and their contact
    are held until then, or until the next prediction, brief or not as this one: afterwards they are
    computed again.
    """

    _last: ClassVar[dict[bool, weakref.ref[Bands]]] = {}

    def __init__(
        self,
        model: Model,
        waves: Components,
        contact: RoughContact | HertzContact,
        total: float,
        *,
        brief: bool,
    ) -> None:
        self._model, self._total, self._brief = model, total, brief
        self._result: list[Band] | None = None
        self.seconds = 0.0  # wall time of the computation; 0 before it
        self.held: tuple[Components, RoughContact | HertzContact] | None = None
        if _pixels(waves) <= HELD:
            self.held = waves, contact
        # a prediction with other spectra is brief
        last = Bands._last.get(brief)
        before = last() if last else None
        if before is not None:
            before.held = None
        Bands._last[brief] = weakref.ref(self)

    def _computed(self) -> list[Band]:
        if self._result is None:
            start = time.perf_counter()
            with blas.one_thread(), np.errstate(over="ignore", invalid="ignore"):
                self._result = self._compute()
            self.held = None
            self.seconds = time.perf_counter() - start
        return self._result

    def _compute(self) -> list[Band]:
        waves, contact = self.held or (self._model.components(), None)
        parts = [
            (w.spectrum.q, w.spectrum.power, np.abs(w.at_centre()), np.abs(w.pressure_at_centre()))
            for w in waves
        ]
        q, power, deformed, pressure = (
            np.concatenate([part.ravel() for part in of_all]) for of_all in zip(*parts, strict=True)
        )
        longer = LongerWaves(self._model, waves, contact)
        return joining(
            (q, power, deformed, pressure),
            lambda limit: longer.ratio([limit] * len(waves)),
            self._total,
            self._model.operating,
            brief=self._brief,
        )

    @overload
    def __getitem__(self, index: int) -> Band: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Band]: ...
    def __getitem__(self, index: int | slice) -> Band | Sequence[Band]:
        """Return a band, the longest waves first, or some of them."""
        return self._computed()[index]

    def __len__(self) -> int:
        """Count the octaves with roughness."""
        return len(self._computed())

    def __eq__(self, other: object) -> bool:
        """Whether another sequence has the same bands."""
        if not isinstance(other, Sequence):
            return NotImplemented
        return self._computed() == list(other)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        """Give the bands, if they are computed already."""
        return "Bands(...)" if self._result is None else f"Bands({self._result})"

    def __getstate__(self) -> dict[str, Any]:
        """Give the state for pickle and copy, without the waves."""
        return {**self.__dict__, "held": None}
