# SPDX-License-Identifier: BSD-3-Clause
"""Local mode analysis of a relaxation sweep on cells that are longer across the motion.

python docs/evidence/machines/modes.py    prints the table of docs/theory/relaxation.md

For an error exp(i (theta_x i + theta_y j)) of the pressure, constant conductance, the density at
ambient pressure, and changes of all lines from one state (Jacobi). A sweep multiplies the error by
1 - omega S D/L: S is the symbol of the equation, D that of the change of a unit (1, or a dipole), L
that of the line system, which includes the deflection up to two nodes away on the same line.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
Symbol = NDArray[np.complex128]

CELLS = 1.0, 1.41, 2.0, 2.8, 4.0
CONDUCTANCES = 0.0, 0.01, 0.1
FACTOR = 2.0 / np.pi**2
DIPOLE, SINGLE, STRONG, SWITCH = 0.7, 0.5, 10.0, 0.1
"""Relaxation factors, and switch, of fortran/multigrid/relaxation.f90."""
LONG = 1.6
"""Ratio above which the weights of a dipole scale with 1/h^2 (fortran/multigrid/workspace.f90)."""
NODES = 40
ALIASES = 20
REACH = range(-2, 3)


def coefficient(i: int, j: int, ratio: float) -> float:
    """Deflection at (i, j) cells, by a cell of 1 x ratio."""
    x, y = np.array([i - 0.5, i + 0.5]), np.array([j - 0.5, j + 0.5]) * ratio
    corner = x[:, None] * np.arcsinh(y / abs(x[:, None])) + y * np.arcsinh(x[:, None] / abs(y))
    return float(FACTOR * (corner[1, 1] - corner[0, 1] - corner[1, 0] + corner[0, 0]))


def deflection(x: Field, y: Field, ratio: float) -> Field:
    """Give the symbol of the deflection: the transform of 1/r over cells, and its aliases."""
    aliases = 2.0 * np.pi * np.arange(-ALIASES, ALIASES + 1)
    kx, ky = x[..., None, None] + aliases[:, None], (y[..., None, None] + aliases) / ratio
    cell = np.sinc(kx / (2.0 * np.pi)) * np.sinc(ky * ratio / (2.0 * np.pi))
    return np.asarray(FACTOR * (2.0 * np.pi / np.hypot(kx, ky) * cell).sum((-1, -2)))


def factor(x: Field, y: Field, ratio: float, conductance: float, *, dipole: bool) -> Field:
    """Amplification factor of a sweep; conductance is eps/h_y^2, the unit of length h_x."""
    # in units of h_x; the wedge term and the deflection both scale with 1/h_x
    eps = conductance * ratio**2
    power = 2 if ratio > LONG else 1
    weights = np.array([ratio**power, 1.0]) / (2.0 * (1.0 + ratio**power)) * dipole
    row = 1.0 - 2.0 * weights[0] * np.cos(x)
    change = row - 2.0 * weights[1] * np.cos(y)
    line = sum(
        np.cos(d * x)
        * (
            coefficient(d, 0, ratio)
            - weights[0] * (coefficient(d - 1, 0, ratio) + coefficient(d + 1, 0, ratio))
            - 2.0 * weights[1] * coefficient(d, 1, ratio)
        )
        for d in REACH
    )
    wedge: Symbol = 1.5 - 2.0 * np.exp(-1j * x) + 0.5 * np.exp(-2j * x)
    along, across = 4.0 * np.sin(0.5 * x) ** 2, 4.0 * np.sin(0.5 * y) ** 2 / ratio**2
    whole = -eps * (along + across) - wedge * deflection(x, y, ratio)
    known = -eps * (along * row + 2.0 * (weights[1] + row) / ratio**2) - wedge * line
    omega = DIPOLE
    if not dipole:
        omega = (SINGLE + eps / STRONG) / (1.0 + eps / STRONG)
    return np.asarray(np.abs(1.0 - omega * whole * change / known))


def lines() -> list[str]:
    """Make the table."""
    columns = [f"{c:g}" for c in CONDUCTANCES]
    result = [
        "| cells | dipoles, short in X or Y: ε/h_y² = "
        f"{' / '.join(columns)} | short in X | single nodes, any: ε/h_x² = {SWITCH:g} "
        f"| ε/h_y² = {SWITCH:g} |",
        "|---|---|---|---|---|",
    ]
    angles = np.linspace(0.02, np.pi, NODES)
    x, y = np.meshgrid(angles, angles, indexing="ij")
    rough_x, rough_y = x >= 0.5 * np.pi, y >= 0.5 * np.pi
    for ratio in CELLS:
        left = [factor(x, y, ratio, c, dipole=True) for c in CONDUCTANCES]
        single = [factor(x, y, ratio, c, dipole=False).max() for c in (SWITCH / ratio**2, SWITCH)]
        cells = [
            " / ".join(f"{each[rough_x | rough_y].max():.2f}" for each in left),
            " / ".join(f"{each[rough_x].max():.2f}" for each in left),
            *(f"{each:.1f}" for each in single),
        ]
        result.append(f"| 1 : {ratio:g} | {' | '.join(cells)} |")
    return result


if __name__ == "__main__":
    print("\n".join(lines()))
