# SPDX-License-Identifier: BSD-3-Clause
"""Deviations of the fit for waves of a/8 to a/32 between its points, which it does not include.

    python docs/evidence/response/unfitted.py

prints the maximum deviation of T over all X for each wavelength of ``unfitted.csv``, whose columns
are those of ``waves.csv``.
"""

from __future__ import annotations

import csv
from collections import defaultdict
from pathlib import Path

import numpy as np

from pyehl.theory.response import inlet_fit

HERE = Path(__file__).resolve().parent


def main() -> None:
    """Compare T = driven + free F with the measured T."""
    result: dict[tuple[str, ...], list[float]] = defaultdict(list)
    with (HERE / "unfitted.csv").open(newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            t, driven, free = (
                complex(float(row[f"{name}_re"]), float(row[f"{name}_im"]))
                for name in ("T", "driven", "free")
            )
            if np.isnan(t):
                continue
            moes = float(row["moes_m"]), float(row["moes_l"])
            kx, ky = float(row["kx"]), float(row["ky"])
            inlet = complex(inlet_fit([kx], [ky], moes, float(row["velocity_ratio"]))[0])
            octave = f"a/{2 ** round(np.log2(np.hypot(kx, ky) / (2.0 * np.pi)))}"
            key = (row["moes_m"], row["moes_l"], row["velocity_ratio"], octave)
            result[key].append(abs(driven + free * inlet - t))
    print("moes_m moes_l     U  wavelength  largest")
    for (m, ell, ratio, octave), off in sorted(result.items()):
        print(f"{m:>6} {ell:>6} {ratio:>5}  {octave:>10}  {max(off):7.3f}")


if __name__ == "__main__":
    main()
