# SPDX-License-Identifier: BSD-3-Clause
"""A dimple in a point contact, compared with a measurement and a simulation: python make.py.

Runs four cases (a few minutes on one processor), writes profiles.csv, table.csv, measured.png and
simulated.png beside this file, and prints the tables of docs/validation.md. `python make.py show`
makes table and pictures from the stored profiles; `python make.py NAME` runs the measured cases
with changes of VARIANTS, and writes NAME.csv.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import pyehl
from pyehl.plots.style import BLUE, PAGE, VERMILLION, band, new_figure, save, styled

HERE = Path(__file__).resolve().parent
CASE = HERE / "dimple.nml"
Array = NDArray[np.float64]
Key = tuple[str, str, int]
"""Measured or simulated, slide-to-roll ratio as in the paper, instant."""

# Radius and depth of the dimple [m] by slide-to-roll ratio (u1 - u2)/(u1 + u2), u1 that of the ball
RADIUS = {"0": 15.5e-6, "-0.5": 21.5e-6}
DEPTH = {
    ("measured", "0"): 7e-6,
    ("measured", "-0.5"): 1.3e-6,
    ("simulated", "0"): 175e-9,
    ("simulated", "-0.5"): 160e-9,
}
PIXEL = 1e-6
# In Hertz radii: length of the tile, and distance of the dimple from the front of the tile
TILE = 6.0
FROM_FRONT = 0.5
# Last position of the centre of the dimple, with a margin
END = 0.95
FRAMES = 0.03
SATURATION = 340.0
"""Range of the interferometer [nm]: measured values beyond it are lower bounds."""
# In micrometres: half the flat part of the contact, half the contact with the outlet constriction,
# length of the strips beside the dimple, and their distance from its edge
PLATEAU, CONTACT, STRIP, DISTANCE = 110.0, 145.0, 60.0, 8.0
# Changes of the measured cases by slide-to-roll ratio: keywords of `films`
VARIANTS: dict[str, dict[str, dict[str, Any]]] = {
    "fine": {"0": {"points": 513}, "-0.5": {"points": 513}},
    "depth": {"0": {"depth": 1.3e-6}, "-0.5": {"depth": 0.8e-6}},
}
COLUMNS = ("source", "ssr", "instant", "centre_um", "quantity", "theirs_nm", "pyehl_nm")


def read_profiles(path: Path) -> dict[Key, Array]:
    """Read profiles on the centre line: x [um] and film [nm] in columns."""
    result: dict[Key, list[tuple[float, float]]] = {}
    with path.open(encoding="utf-8", newline="") as stream:
        for row in csv.DictReader(stream):
            key = row["source"], row["ssr"], int(row["instant"])
            result.setdefault(key, []).append((float(row["x_um"]), float(row["h_nm"])))
    return {key: np.array(values).T for key, values in result.items()}


def centre(key: Key, profile: Array) -> float:
    """Middle between the walls of the dimple [um]; NaN if it is not in the contact."""
    source, ssr, instant = key
    if (ssr, instant) == ("0", 1):
        return np.nan
    x = np.linspace(-CONTACT, CONTACT, 1161)
    h = np.interp(x, *profile)
    peak = int(np.argmax(np.where(np.abs(x) < 130.0, h, 0.0)))
    below = np.flatnonzero(h <= (SATURATION if source == "measured" else h[peak] - 10.0))
    after = int(np.searchsorted(below, peak))
    return float(x[below[after - 1]] + x[below[after]]) / 2.0


def dimple(radius: float, depth: float, length: float) -> pyehl.Topography:
    """Make a tile with a dimple: cosine times Gaussian up to the first zero, no rim."""
    count = round(length / PIXEL)
    place = (np.arange(count) - count // 2) * PIXEL
    t = np.hypot(place[:, None], place[None]) / (1.2 * radius)
    heights = np.where(t < 1.0, -depth * np.cos(0.5 * np.pi * t) * np.exp(-2.0 * t**2), 0.0)
    shift = round(FROM_FRONT / TILE * count)
    return pyehl.Topography(
        np.roll(heights, (-shift - count // 2, -(count // 2)), (0, 1)),
        size=(count * PIXEL, count * PIXEL),
    )


def films(
    source: str,
    ssr: str,
    centres: Sequence[float],
    points: int = 257,
    depth: float = 0.0,
) -> list[tuple[Array, Array]]:
    """Films [nm] over x [um] on the centre line with the dimple at each centre; NaN: without it."""
    slip = 2.0 * float(ssr)
    smooth = pyehl.solve(CASE, f"grid.points={points}")
    a = float(smooth.hertz_radius_m)
    velocity = 1.0 + 0.5 * slip
    start = float(smooth.X[0])
    steps = round((END - start + FROM_FRONT) / velocity / float(smooth.x_mesh))
    ds = pyehl.solve(
        CASE,
        f"grid.points={points}",
        f"contact.slide_to_roll={slip}",
        f"time.steps={steps}",
        "time.estimate_error=.false.",
        # fewer frames on a finer grid, to save memory
        f"output.frame_interval={FRAMES * (points - 1) / 256.0}",
        surface=dimple(RADIUS[ssr], depth or DEPTH[source, ssr], TILE * a),
        # the mean friction of a single passage does not settle
        check=False,
    )
    assert ds.attrs["status"] in ("converged", "not settled"), ds.attrs["status"]
    line = int(np.argmin(np.abs(ds.Y.values)))
    x = 1e6 * a * ds.X.values
    result = []
    for place in centres:
        if np.isnan(place):
            film = smooth.H.values[:, line]
        else:
            time = (place * 1e-6 / a - start + FROM_FRONT) / velocity
            film = ds.frame_H.values[:, line, int(np.argmin(np.abs(ds["T"].values - time)))]
        result.append((x, 1e9 * float(ds.film_scale_m) * film))
    return result


def mean(profile: Array, low: float, high: float) -> float:
    """Mean film between two positions."""
    x = np.linspace(low, high, 201)
    return float(np.interp(x, *profile).mean())


def compare(key: Key, theirs: Array, ours: Array) -> Iterator[tuple[str, float, float]]:
    """Give quantity, theirs and ours [nm] at an instant."""
    source, ssr, _ = key
    place, radius = centre(key, theirs), 1e6 * RADIUS[ssr]
    inside = [profile[1, np.abs(profile[0]) <= CONTACT] for profile in (theirs, ours)]
    yield "minimum", float(inside[0].min()), float(inside[1].min())
    if not place + radius > PLATEAU:
        ends = [p[1, (p[0] > PLATEAU) & (p[0] <= CONTACT)] for p in (theirs, ours)]
        yield "outlet", float(ends[0].min()), float(ends[1].min())
    if np.isnan(place):
        yield "plateau", mean(theirs, -PLATEAU, PLATEAU), mean(ours, -PLATEAU, PLATEAU)
        return
    for name, side in (("behind", -1.0), ("ahead", 1.0)):
        near, far = (place + side * (radius + d) for d in (DISTANCE, DISTANCE + STRIP))
        low, high = np.clip((min(near, far), max(near, far)), -PLATEAU, PLATEAU)
        if high - low > STRIP / 4.0:
            yield name, mean(theirs, low, high), mean(ours, low, high)
    if source == "simulated":
        at = [profile[1, np.abs(profile[0] - place) < radius] for profile in (theirs, ours)]
        yield "dimple", float(at[0].max()), float(at[1].max())


def write(path: Path, head: Iterable[str], rows: Iterable[Iterable[object]]) -> None:
    """Write a table."""
    with path.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(head)
        writer.writerows(rows)


def simulate(data: dict[Key, Array]) -> None:
    """Run the four cases, and write profiles.csv."""
    rows: list[tuple[object, ...]] = []
    for source, ssr in DEPTH:
        keys = [key for key in data if key[:2] == (source, ssr)]
        places = [centre(key, data[key]) for key in keys]
        for key, (x, film) in zip(keys, films(source, ssr, places), strict=True):
            rows += [
                (*key, f"{at:.3f}", f"{h:.2f}")
                for at, h in zip(x, film, strict=True)
                if abs(at) < 170.0
            ]
    write(HERE / "profiles.csv", ("source", "ssr", "instant", "x_um", "h_nm"), rows)


def table(data: dict[Key, Array], result: dict[Key, Array]) -> list[tuple[str, ...]]:
    """Rows of table.csv."""
    return [
        (
            *map(str, key),
            "" if np.isnan(place := centre(key, data[key])) else f"{place:.0f}",
            name,
            f"{theirs:.0f}",
            f"{ours:.0f}",
        )
        for key in data
        for name, theirs, ours in compare(key, data[key], result[key])
    ]


def vary(name: str, data: dict[Key, Array], result: dict[Key, Array]) -> None:
    """Run the measured cases with a change of VARIANTS, and write its table."""
    rows: list[tuple[object, ...]] = []
    for ssr, more in VARIANTS[name].items():
        keys = [key for key in data if key[:2] == ("measured", ssr)]
        places = [centre(key, data[key]) for key in keys]
        for key, film in zip(keys, films("measured", ssr, places, **more), strict=True):
            before = [(what, ours) for what, _, ours in compare(key, data[key], result[key])]
            after = [ours for _, _, ours in compare(key, data[key], np.array(film))]
            for (what, ours), other in zip(before, after, strict=True):
                rows.append((*key[1:], what, f"{ours:.0f}", f"{other:.0f}"))
    write(HERE / f"{name}.csv", ("ssr", "instant", "quantity", "stored_nm", "changed_nm"), rows)


def repeated(data: dict[Key, Array], ssr: str = "0") -> float:
    """Half the range [nm] of the outlet film, which should be the same at all instants.

    In pure rolling it is measured four times while the dimple is elsewhere.
    """
    keys = [("measured", ssr, instant) for instant in range(1, 5)]
    result = [
        theirs
        for key in keys
        for what, theirs, _ in compare(key, data[key], data[key])
        if what == "outlet"
    ]
    return 0.5 * (max(result) - min(result))


@styled()
def draw(source: str, data: dict[Key, Array], result: dict[Key, Array]) -> None:
    """Draw the profiles of all instants; measured ones with their repeatability."""
    figure = new_figure(PAGE, 3.4)
    axes = figure.subplots(2, 5, sharex=True, sharey=True)
    for line, ssr in zip(axes, RADIUS, strict=True):
        for instant, ax in enumerate(line, 1):
            key = source, ssr, instant
            place, film = data[key]
            if source == "measured":
                error = np.full(film.shape, repeated(data))
                band(ax, place, film, error, color=VERMILLION, alpha=0.3, label="repeatability")
            ax.plot(place, film, "o-", ms=1.5, lw=0.6, color=VERMILLION, label=source)
            ax.plot(*result[key], lw=1.0, color=BLUE, label="pyehl")
            ax.grid(visible=True)
        line[0].set_ylabel(f"film [nm], SRR {ssr}".replace("-", "−"))
    for instant, ax in enumerate(axes[0], 1):
        ax.set_title(f"instant {instant}")
    axes[0, 0].set(xlim=(-160.0, 165.0), ylim=(100.0, 430.0))
    for ax in axes[-1]:
        ax.set_xlabel(r"$x$ [µm]")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    save(figure, HERE / f"{source}.png")


def lines(rows: Iterable[Sequence[str]], source: str) -> Iterator[str]:
    """Make the table of docs/validation.md: a row for each instant, theirs before ours."""
    names = ["minimum", "outlet", "plateau", "behind", "ahead"]
    names += ["dimple"] if source == "simulated" else []
    yield "| slide-to-roll ratio | instant | dimple at [µm] | " + " | ".join(names) + " |"
    yield "|---" * (3 + len(names)) + "|"
    result: dict[Sequence[str], dict[str, str]] = {}
    for kind, ssr, instant, place, name, theirs, ours in rows:
        if kind == source:
            result.setdefault((ssr, instant, place), {})[name] = f"{theirs}, {ours}"
    for head, films in result.items():
        cells = [*head, *(films.get(name, "") for name in names)]
        yield "| " + " | ".join(cells).replace("-", "−") + " |"


def main(arguments: Sequence[str]) -> None:
    """Run the cases, or variants, or use stored profiles; write and print."""
    data = read_profiles(HERE / "mourier.csv")
    if not arguments:
        simulate(data)
    result = read_profiles(HERE / "profiles.csv")
    for name in VARIANTS:
        if list(arguments) == [name]:
            vary(name, data, result)
    rows = table(data, result)
    write(HERE / "table.csv", COLUMNS, rows)
    for source in ("measured", "simulated"):
        draw(source, data, result)
        sys.stdout.write("\n".join(lines(rows, source)) + "\n\n")


if __name__ == "__main__":
    main(sys.argv[1:])
