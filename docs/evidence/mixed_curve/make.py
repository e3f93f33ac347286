# SPDX-License-Identifier: BSD-3-Clause
"""Make curve.csv of a curve through mixed lubrication, or print the table of its page.

python docs/evidence/mixed_curve/make.py FOLDER     from the folder of `pyehl stribeck`
python docs/evidence/mixed_curve/make.py picture    draws curve.png
python docs/evidence/mixed_curve/make.py            prints the table
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from pyehl.plots import style
from pyehl.plots.stribeck import draw_stribeck
from pyehl.theory.transition import Curve

HERE = Path(__file__).resolve().parent
SHARE, AREA, FILM = "contact_load_share", "contact_area_share", "h_min_rough_m"
COLUMNS = (
    *("contact.mean_velocity", "status", "lambda_ratio", "mu", "mu_ratio", "mu_ratio_ehl"),
    *(SHARE, f"{SHARE}_error", f"{SHARE}_ehl", f"{SHARE}_ehl_error", AREA, f"{AREA}_ehl"),
    *(FILM, "h_min_rough_ehl_m"),
)


def rows() -> list[dict[str, str]]:
    """Read the table."""
    with (HERE / "curve.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def lines() -> list[str]:
    """Make the table of the points with a full simulation: prediction, then simulation."""
    result = [
        "| speed [m/s] | Λ | load share | simulated | area share | simulated | minimum film [nm] "
        "| simulated |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in rows():
        if not row[f"{SHARE}_ehl"]:
            continue
        speed = f"{float(row['contact.mean_velocity']):.3g}"
        shares = [
            f"{float(row[name]):.2g} ± {float(row[f'{name}_error']):.1g}"
            if float(row[name])
            else "0"
            for name in (SHARE, f"{SHARE}_ehl")
        ]
        areas = [f"{float(row[name]):.2g}" for name in (AREA, f"{AREA}_ehl")]
        films = [f"{1e9 * float(row[name]):.1f}" for name in (FILM, "h_min_rough_ehl_m")]
        cells = [speed, f"{float(row['lambda_ratio']):.2f}", *shares, *areas, *films]
        result.append(f"| {' | '.join(cells)} |")
    return result


def draw() -> Figure:
    """Draw the curve of the table."""
    table = pd.read_csv(HERE / "curve.csv")
    # columns that the table does not have
    table["mu_smooth"] = table["mu"] / table["mu_ratio"]
    for name in ("mu_ratio_spread", "mu_ratio_model_error", "mu_ratio_ehl_error", "theta_2"):
        table[name] = float("nan")
    for name in ("h_min_rough_error_m", "h_min_rough_ehl_error_m", "contact_area_share_error"):
        table[name] = float("nan")
    curve = Curve("", "contact.mean_velocity", table, absolute=True)
    return draw_stribeck([curve], "surface of Table 1 without wavelengths below 30 um, 20 N")


def main() -> None:
    """Run the command of the arguments."""
    if sys.argv[1:] == ["picture"]:
        style.save(draw(), HERE / "curve.png", style.DPI)
        return
    if len(sys.argv) == 2:
        with (Path(sys.argv[1]) / "stribeck.csv").open(encoding="utf-8", newline="") as stream:
            made = list(csv.DictReader(stream))
        with (HERE / "curve.csv").open("w", encoding="utf-8", newline="") as stream:
            table = csv.DictWriter(stream, COLUMNS, extrasaction="ignore", lineterminator="\n")
            table.writeheader()
            table.writerows(made)
    print("\n".join(lines()))


if __name__ == "__main__":
    main()
