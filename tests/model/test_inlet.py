# SPDX-License-Identifier: BSD-3-Clause
"""Waves in the inlet by the linearised Reynolds equation, and quantities that depend on them."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import k0

from pyehl.case import Case
from pyehl.contact.smooth import solve_contact, zone_of
from pyehl.theory.inlet import (
    END,
    SPACING,
    START,
    at_inlet,
    convected_by,
    interpolated_inlet,
    wave_flattening,
)
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_transfer
from pyehl.theory.shear import FlowFactors
from pyehl.theory.transport import Zone, stiffness, upstream

MOES = (500.0, 8.0)


@pytest.fixture(scope="module")
def zone() -> Zone:
    """Return the centre line of a smooth contact."""
    settings = Case.from_text(f"&contact moes_m = {MOES[0]} moes_l = {MOES[1]} /\n").resolve()
    operating = OperatingPoint.from_settings(settings)
    return zone_of(solve_contact(settings), operating, Lubricant.from_settings(settings))


def test_a_uniform_wave_deflects_as_on_the_half_space(zone: Zone):
    x = np.arange(START, END + 0.5 * SPACING, SPACING)
    qx, qy = np.array([15.0, 20.0, 50.0]), np.array([25.0, 30.0, 20.0])
    middle = wave_flattening(zone, qx, qy, 0.0 * qx, x)[:, np.argmin(np.abs(x + 1.1))].sum(-1)
    np.testing.assert_allclose(middle, 1.0 / stiffness(np.hypot(qx, qy)), rtol=0.05)


def test_a_narrow_ellipse_deflects_as_a_strip_of_its_width(zone: Zone):
    """The transform of K_0, and the stiffness of the ellipse; within 20 % of a circle's."""
    narrow = replace(zone, ellipticity=0.05, stiffness=1.3)
    x = np.arange(START, END + 0.5 * SPACING, SPACING)
    qx, qy = np.array([15.0, 20.0]), np.array([0.0, 5.0])
    middle = wave_flattening(narrow, qx, qy, 0.0 * qx, x)[:, np.argmin(np.abs(x + 1.1))].sum(-1)
    across = np.hypot(qy, np.exp(-np.euler_gamma) / 0.05)
    np.testing.assert_allclose(middle, 1.0 / (1.3 * stiffness(np.hypot(qx, across))), rtol=0.05)


@pytest.mark.parametrize("width", [0.3, 1.0, np.inf])
def test_flattening_by_one_cell(zone: Zone, width: float):
    """The integral of K_0 over a cell near and far, of waves along and across; lines of any width.

    The part beyond the last node is omitted.
    """
    x = np.arange(START, END + 0.5 * SPACING, SPACING)
    qx, qy = np.array([0.0, 20.0, 90.0]), np.array([3.0, 0.0, 40.0])
    result = wave_flattening(replace(zone, ellipticity=width), qx, qy, 0.0 * qx, x)
    strip = np.exp(-np.euler_gamma) / (width if np.isfinite(width) else 1.0)
    for m, i, j in ((0, 9, 9), (0, 9, 10), (1, 9, 9), (1, 9, 8), (1, 9, 30), (2, 9, 10), (2, 9, 9)):
        kappa, away = np.hypot(qy[m], strip), x[j] - x[i]
        parts = [
            quad(
                lambda d, m=m, kappa=kappa, part=part: k0(kappa * abs(d)) * part(qx[m] * d),
                *(away - 0.5 * SPACING, away + 0.5 * SPACING),
                points=[0.0] if i == j else None,
            )[0]
            for part in (np.cos, np.sin)
        ]
        expected = 4.0 / np.pi**2 / zone.stiffness * complex(*parts)
        # K_0 next to 0 is used without its square
        assert result[m, i, j] == pytest.approx(expected, rel=2e-2 if i == j else 1e-4)


def test_convection_is_exact_for_polynomials_on_a_wave():
    """For third degree inside, second degree at the last node, first degree next to the start."""
    n, h, slip = 12, 0.1, np.array([0.0, 3.0])
    x = h * np.arange(n)
    operator = convected_by(n, h, slip)
    for rows, degree in ((slice(2, -1), 3), (slice(-1, None), 2), (slice(1, 2), 1)):
        wave = np.exp(1j * np.outer(slip, x))
        result = np.einsum("mij,mj->mi", operator, wave * x**degree)
        expected = wave * degree * x ** (degree - 1)
        np.testing.assert_allclose(result[:, rows], expected[:, rows], atol=1e-12)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 1.5])
def test_halved_spacing_changes_little(zone: Zone, monkeypatch: pytest.MonkeyPatch, ratio: float):
    q = np.array([2.0, 8.0, 20.0, 50.0])
    coarse = at_inlet(zone, q, 0.5 * q, ratio)
    monkeypatch.setattr("pyehl.theory.inlet.SPACING", 0.5 * SPACING)
    np.testing.assert_allclose(at_inlet(zone, q, 0.5 * q, ratio), coarse, atol=0.012)


def test_inlet_passes_only_short_waves(zone: Zone):
    long = at_inlet(zone, np.array([0.5]), np.array([0.0]), 1.0)
    assert abs(long[0]) < 0.05
    q = np.array([100.0, 128.0])
    for ratio in (0.95, 1.0, 1.05):
        short = at_inlet(zone, q, 0.5 * q, ratio)
        np.testing.assert_allclose(short, upstream(zone, q, 0.5 * q, ratio), atol=0.06)


def test_waves_between_those_that_are_solved(zone: Zone):
    random = np.random.default_rng(3)
    q, angle = np.exp(random.uniform(0.5, 4.5, 40)), random.uniform(0.0, 0.5 * np.pi, 40)
    qx, qy = q * np.cos(angle), q * np.sin(angle)
    one = np.ones_like(zone.x)
    thinning = replace(
        zone, factors=FlowFactors(2.0 * one, 1.5 * one, 0.3 * one, 0.1 * one, 2.2 * one)
    )
    for contact, ratio in ((zone, 0.5), (zone, 1.5), (thinning, 1.5)):
        result = interpolated_inlet(contact, qx, qy, ratio)
        np.testing.assert_allclose(result, at_inlet(contact, qx, qy, ratio), atol=0.003)


@pytest.mark.parametrize("edge", [0.8, 1.2])
def test_the_transfer_goes_on_beyond_the_fitted_slip(zone: Zone, edge: float):
    """From the value at the edge of the range, and as the waves of `at_inlet`."""
    qx, qy = np.array([3.0, 10.0, 30.0]), np.array([0.0, 10.0, 5.0])
    at = inlet_transfer(zone, qx, qy, MOES, edge)
    further = edge + np.sign(edge - 1.0) * 1e-9
    np.testing.assert_allclose(inlet_transfer(zone, qx, qy, MOES, further), at, rtol=1e-6)
    far = 1.0 + 2.5 * (edge - 1.0)
    expected = at_inlet(zone, qx, qy, far) / at_inlet(zone, qx, qy, edge)
    np.testing.assert_allclose(inlet_transfer(zone, qx, qy, MOES, far) / at, expected, rtol=0.02)


def test_a_law_without_thinning_changes_nothing(zone: Zone):
    qx, qy = np.array([3.0, 10.0, 30.0]), np.array([0.0, 10.0, 5.0])
    same = inlet_transfer(replace(zone, newtonian=zone), qx, qy, MOES, 1.1)
    np.testing.assert_allclose(same, inlet_transfer(zone, qx, qy, MOES, 1.1), rtol=1e-12)


@pytest.mark.parametrize(
    ("moes", "count", "largest"),
    [
        ((100.0, 3.0), 4, 0.081),
        pytest.param(*((100.0, 20.0), 2, 0.064), marks=pytest.mark.long),
        pytest.param(*((200.0, 10.0), 4, 0.038), marks=pytest.mark.long),
        pytest.param(*((300.0, 12.0), 4, 0.033), marks=pytest.mark.long),
        pytest.param(*((500.0, 5.0), 4, 0.05), marks=pytest.mark.long),
        pytest.param(*((1000.0, 10.0), 4, 0.031), marks=pytest.mark.long),
        pytest.param(*((2000.0, 15.0), 4, 0.057), marks=pytest.mark.long),
        pytest.param(*((3000.0, 3.0), 2, 0.058), marks=pytest.mark.long),
        ((3000.0, 20.0), 2, 0.113),
    ],
)
def test_measured_waves_beyond_the_slip_of_the_fit(evidence, moes, count, largest):
    """T at X = 0 in slip.csv: its largest deviation; the prediction is that of this package."""
    slip = evidence("response", "slip")
    rows = slip.read()
    rows = rows[(rows[:, :2] == moes).all(1)]
    runs = np.unique(rows[:, 2:4], axis=0)
    assert len(runs) == count
    centre = rows[slip.compared(rows) & (rows[:, 6] == 0.0)]
    assert 0.8 * largest < slip.off(centre).max() < largest
    run = rows[(rows[:, 2:4] == runs[0]).all(1)]
    result = slip.predicted(run)
    np.testing.assert_allclose(result, run[:, 9] + 1j * run[:, 10], atol=2e-3)
