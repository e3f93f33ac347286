# SPDX-License-Identifier: BSD-3-Clause
"""Figure 4: mu_r/mu_s of moving waves over theta_2 with eq. 16, our own fit, a better parameter."""

import math
from dataclasses import dataclass

import numpy as np
import pictures
from conditions import SCHEME_NAMES, SCHEMES, VELOCITY_RATIO, WaveSet, waves
from curve_fit import Fit, evaluate, fit, scatter
from figure3 import series, without_result
from parameter import SMALL_WAVES, response_parameter
from piece import Check, Finding, Level, References, Result
from runs import Runs

from pyehl.theory.stribeck import theta_2
from pyehl.types import Array, Mask

NAME = "figure 4"
TITLE = "Relative friction of moving waves over theta_2, eq. 16, and over a better parameter"
# The wave that shows the damping: M, L, wavelength, H_c/A_i
DAMPED = (1000.0, 10.0, 0.25, 2.5)
ONE_CURVE = 1.0
"""theta_2 above which the waves lie on one curve."""
COLUMNS = (
    *("scheme", "moes_m", "moes_l", "wavelength", "film_over_amplitude", "theta_2", "theta_r"),
    *("mu_ratio", "mu_ratio_eq_16", "status"),
)
BELOW = "Below theta_2 = 1 the waves do not lie on one curve"


@dataclass(frozen=True, slots=True)
class Collapsed:
    """Waves of one scheme over both parameters (n,), with fits of the form of eq. 16.

    `fit_one` is the fit over theta_2 to the waves above `ONE_CURVE` only.
    """

    waves: WaveSet
    theta_2: Array
    theta_r: Array
    fit_2: Fit
    fit_r: Fit
    fit_one: Fit

    def scatter(self, theta: Array, second: float, fourth: float) -> float:
        """Rms of ln(mu_r/mu_s over a curve) [-]."""
        known = self.waves.known
        return scatter(self.waves.friction[known], evaluate(theta[known], second, fourth))


def run(runs: Runs, level: Level) -> list[Collapsed]:
    """Run the waves with both schemes, and fit."""
    out = []
    for scheme in SCHEMES:
        result = waves(runs, level, scheme)
        point = result.moes_m, result.moes_l, result.wavelength
        by_paper = theta_2(*point, result.ratio)
        by_response = response_parameter(*point, result.amplitude, VELOCITY_RATIO)
        _, curve = np.unique(np.stack(point), axis=1, return_inverse=True)
        known, curve = result.known, np.asarray(curve).ravel()
        fits = [
            fit(theta[known], result.friction[known], curve[known])
            for theta in (by_paper, by_response)
        ]
        known = known & (by_paper > ONE_CURVE)
        fits.append(fit(by_paper[known], result.friction[known], curve[known]))
        out.append(Collapsed(result, by_paper, by_response, *fits))
    return out


def show(data: list[Collapsed], references: References, level: Level) -> Result:
    """Draw the waves of both schemes over both parameters, and compare with eq. 16."""
    second, fourth = references["eq16.second"], references["eq16.fourth"]
    eq_16 = second.value, fourth.value
    panels, checks, notes, rows = [], [], [], []
    for c in data:
        scheme = c.waves.scheme
        s_16 = c.scatter(c.theta_2, *eq_16)
        s_2 = c.scatter(c.theta_2, c.fit_2.second, c.fit_2.fourth)
        s_r = c.scatter(c.theta_r, c.fit_r.second, c.fit_r.fourth)
        panels += [
            _panel(
                SCHEME_NAMES[scheme],
                r"$\theta_2$", c, c.theta_2,
                [("eq. 16", ":", eq_16), ("our fit", "-", (c.fit_2.second, c.fit_2.fourth))],
            ),
            _panel(
                SCHEME_NAMES[scheme],
                r"$\theta_r$, from the response", c, c.theta_r,
                [("our fit", "-", (c.fit_r.second, c.fit_r.fourth)),
                 (r"small waves, $1 + \theta_r^{-2}/4$", "--", (SMALL_WAVES, 0.0))],
            ),
        ]  # fmt: skip
        checks += _checks(c, eq_16)
        notes += [
            f"Scheme '{scheme}', theta_2: our fit is {c.fit_2}. Rms scatter of mu_r/mu_s "
            f"{100 * s_2:.1f} % about it, {100 * s_16:.1f} % about eq. 16.",
            f"Scheme '{scheme}', theta_r: our fit is {c.fit_r}; the theory for small waves is "
            f"{SMALL_WAVES:g} theta^-2. Rms scatter {100 * s_r:.1f} %, that is "
            f"{s_2 / s_r:.1f} times less than over theta_2.",
            without_result(c.waves),
        ]
        rows += [
            (scheme, c.waves.moes_m[k], c.waves.moes_l[k], c.waves.wavelength[k],
             c.waves.ratio[k], c.theta_2[k], c.theta_r[k], c.waves.friction[k],
             float(evaluate(c.theta_2[k], *eq_16)), c.waves.status[k])
            for k in range(c.theta_2.size)
        ]  # fmt: skip
    caption = (
        "Left: over theta_2, with eq. 16 (dotted) and our fit of its form. Right: over the "
        "parameter from the response. Top: the scheme of the paper. Bottom: the narrow scheme."
    )
    return Result(
        checks,
        (COLUMNS, rows),
        pictures.collapses(panels),
        caption,
        notes,
        findings=[_below(data[0]), *_damping(data, eq_16, level)],
        studies=[c.waves.made for c in data],
    )


def _panel(
    title: str,
    abscissa: str,
    data: Collapsed,
    theta: Array,
    curves: list[tuple[str, str, tuple[float, float]]],
) -> pictures.Collapse:
    known = data.waves.known
    line = np.geomspace(theta[known].min() * 0.9, theta[known].max() * 1.1, 200)
    drawn = [(label, style, line, evaluate(line, *ab)) for label, style, ab in curves]
    return pictures.Collapse(title, abscissa, series(data.waves, theta), drawn)


def _checks(c: Collapsed, eq_16: tuple[float, float]) -> list[Check]:
    """Compare the coefficients of eq. 16 with the confidence intervals of our fits."""
    result = []
    judged = c.waves.scheme == "paper"
    for waves_of, ours, finding in (
        (f"theta_2 > {ONE_CURVE:g}", c.fit_one, ""),
        ("all theta_2", c.fit_2, BELOW),
    ):
        for name, value, (low, high), theirs in (
            ("theta_2^-2", ours.second, ours.second_interval, eq_16[0]),
            ("theta_2^-4", ours.fourth, ours.fourth_interval, eq_16[1]),
        ):
            room = high - value if theirs > value else value - low
            result.append(
                Check(
                    f"coefficient of {name}, {waves_of}, scheme '{c.waves.scheme}'",
                    value,
                    theirs,
                    room if judged else None,
                    f"95 % interval of our fit {low:.3g} ... {high:.3g}",
                    "p. 5, eq. 16 (text)",
                    finding,
                )
            )
    return result


def _below(c: Collapsed) -> Finding:
    """Return the finding on the range of one curve, for the scheme of the paper."""
    known = c.waves.known
    above, below = (known & (c.theta_2 > ONE_CURVE)), (known & (c.theta_2 <= ONE_CURVE))

    def rms(chosen: Mask, ours: Fit) -> float:
        return 100.0 * scatter(c.waves.friction[chosen], ours.at(c.theta_2[chosen]))

    text = (
        f"Under the scheme of the paper the fit to the {above.sum()} waves with theta_2 above "
        f"{ONE_CURVE:g} is {c.fit_one}; these waves scatter by {rms(above, c.fit_one):.1f} % about "
        f"it. The fit to all waves is {c.fit_2}; the {below.sum()} waves below {ONE_CURVE:g} "
        f"scatter by {rms(below, c.fit_2):.0f} % about it. There mu_r/mu_s is not a function of "
        "theta_2 alone, and the coefficients of a fit depend on the selection of waves, which the "
        "paper does not list."
    )
    return Finding(BELOW, text)


def _damping(data: list[Collapsed], eq_16: tuple[float, float], level: Level) -> list[Finding]:
    """Return the finding on the damping of the paper's scheme, if its waves have results."""
    m, ell, lam, ratio = DAMPED
    ratios = []
    for c in data:
        f = c.waves
        point = (f.moes_m == m) & (f.moes_l == ell) & (f.wavelength == lam) & (f.ratio == ratio)
        ratios += [(float(f.friction[k]), float(c.theta_2[k])) for k in np.flatnonzero(point)]
    if len(ratios) != len(data):
        return []
    (damped, theta), (narrow, _) = ratios
    if not (math.isfinite(damped) and math.isfinite(narrow)):
        return []
    mesh = 4.0 / (level.collapse_grid - 1)
    left = math.exp(-0.5 * mesh**3 * (2.0 * math.pi / lam) ** 4)
    text = (
        f"At M = {m:g}, L = {ell:g}, wavelength {lam:g} a, H_c/A_i = {ratio:g} on "
        f"{level.collapse_grid} x {level.collapse_grid} nodes mu_r/mu_s is {damped:.3f} under the "
        f"scheme of the paper and {narrow:.3f} under the narrow scheme; eq. 16 gives "
        f"{float(evaluate(np.array(theta), *eq_16)):.3f}. The paper discretises wedge and squeeze "
        "separately, which damps a wave while it moves through the contact: a fraction "
        f"exp(-h_x^3 k^4 (X + 1)/2) = {left:.2f} of its amplitude is left at the centre. This "
        "damping acts like complete flattening of the roughness: pressure and friction are too "
        "high. The narrow scheme transports a wave at the mean velocity without damping."
    )
    return [Finding("Damping of the paper's scheme on its grid", text)]
