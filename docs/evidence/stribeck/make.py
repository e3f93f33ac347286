# SPDX-License-Identifier: BSD-3-Clause
"""Rewrite curves.csv and stribeck.png: python docs/evidence/stribeck/make.py FOLDER.

About two minutes on one core. The folder gets a study for each surface and shear law, which a
second run continues.
"""

from __future__ import annotations

import csv
import io
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import pyehl
from pyehl.cli import main as command
from pyehl.plots.style import (
    BLUE,
    GREEN,
    PAGE,
    VERMILLION,
    label_log_ticks,
    letter,
    new_figure,
    save,
    styled,
)
from pyehl.surfaces import filtered

HERE = Path(__file__).resolve().parent
CASE = HERE.parents[2] / "cases" / "table1.nml"
CURVES = HERE / "curves.csv"

SHORT = 52e-6
"""Limit of the short waves [m]: an eighth of the Hertz radius."""
FACTOR = 10.0
SPEEDS = "0.25:8:10log"
SLIPS = (0.02, 0.1, 0.3)
SURFACES = ("smooth", "table 1", "short waves x 10")
# The third one has no friction with the Newtonian oil: film breakdown, or no prediction
NAMES = ("smooth", "surface of Table 1", "short waves × 10")
LAWS = ("eyring", "newtonian")
COLUMNS = (
    "h_c_m h_min_m h_min_rough_m lambda_ratio lambda_ratio_deformed theta_2 hersey mu_smooth mu "
    "mu_isothermal mu_ratio mu_ratio_model_error status"
).split()
KEYS = ("contact.mean_velocity", "contact.slide_to_roll")


def options_of(surface: str, folder: Path) -> list[str]:
    """Options of a surface; writes the map of that with its short waves times FACTOR."""
    if surface == "smooth":
        return ["surface.kind=smooth"]
    if surface == "table 1":
        return []
    tile = pyehl.predict(CASE).surface
    long = filtered(tile, SHORT).heights
    path = folder / "short_waves.npy"
    np.save(path, long + FACTOR * (tile.heights - long))
    lengths = [f"surface.length_{axis}={tile.length_x!r}" for axis in "xy"]
    return ["surface.kind=map", f"surface.file={path}", *lengths]


def curve(
    surface: str, law: str, folder: Path, speeds: str = SPEEDS, slips: tuple[float, ...] = SLIPS
) -> list[dict[str, str]]:
    """Run ``pyehl stribeck`` for a surface and a shear law; the rows of its table."""
    place = folder / f"{surface} {law}".replace(" ", "_")
    settings = [*options_of(surface, folder), f"lubricant.shear_law={law}", "grid.points=257"]
    if law != "newtonian":
        # the viscosity decreases by 4 % per kelvin
        settings.append("lubricant.temperature_viscosity=0.04")
    # the curves were made on the domain of the paper
    settings += ["grid.x_inlet=-2.5", "grid.x_outlet=1.5", "grid.y_extent=2.0"]
    words = [word for text in settings for word in ("--set", text)]
    words += ["--speed", speeds, "--slide-to-roll", ",".join(str(s) for s in slips)]
    command(["stribeck", str(CASE), *words, "-o", str(place), "-q"])
    with (place / "stribeck.csv").open(newline="") as stream:
        return list(csv.DictReader(stream))


def stored() -> list[dict[str, str]]:
    """Rows of curves.csv."""
    with CURVES.open(newline="") as stream:
        return list(csv.DictReader(stream))


def rows(
    result: list[dict[str, str]], surface: str, law: str, slip: float
) -> Iterator[dict[str, str]]:
    """Rows of one curve, in the order of speed."""
    for row in result:
        if (row["surface"], row["law"]) == (surface, law) and float(row[KEYS[1]]) == slip:
            yield row


@styled()
def draw(result: list[dict[str, str]], path: Path) -> None:
    """Draw coefficient (Eyring) and ratio (Newtonian) over the speed."""
    figure = new_figure(PAGE, 3.6)
    axes = figure.subplots(1, 2)
    styles = dict(zip(SURFACES, (":", "o-", "s"), strict=True))
    for ax, law, ordinate in zip(axes, LAWS, ("mu", "mu_ratio"), strict=True):
        for surface in SURFACES:
            for slip, colour in zip(SLIPS, (BLUE, VERMILLION, GREEN), strict=True):
                points = [
                    (float(row[KEYS[0]]), float(row[ordinate]))
                    for row in rows(result, surface, law, slip)
                    if row[ordinate]
                ]
                if points:
                    ax.plot(
                        *zip(*points, strict=True),
                        styles[surface],
                        ms=5.0 if styles[surface] == "s" else 2.5,
                        mfc="none",
                        lw=1.1,
                        color=colour,
                        label=f"{NAMES[SURFACES.index(surface)]}, SRR {slip}",
                    )
        ax.set_xscale("log")
        label_log_ticks(ax.xaxis)
        ax.set_xlabel(r"mean velocity $\bar u$ [m/s]")
        ax.grid(visible=True)
    axes[0].set_ylabel(r"$\mu$ (Eyring, 5 MPa, with heat)")
    axes[1].set_ylabel(r"$\mu_r/\mu_s$ (Newtonian)")
    letter(list(axes))
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3)
    save(figure, path)


def main(folder: Path) -> None:
    """Compute all curves, write the table and the picture."""
    folder.mkdir(parents=True, exist_ok=True)
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["surface", "law", *KEYS, *COLUMNS])
    for law in LAWS:
        for surface in SURFACES:
            for row in curve(surface, law, folder):
                writer.writerow([surface, law, *(row.get(name, "") for name in (*KEYS, *COLUMNS))])
    CURVES.write_text(text.getvalue())
    draw(stored(), HERE / "stribeck.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
