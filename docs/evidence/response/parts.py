# SPDX-License-Identifier: BSD-3-Clause
"""Recompute the driven and free parts in ``waves.csv``, ``unfitted.csv`` and ``ridges.csv``.

    python docs/evidence/response/parts.py

For a change of :mod:`pyehl.theory.transport`: the measured T stays; its parts by the transport
equation are computed from smooth contacts on the grids of the runs, in several minutes.
"""

from __future__ import annotations

import csv

import numpy as np
from make import HERE, STATIONS, parts_of, smooth_zone


def main() -> None:
    """Rewrite the tables."""
    for name in ("waves.csv", "unfitted.csv", "ridges.csv"):
        with (HERE / name).open(newline="", encoding="utf-8") as stream:
            head, *rows = list(csv.reader(stream))
        column = {key: i for i, key in enumerate(head)}
        moving = "kx" in column
        groups: dict[tuple[float, float, float, int], list[list[str]]] = {}
        for row in rows:
            m, ell = float(row[0]), float(row[1])
            ratio = float(row[column["velocity_ratio"]]) if moving else 1.0
            groups.setdefault((m, ell, ratio, int(row[column["points"]])), []).append(row)
        for (m, ell, ratio, points), group in groups.items():
            print(f"M {m:g} L {ell:g} U {ratio:g}: {points} x {points} nodes", flush=True)
            ky = np.array([float(row[column["ky"]]) for row in group])
            kx = np.array([float(row[column["kx"]]) if moving else 0.0 for row in group])
            zone, spacing = smooth_zone(m, ell, points), 4.0 / (points - 1.0)
            parts = parts_of(zone, kx, ky, (m, ell), ratio, spacing)
            for j, row in enumerate(group):
                x = float(row[column["x"]]) if moving else 0.0
                driven, free = parts[int(np.argmin(np.abs(STATIONS - x)))]
                if not moving:
                    row[column["driven"]] = f"{driven[j].real:.5f}"
                    row[column["free"]] = f"{free[j].real:.5f}"
                    continue
                values = (driven[j].real, driven[j].imag, free[j].real, free[j].imag)
                first = column["driven_re"]
                row[first : first + 4] = [f"{v:.5f}".replace("-0.00000", "0") for v in values]
        with (HERE / name).open("w", newline="", encoding="utf-8") as stream:
            csv.writer(stream, lineterminator="\n").writerows([head, *rows])


if __name__ == "__main__":
    main()
