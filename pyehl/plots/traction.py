# SPDX-License-Identifier: BSD-3-Clause
"""The picture of traction curves: friction and temperature over the slide-to-roll ratio."""

from collections.abc import Sequence
from textwrap import wrap

import numpy as np
from matplotlib.figure import Figure

from pyehl.plots.stribeck import COLOURS, Curve, Points
from pyehl.plots.style import letter, new_figure
from pyehl.types import Array


def draw_traction(
    curves: Sequence[Curve],
    slips: Sequence[Array],
    surface: str,
    measured: Points | None = None,
    law: str = "",
) -> Figure:
    """Draw coefficients of friction, and the greatest temperature rise where it was computed.

    `slips` are the slide-to-roll ratios of each curve; without sliding there is no friction of
    sliding. `surface` says what the surface is; measured friction is laid over; `law` says what an
    empirical curve is.
    """
    warm = any(np.isfinite(curve.column("temperature_rise_max_K")).any() for curve in curves)
    figure = new_figure(10.0 if warm else 6.0, 4.4)
    axes = figure.subplots(1, 2 if warm else 1, squeeze=False)[0]
    for curve, slip, colour in zip(curves, slips, COLOURS * 9, strict=False):
        tail = f" ({curve.label})" if curve.label else ""
        resting = slip == 0.0
        for name, style, words in (
            ("mu", "o-", "with heat" if warm else "friction"),
            ("mu_isothermal", ":", "isothermal"),
            ("mu_empirical", "--", "empirical"),
        ):
            if name not in curve.rows[0] or (name == "mu_isothermal" and not warm):
                continue
            mu = np.where(resting, 0.0, curve.column(name))
            known = np.isfinite(mu)
            axes[0].plot(
                slip[known], mu[known], style, ms=3, lw=1.2, color=colour, label=f"{words}{tail}"
            )
        if warm:
            rise = np.where(resting, 0.0, curve.column("temperature_rise_max_K"))
            known = np.isfinite(rise)
            axes[1].plot(slip[known], rise[known], "o-", ms=3, lw=1.2, color=colour)
    if measured is not None:
        measured.draw(axes[0], "contact.slide_to_roll")
    for ax in axes:
        ax.set_xlabel("slide-to-roll ratio")
        ax.grid(visible=True, which="major", color="0.92", lw=0.6)
        ax.set_axisbelow(True)
        ax.set_ylim(bottom=0.0)
    axes[0].set_ylabel(r"$\mu$")
    if warm:
        axes[1].set_ylabel("greatest rise of temperature in the film [K]")
        letter(axes)
    axes[0].legend(fontsize="small")
    words = "; ".join(f"{c.label + ': ' if c.label else ''}{c.ends}" for c in curves if c.ends)
    figure.suptitle("\n".join((surface, words, *wrap(law, 90))), fontsize="medium")
    return figure
