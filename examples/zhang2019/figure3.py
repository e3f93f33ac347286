# SPDX-License-Identifier: BSD-3-Clause
"""Figure 3: mu_r/mu_s of moving waves over H_c/A_i, a curve for each operating condition."""

import numpy as np
import pictures
from conditions import SCHEME_NAMES, SCHEMES, WaveSet, smooth_films, waves
from piece import Level, References, Result
from runs import Runs

NAME = "figure 3"
TITLE = "Relative friction of moving waves over H_c/A_i"

COLUMNS = (
    *("scheme", "moes_m", "moes_l", "wavelength", "film_over_amplitude", "amplitude"),
    *("mu_ratio", "status"),
)


def run(runs: Runs, level: Level) -> list[WaveSet]:
    """Run the waves under both schemes."""
    smooth_films(runs, level)
    return [waves(runs, level, scheme) for scheme in SCHEMES]


def series(found: WaveSet, place: pictures.Array) -> list[pictures.Series]:
    """Curves of a set over a parameter (n,)."""
    curves = sorted(set(zip(found.moes_m, found.moes_l, found.wavelength, strict=True)))
    out = []
    for m, ell, lam in curves:
        here = (found.moes_m == m) & (found.moes_l == ell) & (found.wavelength == lam)
        here &= found.known
        if not here.any():
            continue
        out.append(
            pictures.Series(float(m), float(ell), float(lam), place[here], found.friction[here])
        )
    return out


def without_result(found: WaveSet) -> str:
    """Tell which waves have no result, and why."""
    lost = [
        f"({found.moes_m[k]:g}, {found.moes_l[k]:g}, {found.wavelength[k]:g}, "
        f"{found.ratio[k]:g}) {found.status[k]}"
        for k in np.flatnonzero(~found.known)
    ]
    if not lost:
        return f"Scheme '{found.scheme}': all {found.friction.size} waves have a result."
    return (
        f"Scheme '{found.scheme}': {np.count_nonzero(found.known)} of {found.friction.size} waves "
        f"have a result; without one, as (M, L, wavelength, H_c/A_i) status: {'; '.join(lost)}."
    )


def show(data: list[WaveSet], references: References, level: Level) -> Result:
    """Draw the curves; the paper's own are not published as numbers."""
    grid = f"{level.collapse_grid} x {level.collapse_grid} nodes"
    figure = pictures.friction_over_film(
        [(f"{SCHEME_NAMES[found.scheme]}, {grid}", series(found, found.ratio)) for found in data]
    )
    rows = [
        (f.scheme, f.moes_m[k], f.moes_l[k], f.wavelength[k], f.ratio[k], f.amplitude[k],
         f.friction[k], f.status[k])
        for f in data
        for k in range(f.friction.size)
    ]  # fmt: skip
    falling = [
        bool(np.all(np.diff(s.friction[np.argsort(s.place)]) < 0.0))
        for found in data
        for s in series(found, found.ratio)
    ]
    ends = [s.friction[np.argmax(s.place)] for found in data for s in series(found, found.ratio)]
    notes = [
        f"The friction falls with H_c/A_i on {sum(falling)} of {len(falling)} curves, as in the "
        f"paper; at the largest H_c/A_i it is {min(ends):.3f} to {max(ends):.3f}. No parameter of "
        "film over roughness alone brings the curves together.",
        "The conditions of the paper's curves are not in its text: these are the middle and "
        "corners of the ranges that it states for Fig. 4.",
        *(without_result(found) for found in data),
    ]
    return Result(
        (),
        (COLUMNS, rows),
        figure,
        "Both schemes; the curves of the paper are not published as numbers.",
        notes,
        studies=[found.made for found in data],
        unjudged="the paper gives neither the numbers nor the conditions of these curves",
    )
