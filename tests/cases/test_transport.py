# SPDX-License-Identifier: BSD-3-Clause
"""Why the narrow scheme is the default: transport alone, du/dX + du/dT = 0.

In the contact the viscosity leaves only this of the Reynolds equation. A wave that enters at X = -1
is stepped through the contact by the differences of both time schemes, with a time step of h.
"""

from pathlib import Path

import numpy as np
import pytest


def amplitude(scheme: str, wavelength: float, h: float) -> tuple[np.ndarray, np.ndarray]:
    """Distances from the inlet, and the amplitude of the wave there over that at the inlet."""
    k = 2.0 * np.pi / wavelength
    n = round(2.0 / h) + 1
    x = h * np.arange(n)
    before, now = np.zeros(n), np.zeros(n)
    period = round(wavelength / h)
    peak = np.zeros(n)
    steps = 2 * n + period
    for step in range(steps):
        earlier, before, now = before, now, np.zeros(n)
        # The inlet and its neighbour have the exact wave
        now[:2] = np.sin(k * (x[:2] - step * h))
        if scheme == "narrow":
            now[2:] = (2.0 * before[1:-1] - 0.5 * earlier[:-2]) / 1.5
        else:
            for i in range(2, n):
                known = 2.0 * now[i - 1] - 0.5 * now[i - 2] + 2.0 * before[i] - 0.5 * earlier[i]
                now[i] = known / 3.0
        if step >= steps - period:
            # Mean square over one period
            peak += 2.0 * now**2 / period
    return x, np.sqrt(peak)


def kept(angle: float) -> float:
    """Fraction that the scheme of the paper keeps from node to node, of a wave with k h = angle."""
    # The factor r from node to node solves (1.5 + s) r^2 - 2 r + 0.5 = 0, s: difference in T
    s = 1.5 - 2.0 * np.exp(1j * angle) + 0.5 * np.exp(2j * angle)
    return float(np.abs(np.roots([1.5 + s, -2.0, 0.5])).max())


@pytest.mark.parametrize("wavelength", [0.5, 0.25, 0.125])
def test_narrow_scheme_transports_a_wave_unchanged(wavelength: float):
    _, size = amplitude("narrow", wavelength, 1.0 / 64.0)
    # Rounding, and the remainder of the start (a factor of 1/3 per step)
    assert size == pytest.approx(np.ones_like(size), abs=1e-12)


@pytest.mark.parametrize(
    ("wavelength", "h"), [(0.5, 1.0 / 32.0), (0.5, 1.0 / 64.0), (0.25, 1.0 / 64.0)]
)
def test_paper_scheme_damps_a_wave(wavelength: float, h: float):
    x, size = amplitude("paper", wavelength, h)
    angle = 2.0 * np.pi * h / wavelength
    # Not from the inlet itself: the differences are one-sided, which affects a few nodes
    start = x.size // 4
    exponent = np.log(size[start] / size[-1]) / (x[-1] - x[start])
    assert exponent == pytest.approx(-np.log(kept(angle)) / h, rel=1e-8)
    # exp(-h^3 k^4 (X + 1)/2) is its leading term; the next one is 7/6 (k h)^2 of it
    leading = 0.5 * angle**4 / h
    assert exponent / leading - 1.0 == pytest.approx(-7.0 / 6.0 * angle**2, rel=0.25)
    assert size[-1] < 0.95


def test_page_states_the_remaining_amplitude(root: Path):
    """Over the length of a contact of 128 nodes, by the nodes per wave."""
    left = [100.0 * kept(2.0 * np.pi / nodes) ** 128 for nodes in (32, 16, 12)]
    text = (root / "docs/theory/time-steps.md").read_text(encoding="utf-8")
    say = "with 32, 16 and 12 nodes per wavelength retain {:.0f}, {:.0f} and {:.0f} %"
    assert say.format(*left) in text
