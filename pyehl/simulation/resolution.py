# SPDX-License-Identifier: BSD-3-Clause
"""How much of a predicted mu_r/mu_s the grid of a run resolves."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from pyehl import lengths, surfaces
from pyehl.case import Case
from pyehl.contact.smooth import solve_contact
from pyehl.errors import EhlError, InputError
from pyehl.prediction.friction import run_and_below
from pyehl.prediction.model import Model, ModelOptions, RoughSurface
from pyehl.prediction.predict import unpredictable
from pyehl.prediction.spectrum import Spectrum
from pyehl.surfaces import Topography
from pyehl.theory.line_contact import AnyContact, contact_of, formula_film
from pyehl.theory.lubricant import Lubricant
from pyehl.types import Settings

NODES = 8
"""Nodes per wavelength above which a wave counts as resolved."""
ON_GRID = 2
"""Nodes per wavelength below which a grid cannot represent a wave."""
TOLERANCE = 0.01
"""Fraction of mu_r/mu_s from unresolved waves above which there is a warning."""


@dataclass(frozen=True, slots=True)
class Resolution:
    """How much of a predicted mu_r/mu_s a grid resolves."""

    mu_ratio: float  # predicted with all waves [-]
    # The same without the waves that have fewer than NODES, or ON_GRID nodes [-]
    resolved: float
    on_grid: float
    shortest: float  # wavelength of NODES nodes [m]
    part: str = ""  # part of a large surface that was used; empty: all of it

    @property
    def matters(self) -> bool:
        """Whether more than TOLERANCE of the result comes from waves that are not resolved."""
        return abs(self.unresolved) > TOLERANCE * self.mu_ratio

    def __str__(self) -> str:
        """Describe it in one line."""
        increase, part = self.mu_ratio - 1.0, self.unresolved
        shortest = lengths.length(self.shortest, max_unit="um")
        return (
            f"predicted   mu_r/mu_s {self.mu_ratio:.3f}; of the increase {increase:+.3f}, "
            f"{part:+.3f} come from waves shorter than {shortest}, "
            f"{NODES} nodes of this grid" + (f" (predicted with {self.part})" if self.part else "")
        )

    def report(self) -> list[str]:
        """Lines of the plan."""
        lines = [str(self)]
        if self.matters:
            lines.append(
                f"warning: more than {TOLERANCE:.0%} of mu_r/mu_s comes from waves with fewer than "
                f"{NODES} nodes; use a finer grid (grid.points), or remove these waves "
                "(surface.shortest_wavelength)"
            )
        return lines

    @property
    def unresolved(self) -> float:
        """Part of the ratio in waves with fewer than NODES nodes [-]."""
        return self.mu_ratio - self.resolved

    @property
    def left_out(self) -> float:
        """Part of the ratio in waves with fewer than ON_GRID nodes [-].

        They are not in the error from two grids: neither grid resolves them.
        """
        return self.mu_ratio - self.on_grid


def resolution(case: Case, tiles: Mapping[str, Topography] | None = None) -> Resolution | None:
    """Predict what the grid of a case resolves.

    None if no surface is a moving map or fractal, the case has a duty, or the grid resolves all
    waves. `tiles` are the surfaces by group, on their tracks and before their spectrum is cut; a
    tile may be a part of a large surface. A surface that is not given is made from the case, and of
    a large one only :func:`pyehl.surfaces.part_of` is used. EhlError if the smooth contact has no
    solution, or the prediction gives no ratio; InputError or FileError if a surface is not usable,
    and InputError if the case cannot be predicted.
    """
    settings = case.resolve()
    groups = surfaces.rough_groups(settings) if "duty" not in settings else []
    rough = [settings[group] for group in groups]
    if not any(s["kind"] in ("map", "fractal") and s["velocity_ratio"] != 0.0 for s in rough):
        return None
    why = unpredictable(settings)
    if why:
        raise InputError(why)
    operating = contact_of(settings)
    lubricant = Lubricant.from_settings(settings)
    grid = settings["grid"]
    mesh = (float(grid["x_outlet"]) - float(grid["x_inlet"])) / (int(grid["points"]) - 1)
    if not operating.ellipse.is_line:
        # the cells of a strip are nearly square
        mesh = max(mesh, 2.0 * float(grid["y_extent"]) / (int(grid["points_y"]) - 1))
    # with two surfaces, the amplitude of one may be relative to the film
    film = formula_film(operating, lubricant) if len(groups) > 1 else 0.0
    result = [_tile(settings, group, (tiles or {}).get(group), operating, film) for group in groups]
    shortest = NODES * mesh * operating.hertz_radius
    spectra = [Spectrum.of(tile.heights, tile.length_x, tile.length_y) for tile, _ in result]
    if not any(spectrum.share_below(shortest) > 0.0 for spectrum in spectra):
        return None
    contact = solve_contact(settings)
    rough_tiles = tuple(
        RoughSurface(tile, float(keys["velocity_ratio"]), float(keys["x_start"]))
        for (tile, _), keys in zip(result, rough, strict=True)
    )
    model = Model(rough_tiles, contact, operating, lubricant, ModelOptions())
    friction, below = run_and_below(model, NODES * mesh, ON_GRID * mesh)
    if not math.isfinite(friction.mu_ratio):
        raise EhlError(f"{friction.status}: {friction.message}")
    resolved, on_grid = below
    parts = " and ".join(part for _, part in result if part)
    return Resolution(friction.mu_ratio, resolved, on_grid, shortest, parts)


def _tile(
    settings: Settings, group: str, tile: Topography | None, operating: AnyContact, film: float
) -> tuple[Topography, str]:
    """Surface of a group with a film h_c [m], and its name if it is only a part."""
    if tile is not None:
        tile = surfaces.finished(tile, {**settings[group], "track": 0.0})
        return tile, tile.origin
    tile = surfaces.from_settings({**settings, "surface": settings[group]}, operating, film)
    middle = surfaces.part_of(tile.heights, tile.pixel, tile.origin)
    return (tile, "") if middle is None else (middle, middle.origin)
