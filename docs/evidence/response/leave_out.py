# SPDX-License-Identifier: BSD-3-Clause
"""How well an operating point is met by a fit to all the others.

    python docs/evidence/response/leave_out.py

writes ``leave_out.csv``, some minutes: the largest deviation of T over all X, for every operating
point of ``waves.csv`` left out with all its velocity ratios, at U = 1 and 1.01 (`slow`) and at
other ones (`slip`). Each fit begins at that to all points.
"""

from __future__ import annotations

import csv

import numpy as np
from fit import HERE, fit, read, select

FEW = (6, 3)
"""Iterations, from a start that is good."""


def main() -> None:
    """Leave out the operating points one at a time."""
    rows = [("moes_m", "moes_l", "slow", "slip")]
    everything = read()
    data = everything.chosen(select(everything))
    whole = fit(data)
    moving = data.kx > 0.0
    for m, ell in sorted(set(zip(data.m[moving], data.l[moving], strict=True))):
        here = (data.m == m) & (data.l == ell)
        found = fit(data.chosen(~here), FEW, whole)
        waves = data.chosen(here & moving)
        left = np.abs(found.residual(waves)).max(axis=1)
        slow = np.abs(waves.ratio - 1.0) < 0.02
        largest = [f"{left[part].max():.3f}" if part.any() else "" for part in (slow, ~slow)]
        rows.append((f"{m:g}", f"{ell:g}", *largest))
        print(*rows[-1], flush=True)
    with (HERE / "leave_out.csv").open("w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
