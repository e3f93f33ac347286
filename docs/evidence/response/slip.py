# SPDX-License-Identifier: BSD-3-Clause
"""Waves at slips beyond those of the fit: ``slip.csv``, measurements and response.

    python docs/evidence/response/slip.py

makes the missing runs of `PLAN`, about a minute each, computes the response with pressure and film
of the smooth contact on the grid of a run, and prints the deviations of T. The response is not
fitted to these waves.
"""

from __future__ import annotations

import csv
from itertools import product

import numpy as np
from make import FILLING, HERE, MIDDLE, STATIONS, settings_of, smooth_zone, superpose, waves_of
from numpy.typing import NDArray

from pyehl.theory.response import inlet_transfer
from pyehl.theory.transport import transport

TABLE = HERE / "slip.csv"
# M, L, U and points
PLAN = (
    *product((100.0,), (3.0,), (0.5, 0.7, 1.3, 1.5), (513,)),
    *product((200.0,), (10.0,), (0.5, 0.7, 1.3, 1.5), (513,)),
    *product((300.0,), (12.0,), (0.5, 0.7, 1.3, 1.5), (513,)),
    *product((500.0,), (5.0,), (0.5, 0.7, 1.3, 1.5), (513,)),
    *product((1000.0,), (10.0,), (0.5, 0.7, 1.3, 1.5), (513,)),
    *product((2000.0,), (15.0,), (0.5, 0.7, 1.3, 1.5), (513,)),
    *product((100.0, 3000.0), (20.0,), (0.5, 1.5), (513,)),
    *product((3000.0,), (3.0,), (0.5, 1.5), (513,)),
)
COLUMNS = "moes_m moes_l velocity_ratio points kx ky x T_re T_im predicted_re predicted_im".split()
# Minimum number of nodes per wavelength, and maximum length along the motion [a], of compared waves
NODES, LONGEST = 10.0, 3.0


def measure(moes_m: float, moes_l: float, ratio: float, points: int) -> NDArray[np.float64]:
    """Rows of a run, without the prediction."""
    waves = waves_of(points, 0)
    result = superpose(
        settings_of(moes_m, moes_l), waves, points=points, velocity_ratio=ratio, filling=FILLING
    )
    place = [int(np.argmin(np.abs(result.x - x))) for x in STATIONS]
    t = result.response[:, place]
    heads = np.broadcast_to([moes_m, moes_l, ratio, points], (*t.shape, 4))
    q = np.repeat(np.stack([waves.kx, waves.ky], axis=-1)[:, np.newaxis], STATIONS.size, axis=1)
    x = np.broadcast_to(STATIONS, t.shape)
    rest = np.stack([x, t.real, t.imag, 0.0 * x, 0.0 * x], axis=-1)
    return np.concatenate([heads, q, rest], axis=-1).reshape(-1, len(COLUMNS))


def predicted(run: NDArray[np.float64]) -> NDArray[np.complex128]:
    """T of the rows of a run."""
    m, ell, ratio, points = (float(v) for v in run[0, :4])
    kx, ky = run[:: STATIONS.size, 4], run[:: STATIONS.size, 5]
    zone, spacing = smooth_zone(m, ell, int(points)), 4.0 / (points - 1.0)
    inlet = inlet_transfer(zone, kx, ky, (m, ell), ratio, spacing=spacing)
    turned = np.exp(1j * (ratio - 1.0) * np.outer(kx, STATIONS + 1.0))
    parts = np.array(transport(zone, kx, ky, ratio, STATIONS, spacing))
    return np.asarray(parts[:, 0].T + parts[:, 1].T * inlet[:, np.newaxis] * turned).ravel()


def read() -> NDArray[np.float64]:
    """Rows of the table."""
    with TABLE.open(newline="", encoding="utf-8") as stream:
        return np.array([[float(v) for v in row] for row in list(csv.reader(stream))[1:]])


def compared(rows: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether the grid resolves the wave of a row, and the edge does not affect it."""
    nodes = 2.0 * np.pi / np.hypot(rows[:, 4], rows[:, 5]) * (rows[:, 3] - 1.0) / 4.0
    long = 2.0 * np.pi / rows[:, 4] >= LONGEST
    return np.asarray((nodes >= NODES) & ~long & ~np.isnan(rows[:, 7]))


def off(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """|T - T of the prediction| of rows."""
    return np.hypot(rows[:, 7] - rows[:, 9], rows[:, 8] - rows[:, 10])


def main() -> None:
    """Measure missing runs, predict all, print and write."""
    rows = read()
    result = []
    print("moes_m moes_l    U  points  waves  X = 0: rms  largest  all X: largest")
    for key in PLAN:
        there = rows[(rows[:, :4] == key).all(1)]
        run = there if there.size else measure(*key)
        t = predicted(run)
        run[:, 9], run[:, 10] = t.real, t.imag
        result.append(run)
        here = run[compared(run)]
        centre, all_x = off(here[here[:, 6] == STATIONS[MIDDLE]]), off(here)
        numbers = np.sqrt(np.mean(centre**2)), centre.max(), all_x.max()
        print(
            f"{key[0]:6g} {key[1]:6g} {key[2]:4g} {key[3]:7g} {centre.size:6d}"
            + "".join(f"{v:11.4f}" for v in numbers),
            flush=True,
        )
    with TABLE.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row in np.concatenate(result):
            heads = [f"{v:.6g}" for v in row[:7]]
            writer.writerow([*heads, *(f"{v:.5f}" for v in row[7:])])


if __name__ == "__main__":
    main()
