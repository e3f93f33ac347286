# SPDX-License-Identifier: BSD-3-Clause
"""Cross-validation of the fit: deviations at an operating point of a fit to all others.

    python docs/evidence/response/leave_out.py

writes ``leave_out.csv`` in several minutes: the maximum deviation of T over all X, for every
operating point of ``waves.csv`` omitted with all its velocity ratios, at U = 1 and 1.01 (`slow`)
and at other ones (`slip`). Each fit starts from that to all points.
"""

from __future__ import annotations

import csv

import numpy as np
from fit import HERE, Data, Fit, fit, read, select

FEW = (6, 3)
"""Numbers of iterations from a good start."""


def left_out(data: Data, whole: Fit, moes_m: float, moes_l: float) -> list[str]:
    """Maximum deviation at a point from the fit to all others, at U = 1 and 1.01 and elsewhere."""
    here = (data.m == moes_m) & (data.l == moes_l)
    waves = data.chosen(here & (data.kx > 0.0))
    result = fit(data.chosen(~here), FEW, whole)
    residual = np.abs(result.residual(waves)).max(axis=1)
    slow = np.abs(waves.ratio - 1.0) < 0.02
    return [f"{residual[part].max():.3f}" if part.any() else "" for part in (slow, ~slow)]


def main() -> None:
    """Omit the operating points one at a time."""
    rows = [["moes_m", "moes_l", "slow", "slip"]]
    everything = read()
    data = everything.chosen(select(everything))
    whole = fit(data)
    moving = data.kx > 0.0
    for m, ell in sorted(set(zip(data.m[moving], data.l[moving], strict=True))):
        rows.append([f"{m:g}", f"{ell:g}", *left_out(data, whole, m, ell)])
        print(*rows[-1], flush=True)
    with (HERE / "leave_out.csv").open("w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
