# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a rough surface and its prediction: spectrum, roughness in the contact, passage.

Each function returns a figure; arrays have their first index along x.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from numpy.typing import NDArray

from pyehl.plots.style import (
    BLUE,
    DIVERGING,
    GREY,
    SEQUENTIAL,
    VERMILLION,
    axes_or_new,
    edges,
    height_unit,
    letter,
    new_figure,
)
from pyehl.surfaces import Topography, psd_2d, psd_isotropic
from pyehl.theory import amplitude

__all__ = ["friction_passage", "octaves", "passage", "roughness_pair", "surface_spectrum"]

Array = NDArray[np.float64]


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
        Wavelength convention of A_d/A_i, see :mod:`pyehl.theory.amplitude`; drawn for waves
        along x.
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


def passage(shift: Array, ratio: Array, length: float, ax: Axes | None = None) -> Axes:
    """Draw mu_r/mu_s over one passage of the tile.

    Parameters
    ----------
    shift, ratio
        (n,) displacement of the tile [m], equally spaced from 0, and mu_r/mu_s there [-].
    length
        Of the tile along x [m].
    ax
        Where to draw; None: a new figure.

    Returns
    -------
    Axes
        `ax`, or the new ones.
    """
    ax = axes_or_new(ax, 3.8, 2.9)
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
    return ax


def octaves(bands: Sequence[tuple[float, float, float]], ax: Axes | None = None) -> Axes:
    """Draw what each octave of wavelengths adds to mu_r/mu_s.

    Parameters
    ----------
    bands
        Longest and shortest wavelength [m] and rise [-] of each octave.
    ax
        Where to draw; None: a new figure.

    Returns
    -------
    Axes
        `ax`, or the new ones.
    """
    ax = axes_or_new(ax, 3.8, 2.9)
    for longest, shortest, rise in bands:
        if math.isfinite(rise):
            ax.fill_between(
                [shortest * 1e6, longest * 1e6], 0.0, [rise, rise], color=BLUE, alpha=0.75,
                lw=0.8, ec="white",
            )  # fmt: skip
    ax.axhline(0.0, color=GREY, lw=0.8)
    ax.set_xscale("log")
    ax.set_xlabel(r"wavelength of the component [$\mu$m]")
    ax.set_ylabel(r"contribution to $\mu_r/\mu_s - 1$")
    return ax


def friction_passage(
    shift: Array,
    ratio: Array,
    length: float,
    bands: Sequence[tuple[float, float, float]] = (),
) -> Figure:
    """Figure of :func:`passage` and, unless there are no bands, :func:`octaves`."""
    figure = new_figure(7.2 if bands else 3.8, 2.9)
    axes = list(figure.subplots(1, 2 if bands else 1, squeeze=False)[0])
    passage(shift, ratio, length, axes[0])
    if bands:
        octaves(bands, axes[1])
    letter(axes)
    return figure
