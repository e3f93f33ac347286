# SPDX-License-Identifier: BSD-3-Clause
"""Friction over a passage by the response of the contact, over its tracks, and by bands.

The model is that of Zhang et al. 2019, section 3, with three changes: the ratio of deformed to
undeformed amplitude is the complex response of :mod:`pyehl.theory.response`, pressure and film
are those of the smooth contact of :mod:`pyehl.prediction.smooth`, and the leading term of second
order is that of :mod:`pyehl.prediction.second_order`. With ``reduction="amplitude"``
the real ratio of the paper takes the place of the response: it moves with the roughness. With
``smooth="hertz"`` too, the contact is that of the paper, a semi-ellipse and a uniform film.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from pyehl.errors import InputError
from pyehl.prediction.bands import Band, joining
from pyehl.prediction.breakdown import remedies_of
from pyehl.prediction.carrying import confirmed, within_range
from pyehl.prediction.contact import HertzContact, Response
from pyehl.prediction.deformed import film_levels
from pyehl.prediction.edge import Edge
from pyehl.prediction.errors import KNOWN_RATIO, model_error
from pyehl.prediction.friction import BEYOND, LARGEST_RATIO, RoughFriction, outcome, passed
from pyehl.prediction.options import Options
from pyehl.prediction.passage import (
    friction_along,
    longer_waves,
    meet_more,
    short_mean,
    tracks_of,
    working_grid,
)
from pyehl.prediction.rough_contact import RoughContact
from pyehl.prediction.smooth import SmoothContact, circle_of, zone_of
from pyehl.prediction.spectrum import Spectrum
from pyehl.prediction.transfer import Transfer
from pyehl.prediction.waves import Waves
from pyehl.surfaces import Topography, filtered
from pyehl.theory.amplitude import component_amplitude_ratio
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Array, Indices

Parts = tuple[Topography, Spectrum, Transfer, Edge]

# Points per shorter semi-axis at which the shear stress is taken: the tile is finer, and its other
# pixels are met at other positions
POINTS = 60
# Eq. 11 with wavelength 2 pi/|q| over E'|q|/4 (see `pyehl.prediction`)
STIFFER = math.sqrt(2.0)


@dataclass(frozen=True, slots=True)
class RoughPassage:
    """A rough tile in a contact: what is common to its passage, its tracks and its bands."""

    # The tile; its pixel [0, 0] starts at the centre of the contact and moves along x
    topography: Topography
    contact: SmoothContact
    # Operating point, lubricant with its shear law, and how the model is read
    operating: OperatingPoint
    lubricant: Lubricant
    options: Options
    velocity_ratio: float  # velocity of the rough surface over the mean velocity [-]
    mesh: float = 0.0  # mesh size on which its waves leak [a]; 0: as in nature
    groups: tuple[str, ...] = ("surface",)  # groups of the case that its tile is of
    filter_kind: str = "sharp"  # how its spectrum is cut

    def spectrum(self, tile: Topography) -> Spectrum:
        """Components of a tile, in the units of the contact."""
        o = self.operating
        lengths = tile.length_x / o.hertz_radius, tile.length_y / o.hertz_radius
        return Spectrum.of(tile.heights / o.film_scale, *lengths)

    def transfer(self, spectrum: Spectrum) -> Transfer:
        """Find what the contact makes of components. InputError where alpha is 0."""
        o = self.operating
        if o.moes_l == 0.0:
            raise InputError(
                "a prediction needs a viscosity that rises with pressure: its response of the "
                "contact to waves goes by M/L, and L = 0\nexpected: lubricant.pressure_viscosity "
                "above 0, or a run without a prediction"
            )
        if self.options.reduction == "response":
            zone = zone_of(self.contact, o, self.lubricant)
            moes = circle_of(self.contact, o, self.lubricant)
            u, weighs = self.velocity_ratio, self.lubricant.shear.weighs_flow
            return Transfer.of(spectrum, zone, moes, u, at_amplitude=weighs, mesh=self.mesh)
        ratio = component_amplitude_ratio(
            spectrum.qx[:, np.newaxis],
            spectrum.qy[np.newaxis, :],
            1.0,
            o.moes_m,
            o.moes_l,
            convention=self.options.wavelength_convention,
        )
        return Transfer.carried(ratio, STIFFER if self.options.stiffness == "paper" else 1.0)

    def _contact(
        self, spectrum: Spectrum, transfer: Transfer, edge: Edge, power: Array | None = None
    ) -> RoughContact | HertzContact:
        """Contact of a tile; `power` of the components as the transfer was made for them."""
        if self.options.as_in_paper:
            return HertzContact(
                spectrum.tile(transfer.pressure_at_centre(spectrum, self.velocity_ratio)),
                spectrum.tile(transfer.at_centre(spectrum, self.velocity_ratio)),
                self.contact.central_film,
                pixel=spectrum.pixel,
                operating=self.operating,
                lubricant=self.lubricant,
                load_balance=self.options.load_balance,
            )
        return self.on_points(spectrum, transfer, edge, self._stride(spectrum), power)

    def on_points(
        self,
        spectrum: Spectrum,
        transfer: Transfer,
        edge: Edge,
        stride: int,
        power: Array | None = None,
    ) -> RoughContact:
        """Contact of a tile by its response, at every so many-th of its pixels; else as above."""
        return RoughContact(
            Waves.of(spectrum, transfer, self.contact.central_film, self.velocity_ratio, stride),
            edge,
            self.contact,
            pixel=spectrum.pixel,
            stride=stride,
            operating=self.operating,
            lubricant=self.lubricant,
            velocity_ratio=self.velocity_ratio,
            second=transfer.second.of(spectrum.power if power is None else power)
            if transfer.second
            else None,
        )

    def _stride(self, spectrum: Spectrum) -> int:
        """Every so many-th pixel across the motion is a point of the contact."""
        return 1 if self.options.as_in_paper else self.stride_of(spectrum, POINTS)

    def stride_of(self, spectrum: Spectrum, points: float) -> int:
        """Stride of the pixels that leaves so many points per shorter semi-axis."""
        short = min(1.0, self.operating.ellipse.ellipticity)
        stride = max(1, int(short / (points * max(spectrum.pixel))))
        while spectrum.shape[1] % stride:
            stride -= 1
        return stride

    def deformed(self) -> Array:
        """Deformed roughness (nx, ny) [m] at the centre of the contact, on the pixels given."""
        spectrum = self.spectrum(self.topography)
        t = self.transfer(spectrum).at_centre(spectrum, self.velocity_ratio)
        return np.asarray(spectrum.tile(t) * self.operating.film_scale)

    def response(self, spectrum: Spectrum, transfer: Transfer) -> Response:
        """Pressure [Pa] and deformed roughness [m] at the centre of the contact."""
        u, o = self.velocity_ratio, self.operating
        pressure = spectrum.tile(transfer.pressure_at_centre(spectrum, u)) * o.hertz_pressure
        return Response(pressure, spectrum.tile(transfer.at_centre(spectrum, u)) * o.film_scale)

    def parts(self) -> Parts:
        """Tile on the grid that is worked on, its components, and what becomes of them."""
        grid = working_grid(self.topography, self.operating, self.options.positions)
        spectrum = self.spectrum(grid)
        transfer = self.transfer(spectrum)
        edge = Edge.of(spectrum, transfer, self.velocity_ratio, self.operating.ellipse)
        return grid, spectrum, transfer, edge

    def mean(self, parts: Parts | None = None) -> float:
        """mu_r/mu_s over a few positions [-], by its `parts`; NaN where the film ends."""
        grid, spectrum, transfer, edge = parts or self.parts()
        with np.errstate(over="ignore", invalid="ignore"):
            contact = self._contact(spectrum, transfer, edge)
            return short_mean(contact, grid.shape[0])

    def known(self) -> bool:
        """Whether the error of the ratio is; that of the paper never is, and is not asked for."""
        return self.options.as_in_paper or math.isfinite(model_error(self.mean()))

    def run(
        self, tracks: int = 8, *, brief: bool = False, parts: Parts | None = None
    ) -> tuple[RoughFriction, tuple[float, float], list[Band]]:
        """Friction over the passage, mean and spread over the tracks, and what each band adds.

        `brief`: of the bands the shortest alone, and without a search for what would help where
        the linear response ends. No tracks: NaN for mean and spread. `parts`: if they were made.
        """
        grid, spectrum, transfer, edge = parts or self.parts()
        with np.errstate(over="ignore", invalid="ignore"):
            contact = self._contact(spectrum, transfer, edge)
            t = transfer.at_centre(spectrum, self.velocity_ratio)
            limit = self.options.film_limit / self.operating.film_scale
            contact.watch(film_levels(limit, [(spectrum.power, np.abs(t))], [self.velocity_ratio]))
            passage = friction_along(contact, grid.shape[0], self.options.positions, LARGEST_RATIO)
            if not self.options.positions:
                meet_more(contact, grid.shape[0], passage[0])
            found = self._result(contact, grid, (spectrum, transfer, edge), passage, brief)
            if found.status != "predicted":
                return found, (math.nan, math.nan), []
            ratios = np.array(
                [
                    found.mu_ratio if offset == 0.0 else short_mean(contact, grid.shape[0], track)
                    for offset, track in tracks_of(
                        self.topography, grid, self._stride(spectrum), tracks
                    )
                ]
            )
            bands = self._bands(spectrum, transfer, edge, found.mu_ratio, brief)
        over = (float(ratios.mean()), float(ratios.std())) if tracks else (math.nan, math.nan)
        return found, over, bands

    def run_and_below(self, *shortest: float) -> tuple[RoughFriction, list[float]]:
        """Friction in brief, and mu_r/mu_s without the waves shorter than some lengths [a].

        The latter over a few positions each, and none where friction is not predicted.
        """
        parts = self.parts()
        found, _, _ = self.run(0, brief=True, parts=parts)
        if found.status != "predicted":
            return found, []
        limits = [2.0 * math.pi / length for length in shortest]
        with np.errstate(over="ignore", invalid="ignore"):
            return found, [self._below(*parts[1:], limit) for limit in limits]

    def _result(
        self,
        contact: RoughContact | HertzContact,
        grid: Topography,
        parts: tuple[Spectrum, Transfer, Edge],
        passage: tuple[Indices, Array, float],
        brief: bool,
    ) -> RoughFriction:
        ratios = passage[1]
        status, message = outcome(contact, ratios, load_balance=self.options.load_balance)
        if status == BEYOND and not brief and (first := remedies_of(self.topography)):
            message += "; " + ", ".join(f"first {option}" for option in first)
        elif status == BEYOND and not brief:
            message += self._carried(*parts)
        return passed(
            contact,
            (status, message),
            (np.asarray(passage[0] * grid.pixel[0], dtype=float), ratios, passage[2]),
            film_unit=self.operating.film_scale,
            response=self._tiles(*parts[:2], grid.shape == self.topography.shape),
        )

    def _carried(self, spectrum: Spectrum, transfer: Transfer, edge: Edge) -> str:
        """Say which cut-off would bring the ratio into the range of the model; '' for none."""
        high = within_range(
            lambda shortest: self._below(spectrum, transfer, edge, 2.0 * math.pi / shortest),
            min(spectrum.pixel),
            2.0 * math.pi / float(spectrum.q[spectrum.q > 0].min()),
        )
        if high is None:
            return ""
        longest = max(self.topography.length_x, self.topography.length_y)
        cut = confirmed(high * self.operating.hertz_radius, longest, self._known)
        if cut is None:
            return ""
        keys = " and ".join(f"{group}.shortest_wavelength" for group in self.groups)
        return f"; {keys} = {cut:g} would leave {KNOWN_RATIO:g} or less"

    def _known(self, shortest: float) -> bool:
        """Whether the tile without waves shorter than a length [m] has a ratio that is known."""
        tile = filtered(self.topography, shortest_wavelength=shortest, kind=self.filter_kind)
        part = replace(self, topography=tile)
        found, _, _ = part.run(0, brief=True)
        return found.status == "predicted" and found.mu_ratio <= KNOWN_RATIO

    def _tiles(self, spectrum: Spectrum, transfer: Transfer, same: bool) -> Response:
        """Pressure and deformed roughness at the centre of the contact, on the pixels given."""
        if not same:
            spectrum = self.spectrum(self.topography)
            transfer = self.transfer(spectrum)
        return self.response(spectrum, transfer)

    def _bands(
        self, spectrum: Spectrum, transfer: Transfer, edge: Edge, total: float, brief: bool
    ) -> list[Band]:
        """Return what each octave, or the last one alone, adds when it joins all longer ones."""
        t = transfer.at_centre(spectrum, self.velocity_ratio)
        pressure = np.abs(transfer.pressure_at_centre(spectrum, self.velocity_ratio))
        return joining(
            (spectrum.q, spectrum.power, np.abs(t), pressure),
            lambda limit: self._below(spectrum, transfer, edge, limit),
            total,
            self.operating,
            brief=brief,
        )

    def _below(self, spectrum: Spectrum, transfer: Transfer, edge: Edge, limit: float) -> float:
        """mu_r/mu_s of the waves with |q| below a limit [1/a], on as few pixels as they need."""
        part, index = longer_waves(spectrum, limit, self.operating.ellipse.ellipticity)
        power = np.where(spectrum.q < limit, spectrum.power, 0.0)
        contact = self._contact(part, transfer.kept(index), edge.below(limit), power)
        return short_mean(contact, part.shape[0])
