# SPDX-License-Identifier: BSD-3-Clause
"""The figure of ``pyehl response``: measured lags are on the lines, whole turns apart."""

import numpy as np

from pyehl.plots.response import response_figure


def test_lags_of_many_turns_lie_on_the_lines():
    nabla = np.geomspace(0.2, 20.0, 300)

    def lag(where: np.ndarray, direction: np.ndarray) -> np.ndarray:
        """Drift of a free wave [deg]: up to four turns."""
        return 20.0 + 300.0 / where * np.cos(np.radians(direction))

    lines = {
        d: (nabla, 0.5 * np.exp(1j * np.radians(lag(nabla, np.full(300, d)))))
        for d in (0.0, 45.0, 90.0)
    }
    places, directions = np.geomspace(0.25, 15.0, 12), np.tile([0.0, 30.0, 45.0, 80.0], 3)
    result = (lag(places, directions) + 180.0) % 360.0 - 180.0
    waves = {"nabla_2": places, "direction": directions, "amplitude": 0.5 + 0.0 * places}
    figure = response_figure(waves | {"lag": result}, lines, "")
    ax = figure.axes[1]
    (dots,) = ax.collections
    np.testing.assert_allclose(np.asarray(dots.get_offsets())[:, 1], lag(places, directions))
    for line, direction in zip(ax.lines, lines, strict=True):
        expected = lag(nabla, np.full(300, direction))
        np.testing.assert_allclose(line.get_ydata(), expected, atol=1e-6)
