# SPDX-License-Identifier: BSD-3-Clause
"""A rough surface and its prediction: heights, spectrum, roughness in the contact, passage.

Each function draws on `ax`, or on a new figure, and returns the axes; arrays have their first
index along x, the direction of motion.
"""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from pyehl.plots import style
from pyehl.plots.outline import Outline
from pyehl.surfaces import Topography, interpolated, psd_2d, psd_isotropic
from pyehl.surfaces.findings import Finding
from pyehl.surfaces.map_steps import nearest
from pyehl.theory.amplitude import component_amplitude_ratio
from pyehl.types import Array

# Minimum spectral density that is drawn, over the maximum
FLOOR = 1e-10
# Maximum number of pixels of a map along each side: more are not visible
PLACES = 1201
C_ISO = r"$C_\mathrm{iso}$ [m⁴]"
RATIO = r"$\mu_r/\mu_s$"
# Powers of ten beyond which an axis has a common factor, to keep its numbers short
SHORT = (-3, 4)
SHOWN = 0.005
"""Fraction of the heights beyond either end of the colour scale, so that spikes do not set it."""


def heights(topography: Topography, *, ax: Axes | None = None) -> Axes:
    """Heights of a tile as a map with a colour bar; peaks positive."""
    ax = style.axes_or_new(ax, 3.6, 3.0)
    z = topography.heights
    unit, name = style.height_unit(float(np.abs(z).max()))
    top = float(np.abs(z).max()) * unit
    scale, length = style.length_unit(max(topography.size))
    extent = (0.0, topography.length_x * scale, 0.0, topography.length_y * scale)
    image = ax.imshow(
        z.T * unit, origin="lower", extent=extent, cmap=style.DIVERGING, vmin=-top, vmax=top
    )
    slender = topography.length_y / topography.length_x
    style.colour_bar(image, ax, f"height [{name}]", slender=slender, above=True)
    style.few_ticks(ax)
    ax.set(xlabel=f"x [{length}]", ylabel=f"y [{length}]")
    return ax


def spectrum_map(topography: Topography, *, ax: Axes | None = None) -> Axes:
    """Two-dimensional spectrum C2D [m^4] of a tile over both wavenumbers."""
    ax = style.axes_or_new(ax, 3.6, 3.0)
    qx, qy, c2d = psd_2d(topography)
    maximum = float(c2d.max())
    extent = style.extent_of(qx, qy, 1e-6)
    image = ax.imshow(
        np.maximum(c2d, FLOOR * maximum).T, origin="lower", extent=extent, cmap=style.SEQUENTIAL,
        norm=LogNorm(vmin=FLOOR * maximum, vmax=maximum),
    )  # fmt: skip
    slender = float(np.ptp(qy) / np.ptp(qx))
    style.colour_bar(image, ax, "C2D [m⁴]", slender=slender, above=True)
    style.few_ticks(ax)
    ax.set(xlabel="q along x [rad/µm]", ylabel="q along y [rad/µm]")
    return ax


def spectrum_line(
    topography: Topography, deformed: Array, flattened: Array, *, ax: Axes | None = None
) -> Axes:
    """Radially averaged spectrum C_iso [m^4] of a tile, and the response of a contact to its waves.

    A second axis has abs(T), the fraction of a wave that remains in the contact, and abs(1 - T),
    the fraction that pressure flattens.

    Parameters
    ----------
    topography
        The tile.
    deformed, flattened
        Deformed roughness and its flattened part [m], of the shape of the tile.
    """
    ax = style.axes_or_new(ax, 3.8, 3.0)
    q, c_iso = psd_isotropic(topography)
    shown = c_iso > FLOOR * float(psd_2d(topography)[2].max())
    ax.loglog(1e-6 * q[shown], c_iso[shown], ".", ms=2.5, color=style.BLUE)
    ax.set_xlabel("|q| [rad/µm]")
    style.y_label(ax, C_ISO, style.BLUE)
    style.label_decades(ax.xaxis, ax.yaxis, max_labels=3)
    twin = ax.twinx()
    for values, line, mark, label in (
        (deformed, "-", "o", "|T|"),
        (flattened, "--", "x", "|1 − T|"),
    ):
        part = Topography(values, topography.size)
        ratio = np.sqrt(psd_isotropic(part)[1][shown] / c_iso[shown])
        # a single wave is a point
        marker = mark if ratio.size == 1 else ""
        twin.plot(
            1e-6 * q[shown], ratio, line, marker=marker, color=style.VERMILLION, lw=1.4, label=label
        )
    style.y_label(twin, "|T|; dashed |1 − T|", style.VERMILLION)
    return ax


def roughness(
    topography: Topography,
    values: Array,
    hertz_radius: float,
    *,
    name: str = "",
    bar: bool = True,
    ellipticity: float = 1.0,
    ax: Axes | None = None,
) -> Axes:
    """Draw a tile inside the Hertz ellipse, on the scale of the undeformed roughness.

    Parameters
    ----------
    topography
        The undeformed tile, repeated over the contact with its pixel [0, 0] at the centre.
    values
        Heights to draw [m], of the same shape: undeformed or deformed.
    hertz_radius
        a [m], for an ellipse the semi-axis along the motion.
    name
        Name of the field in the title, which also gives its rms.
    bar
        Whether it has a colour bar.
    ellipticity
        The other semi-axis over a [-].
    """
    ax = style.axes_or_new(ax, 3.8, 3.1)
    nx, ny = topography.shape
    px, py = topography.pixel
    a, b = hertz_radius, ellipticity * hertz_radius
    # a contact may have more pixels than a picture can show
    strides = [_stride(s / p, n) for s, p, n in ((a, px, nx), (b, py, ny))]
    i, j = (
        stride * np.arange(-int(s / p / stride), int(s / p / stride) + 1)
        for s, p, stride in zip((a, b), (px, py), strides, strict=True)
    )
    if max(strides) > 1:
        name = f"{name} one of {strides[0] * strides[1]} pixels,".strip()
    inside = (i * px / a)[:, None] ** 2 + (j * py / b)[None, :] ** 2 <= 1.0
    at = np.ix_(i % nx, j % ny)
    top = float(np.abs(topography.heights[at][inside]).max())
    unit, label = style.height_unit(top)
    shown = np.where(inside, values[at], np.nan) * unit
    outline, mm = Outline(ellipticity), 1e3
    style.contact_heights(
        shown, i * px * mm, j * py * mm, a * mm, top * unit, label,
        name=name, bar=bar, ax=ax, outline=outline,
    )  # fmt: skip
    style.place_labels(ax, "x [mm]", "y [mm]", outline)
    style.few_ticks(ax)
    return ax


def _stride(half: float, pixels: int) -> int:
    """Stride of the pixels to draw of a tile in a contact, `half` pixels from its centre to end."""
    stride = max(1, math.ceil((2 * int(half) + 1) / PLACES))
    # coprime with the tile, so that repeated tiles show all of their pixels
    while stride > 1 and math.gcd(stride, pixels) > 1:
        stride += 1
    return stride


def passage(
    shift: Array,
    ratio: Array,
    length: float,
    *,
    second: Array | None = None,
    ax: Axes | None = None,
) -> Axes:
    """mu_r/mu_s over one passage of the tile, or over a common period of two.

    Parameters
    ----------
    shift, ratio
        (n,) displacement of the tile [m], equally spaced from 0, and mu_r/mu_s there [-]; NaN where
        it is not known.
    length
        Length of the tile along x [m].
    second
        (n,) displacement of the tile of a second surface [m]. If it is not monotonic, the positions
        are not those of a common period but all relative ones of two tiles, in no order of time.
    """
    ax = style.axes_or_new(ax, 3.8, 2.9)
    known = np.isfinite(ratio)
    scale, unit = style.length_unit(length)
    name = f"displacement of the surface [{unit}]"
    if second is None or bool(np.all(np.diff(second) >= 0.0)):
        length *= round(float(shift[-1]) * (1.0 + 1.0 / max(1, shift.size - 1)) / length) or 1
        if known.all():
            fine = interpolated(ratio, 16)
            at = np.arange(fine.size + 1) * length / fine.size
            ax.plot(at * scale, np.append(fine, fine[0]), color=style.BLUE, lw=1.4)
    ax.plot(shift * scale, ratio, "o", ms=3.0, color=style.BLUE)
    if known.all():
        mean = float(ratio.mean())
        ax.axhline(mean, color=style.VERMILLION, lw=1.0, ls="--", label=f"mean {mean:.3f}")
    if not known.any():
        style.not_known(ax)
        ax.set(xlabel=name, ylabel=RATIO)
        return ax
    ax.axhline(1.0, color=style.GREY, lw=0.8, ls=":", label="smooth")
    ax.set(xlim=(0.0, length * scale), xlabel=name)
    ax.set(ylabel=RATIO)
    ax.ticklabel_format(axis="y", scilimits=SHORT)
    # the letter of the panel is at the left
    ax.yaxis.get_offset_text().set(x=1.0, ha="right")
    ax.legend(loc="best")
    return ax


def octaves(bands: Sequence[tuple[float, float, float]], *, ax: Axes | None = None) -> Axes:
    """Draw the contribution of each octave to mu_r/mu_s, and the increase over the cut-off.

    Parameters
    ----------
    bands
        Longest and shortest wavelength [m] and increase [-] of each octave; NaN if not known.
    """
    ax = style.axes_or_new(ax, 3.8, 2.9)
    ax.set(xlabel="wavelength of the component [μm]", ylabel=f"contribution to {RATIO}")
    known = sorted((band for band in bands if math.isfinite(band[2])), reverse=True)
    if not known:
        style.not_known(ax)
        return ax
    for longest, shortest, increase in known:
        ax.fill_between(
            [shortest * 1e6, longest * 1e6], 0.0, [increase] * 2, color=style.GREEN, alpha=0.75,
            lw=0.8, ec="white",
        )  # fmt: skip
    cut, total = [band[1] * 1e6 for band in known], np.cumsum([band[2] for band in known])
    ax.plot(cut, total, "o-", ms=3, lw=1.2, color=style.BLUE, label="with all longer waves")
    ax.axhline(0.0, color=style.GREY, lw=0.8)
    ax.set_xscale("log")
    style.label_decades(ax.xaxis)
    # a power of ten would overlap the letter of the panel: only for large contributions
    ax.ticklabel_format(axis="y", scilimits=(-9, SHORT[1]))
    ax.legend()
    return ax


@style.styled()
def before_and_after(
    surface: Topography, conditions: tuple[float, float, float, str] | None = None
) -> Figure:
    """Draw a surface before and after preparation, and its isotropic spectrum.

    `conditions` are a [m], M, L and the wavelength convention; with them the amplitude reduction
    A_d/A_i of waves along x is drawn over the spectrum.
    """
    made = surface.preparation
    figure = style.new_figure(style.PAGE, 2.3 if made else 2.8)
    axes = list(figure.subplots(1, 3 if made else 2))
    style.letter(axes)
    lengths = (surface.length_x, surface.length_y)
    curves = [("prepared" if made else "surface", style.BLUE, surface)]
    if made:
        scan = made.scan
        size = scan.length_x, scan.length_y
        _map(axes[0], scan.heights - np.nanmean(scan.heights), size, "as measured")
        # treated as a tile, its holes filled with neighbouring values
        z = nearest(scan.heights)
        raw = Topography(z - z.mean(), size)
        nx, ny = made.prepared.shape
        lengths = (nx * made.pixel[0], ny * made.pixel[1])
        _map(axes[1], made.prepared, lengths, "prepared")
        _mark(axes[0], made.record.findings, style.length_unit(max(size))[0])
        curves.insert(0, ("as measured", style.GREY, raw))
    else:
        _map(axes[0], surface.heights, lengths, "surface")
    _spectra(axes[-1], curves, conditions)
    style.legend_below(figure, axes[-1])
    return figure


def _map(ax: Axes, heights: Array, size: tuple[float, float], title: str) -> None:
    """Heights as a map; holes are white."""
    low, high = np.nanquantile(heights, [SHOWN, 1.0 - SHOWN])
    top = float(max(abs(low), abs(high))) or 1.0
    unit, name = style.height_unit(top)
    scale, length = style.length_unit(max(size))
    image = ax.imshow(
        heights.T * unit, origin="lower", extent=(0.0, size[0] * scale, 0.0, size[1] * scale),
        cmap=style.DIVERGING, vmin=-top * unit, vmax=top * unit, interpolation="nearest",
    )  # fmt: skip
    bar = ax.figure.colorbar(image, ax=ax, fraction=0.046, extend="both")
    bar.set_label(f"height [{name}]")
    rms = float(np.nanstd(heights)) * unit
    head = f"{ax.get_title(loc='left')} {title},\nrms {rms:.3g} {name}"
    ax.set_title(head, loc="left")
    style.few_ticks(ax)
    ax.set(xlabel=f"x [{length}]", ylabel=f"y [{length}]")


def _mark(ax: Axes, findings: Sequence[Finding], scale: float) -> None:
    """Outline steps and dust specks on the measured map; `scale`: its unit of length per metre."""
    (image,) = ax.get_images()
    right = float(image.get_extent()[1])
    for finding in findings:
        for x_min, x_max, y_min, y_max in finding.places:
            minimum = 0.012 * right
            width, height = (x_max - x_min) * scale, (y_max - y_min) * scale
            grow = 0.0 if min(width, height) == 0.0 else minimum
            box = Rectangle(
                (x_min * scale - grow, y_min * scale - grow), width + 2 * grow, height + 2 * grow,
                fill=False, ec=style.GREEN, lw=1.4, ls="--" if grow == 0.0 else "-",
            )  # fmt: skip
            ax.add_patch(box)


def _spectra(
    ax: Axes,
    curves: list[tuple[str, str, Topography]],
    conditions: tuple[float, float, float, str] | None,
) -> None:
    ends: list[float] = []
    for label, colour, tile in curves:
        q, c_iso = psd_isotropic(tile)
        shown = c_iso > c_iso.max() * 1e-14
        ax.loglog(1e-6 * q[shown], c_iso[shown], "-", color=colour, label=label)
        ends += [float(q[0]), float(q[-1])]
    ax.set(xlabel="|q| [rad/µm]", ylabel=C_ISO)
    style.label_decades(ax.xaxis, ax.yaxis)
    if conditions is None:
        return
    radius, moes_m, moes_l, convention = conditions
    twin = ax.twinx()
    line = np.geomspace(min(ends), max(ends), 200)
    ratio = component_amplitude_ratio(line, 0.0, radius, moes_m, moes_l, convention=convention)
    twin.plot(1e-6 * line, ratio, color=style.VERMILLION, lw=1.4)
    twin.set_ylim(0.0, 1.02)
    style.y_label(twin, r"$A_d/A_i$", style.VERMILLION)
