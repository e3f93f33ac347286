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
    """Run the waves with both schemes."""
    smooth_films(runs, level)
    return [waves(runs, level, scheme) for scheme in SCHEMES]


def series(result: WaveSet, place: pictures.Array) -> list[pictures.Series]:
    """Return the curves of a set over a parameter (n,)."""
    curves = sorted(set(zip(result.moes_m, result.moes_l, result.wavelength, strict=True)))
    out = []
    for m, ell, lam in curves:
        here = (result.moes_m == m) & (result.moes_l == ell) & (result.wavelength == lam)
        here &= result.known
        if not here.any():
            continue
        out.append(
            pictures.Series(float(m), float(ell), float(lam), place[here], result.friction[here])
        )
    return out


def without_result(result: WaveSet) -> str:
    """Return a note on the waves without a result, with the reasons."""
    missing = [
        f"({result.moes_m[k]:g}, {result.moes_l[k]:g}, {result.wavelength[k]:g}, "
        f"{result.ratio[k]:g}) {result.status[k]}"
        for k in np.flatnonzero(~result.known)
    ]
    if not missing:
        return f"Scheme '{result.scheme}': all {result.friction.size} waves have a result."
    return (
        f"Scheme '{result.scheme}': {np.count_nonzero(result.known)} of {result.friction.size} "
        "waves have a result; without one, as (M, L, wavelength, H_c/A_i) status: "
        f"{'; '.join(missing)}."
    )


def show(data: list[WaveSet], references: References, level: Level) -> Result:
    """Draw the curves; those of the paper are not published as numbers."""
    grid = f"{level.collapse_grid} x {level.collapse_grid} nodes"
    figure = pictures.friction_over_film(
        [
            (f"{SCHEME_NAMES[result.scheme]}, {grid}", series(result, result.ratio))
            for result in data
        ]
    )
    rows = [
        (f.scheme, f.moes_m[k], f.moes_l[k], f.wavelength[k], f.ratio[k], f.amplitude[k],
         f.friction[k], f.status[k])
        for f in data
        for k in range(f.friction.size)
    ]  # fmt: skip
    falling = [
        bool(np.all(np.diff(s.friction[np.argsort(s.place)]) < 0.0))
        for result in data
        for s in series(result, result.ratio)
    ]
    ends = [s.friction[np.argmax(s.place)] for result in data for s in series(result, result.ratio)]
    notes = [
        f"The friction falls with H_c/A_i on {sum(falling)} of {len(falling)} curves, as in the "
        f"paper; at the largest H_c/A_i it is {min(ends):.3f} to {max(ends):.3f}. No parameter of "
        "film over roughness alone brings the curves together.",
        "The conditions of the paper's curves are not in its text: these are the middle and "
        "corners of the ranges that it states for Fig. 4.",
        *(without_result(result) for result in data),
    ]
    return Result(
        (),
        (COLUMNS, rows),
        figure,
        "Both schemes; the curves of the paper are not published as numbers.",
        notes,
        studies=[result.made for result in data],
        unjudged="the paper gives neither the numbers nor the conditions of these curves",
    )
