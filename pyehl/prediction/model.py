# SPDX-License-Identifier: BSD-3-Clause
"""The model of a rough contact: from the heights of one or two surfaces to mu_r/mu_s.

Zhang, Biboulet, Venner & Lubrecht 2019 (doi 10.1016/j.triboint.2019.01.028), section 3, with three
changes: the complex response in place of the real ratio, pressure and film of the solved smooth
contact in place of a semi-ellipse and a uniform film, and terms of second order.

======================================= ==========================================================
equation                                function
======================================= ==========================================================
rr(q), components of the surface, eq. 9 :meth:`spectrum.Spectrum.of`
rr_d = T(q) rr(q), eq. 10               :meth:`response.Transfer.of_all`; real ratio of the paper:
                                        :func:`pyehl.theory.amplitude.component_amplitude_ratio`
T = driven + free e^(i (U-1) k_x (X+1)) :func:`pyehl.theory.transport.transport` (driven, decay of
                                        the free wave), :func:`pyehl.theory.response.inlet_transfer`
delta p = E'|q|/4 (1 - T) rr(q), eq. 11 :func:`pyehl.theory.transport.wave_pressure`,
                                        :meth:`response.Transfer.gain` (finite contact)
sum over all waves, eq. 12              :class:`moving_tile.WaveTiles`, of one surface
                                        :class:`moving_tile.PixelTile`, of two ``LineTile``
edge of the contact                     :meth:`moving_tile.Edge.of_all`
second order: gamma (P^2 - s^2), f(t/H) :meth:`response.SecondOrder.of`,
                                        :func:`response.film_left`
tau(p_s + delta p, h_s - rr_d), eq. 13  :meth:`pyehl.contact.sheared.ShearedContact.stress`
friction: integral of tau, eq. 14       :meth:`rough_contact.RoughContact.friction`; model of the
                                        paper: :meth:`pyehl.contact.sheared.HertzContact.friction`
mean over the passage                   :mod:`relative_positions`
mu_r/mu_s, tracks                       :func:`friction.run`
bands                                   :class:`bands.Bands`
p_s, h_s: the smooth contact            :func:`pyehl.contact.smooth.solve_contact`
contact at a boundary film              :func:`mixed_lubrication.partial_film`
heat of sliding                         :func:`pyehl.contact.smooth.heat_of`
where the film ends, and a cut-off      :func:`breakdown.below_zero`, :func:`breakdown.advise`
with which it would not
errors                                  :func:`model.model_error`
======================================= ==========================================================

Two surfaces: to first order each is deformed as if the other one were smooth, at its own velocity
ratio, and the changes of film and pressure by both add up. The second-order terms include products
of the waves of both surfaces, and the leakage depends on their total amplitude. The result does not
depend on the order of the surfaces.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from pyehl.contact.sheared import HertzContact
from pyehl.contact.smooth import SmoothContact, circle_of, zone_of
from pyehl.errors import InputError
from pyehl.prediction.moving_tile import Component, Edge, PixelTile, long_waves
from pyehl.prediction.relative_positions import RelativePositions, TilePositions
from pyehl.prediction.response import Response, Transfer
from pyehl.prediction.rough_contact import RoughContact
from pyehl.prediction.spectrum import Spectrum, working_grid
from pyehl.surfaces import Topography, filtered
from pyehl.surfaces.pair import merged
from pyehl.theory.amplitude import component_amplitude_ratio
from pyehl.theory.ellipse import Ellipse
from pyehl.theory.line_contact import AnyContact
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.response import fitted_range
from pyehl.theory.strip_edge import StripEdge
from pyehl.types import Array, Settings


@dataclass(frozen=True, slots=True)
class ModelOptions:
    """Options of the model: the group ``psd`` of a case, whose schema has the allowed words."""

    # Amplitude ratio of a wave in the contact: ``"response"``, the complex response of
    # :mod:`pyehl.theory.response`, or ``"amplitude"``, the real ratio of the paper
    reduction: str = "response"
    # Pressure and film under the roughness: ``"solved"``, of the smooth contact, or ``"hertz"``,
    # semi-ellipse and uniform film, as in the paper
    smooth: str = "solved"
    wavelength_convention: str = "components"  # one of :data:`pyehl.theory.amplitude.CONVENTIONS`
    stiffness: str = "exact"  # ``"exact"``: E'|q|/4; ``"paper"``: eq. 11 with wavelength 2 pi/|q|
    # Whether the load of delta p is subtracted from that of the semi-ellipse: a Hertz contact under
    # the remaining load, p_h and a scaled by its cube root
    load_balance: bool = False
    # Film below which the fraction of the contact is reported [m]; 0: none
    film_limit: float = 0.0
    # Number of positions of the surface over one passage; 0: doubled until mu_r/mu_s is resolved
    positions: int = 0

    @property
    def as_in_paper(self) -> bool:
        """Whether both the reduction and the smooth contact are those of the paper."""
        return self.reduction == "amplitude" and self.smooth == "hertz"

    @property
    def measured(self) -> bool:
        """Whether the errors of the model were measured with these options."""
        return self.reduction == "response" and self.smooth == "solved"

    @classmethod
    def from_settings(cls, settings: Settings) -> ModelOptions:
        """Read the group ``psd`` of a resolved case."""
        group = settings["psd"]
        return cls(**{field.name: group[field.name] for field in fields(cls)})


# Error of mu_r/mu_s against the full simulation: a constant part, due to short waves and tracks,
# and a part proportional to the increase, measured in docs/evidence/prediction
CONSTANT = 0.01
SHARE_OF_INCREASE = 0.07
# The same for a flow that obeys a shear law, with which the friction hardly increases
# (docs/evidence/thinning)
CONSTANT_THINNING = 0.004
SHARE_THINNING = 0.1
# Additional error of a narrow contact, over a/b - 1 (docs/evidence/ellipse)
NARROW = 0.025
# Largest ratio at which the error was measured
KNOWN_RATIO = 5.0
# Range of ellipticities in which it was measured, and largest one for film and pressure
ELLIPTICITY = [0.39, 10.1]
FILM_ELLIPTICITY = 4.1
# Range of velocity ratios of the measured waves (docs/evidence/response/slip.csv)
VELOCITY_RATIO = [0.5, 1.5]
# Range of `thinning` in `outside_range` (docs/evidence/thinning)
THINNING = [0.95, 1.5]


def model_error(mu_ratio: float, *, thins: bool = False, ellipticity: float = 1.0) -> float:
    """Error of a predicted mu_r/mu_s [-]; NaN beyond the largest ratio that was measured.

    It covers the deviation from the full simulation of this package on 513 x 513 nodes in at least
    nine of ten cases of docs/evidence/prediction; `thins`: for a flow that obeys a shear law, on
    257 x 257 nodes, of docs/evidence/thinning. `ellipticity` is the semi-axis across the motion
    over a [-]; a narrow contact has a larger error.
    """
    if not mu_ratio <= KNOWN_RATIO:
        return math.nan
    constant, share = CONSTANT, SHARE_OF_INCREASE
    if thins:
        constant, share = CONSTANT_THINNING, SHARE_THINNING
    return constant + share * abs(mu_ratio - 1.0) + NARROW * max(0.0, 1.0 / ellipticity - 1.0)


def why_no_error(
    mu_ratio: float, outside: Sequence[str], options: ModelOptions, *, friction_alone_thins: bool
) -> str:
    """Say why `model_error` is not known for a prediction; '' if it is known.

    `outside`: quantities outside the range of the response; `friction_alone_thins`: a shear law
    applies to the friction but not to the flow.
    """
    if not math.isfinite(mu_ratio):
        return "there is no mu_ratio"
    if outside:
        return f"outside the range of the response by {', '.join(outside)}"
    if not options.measured:
        return "it was measured with other psd.reduction and psd.smooth"
    if friction_alone_thins:
        return "with a shear law it was measured with lubricant.flow = 'consistent'"
    if mu_ratio > KNOWN_RATIO:
        return f"it was measured up to mu_r/mu_s = {KNOWN_RATIO:g}"
    return ""


def outside_range(
    operating: AnyContact,
    velocity_ratio: float,
    options: ModelOptions,
    thinning: float = 1.0,
    widest: float = ELLIPTICITY[1],
) -> list[str]:
    """Name the quantities outside the range in which the response was measured.

    `moes_m` and `moes_l` of an elliptical contact are those of the circle with the same dry inlet.
    `thinning`: viscosity at low shear over that of a Newtonian lubricant with the same film
    thickness; `widest`: largest ellipticity, FILM_ELLIPTICITY for film and pressure. Empty
    unless `psd.reduction` is 'response'.
    """
    if options.reduction != "response":
        return []
    moes_m, moes_l = operating.equivalent_moes
    values = {
        "moes_m": moes_m,
        "moes_l": moes_l,
        "velocity_ratio": velocity_ratio,
        "ellipticity": operating.ellipse.side,
        "thinning": thinning,
    }
    limits = fitted_range() | {
        "velocity_ratio": VELOCITY_RATIO,
        "ellipticity": [ELLIPTICITY[0], widest],
        "thinning": THINNING,
    }
    return [name for name, v in values.items() if not limits[name][0] <= v <= limits[name][1]]


Components = list[Component]

PIXEL_POINTS = 60
"""Points per shorter semi-axis at which the shear stress under one surface is evaluated: the tile
is finer, and other positions use its other pixels. 128 points change mu_r/mu_s of Table 1 by less
than 0.1 % (tests/model/test_prediction.py)."""
GRID_POINTS = 60.5
"""Points per semi-axis under two surfaces; the half shifts the points from one semi-axis to the
next. 90.5 points change a mu_r/mu_s of 2.31 by 0.15 %."""
PAPER_STIFFNESS = math.sqrt(2.0)
"""Eq. 11 with wavelength 2 pi/|q| over E'|q|/4 (see `pyehl.prediction`)."""


@dataclass(frozen=True)
class RoughSurface:
    """A moving rough tile; its pixel [0, 0] starts at X = front and moves along x."""

    topography: Topography
    velocity_ratio: float  # velocity over the mean velocity [-]
    front: float = 0.0  # [a]
    filter_kind: str = "sharp"  # how its spectrum is cut
    groups: tuple[str, ...] = ("surface",)  # groups of the case that define it


@dataclass(frozen=True)
class Model:
    """One or two rough surfaces in a contact, with the options of the model."""

    surfaces: tuple[RoughSurface, ...]
    contact: SmoothContact
    operating: AnyContact
    lubricant: Lubricant
    options: ModelOptions
    mesh: float = 0.0  # mesh size of the leakage of waves [a]; 0: continuous equations

    @classmethod
    def of_one(
        cls,
        tile: Topography,
        contact: SmoothContact,
        operating: AnyContact,
        lubricant: Lubricant,
        options: ModelOptions,
        velocity_ratio: float,
        mesh: float = 0.0,
    ) -> Model:
        """Make the model of one rough surface that begins at the centre."""
        rough = RoughSurface(tile, velocity_ratio)
        return cls((rough,), contact, operating, lubricant, options, mesh)

    @cached_property
    def order(self) -> tuple[int, ...]:
        """Order in which the surfaces are summed, by their numbers.

        The faster one is first; at equal velocities the order follows from front, size and heights.
        """

        def key(k: int) -> tuple[float, ...] | tuple[object, ...]:
            one, tile = self.surfaces[k], self.surfaces[k].topography
            heights = np.ascontiguousarray(tile.heights).tobytes()
            return (-one.velocity_ratio, one.front, *tile.size, *tile.shape, heights)

        numbers = range(len(self.surfaces))
        return tuple(sorted(numbers, key=key)) if len(numbers) > 1 else (0,)

    @property
    def in_order(self) -> list[RoughSurface]:
        """The surfaces in the order in which they are summed."""
        return [self.surfaces[k] for k in self.order]

    @cached_property
    def merged(self) -> Model | None:
        """The model with the sum of two surfaces that move together; None for other surfaces."""
        if len(self.surfaces) == 1:
            return None
        first, second = self.in_order
        if first.velocity_ratio != second.velocity_ratio:
            return None
        ahead = (second.front - first.front) * self.operating.hertz_radius
        tile = merged(first.topography, second.topography, ahead)
        groups = tuple(group for one in self.surfaces for group in one.groups)
        one = replace(first, topography=tile or first.topography, groups=groups)
        return None if tile is None else replace(self, surfaces=(one,))

    # from heights to film and pressure in the contact

    def spectrum(self, tile: Topography) -> Spectrum:
        """Components of a tile, in the units of the contact."""
        o = self.operating
        lengths = tile.length_x / o.hertz_radius, tile.length_y / o.hertz_radius
        return Spectrum.of(tile.heights / o.film_scale, *lengths)

    def transfers(self, spectra: Sequence[Spectrum]) -> list[Transfer]:
        """Compute the transfer of components, in order; InputError if alpha is 0."""
        o, options = self.operating, self.options
        if o.moes_l == 0.0:
            raise InputError(
                "a prediction needs a viscosity that increases with pressure: its response of the "
                "contact to waves goes by M/L, and L = 0\nexpected: lubricant.pressure_viscosity "
                "above 0, or a run without a prediction"
            )
        if options.reduction == "response":
            ratios = [one.velocity_ratio for one in self.in_order]
            return Transfer.of_all(
                list(zip(spectra, ratios, strict=True)),
                zone_of(self.contact, o, self.lubricant),
                circle_of(self.contact, o, self.lubricant),
                at_amplitude=self.lubricant.shear.friction_matches_flow,
                mesh=self.mesh,
            )
        moes, convention = (o.moes_m, o.moes_l), options.wavelength_convention
        stiffening = PAPER_STIFFNESS if options.stiffness == "paper" else 1.0
        waves = [(s.qx[:, np.newaxis], s.qy[np.newaxis, :]) for s in spectra]
        return [
            Transfer.uniform(
                component_amplitude_ratio(*q, 1.0, *moes, convention=convention), stiffening
            )
            for q in waves
        ]

    def components(self, tiles: Sequence[Topography] | None = None) -> Components:
        """Components of tiles, which are given by number, with their transfers, in order.

        By default the tiles are those of `grids`.
        """
        tiles = self.grids() if tiles is None else tiles
        spectra = [self.spectrum(tiles[k]) for k in self.order]
        ratios = [one.velocity_ratio for one in self.in_order]
        waves = list(zip(spectra, self.transfers(spectra), ratios, strict=True))
        edges = Edge.of_all(waves, self._shape(spectra))
        return [Component(s, t, edge, u) for (s, t, u), edge in zip(waves, edges, strict=True)]

    def _shape(self, spectra: Sequence[Spectrum]) -> Ellipse | StripEdge:
        """Shape of the contact; for a line with the wavenumbers of long waves along Y."""
        if not self.operating.ellipse.is_line:
            return self.operating.ellipse
        across = [np.abs(s.qy[long_waves(s, StripEdge.largest)[1]]) for s in spectra]
        wavenumbers = np.unique(np.concatenate(across))
        width = max(s.pixel[1] * s.shape[1] for s in spectra)
        # wavenumbers of two tiles that are nearly equal count once
        distinct = np.diff(wavenumbers, prepend=-math.inf) > 1.0 / width
        return StripEdge(wavenumbers[distinct], width)

    def grids(self) -> list[Topography]:
        """Resample the tiles, by number, on grids that resolve the contact and fit the positions.

        InputError if that takes too many pixels.
        """
        positions = self.options.positions if len(self.surfaces) == 1 else 0
        return [working_grid(one.topography, self.operating, positions) for one in self.surfaces]

    def stride_of(self, spectrum: Spectrum, points: float) -> int:
        """Stride of the pixels with which at least `points` points per shorter semi-axis remain.

        1 in the model of the paper, which uses all pixels.
        """
        if self.options.as_in_paper:
            return 1
        short = min(1.0, self.operating.ellipse.ellipticity)
        stride = max(1, int(short / (points * max(spectrum.pixel))))
        while spectrum.shape[1] % stride:
            stride -= 1
        return stride

    def rough_contact(
        self,
        waves: Components,
        powers: Sequence[Array] | None = None,
        tracks: Sequence[float] = (0.0, 0.0),
        like: RoughContact | HertzContact | None = None,
    ) -> RoughContact | HertzContact:
        """Make the contact of components; `powers` are those for which their transfers hold.

        `tracks`: displacements of two surfaces across the motion [a]; `like`: a contact of
        components of the same shapes and velocities, with which it shares what it can.
        """
        first, of = waves[0], (self.contact, self.operating, self.lubricant)
        if len(waves) > 1:
            shared = like if isinstance(like, RoughContact) else None
            return RoughContact.on_grid(*of, waves, GRID_POINTS, powers, tracks, shared)
        if isinstance(like, RoughContact) and isinstance(like.tiles[0], PixelTile):
            tile = like.tiles[0].with_wave(first, self.contact.central_film)
            return like.with_waves(waves, powers, [tile])
        spectrum, transfer, ratio = first.spectrum, first.transfer, first.velocity_ratio
        if self.options.as_in_paper:
            return HertzContact(
                spectrum.tile(transfer.pressure_at_centre(spectrum, ratio)),
                spectrum.tile(transfer.at_centre(spectrum, ratio)),
                self.contact.central_film,
                pixel=spectrum.pixel,
                operating=self.operating,
                lubricant=self.lubricant,
                load_balance=self.options.load_balance,
            )
        return RoughContact.on_pixels(*of, self.pixel_tile(first, PIXEL_POINTS), powers)

    def pixel_tile(self, wave: Component, points: float) -> PixelTile:
        """Make a tile with at least `points` of its pixels per shorter semi-axis."""
        stride = self.stride_of(wave.spectrum, points)
        return PixelTile(wave, self.contact.central_film, stride, self.operating)

    def positions(self, waves: Components) -> TilePositions | RelativePositions:
        """Give the positions of the surfaces, in order."""
        if len(waves) == 1:
            pixels = waves[0].spectrum.shape[0]
            return TilePositions(pixels, self.surfaces[0].topography.length_x / pixels)
        return self.relative_positions

    @property
    def relative_positions(self) -> RelativePositions:
        """Positions of two surfaces, in order."""
        first, second = self.in_order
        radius = self.operating.hertz_radius
        lengths = first.topography.length_x / radius, second.topography.length_x / radius
        ratios = first.velocity_ratio, second.velocity_ratio
        return RelativePositions(lengths, ratios, (first.front, second.front), radius)

    def outside_range(self, widest: float = ELLIPTICITY[1]) -> list[str]:
        """Name the quantities outside the range of the response for any surface, each once."""
        rest = self.options, self.contact.thinning, widest
        result = [outside_range(self.operating, s.velocity_ratio, *rest) for s in self.surfaces]
        return list(dict.fromkeys(name for names in result for name in names))

    def without_shorter(self, numbers: Sequence[int], shortest: float) -> Model:
        """Remove waves shorter than a length [m] from the surfaces with these numbers."""
        cut = (
            replace(one, topography=filtered(one.topography, shortest, kind=one.filter_kind))
            if k in numbers
            else one
            for k, one in enumerate(self.surfaces)
        )
        return replace(self, surfaces=tuple(cut))

    def responses(self, waves: Components | None = None) -> list[Response]:
        """Pressure [Pa] and deformed roughness [m] of each at the centre, by number, on its pixels.

        From the components `waves` if these have the same pixels.
        """
        o = self.operating
        return [
            Response(s.tile(t.pressure_at_centre(s, u)) * o.hertz_pressure, self._deformed(s, t, u))
            for s, t, u in self._on_pixels(waves)
        ]

    def deformed(self) -> list[Array]:
        """Deformed roughness of each surface at the centre of the contact, on its pixels [m]."""
        return [self._deformed(*wave) for wave in self._on_pixels(None)]

    def _deformed(self, spectrum: Spectrum, transfer: Transfer, velocity_ratio: float) -> Array:
        left = transfer.at_centre(spectrum, velocity_ratio)
        return np.asarray(spectrum.tile(left) * self.operating.film_scale)

    def _on_pixels(self, waves: Components | None) -> list[tuple[Spectrum, Transfer, float]]:
        """Components of the tiles on their own pixels, and velocity ratios, by number."""
        tiles = [one.topography for one in self.in_order]
        if waves and [w.spectrum.shape for w in waves] == [tile.shape for tile in tiles]:
            result = [(w.spectrum, w.transfer) for w in waves]
        else:
            spectra = [self.spectrum(tile) for tile in tiles]
            result = list(zip(spectra, self.transfers(spectra), strict=True))
        ratios = [one.velocity_ratio for one in self.surfaces]
        return [(*result[self.order.index(k)], u) for k, u in enumerate(ratios)]
