# SPDX-License-Identifier: BSD-3-Clause
"""Compare measured waves with the response: ``waves.csv``.

    python docs/evidence/thinning/compare.py FOLDER waves.csv

FOLDER has the runs of ``waves.py``. T is predicted with pressure and film of the run itself, on its
grid, so that its errors are not in the comparison.
"""

from __future__ import annotations

import csv
import math
import sys
from pathlib import Path

import numpy as np
from waves import PLAN, case_of

from pyehl.prediction.smooth import zone_on
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_base, inlet_fit
from pyehl.theory.transport import transport

STATIONS = np.array([-0.5, 0.0, 0.5])
COLUMNS = (
    "run slide_to_roll kx ky x T_re T_im predicted_re predicted_im newtonian_re newtonian_im"
).split()


def predicted(zone, found, moes, ratio):
    """T at the stations."""
    kx, ky = (2.0 * np.pi / found["tile"] * found[name] for name in ("along", "across"))
    spacing = float(found["spacing"])
    inlet = inlet_base(zone, kx, ky, moes, ratio, spacing) * inlet_fit(kx, ky, moes, ratio)
    parts = transport(zone, kx, ky, ratio, STATIONS, spacing)
    turned = [np.exp(1j * kx * (ratio - 1.0) * (x + 1.0)) for x in STATIONS]
    return kx, ky, [d + f * inlet * t for (d, f), t in zip(parts, turned, strict=True)]


def main(arguments: list[str]) -> None:
    """Write the table and print what each run deviates by."""
    rows = []
    for name, run in PLAN.items():
        path = Path(arguments[0]) / f"{name}.npz"
        if not path.exists():
            continue
        found = np.load(path)
        settings = case_of(run).resolve()
        o, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
        line = found["x"], np.maximum(found["pressure"], 0.0), found["film"], o
        zone = zone_on(*line, oil)
        ratio = run.velocity_ratio
        from dataclasses import replace
        kx, ky, t = predicted(zone, found, (o.moes_m, o.moes_l), ratio)
        _, _, n = predicted(replace(zone, factors=None), found, (o.moes_m, o.moes_l), ratio)
        off = []
        for j in range(kx.size):
            for x, p, old in zip(STATIONS, t, n, strict=True):
                i = int(np.argmin(np.abs(found["x"] - x)))
                measured = found["response"][j, i]
                off.append((abs(p[j] - measured), abs(old[j] - measured), abs(1-measured)))
                values = [v for c in (measured, p[j], old[j]) for v in (c.real, c.imag)]
                rows.append([name, kx[j], ky[j], x, *values])
        off = np.array(off).reshape(kx.size, 3, 3)
        if "-v" in arguments:
            for j in range(kx.size):
                i = int(np.argmin(np.abs(found["x"] - 0)))
                m=found['response'][j,i]
                print(f"   lam {2*np.pi/np.hypot(kx[j],ky[j]):.3f} ang {np.degrees(np.arctan2(ky[j],kx[j])):4.0f} meas {m:.4f} pred {t[1][j]:.4f} newt {n[1][j]:.4f}  off {off[j,:,0].round(4)}")
        print(f"{name:26s} rms {np.sqrt((off[:,:,0]**2).mean(0)).round(4)} max {off[:,:,0].max(0).round(4)} newtonian max {off[:,1,1].max():.3f}"
              f" f {zone.factors.along.max():.3g} {zone.factors.across.max():.3g} Hc {np.interp(0,found['x'],found['film']):.4f}")

if __name__ == "__main__":
    main(sys.argv[1:])
