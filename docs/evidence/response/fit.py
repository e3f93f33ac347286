# SPDX-License-Identifier: BSD-3-Clause
"""Fit the inlet transfer of :mod:`pyehl.theory.response` to the measured waves.

    python docs/evidence/response/fit.py [response.json]

reads ``waves.csv`` and ``ridges.csv``, writes ``pyehl/theory/response.json`` (or the named file)
and ``residuals.csv``, and prints the residuals.

T = driven + free F, where the tables include the base of G in free, and F = exp(i k_x (U - 1) X_0 -
c (U - 1) X_1)/(1 + z). ln|z|, arg z/c and X_0 are polynomials in s = ln(nabla_2)/2,
c = |k_x|/|q|, ln(L/10), ln(M/1000)/2 and U - 1. Terms in M h^2, h the grid spacing, represent the
grid error; the result omits them and holds for h = 0. Least squares of T at all X (Gauss-Newton),
with more weight for larger residuals.
"""

from __future__ import annotations

import csv
import json
import re
import sys
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

HERE = Path(__file__).resolve().parent
TARGET = HERE.parents[2] / "pyehl" / "theory" / "response.json"
Array = NDArray[np.float64]

# s is clipped to this range; beyond it z is proportional to nabla_2 to the power SLOPE
PARAMETER, SLOPE = (-0.7, 1.6), 1.35
# Minimum number of nodes per wavelength by grid: more on coarse grids
NODES = {257: 14.0, 513: 10.0, 1025: 8.0}
# Longest fitted wave along the motion [a]: the edge of the contact affects longer ones
LONGEST = 3.0
WEIGHT_OF_RIDGES = 3.0
# M L at which the leakage in the inlet, LEAK/(M L), is 1
LEAK = 300.0
# Penalty on the coefficients, some of which few data determine
PENALTY = 0.01
# Scales of the variables, so that one penalty suits all terms
SCALES = (1.0, 1.0, 1.5, 1.5, 5.0, 1.0, 1.0)


def _terms() -> list[tuple[int, ...]]:
    """Powers of s, c, ln(L/10), ln(M/1000)/2, U - 1, the leakage and M h^2."""

    def upto(order: int, *others: int) -> list[tuple[int, ...]]:
        """All terms in s and c up to an order, times powers of the others, by default 0."""
        rest = (*others, 0, 0, 0, 0, 0)[:5]
        return [(i, j, *rest) for i in range(order + 1) for j in range(order + 1) if i + j <= order]

    result = upto(5)
    for powers in ((1, 0), (0, 1)):
        result += upto(4, *powers)
    for powers in ((2, 0), (0, 2), (1, 1)):
        result += upto(3, *powers)
    for powers in ((3, 0), (0, 3), (2, 1), (1, 2)):
        result += upto(2, *powers)
    result += upto(4, 0, 0, 1) + upto(2, 0, 0, 2)
    result += upto(2, 1, 0, 1) + upto(2, 0, 1, 1)
    for powers in ((2, 0, 1), (0, 2, 1), (1, 1, 1)):
        result += upto(1, *powers)
    for powers in ((1, 0, 2), (0, 1, 2)):
        result += upto(0, *powers)
    # effect of the leakage in the inlet, only at low M L
    result += upto(5, 0, 0, 0, 1) + upto(4, 0, 0, 0, 2)
    result += upto(4, 0, 0, 1, 1) + upto(4, 0, 0, 2, 1) + upto(3, 0, 0, 1, 2)
    # ridges do not depend on U
    result = [(i, j + (e > 0), a, b, e, *rest) for i, j, a, b, e, *rest in result]
    return result + upto(1, 0, 0, 0, 0, 1)


TERMS = _terms()
SHAPES = ((0, 0), (1, 0), (2, 0), (0, 2), (1, 2))
LEAKING = (*SHAPES, (3, 0))
ORIGIN = [
    (i, j, a, b, e, f, 0)
    for i, j, a, b, e, f in (
        *((i, j, 0, 0, 0, 0) for i, j in SHAPES),
        *((i, j, 0, 0, 0, f) for f in (1, 2) for i, j in LEAKING),
        *((i, 0, *powers, 0) for powers in ((1, 0, 0), (0, 1, 0), (0, 0, 1)) for i in (0, 1)),
        *((0, 0, 1, 0, 1, 0), (0, 0, 0, 1, 1, 0)),
    )
]
GROWTH = [
    *((i, j, 0, 0, e, f, 0) for e in (0, 1) for f in (1, 2) for i, j in (*LEAKING, (0, 1))),
    *((i, j, *p, 0, 0, 0) for i, j in ((0, 0), (1, 0), (0, 2)) for p in ((0, 0), (1, 0), (0, 1))),
]


@dataclass(frozen=True, slots=True)
class Data:
    """Waves (m,) and their measurements at several X (m, 3)."""

    m: Array
    l: Array  # noqa: E741
    ratio: Array
    points: Array
    kx: Array
    ky: Array
    t: NDArray[np.complex128]
    driven: NDArray[np.complex128]
    free: NDArray[np.complex128]

    def chosen(self, mask: NDArray[np.bool_]) -> Data:
        """Select some of the waves."""
        return Data(*(getattr(self, name)[mask] for name in self.__slots__))

    @property
    def q(self) -> Array:
        """|q| [1/a]."""
        return np.hypot(self.kx, self.ky)

    @property
    def nodes(self) -> Array:
        """Nodes per wavelength."""
        return 2.0 * np.pi / self.q * (self.points - 1.0) / 4.0

    @property
    def variables(self) -> tuple[Array, ...]:
        """Variables s (clipped), c, ln(L/10), ln(M/1000)/2, U - 1, leakage LEAK/(M L), M h^2."""
        s = 0.5 * np.log(2.0 * np.pi / self.q * np.sqrt(self.m / self.l))
        return (
            np.clip(s, *PARAMETER),
            self.kx / self.q,
            np.log(self.l / 10.0),
            0.5 * np.log(self.m / 1000.0),
            self.ratio - 1.0,
            LEAK / (self.m * self.l),
            self.m * (4.0 / (self.points - 1.0)) ** 2,
        )

    @property
    def beyond(self) -> Array:
        """Contribution to ln|z| of the clipped part of s."""
        s = 0.5 * np.log(2.0 * np.pi / self.q * np.sqrt(self.m / self.l))
        return 2.0 * SLOPE * (s - np.clip(s, *PARAMETER))

    def powers(self, terms: list[tuple[int, ...]]) -> Array:
        """Give the terms (m, number of terms), scaled."""
        scaled = [v * f for v, f in zip(self.variables, SCALES, strict=True)]
        return np.stack(
            [np.prod([v**p for v, p in zip(scaled, term, strict=True)], axis=0) for term in terms],
            axis=1,
        )


def read(folder: Path = HERE) -> Data:
    """All waves, ridges last (with kx = 0, and the same value at all X)."""
    with (folder / "waves.csv").open(newline="", encoding="utf-8") as stream:
        table = np.array([[float(v) for v in row] for row in list(csv.reader(stream))[1:]])
    with (folder / "ridges.csv").open(newline="", encoding="utf-8") as stream:
        ridges = np.array([[float(v) for v in row] for row in list(csv.reader(stream))[1:]])
    table = table.reshape(-1, 3, table.shape[1])
    heads = [table[:, 0, i] for i in range(6)]
    # a run that was too short has no T and does not count
    table[:, :, 7:13][np.isnan(table[:, :, 7])] = 0.0
    parts = [table[:, :, i] + 1j * table[:, :, i + 1] for i in (7, 9, 11)]
    one, none = np.ones(len(ridges)), np.zeros(len(ridges))
    more = [ridges[:, 0], ridges[:, 1], one, ridges[:, 2], none, ridges[:, 3]]
    also = [np.repeat(ridges[:, i : i + 1], 3, axis=1) + 0j for i in (4, 5, 6)]
    return Data(
        *(np.concatenate(pair) for pair in zip(heads, more, strict=True)),
        *(np.concatenate(pair) for pair in zip(parts, also, strict=True)),
    )


def select(data: Data) -> NDArray[np.bool_]:
    """Waves that are fitted."""
    enough = data.nodes >= np.array([NODES[int(n)] for n in data.points])
    short = 2.0 * np.pi / np.maximum(data.kx, 1e-12) < LONGEST
    ridge = (data.kx == 0.0) & (data.ky > 3.0)
    return (enough & short) | ridge


class Fit:
    """Coefficients of ln|z|, arg z/c, X_0 and X_1."""

    def __init__(self, coefficients: Array) -> None:
        self.coefficients = coefficients

    def transfer(self, data: Data) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """G and z of waves (m,), with the error of their grids."""
        return self.of_powers(data, *(data.powers(terms) for terms in (TERMS, ORIGIN, GROWTH)))

    def of_powers(
        self, data: Data, powers: Array, origin: Array, growth: Array
    ) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """G and z by the powers of the variables in TERMS, ORIGIN and GROWTH."""
        modulus, angle, first, second = self.parts()
        _, c, _, _, slip, _, _ = data.variables
        z = np.exp(powers @ modulus + data.beyond + 1j * c * (powers @ angle))
        shift = data.kx * slip * (origin @ first) + 1j * c * slip * (growth @ second)
        return np.exp(1j * shift) / (1.0 + z), z

    def parts(self) -> list[Array]:
        """Coefficients of ln|z|, arg z/c, X_0 and X_1."""
        sizes = len(TERMS), len(TERMS), len(ORIGIN)
        return np.split(self.coefficients, np.cumsum(sizes))

    def residual(self, data: Data) -> NDArray[np.complex128]:
        """T of the fit less T (m, 3)."""
        return data.driven + data.free * self.transfer(data)[0][:, np.newaxis] - data.t

    def as_json(self) -> dict[str, Any]:
        """Coefficients in the form that :mod:`pyehl.theory.response` reads."""

        def listed(terms: list[tuple[int, ...]], values: Array) -> list[list[float]]:
            result = []
            for term, value in zip(terms, values, strict=True):
                if not term[6]:
                    scale = np.prod([f**p for f, p in zip(SCALES, term, strict=True)])
                    result.append([float(f"{value * scale:.7g}"), *term[:6]])
            return result

        names = {"modulus": TERMS, "angle": TERMS, "origin": ORIGIN, "growth": GROWTH}
        return {
            "range": {"moes_m": [100, 3000], "moes_l": [3, 20], "velocity_ratio": [0.8, 1.2]},
            "parameter": list(PARAMETER),
            "slope": SLOPE,
            "leak": LEAK,
            **{
                name: listed(terms, values)
                for (name, terms), values in zip(names.items(), self.parts(), strict=True)
            },
        }


def _start(data: Data) -> Fit:
    """Linear fit to the z of each wave."""
    norm = np.maximum((np.abs(data.free) ** 2).sum(axis=1), 1e-30)
    g = (np.conj(data.free) * (data.t - data.driven)).sum(axis=1) / norm
    z = 1.0 / np.where(g == 0.0, 1e-6, g) - 1.0
    angle = np.where(np.angle(z) > 2.0, np.angle(z) - 2.0 * np.pi, np.angle(z))
    strength = np.minimum(np.abs(g), 2.0) ** 2 * np.minimum(np.abs(z), 1e3)
    weight = np.minimum(strength * np.abs(data.free).mean(axis=1) + 1e-6, 1.0)[:, np.newaxis]
    powers, c, n = data.powers(TERMS), data.variables[1][:, np.newaxis], len(TERMS)
    size = np.log(np.abs(z)) - data.beyond

    def solve(matrix: Array, values: Array) -> Array:
        a = np.vstack([matrix * weight, 1e-2 * np.eye(n)])
        b = np.concatenate([values * weight[:, 0], np.zeros(n)])
        return np.asarray(np.linalg.lstsq(a, b, rcond=None)[0])

    return Fit(
        np.concatenate(
            [solve(powers, size), solve(powers * c, angle), np.zeros(len(ORIGIN) + len(GROWTH))]
        )
    )


def fit(data: Data, iterations: tuple[int, int] = (40, 40), start: Fit | None = None) -> Fit:
    """Gauss-Newton from a start or the linear fit, with more weight for larger residuals.

    The first iterations approximately minimise the sum of the fourth powers of the residuals, the
    last ones that of the tenth powers.
    """
    powers, origin, growth = (data.powers(terms) for terms in (TERMS, ORIGIN, GROWTH))
    _, c, _, _, slip, _, _ = data.variables
    first = np.where(data.kx == 0.0, WEIGHT_OF_RIDGES, 1.0)
    turned, moved = powers * c[:, np.newaxis], origin * (data.kx * slip)[:, np.newaxis]
    grown = growth * (c * slip)[:, np.newaxis]
    # effect of a change of G on T at all X, as one number
    strength = np.maximum(np.sqrt((np.abs(data.free) ** 2).sum(axis=1)), 1e-12)
    result = start or _start(data)
    for k in range(sum(iterations)):
        last = k >= iterations[0]
        g, z = result.of_powers(data, powers, origin, growth)
        residual = data.driven + data.free * g[:, np.newaxis] - data.t
        size = np.abs(residual).max(axis=1) * first
        weight = first * (0.003 + size) ** (4.0 if last else 1.0)
        weight /= np.sqrt(np.mean(weight**2))
        log_z = (-g * z / (1.0 + z) * strength * weight)[:, np.newaxis]
        shift = (1j * g * strength * weight)[:, np.newaxis]
        jacobian = np.hstack(
            [log_z * powers, 1j * log_z * turned, shift * moved, 1j * shift * grown]
        )
        wanted = -(np.conj(data.free) * residual).sum(axis=1) / strength * weight
        a = np.vstack([jacobian.real, jacobian.imag])
        b = np.concatenate([wanted.real, wanted.imag])
        normal = a.T @ a
        penalty = np.diag(PENALTY**2 + 1e-9 * np.diag(normal))
        step = np.linalg.solve(normal + penalty, a.T @ b - PENALTY**2 * result.coefficients)
        limit = min(1.0, 3.0 / np.abs(step).max()) if k < 5 else 0.3 if last else 0.7
        result = Fit(result.coefficients + limit * step)
    return result


def table(result: Fit, data: Data) -> list[list[str]]:
    """Maximum and rms residual of T per operating point, at X = 0 and over all X."""
    residual = np.abs(result.residual(data))
    groups: dict[tuple[float, float, float], list[int]] = defaultdict(list)
    for i, key in enumerate(zip(data.m, data.l, data.ratio, strict=True)):
        if data.kx[i] > 0.0:
            groups[key].append(i)
    lines = []
    for key, waves in sorted(groups.items()):
        r = residual[waves]
        values = (r[:, 1].max(), np.sqrt(np.mean(r[:, 1] ** 2)), r.max())
        lines.append([*(f"{v:g}" for v in key), str(len(waves)), *(f"{v:.4f}" for v in values)])
    return lines


def main(target: Path) -> None:
    """Fit, write the coefficients and the residuals, print them."""
    everything = read()
    data = everything.chosen(select(everything))
    result = fit(data)
    # one term per line
    text = re.sub(
        r"\[[^][]*\]", lambda m: " ".join(m[0].split()), json.dumps(result.as_json(), indent=1)
    )
    target.write_text(text + "\n", encoding="utf-8")
    lines = table(result, data)
    with (HERE / "residuals.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        names = "moes_m moes_l velocity_ratio waves largest_at_centre rms_at_centre largest".split()
        writer.writerows([names, *lines])
    for line in lines:
        print("  ".join(value.rjust(7) for value in line))
    residual = np.abs(result.residual(data))
    ridge = data.kx == 0.0
    print(
        f"{np.count_nonzero(~ridge)} waves: at X = 0 largest {residual[~ridge, 1].max():.4f}, rms "
        f"{np.sqrt(np.mean(residual[~ridge, 1] ** 2)):.4f}; over all X largest "
        f"{residual[~ridge].max():.4f}"
    )
    print(f"{np.count_nonzero(ridge)} ridges: largest {residual[ridge].max():.4f}")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else TARGET)
