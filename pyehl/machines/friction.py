# SPDX-License-Identifier: BSD-3-Clause
"""Friction of a contact with Hertz pressure and a uniform film, by the shear law of the oil."""

import math

import numpy as np

from pyehl.contact.heat import HeatOf
from pyehl.machines.contact import Film
from pyehl.theory.friction import absolute_friction
from pyehl.theory.heat import Heat
from pyehl.theory.shear import shear_stress
from pyehl.types import Array

# Nodes of the heat along and across the motion, and of the integrals
NODES, ROWS, GAUSS = 129, 9, 40


def traction(film: Film) -> tuple[float, float]:
    """Coefficient of friction of sliding [-] and flash temperature [K] (Tian & Kennedy).

    Pressure p_h sqrt(1 - r^2) and a uniform film h_c, with frictional heating where the case
    includes it. NaN without sliding along the motion; mu is NaN for an unphysical Newtonian stress.
    """
    point, oil, h_c = film.point, film.lubricant, film.h_c
    if point.slide_to_roll == 0.0:
        return math.nan, math.nan
    p_h, speed = film.hertz_pressure, point.sliding_speed
    x, weights = np.polynomial.legendre.leggauss(GAUSS)
    angle = 0.25 * math.pi * (x + 1.0)  # r = sin(angle)
    pressure = p_h * np.cos(angle)
    stress = shear_stress(
        oil.viscosity * oil.viscosity_ratio(pressure) * speed / h_c, pressure, oil.shear
    )
    area = np.cos(angle) if film.line else np.sin(2.0 * angle)
    mean = 0.25 * math.pi * float(np.sum(weights * stress * area))
    mu = mean / (p_h * (math.pi / 4.0 if film.line else 2.0 / 3.0))
    result = absolute_friction(point, oil, h_c, mu, 1.0, _heat(film, h_c))
    return result["mu"], result["flash_temperature_K"]


def _heat(film: Film, h_c: float) -> Heat:
    """Return the effect of frictional heating for that pressure and film."""
    rows = 2 if film.line else ROWS
    across = 0.0 if film.line else film.point.ellipse.ellipticity
    x = np.linspace(-1.0, 1.0, NODES)
    y = np.linspace(0.0, across or 0.1, rows)
    remaining = 1.0 - x[:, None] ** 2 - (y[None, :] / across if across else 0.0 * y[None, :]) ** 2
    pressure = np.sqrt(np.maximum(remaining, 0.0))
    films = np.full(pressure.shape, h_c / film.point.film_scale)
    nodes = HeatOf(film.wide or film.settings, film.lubricant, x, y, even=True)
    return nodes(pressure, films, np.zeros(pressure.shape, dtype=bool))


def rolling_force(film: Film) -> float:
    """Return the rolling resistance of the pressure-driven flow on each surface [N].

    Lines: 4.318 (alpha eta0 u/R)^0.658 W^0.0126 R/alpha per length (Goksem & Hargreaves 1978, J.
    Lubr. Technol. 100, 346); ellipses: the elastohydrodynamic asymptote 7.5 kappa/M p_h a^3/R_x, M
    of the circular contact with the same equations (Biboulet & Houpert 2010, Proc. Inst. Mech. Eng.
    J 224, part 2). NaN for lines where alpha is 0.
    """
    if film.line is None:
        point, shape = film.point, film.point.ellipse
        m_round = point.moes_m / (shape.ellipticity * shape.kernel_ratio**0.25)
        number = 7.5 * shape.ellipticity / m_round
        return number * point.hertz_pressure * point.hertz_radius**3 / point.radius
    line = film.line
    if line.pressure_viscosity == 0.0:
        return math.nan
    flow = line.material * line.speed
    force = 4.318 * flow**0.658 * line.load_number**0.0126 * line.radius / line.pressure_viscosity
    return float(force * film.contact.length)


def groove_sliding(film: Film, h_c: float) -> float:
    """Sliding power in the groove of a ball that rolls freely and spins [W].

    Heathcote slip: the common surface of ball and groove is curved across the motion, so that both
    have the same velocity only on two lines; the tractions on both sides of these balance.
    Isothermal, with the Hertz pressure and a uniform film h_c [m]. NaN for a Newtonian oil, whose
    stress would be unphysical.
    """
    point, oil, contact = film.point, film.lubricant, film.contact
    if oil.shear.law == "newtonian":
        return math.nan
    from scipy.optimize import brentq  # noqa: PLC0415 (takes as long to load as all the rest)

    a, b = point.semi_axes
    nodes, weights = np.polynomial.legendre.leggauss(GAUSS)
    r = np.sin(0.25 * math.pi * (nodes + 1.0))
    area = 0.25 * math.pi * weights * r * np.cos(0.25 * math.pi * (nodes + 1.0))
    turn = 2.0 * math.pi * (np.arange(GAUSS) + 0.5) / GAUSS
    x, y = a * np.outer(r, np.cos(turn)), b * np.outer(r, np.sin(turn))
    area = np.outer(area, np.full(GAUSS, 2.0 * math.pi / GAUSS)) * a * b
    pressure = point.hertz_pressure * np.sqrt(1.0 - r**2)[:, None] * np.ones(GAUSS)
    viscosity = oil.viscosity * oil.viscosity_ratio(pressure)
    # 1/R of the common surface across the motion
    curvature = 0.5 * (1.0 / contact.radii[1] - 1.0 / contact.radii[3])
    fall = contact.mean_velocity / contact.radius * 0.5 * curvature * y**2

    def stress(level: float) -> tuple[Array, Array, Array]:
        """Sliding velocity along the motion, sliding speed, and the stress for that speed."""
        along = level - fall - contact.spin * y
        size = np.hypot(along, contact.spin * x)
        return along, size, shear_stress(viscosity * size / h_c, pressure, oil.shear)

    def pull(level: float) -> float:
        along, size, tau = stress(level)
        share = np.divide(along, size, out=np.zeros_like(size), where=size > 0.0)
        return float(np.sum(area * tau * share))

    bound = float(fall.max()) + abs(contact.spin) * b
    level = brentq(pull, -bound, bound, xtol=1e-14 * bound) if bound > 0.0 else 0.0
    _, size, tau = stress(level)
    return float(np.sum(area * tau * size))
