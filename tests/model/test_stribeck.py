# SPDX-License-Identifier: BSD-3-Clause
"""theta_2 and eq. 16."""

import pytest
import reference

from pyehl.theory import stribeck


def test_figure_2():
    case = reference.FIG_2
    theta = stribeck.theta_2(
        case["moes_m"], case["moes_l"], case["wavelength"], 1 / case["amplitude_over_film"]
    )
    ratio = float(stribeck.relative_friction(theta))
    assert ratio == pytest.approx(1.466, abs=5e-4)
    assert ratio == pytest.approx(case["mu_ratio"], rel=5e-3)


def test_exponents():
    base = stribeck.theta_2(1000.0, 10.0, 0.5, 2.0)
    for factors, power in (((2, 1, 1, 1), 0.33), ((1, 2, 1, 1), -1.1), ((1, 1, 2, 1), 0.67)):
        scaled = [v * f for v, f in zip((1000.0, 10.0, 0.5, 2.0), factors, strict=True)]
        assert float(stribeck.theta_2(*scaled) / base) == pytest.approx(2**power)


def test_range():
    assert stribeck.in_range(1000.0, 10.0, 0.5, 2.5) == []
    assert len(stribeck.in_range(100.0, 20.0, 0.1, 20.0)) == 4


def test_refuses():
    with pytest.raises(ValueError, match="positive"):
        stribeck.theta_2(1000.0, 0.0, 0.5, 2.0)
    with pytest.raises(ValueError, match="positive"):
        stribeck.relative_friction(0.0)
