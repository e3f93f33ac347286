# SPDX-License-Identifier: BSD-3-Clause
"""Shear traction on a body by the shear law of its oil, or by a coefficient of friction."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from pyehl.errors import InputError
from pyehl.theory.line_contact import AnyContact
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.shear import shear_stress
from pyehl.types import Array

if TYPE_CHECKING:
    import xarray as xr


MAX_FRICTION = 2.0
# Criteria of a step: traction at the edge over the largest one, and over that one node inside
STEP, FLAT = 0.1, 0.85


def check_friction(friction: str | float) -> None:
    """Raise InputError for a friction that is neither 'run', 'none' nor a coefficient."""
    if isinstance(friction, str) and friction in ("run", "none"):
        return
    if isinstance(friction, int | float) and not isinstance(friction, bool):
        if 0.0 <= friction <= MAX_FRICTION:
            return
    raise InputError(
        f"friction = {friction!r}: expected 'run', 'none', or a coefficient of friction 0 ... 2"
    )


def value_of(data: xr.Dataset, name: str) -> float:
    """Value of a result; NaN if it has none."""
    return float(data[name]) if name in data else math.nan


def friction_of(
    data: xr.Dataset, operating: AnyContact, lubricant: Lubricant | None, friction: str | float
) -> tuple[float, float, str]:
    """Return the coefficient of friction of the smooth contact, the heat factor, and a note.

    The factor is the effect of frictional heating on the traction of the rough contact, over that
    on the smooth one. NaN: without friction.
    """
    if friction == "none" or (friction != "run" and friction == 0.0):
        return math.nan, math.nan, "without friction, as requested"
    if friction != "run":
        return float(friction), 1.0, f"traction is {friction:g} times the pressure, as requested"
    if lubricant is None:
        return math.nan, math.nan, "without friction: the case has Moes numbers and no oil"
    if operating.sliding_speed == 0.0:
        return math.nan, math.nan, "without friction: pure rolling"
    mu = [value_of(data, n) for n in ("mu_smooth", "mu_smooth_isothermal", "mu", "mu_isothermal")]
    if math.isfinite(mu[1]) and not math.isfinite(mu[0]):
        # the smooth contact is taken to be as warm as the rough one
        mu[0] = mu[1] * mu[2] / mu[3]
    smooth = mu[0] if math.isfinite(mu[0]) else mu[2]
    if not math.isfinite(smooth):
        why = data.attrs.get("mu_note", "the result states no coefficient of friction")
        return math.nan, math.nan, f"without friction: {why}"
    heat = (mu[2] / mu[3]) / (mu[0] / mu[1]) if all(map(math.isfinite, mu)) else 1.0
    note = f"traction by the shear law of the oil, scaled to mu_smooth = {smooth:.4g}" + (
        " and for heat" if math.isfinite(mu[1]) and mu[1] != mu[0] else ""
    )
    return smooth, heat, note


class Traction:
    """Traction on the body from pressure [p_h] and film [m].

    `smooth`: pressure and film of the smooth contact (nx, ny); `area` of a node and `width` of the
    grid across the motion [a^2, a]; `result`: that of `friction_of`; no lubricant in Moes numbers;
    `body` 1 or 2; `friction`: 'run' for the shear law, else in proportion to the pressure.
    """

    def __init__(
        self,
        smooth: tuple[Array, Array | None],
        area: float,
        width: float,
        operating: AnyContact,
        lubricant: Lubricant | None,
        result: tuple[float, float, str],
        body: int,
        friction: str | float,
    ) -> None:
        self.operating, self.lubricant, self.coulomb = operating, lubricant, friction != "run"
        self.mu, self.heat, _ = result
        self.by_film = math.isfinite(self.mu) and not self.coulomb
        # friction retards the faster body
        faster = operating.slide_to_roll >= 0.0
        self.sign = -1.0 if (body == 1) == faster else 1.0
        self.scale = 1.0
        if self.by_film:
            total = float(self._by_law(*smooth).sum()) * area
            load = 2.0 * math.pi / 3.0 * operating.ellipse.side
            if operating.ellipse.is_line:
                load = 0.5 * math.pi * width
            self.scale = self.mu * load / total

    def _by_law(self, pressure: Array, film: Array | None) -> Array:
        """Shear stress [p_h] of the isothermal film, 0 where there is no pressure."""
        assert self.lubricant is not None
        assert film is not None
        p_h = self.operating.hertz_pressure
        p = np.maximum(pressure, 0.0) * p_h
        viscosity = self.lubricant.viscosity * self.lubricant.viscosity_ratio(p)
        newtonian = viscosity * abs(self.operating.sliding_speed) / film
        return np.where(p > 0.0, shear_stress(newtonian, p, self.lubricant.shear), 0.0) / p_h

    def __call__(self, pressure: Array, film: Array | None, rough: bool) -> Array | None:
        """Return the traction (nx, ny) [p_h], None without friction; only `by_film` uses `film`."""
        if not math.isfinite(self.mu):
            return None
        if self.coulomb:
            return self.sign * self.mu * pressure
        factor = self.sign * self.scale * (self.heat if rough else 1.0)
        return factor * self._by_law(pressure, film)


def steep_edge(traction: Array | None) -> bool:
    """Whether a traction (nx, ny) ends in a step along x, or at the border of the grid.

    Then the stress along x is not finite at the surface (Johnson 1985, chapter 2.5). From the
    last node but one to the last a traction that vanishes as the square root of the distance
    decreases by 30 %, a linear one by 50 %.
    """
    if traction is None:
        return False
    size = np.abs(traction)
    edged = np.pad(size, ((2, 2), (0, 0)))
    last, loaded = edged[2:-2], size > STEP * size.max()
    steps = [
        loaded & (outside == 0.0) & (last > FLAT * within)
        for outside, within in ((edged[1:-3], edged[3:-1]), (edged[3:-1], edged[1:-3]))
    ]
    return bool(np.any(steps))
