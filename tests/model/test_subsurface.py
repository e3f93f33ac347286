# SPDX-License-Identifier: BSD-3-Clause
"""Stress below the surface against closed forms: half-space, invariants, fatigue and life."""

import math

import numpy as np
import pytest

import pyehl
from pyehl.subsurface import cycle
from pyehl.subsurface.cycle import (
    Cycle,
    Fatigue,
    deviator,
    hydrostatic,
    octahedral_shear,
    principal_shear,
    smallest_sphere,
    von_mises,
)
from pyehl.subsurface.half_space import HalfSpace
from pyehl.subsurface.passage import depths
from pyehl.types import Array

POINTS = 257
X = np.linspace(-2.5, 1.5, POINTS)
"""The domain of the solver [a]."""


def hertz(ratio: float = 1.0) -> tuple[tuple[float, float], Array]:
    """Mesh and pressure [p_h] of an ellipse whose semi-axis across is `ratio` times that along."""
    y = np.linspace(-2.0 * ratio, 2.0 * ratio, POINTS)
    radius = np.hypot(X[:, np.newaxis], y[np.newaxis, :] / ratio)
    mesh = float(X[1] - X[0]), float(y[1] - y[0])
    return mesh, np.sqrt(np.maximum(0.0, 1.0 - radius**2))


def largest(half_space: HalfSpace, pressure: Array, places: Array) -> tuple[float, float]:
    """Largest principal shear and its depth, by a parabola through three depths."""
    shear = [principal_shear(half_space.layer(z).under(pressure)).max() for z in places]
    k = int(np.argmax(shear))
    a, b, c = np.polyfit(places[k - 1 : k + 2], shear[k - 1 : k + 2], 2)
    return float(c - b * b / (4.0 * a)), float(-b / (2.0 * a))


def test_axis_of_a_circle() -> None:
    """Johnson 1985, eq. 3.45; the stated error covers the deviation."""
    mesh, pressure = hertz()
    half_space, middle = HalfSpace(pressure.shape, mesh), POINTS // 2
    i = int(np.abs(X).argmin())
    for z in (0.0, 0.05, 0.48, 1.0, 3.0):
        layer = half_space.layer(z)
        stress = layer.under(pressure)[:, i, middle]
        angle = math.atan2(1.0, z)
        radial = -1.3 * (1.0 - z * angle) + 0.5 / (1.0 + z * z)
        exact = [radial, radial, -1.0 / (1.0 + z * z), 0.0, 0.0, 0.0]
        off = float(np.abs(stress - exact).max())
        assert off < 5e-4
        assert off < layer.error(pressure) < 0.005


def test_shear_below_a_circle() -> None:
    """Largest shear 0.310 p_h at 0.481 a for nu = 0.3 (Johnson 1985, section 4.2)."""
    mesh, pressure = hertz()
    half_space = HalfSpace(pressure.shape, mesh)
    value, depth = largest(half_space, pressure, np.linspace(0.4, 0.56, 5))
    assert value == pytest.approx(0.3100, rel=1e-3)
    assert depth == pytest.approx(0.481, abs=0.003)


# Johnson 1985, table 4.1, nu = 0.3: short over long semi-axis, depth over the short one, shear over
# p_h; to three digits, the depth to 0.01
TABLE = [(0.2, 0.745, 0.322), (0.4, 0.665, 0.325), (0.6, 0.590, 0.323), (0.8, 0.530, 0.317)]


@pytest.mark.parametrize(("sides", "depth", "shear"), TABLE)
def test_shear_below_ellipses(sides: float, depth: float, shear: float) -> None:
    mesh, pressure = hertz(1.0 / sides)
    half_space = HalfSpace(pressure.shape, mesh)
    value, place = largest(half_space, pressure, depth + np.linspace(-0.12, 0.12, 5))
    assert value == pytest.approx(shear, rel=5e-3)
    assert place == pytest.approx(depth, abs=0.01)


def line() -> tuple[HalfSpace, Array]:
    """A line contact: the load repeats itself along y."""
    pressure = np.sqrt(np.maximum(0.0, 1.0 - X**2))[:, np.newaxis] * np.ones(4)
    return HalfSpace((POINTS, 4), (X[1] - X[0], 0.1), periodic=(False, True)), pressure


def test_line_contact() -> None:
    """0.300 p_h at 0.786 b; orthogonal shear 0.250 p_h at 0.5 b and x = 0.866 b (Johnson, 4.1)."""
    half_space, pressure = line()
    value, depth = largest(half_space, pressure, np.linspace(0.7, 0.86, 5))
    assert value == pytest.approx(0.3003, rel=2e-3)
    assert depth == pytest.approx(0.786, abs=0.003)
    orthogonal = half_space.layer(0.5).under(pressure)[4][:, 0]
    assert orthogonal.max() == pytest.approx(0.25, rel=2e-3)
    assert orthogonal.min() == pytest.approx(-0.25, rel=2e-3)
    assert abs(X[orthogonal.argmax()]) == pytest.approx(math.sqrt(3.0) / 2.0, abs=X[1] - X[0])


@pytest.mark.parametrize(("friction", "on_surface"), [(0.2, False), (0.3, True), (0.4, True)])
def test_high_friction_moves_the_maximum_shear_to_the_surface(
    friction: float, *, on_surface: bool
) -> None:
    """From a coefficient of about 0.3 on, under a line; there it is at least the friction."""
    half_space, pressure = line()
    places = np.concatenate([[0.0], np.geomspace(0.01, 1.5, 30)])
    shear = [
        principal_shear(half_space.layer(z).under(pressure, friction * pressure)).max()
        for z in places
    ]
    assert (int(np.argmax(shear)) == 0) is on_surface
    assert max(shear) > max(0.3, friction)


@pytest.mark.parametrize("z", [0.02, 0.05, 0.1, 0.5, 1.5])
def test_line_contact_with_friction(z: float) -> None:
    """All components by McEwen's closed form (Johnson 1985, eqs 4.49 and 7.8), mu = 0.3.

    The pressure of a node is the mean over its cell, as for the deflections of the solver.
    """
    half_space, _ = line()
    mu, ends = 0.3, np.clip(np.append(X, 2.0 * X[-1] - X[-2]) - 0.5 * (X[1] - X[0]), -1.0, 1.0)
    integral = 0.5 * (ends * np.sqrt(1.0 - ends**2) + np.arcsin(ends))
    pressure = (np.diff(integral) / (X[1] - X[0]))[:, np.newaxis] * np.ones(4)
    stress = half_space.layer(z).under(pressure, mu * pressure)[:, :, 0]
    square = 1.0 - X**2 + z**2
    root = np.sqrt(square**2 + 4.0 * X**2 * z**2)
    m = np.sqrt(0.5 * (root + square))
    n = np.sign(X) * np.sqrt(np.maximum(0.5 * (root - square), 0.0))
    share = (z**2 + n**2) / (m**2 + n**2)
    along = -(m * (1.0 + share) - 2.0 * z)
    normal = -m * (1.0 - share)
    shear = -n * (m**2 - z**2) / (m**2 + n**2)
    by_traction = n * (2.0 - (z**2 - m**2) / (m**2 + n**2)) - 2.0 * X
    exact = {0: along + mu * by_traction, 2: normal + mu * shear, 4: shear + mu * along}
    for component, values in exact.items():
        assert np.abs(stress[component] - values).max() < 0.005
    top = np.hypot(0.5 * (exact[0] - exact[2]), exact[4]).max()
    result = np.hypot(0.5 * (stress[0] - stress[2]), stress[4]).max()
    assert result == pytest.approx(top, rel=5e-3)


def test_depths_follow_the_waves() -> None:
    """The first depth is 0.4 over the highest wavenumber; the layer of 1/k has rows around it."""
    mesh, pressure = hertz()
    # without the waves near the edge
    pressure = pressure**6
    smooth = depths(pressure, mesh, 1.0)
    for k in (20.0, 60.0):
        wavy = pressure * (1.0 + 0.1 * np.cos(k * X)[:, np.newaxis])
        result = depths(wavy, mesh, 1.0)
        assert result[0] == 0.0
        assert result[1] == pytest.approx(0.4 / k, rel=0.25)
        assert result[1] < smooth[1]
        assert np.count_nonzero((result > 0.4 / k) & (result < 2.5 / k)) >= 6
        # geometric, down to three half widths
        assert result[2:] / result[1:-1] == pytest.approx(result[2] / result[1])
        assert result[2] / result[1] <= 1.3
        assert result[-1] == pytest.approx(3.0)


@pytest.mark.parametrize("along", [True, False])
def test_wave(along: bool) -> None:
    """Under p cos(q x) the shear is p q z exp(-q z), largest p/e at z = 1/q (Johnson, 13.2)."""
    n, q = 64, 3
    angle = 2.0 * np.pi * q * np.arange(n) / n
    wave = np.cos(angle)[:, np.newaxis] * np.ones(n)
    pressure = wave if along else wave.T
    half_space = HalfSpace((n, n), (2.0 * np.pi / n,) * 2, periodic=(True, True))
    for z in (0.1, 1.0 / q, 1.0):
        stress = half_space.layer(z).under(pressure)
        normal, shear = (stress[0], stress[4]) if along else (stress[1], stress[5])
        in_plane = np.hypot(0.5 * (normal - stress[2]), shear)
        assert in_plane == pytest.approx(q * z * math.exp(-q * z), rel=1e-10)
    assert half_space.layer(1.0).error(pressure) == 0.0


def test_traction_of_waves() -> None:
    """Equilibrium and the traction on the surface, for waves in any direction."""
    n, mesh = 48, 2.0 * np.pi / 48
    x = mesh * np.arange(n)
    phase = 2.0 * x[:, np.newaxis] + 3.0 * x[np.newaxis, :]
    pressure, traction = np.cos(phase), 0.4 * np.sin(phase + 0.3)
    half_space = HalfSpace((n, n), (mesh, mesh), periodic=(True, True))
    top = half_space.layer(0.0).under(pressure, traction)
    assert top[2] == pytest.approx(-pressure, abs=1e-12)
    assert top[4] == pytest.approx(-traction, abs=1e-12)
    assert top[5] == pytest.approx(0.0, abs=1e-12)
    z, step = 0.3, 1e-5
    here, above, below = (
        half_space.layer(depth).under(pressure, traction) for depth in (z, z - step, z + step)
    )

    def derivative(values: Array, axis: int) -> Array:
        k = 1j * np.fft.fftfreq(n, 1.0 / n)
        shape = (n, 1) if axis == 0 else (1, n)
        return np.real(np.fft.ifft(k.reshape(shape) * np.fft.fft(values, axis=axis), axis=axis))

    for a, b, c in ((0, 3, 4), (3, 1, 5), (4, 5, 2)):
        balance = derivative(here[a], 0) + derivative(here[b], 1)
        balance += (below[c] - above[c]) / (2.0 * step)
        assert balance == pytest.approx(0.0, abs=1e-8)


def test_invariants() -> None:
    """Against the eigenvalues of random tensors, and a state without shear."""
    stress = np.random.default_rng(7).normal(size=(6, 500))
    xx, yy, zz, xy, xz, yz = stress
    tensors = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1)
    values = np.linalg.eigvalsh(tensors)
    assert principal_shear(stress) == pytest.approx(0.5 * (values[:, 2] - values[:, 0]), rel=1e-9)
    assert hydrostatic(stress) == pytest.approx(values.mean(axis=1))
    differences = np.array([values[:, i] - values[:, j] for i, j in ((0, 1), (1, 2), (2, 0))])
    mises = np.sqrt(0.5 * (differences**2).sum(axis=0))
    assert von_mises(stress) == pytest.approx(mises, rel=1e-12)
    assert octahedral_shear(stress) == pytest.approx(math.sqrt(2.0) / 3.0 * mises, rel=1e-12)
    even = np.array([-2.0, -2.0, -2.0, 0.0, 0.0, 0.0])[:, np.newaxis]
    assert principal_shear(even) == pytest.approx(0.0)


def test_fatigue_limits_are_met_by_their_own_tests() -> None:
    """Fully reversed torsion and bending at their limits both give the limit."""
    time = np.linspace(0.0, 2.0 * np.pi, 73)
    torsion, bending = np.zeros((6, 73, 1)), np.zeros((6, 73, 1))
    torsion[3, :, 0], bending[0, :, 0] = 300.0 * np.sin(time), 450.0 * np.sin(time)
    for criterion in ("dang-van", "crossland"):
        result = Fatigue(criterion, 300.0, 450.0)
        for history in (torsion, bending):
            assert result.largest(Cycle.of(history, result.weight)) == pytest.approx(
                300.0, rel=1e-3
            )
    with pytest.raises(pyehl.InputError, match="torsion_limit/bending_limit"):
        Fatigue("dang-van", 100.0, 450.0)


def test_smallest_sphere() -> None:
    """For a regular simplex the circumscribed sphere; for out-of-phase shear its circle."""
    time = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False)
    path = np.zeros((6, 60, 2))
    path[3, :, 0], path[4, :, 0] = 2.0 + np.cos(time), np.sin(time)
    corner = np.arange(60) % 3 * 2.0 * np.pi / 3.0
    path[3, :, 1], path[5, :, 1] = np.cos(corner), np.sin(corner)
    centre, radius = smallest_sphere(path)
    assert radius == pytest.approx([1.0, 1.0], rel=0.01)
    assert centre[3] == pytest.approx([2.0, 0.0], abs=0.02)
    assert deviator(path) == pytest.approx(path)


@pytest.mark.parametrize("bearing", cycle.BEARINGS)
def test_life_factor(bearing: str) -> None:
    """Continuous over kappa, larger for thicker films and cleaner oil, at most 50."""
    for kappa in (0.4, 1.0):
        below, above = (cycle.a_iso(kappa * f, 0.3, bearing) for f in (1.0 - 1e-9, 1.0 + 1e-9))
        assert below == pytest.approx(above, rel=1e-3)
    assert cycle.a_iso(2.0, 0.3, bearing) > cycle.a_iso(1.0, 0.3, bearing) > 0.1
    assert cycle.a_iso(1.0, 0.5, bearing) > cycle.a_iso(1.0, 0.1, bearing)
    assert cycle.a_iso(4.0, 5.0, bearing) == cycle.MAX_A_ISO == cycle.a_iso(9.0, 5.0, bearing)
    assert math.isnan(cycle.a_iso(0.05, 0.3, bearing))
