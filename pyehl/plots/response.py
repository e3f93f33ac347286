# SPDX-License-Identifier: BSD-3-Clause
"""The measured response of a contact to waves of roughness: amplitude and lag over wavelength."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from pyehl.plots.style import GREY, PAGE, SEQUENTIAL, letter, new_figure, styled
from pyehl.theory.amplitude import amplitude_ratio, wavelength_parameter
from pyehl.types import Array, Complex


@styled()
def response_figure(
    waves: Mapping[str, Array], lines: Mapping[float, tuple[Array, Complex]], label: str
) -> Figure:
    """Draw |T| and the phase of T at X = 0 over nabla_2.

    `waves`: nabla_2, direction [deg], amplitude and lag [deg] of the measured waves, (m,);
    `lines`: the shipped response by direction [deg], nabla_2 (n,) and T (n,).
    """
    figure = new_figure(PAGE, 3.0)
    axes: Any = figure.subplots(1, 2, sharex=True)
    colours: Any = {"cmap": SEQUENTIAL, "vmin": 0.0, "vmax": 90.0}
    for ax, name in zip(axes, ("amplitude", "lag"), strict=True):
        measured = waves[name] if name == "amplitude" else _turned(waves, lines)
        dots = ax.scatter(waves["nabla_2"], measured, c=waves["direction"], s=8, **colours)
        for direction, (nabla, t) in lines.items():
            values = np.abs(t) if name == "amplitude" else _lag(t)
            colour = dots.cmap(dots.norm(direction))
            ax.plot(nabla, values, color=colour, lw=1, label=rf"shipped, {direction:g}$\degree$")
        ax.set_xscale("log")
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.xaxis.set_major_formatter("{x:g}")
        ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.set_xlabel(r"$\nabla_2 = (\lambda/a)\sqrt{M/L}$")
    nabla = np.geomspace(waves["nabla_2"].min(), waves["nabla_2"].max(), 100)
    paper = amplitude_ratio(wavelength_parameter(nabla, 1.0, 1.0))
    axes[0].plot(nabla, paper, color=GREY, ls="--", lw=1, label=r"$1/(1 + 0.15x + 0.015x^2)$")
    axes[0].set_ylabel(r"$|T|$ at $X = Y = 0$")
    axes[1].set_ylabel(r"lag of the film wave [$\degree$]")
    axes[0].legend()
    figure.colorbar(dots, ax=axes[1], label=r"crests to across the motion [$\degree$]")
    figure.set_label(label)
    letter(axes)
    return figure


def _lag(t: Complex) -> Array:
    """Phase of T along a line [deg], unwrapped from the longest wave, which has the least lag."""
    return np.degrees(np.unwrap(np.angle(t)[::-1])[::-1])


def _turned(waves: Mapping[str, Array], lines: Mapping[float, tuple[Array, Complex]]) -> Array:
    """Lags of the measured waves [deg], shifted by multiples of 360 deg to be near the lines."""
    # the lag of a wave depends on the cosine of its direction
    directions = sorted(lines, reverse=True)
    cosines = np.cos(np.radians(directions))
    lags = np.stack(
        [
            np.interp(np.log(waves["nabla_2"]), np.log(lines[d][0]), _lag(lines[d][1]))
            for d in directions
        ]
    )
    here = np.cos(np.radians(waves["direction"]))
    near = np.array([np.interp(c, cosines, column) for c, column in zip(here, lags.T, strict=True)])
    return np.asarray(waves["lag"] + 360.0 * np.round((near - waves["lag"]) / 360.0))
