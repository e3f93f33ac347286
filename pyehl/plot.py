# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of results, and the verb ``pyehl plot``.

Each function returns a figure and draws nothing on a screen. Arrays have their first index along x.
Maps are colour-blind safe; lengths are in mm, films in um, pressures in GPa when scales are given,
else in Hertz units.
"""

from __future__ import annotations

import argparse
import csv
import json
import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from numpy.typing import NDArray
from scipy.ndimage import zoom

from pyehl import amplitude
from pyehl.operating import OperatingPoint
from pyehl.topography import Topography, psd_2d, psd_isotropic

if TYPE_CHECKING:
    from pyehl.predict import Prediction
    from pyehl.results import Result

__all__ = [
    "Scales",
    "add_arguments",
    "axis_unit",
    "centre_lines",
    "edges",
    "execute",
    "film_maps",
    "friction_passage",
    "height_unit",
    "letter",
    "nearest",
    "new_figure",
    "roughness_pair",
    "save",
    "save_prediction",
    "surface_spectrum",
]

Array = NDArray[np.float64]

DPI = 300
# Okabe & Ito: told apart by everybody
BLUE, VERMILLION, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#666666"
SEQUENTIAL, DIVERGING = "viridis", "PuOr_r"

# Light and lubricant of the pseudo-interferogram: red laser line, mineral oil
LIGHT = 633e-9
REFRACTIVE_INDEX = 1.5
COHERENT_FRINGES = 8.0
# Half side of the film maps [a]
VIEW = 1.3


@dataclass(frozen=True, slots=True)
class Scales:
    """What turns Hertz units into SI: a [m], p_h [Pa], a^2/R [m]."""

    radius: float
    pressure: float
    film: float


def new_figure(width: float, height: float) -> Figure:
    """Make an empty figure of a size in inches, laid out by itself."""
    return Figure(figsize=(width, height), layout="constrained")


def save(figure: Figure, path: str | Path, dpi: int = DPI) -> Path:
    """Write a figure as PNG (or what the suffix says) at `dpi` dots per inch; returns the path."""
    path = Path(path)
    figure.savefig(path, dpi=dpi)
    return path


def letter(axes: Sequence[Axes]) -> None:
    """Mark several axes (a), (b), ...."""
    if len(axes) > 1:
        for mark, ax in zip("abcdef", axes, strict=False):
            ax.set_title(f"({mark})", loc="left", fontsize="medium")


def axis_unit(scales: Scales | None, name: str) -> tuple[float, str]:
    """Factor from Hertz radii to the unit of an axis, and its label."""
    if scales is None:
        return 1.0, f"${name.upper()} = {name}/a$"
    return scales.radius * 1e3, f"${name}$ [mm]"


def edges(centres: NDArray[np.floating[Any]]) -> tuple[float, float]:
    """Outer edges of the first and the last pixel around equally spaced centres."""
    half = 0.5 * (centres[1] - centres[0])
    return float(centres[0] - half), float(centres[-1] + half)


def nearest(values: Array, target: float) -> int:
    """Index of the value nearest to a target."""
    return int(np.argmin(np.abs(values - target)))


def centre_lines(
    x: Array, y: Array, pressure: Array, film: Array, scales: Scales | None = None
) -> Figure:
    """Pressure and film on the centre lines y = 0 and x = 0, with the Hertz ellipse.

    Parameters
    ----------
    x, y
        (nx,), (ny,) in Hertz radii.
    pressure, film
        P and H, (nx, ny), in Hertz units.
    scales
        For SI units; None for Hertz units.
    """
    figure = new_figure(7.2, 3.3)
    unit_p = 1.0 if scales is None else scales.pressure * 1e-9
    unit_h = 1.0 if scales is None else scales.film * 1e6
    label_p = r"$P = p/p_h$" if scales is None else r"$p$ [GPa]"
    label_h = r"$H = hR/a^2$" if scales is None else r"$h$ [$\mu$m]"
    i0, j0 = nearest(x, 0.0), nearest(y, 0.0)
    central = float(film[i0, j0]) * unit_h
    p_top = 1.08 * max(unit_p, float(pressure.max()) * unit_p)
    axes = list(figure.subplots(1, 2, sharey=True))
    twins: list[Axes] = []
    for ax, along, name, p, h in (
        (axes[0], x, "x", pressure[:, j0], film[:, j0]),
        (axes[1], y, "y", pressure[i0, :], film[i0, :]),
    ):
        unit, label = axis_unit(scales, name)
        hertz = np.linspace(-1.0, 1.0, 401)
        (dashed,) = ax.plot(
            hertz * unit, np.sqrt(1.0 - hertz**2) * unit_p, "--", color=GREY, lw=0.9, label="Hertz"
        )
        (solid,) = ax.plot(along * unit, p * unit_p, color=BLUE, lw=1.4, label="pressure")
        twin = ax.twinx()
        (thick,) = twin.plot(along * unit, h * unit_h, color=VERMILLION, lw=1.4, label="film")
        twin.set_ylim(0.0, 5.0 * central)
        twin.tick_params(axis="y", colors=VERMILLION)
        twins.append(twin)
        ax.set_xlim(along[0] * unit, along[-1] * unit)
        ax.set_ylim(0.0, p_top)
        ax.set_xlabel(label)
        ax.tick_params(axis="y", colors=BLUE)
        if name == "y":
            figure.legend(handles=[solid, dashed, thick], loc="outside lower center", ncols=3)
    axes[0].set_ylabel(label_p, color=BLUE)
    twins[1].set_ylabel(label_h, color=VERMILLION)
    twins[0].set_yticklabels([])
    letter(axes)
    return figure


def _round_step(value: float) -> float:
    """Return the 1, 2 or 5 times a power of ten nearest below a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    return max(step for step in (1.0, 2.0, 5.0) if step * power <= value * (1 + 1e-12)) * power


def film_maps(x: Array, y: Array, film: Array, scales: Scales | None = None) -> Figure:
    """Draw the film as a pseudo-interferogram and as contours.

    Parameters
    ----------
    x, y
        (nx,), (ny,) in Hertz radii.
    film
        H (nx, ny) in Hertz units.
    scales
        For SI units; the interferogram is then that of red light (633 nm) in oil, else its fringe
        is a round share of the central film.

    Raises
    ------
    ValueError
        If the film at the centre is not a positive number.
    """
    figure = new_figure(7.2, 3.3)
    axes = list(figure.subplots(1, 2, sharey=True))
    unit_x, label_x = axis_unit(scales, "x")
    _, label_y = axis_unit(scales, "y")
    unit = 1.0 if scales is None else scales.film * 1e6
    h = film * unit
    central = float(h[nearest(x, 0.0), nearest(y, 0.0)])
    if not (math.isfinite(central) and central > 0.0):
        raise ValueError(f"the film at the centre is {central:.4g}: no map of it can be drawn")
    if scales is None:
        fringe = _round_step(0.5 * central)
        caption = f"fringe $\\Delta H$ = {fringe:g}"
    else:
        fringe = 1e6 * LIGHT / (2.0 * REFRACTIVE_INDEX)
        caption = f"fringe {fringe:.3f} $\\mu$m ({LIGHT * 1e9:.0f} nm, n = {REFRACTIVE_INDEX:g})"
    inner_x, inner_y = np.abs(x) <= VIEW, np.abs(y) <= VIEW
    view = h[np.ix_(inner_x, inner_y)]
    factor = max(1, math.ceil(1200 / max(view.shape)))
    fine = zoom(view, factor, order=1, grid_mode=True, mode="nearest")
    extent = (
        *(v * unit_x for v in edges(x[inner_x])),
        *(v * unit_x for v in edges(y[inner_y])),
    )
    # Dark where the paths differ by whole wavelengths: the reflection at one face turns the
    # phase. Contrast fades with the film as under filtered light, before the screen aliases.
    contrast = np.exp(-((fine / (COHERENT_FRINGES * fringe)) ** 2))
    intensity = 0.5 * (1.0 - contrast * np.cos(2.0 * np.pi * fine / fringe))
    axes[0].imshow(
        intensity.T, origin="lower", extent=extent, cmap="gray", vmin=0.0, vmax=1.0,
        interpolation="antialiased",
    )  # fmt: skip
    axes[0].set_xlabel(label_x)
    axes[0].set_ylabel(label_y)
    axes[0].text(
        0.03, 0.03, caption, transform=axes[0].transAxes, fontsize="small",
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 2.0},
    )  # fmt: skip

    least = float(h.min())
    step = _round_step(max((central - least) / 4.0, central / 20.0))
    first = step * math.floor(least / step)
    levels = np.arange(first, 1.6 * central + 0.5 * step, step)
    # what is thicker is the gap around the contact: left white
    shades = colormaps[SEQUENTIAL].with_extremes(over="white")
    filled = axes[1].contourf(x * unit_x, y * unit_x, h.T, levels=levels, cmap=shades, extend="max")
    axes[1].contour(
        x * unit_x, y * unit_x, h.T, levels=levels, colors="black", linewidths=0.3, alpha=0.6
    )
    bar = figure.colorbar(filled, ax=axes[1], shrink=0.9)
    bar.set_label(r"$H = hR/a^2$" if scales is None else r"$h$ [$\mu$m]")
    axes[1].set_xlabel(label_x)
    for ax in axes:
        ax.add_patch(Circle((0.0, 0.0), unit_x, fill=False, ls="--", lw=0.9, ec=VERMILLION))
        ax.set_aspect("equal")
        ax.set_xlim(max(x[0], -VIEW) * unit_x, min(x[-1], VIEW) * unit_x)
        ax.set_ylim(max(y[0], -VIEW) * unit_x, min(y[-1], VIEW) * unit_x)
        if scales is None:
            ax.set_xticks([-1.0, -0.5, 0.0, 0.5, 1.0])
            ax.set_yticks([-1.0, -0.5, 0.0, 0.5, 1.0])
    letter(axes)
    return figure


def height_unit(largest: float) -> tuple[float, str]:
    """Factor from metres to the unit for heights up to `largest`, and its name."""
    return (1e9, "nm") if largest < 5e-7 else (1e6, r"$\mu$m")


def surface_spectrum(
    topography: Topography,
    hertz_radius: float,
    moes_m: float,
    moes_l: float,
    convention: str = "components",
) -> Figure:
    """Draw a rough surface, its two-dimensional and its radially averaged spectrum with A_d/A_i.

    Parameters
    ----------
    topography
        The tile.
    hertz_radius
        a [m].
    moes_m, moes_l
        Conditions at which A_d/A_i is drawn.
    convention
        Wavelength convention of A_d/A_i, see :mod:`pyehl.amplitude`; drawn for waves along x.
    """
    figure = new_figure(10.2, 2.9)
    axes = list(figure.subplots(1, 3))
    axes[2].set_box_aspect(1.0)
    z = topography.heights
    unit, name = height_unit(float(np.abs(z).max()))
    top = float(np.abs(z).max()) * unit
    extent = (0.0, topography.length_x * 1e3, 0.0, topography.length_y * 1e3)
    image = axes[0].imshow(
        z.T * unit, origin="lower", extent=extent, cmap=DIVERGING, vmin=-top, vmax=top
    )
    figure.colorbar(image, ax=axes[0], fraction=0.046).set_label(f"height [{name}]")
    axes[0].set_xlabel("$x$ [mm]")
    axes[0].set_ylabel("$y$ [mm]")

    qx, qy, c2d = psd_2d(topography)
    q, c_iso = psd_isotropic(topography)
    least = float(c2d.max()) * 1e-10
    filled = np.maximum(c2d, least)
    spectrum_extent = (*(v * 1e-6 for v in edges(qx)), *(v * 1e-6 for v in edges(qy)))
    image = axes[1].imshow(
        filled.T, origin="lower", extent=spectrum_extent, cmap=SEQUENTIAL,
        norm=LogNorm(vmin=least, vmax=float(c2d.max())),
    )  # fmt: skip
    figure.colorbar(image, ax=axes[1], fraction=0.046).set_label(r"$C^{2D}$ [m$^4$]")
    axes[1].set_xlabel(r"$q_x$ [rad/$\mu$m]")
    axes[1].set_ylabel(r"$q_y$ [rad/$\mu$m]")

    shown = c_iso > least
    axes[2].loglog(q[shown], c_iso[shown], "o", ms=2.5, color=BLUE, label=r"$C^{iso}$")
    axes[2].set_xlabel(r"$|q|$ [rad/m]")
    axes[2].set_ylabel(r"$C^{iso}$ [m$^4$]", color=BLUE)
    axes[2].tick_params(axis="y", colors=BLUE)
    twin = axes[2].twinx()
    line = np.geomspace(q[0], q[-1], 200) if q.size > 1 else q
    ratio = amplitude.component_amplitude_ratio(
        line, 0.0, hertz_radius, moes_m, moes_l, convention=convention
    )
    twin.set_box_aspect(1.0)
    twin.plot(line, ratio, color=VERMILLION, lw=1.4)
    twin.set_ylim(0.0, 1.02)
    twin.set_ylabel(r"$A_d/A_i$", color=VERMILLION)
    twin.tick_params(axis="y", colors=VERMILLION)
    letter(axes)
    return figure


def roughness_pair(
    topography: Topography,
    deformed: Array,
    hertz_radius: float,
    *,
    labels: tuple[str, str] = ("undeformed", "deformed"),
) -> Figure:
    """Two roughness maps inside the Hertz circle, on one scale.

    Parameters
    ----------
    topography
        The undeformed tile; repeated over the contact, its pixel [0, 0] at the centre.
    deformed
        Deformed roughness of the same shape [m].
    hertz_radius
        a [m].
    labels
        What the two are called.
    """
    nx, ny = topography.shape
    px, py = topography.pixel
    half_x, half_y = int(hertz_radius / px), int(hertz_radius / py)
    i, j = np.arange(-half_x, half_x + 1), np.arange(-half_y, half_y + 1)
    inside = (i * px / hertz_radius)[:, None] ** 2 + (j * py / hertz_radius)[None, :] ** 2 <= 1.0
    at = np.ix_(i % nx, j % ny)
    top = float(np.abs(topography.heights[at][inside]).max())
    unit, name = height_unit(top)
    figure = new_figure(7.0, 3.1)
    axes = list(figure.subplots(1, 2, sharey=True))
    extent = (*edges(i * (px / hertz_radius)), *edges(j * (py / hertz_radius)))
    image = None
    for ax, z, label in zip(axes, (topography.heights, deformed), labels, strict=True):
        shown = np.where(inside, z[at], np.nan) * unit
        image = ax.imshow(
            shown.T, origin="lower", extent=extent, cmap=DIVERGING,
            vmin=-top * unit, vmax=top * unit,
        )  # fmt: skip
        ax.add_patch(Circle((0.0, 0.0), 1.0, fill=False, lw=0.8, ec=GREY))
        rms = float(np.std(z[at][inside])) * unit
        ax.set_title(f"{label}, rms {rms:.3g} {name}", fontsize="medium")
        ax.set_xlabel("$x/a$")
        ax.set_xlim(-1.05, 1.05)
        ax.set_ylim(-1.05, 1.05)
        ax.set_xticks([-1.0, -0.5, 0.0, 0.5, 1.0])
        ax.set_yticks([-1.0, -0.5, 0.0, 0.5, 1.0])
    axes[0].set_ylabel("$y/a$")
    if image is not None:
        figure.colorbar(image, ax=axes, shrink=0.9).set_label(f"height [{name}]")
    letter(axes)
    return figure


def friction_passage(
    shift: Array,
    ratio: Array,
    length: float,
    bands: Sequence[tuple[float, float, float]] = (),
) -> Figure:
    """mu_r/mu_s over one passage of the tile, and what each octave of wavelengths adds.

    Parameters
    ----------
    shift, ratio
        (n,) displacement of the tile [m], equally spaced from 0, and mu_r/mu_s there [-].
    length
        Of the tile along x [m].
    bands
        Longest and shortest wavelength [m] and rise [-] of each octave; empty: not drawn.
    """
    figure = new_figure(7.2 if bands else 3.8, 2.9)
    axes = list(figure.subplots(1, 2 if bands else 1, squeeze=False)[0])
    ax = axes[0]
    n = ratio.size
    half = np.fft.rfft(ratio)
    if n % 2 == 0:
        half[-1] *= 0.5
    fine = np.fft.irfft(half, 16 * n) * 16.0
    at = np.arange(16 * n + 1) * length / (16 * n)
    mean = float(ratio.mean())
    ax.plot(at * 1e3, np.append(fine, fine[0]), color=BLUE, lw=1.4)
    ax.plot(shift * 1e3, ratio, "o", ms=3.0, color=BLUE)
    ax.axhline(mean, color=VERMILLION, lw=1.0, ls="--", label=f"mean {mean:.3f}")
    ax.axhline(1.0, color=GREY, lw=0.8, ls=":", label="smooth")
    ax.set_xlim(0.0, length * 1e3)
    ax.set_xlabel("displacement of the surface [mm]")
    ax.set_ylabel(r"$\mu_r/\mu_s$")
    ax.legend(loc="best", fontsize="small")
    if bands:
        right = axes[1]
        for longest, shortest, rise in bands:
            if math.isfinite(rise):
                right.fill_between(
                    [shortest * 1e6, longest * 1e6], 0.0, [rise, rise], color=BLUE, alpha=0.75,
                    lw=0.8, ec="white",
                )  # fmt: skip
        right.axhline(0.0, color=GREY, lw=0.8)
        right.set_xscale("log")
        right.set_xlabel(r"wavelength of the component [$\mu$m]")
        right.set_ylabel(r"contribution to $\mu_r/\mu_s - 1$")
    letter(axes)
    return figure


def save_prediction(prediction: Prediction, folder: Path) -> list[Path]:
    """Write the pictures of a prediction into a folder; returns their paths."""
    f, o = prediction.friction, prediction.operating
    bands = [(b.longest, b.shortest, b.rise) for b in prediction.bands]
    return _save_prediction(
        folder,
        prediction.surface,
        f.response.deformed,
        (o.hertz_radius, o.moes_m, o.moes_l, prediction.options.wavelength_convention),
        (f.shift, f.passage, bands) if f.status == "predicted" else None,
    )


def _save_prediction(
    folder: Path,
    surface: Topography,
    deformed: Array,
    conditions: tuple[float, float, float, str],
    passage: tuple[Array, Array, Sequence[tuple[float, float, float]]] | None,
    dpi: int = DPI,
) -> list[Path]:
    written = [
        save(surface_spectrum(surface, *conditions), folder / "surface_spectrum.png", dpi),
        save(roughness_pair(surface, deformed, conditions[0]), folder / "roughness.png", dpi),
    ]
    if passage is not None:
        shift, ratio, bands = passage
        figure = friction_passage(shift, ratio, surface.length_x, bands)
        written.append(save(figure, folder / "passage.png", dpi))
    return written


def _columns(path: Path) -> dict[str, Array]:
    with path.open(newline="", encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    table = np.array(rows[1:], dtype=float).reshape(len(rows) - 1, len(rows[0]))
    return {name: table[:, k] for k, name in enumerate(rows[0])}


def _plot_prediction(folder: Path, summary: dict[str, Any], target: Path, dpi: int) -> list[Path]:
    surface = Topography(
        np.load(folder / "surface.npy", allow_pickle=False),
        float(summary["length_x"]),
        float(summary["length_y"]),
        str(summary["surface"]),
    )
    deformed = np.load(folder / "deformed.npy", allow_pickle=False)
    passage = None
    if summary["status"] == "predicted":
        along, bands = _columns(folder / "passage.csv"), _columns(folder / "bands.csv")
        octaves = zip(bands["longest"], bands["shortest"], bands["rise"], strict=True)
        passage = (
            along["shift_m"],
            along["mu_ratio"],
            [(float(a), float(b), float(c)) for a, b, c in octaves],
        )
    conditions = (
        float(summary["hertz_radius"]),
        float(summary["moes_m"]),
        float(summary["moes_l"]),
        str(summary["wavelength_convention"]),
    )
    return _save_prediction(target, surface, deformed, conditions, passage, dpi)


def _plot_run(folder: Path, target: Path, units: str, dpi: int) -> list[Path]:
    from pyehl import results  # noqa: PLC0415

    run = results.read(folder)
    operating = OperatingPoint.from_settings(run.case)
    scales = None
    if units == "si" or (units == "auto" and operating.si):
        scales = Scales(operating.hertz_radius, operating.hertz_pressure, operating.film_scale)
    x, y, pressure, film = (run[name] for name in "XYPH")
    written = [
        save(centre_lines(x, y, pressure, film, scales), target / "centre_lines.png", dpi),
        save(film_maps(x, y, film, scales), target / "film.png", dpi),
    ]
    if "A_d" in run.variables:
        written += _plot_march(run, target, scales, dpi, operating.time_scale if scales else 0.0)
    return written


def _plot_march(
    run: Result, target: Path, scales: Scales | None, dpi: int, seconds: float
) -> list[Path]:
    from pyehl import plot_march  # noqa: PLC0415 (it imports this module)

    x, y = run["X"], run["Y"]
    pair = plot_march.deformed_roughness(x, y, run["RR"], run["A_d"], scales)
    lines = plot_march.rough_and_smooth(
        x, y, (run["P"], run["P_smooth"]), (run["H"], run["H_smooth"]), scales
    )
    written = [
        save(pair, target / "deformed_roughness.png", dpi),
        save(lines, target / "rough_and_smooth.png", dpi),
    ]
    time = run["history_T"]
    if time.size > 1:
        figure = plot_march.friction_history(
            time,
            run["history_mu_ratio"],
            period=float(run.summary["T_period"]),
            mean=run.summary["mu_ratio"],
            formula=plot_march.eq_16(run),
            seconds=seconds,
        )
        written.append(save(figure, target / "friction.png", dpi))
    return written


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of ``pyehl plot``."""
    parser.add_argument("folder", type=Path, help="result folder of pyehl run or predict")
    parser.add_argument("-o", "--output", type=Path, help="where the PNG go (default: the folder)")
    parser.add_argument(
        "--units",
        choices=("auto", "si", "hertz"),
        default="auto",
        help="of the EHL fields (default: SI when the case was given in SI)",
    )
    parser.add_argument("--dpi", type=int, default=DPI, help=f"dots per inch (default: {DPI})")


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl plot``; 0 when drawn, 2 when there is nothing to draw."""
    folder: Path = args.folder
    try:
        if not (folder / "summary.json").is_file():
            raise ValueError(f"{folder}: no result folder, it has no summary.json")
        if not 10 <= args.dpi <= 2400:
            raise ValueError(f"--dpi {args.dpi}: 10 ... 2400 dots per inch were expected")
        target: Path = args.output or folder
        target.mkdir(parents=True, exist_ok=True)
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        if summary.get("kind") == "prediction":
            written = _plot_prediction(folder, summary, target, args.dpi)
        else:
            written = _plot_run(folder, target, args.units, args.dpi)
    except (ValueError, KeyError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    for path in written:
        print(path)
    return 0
