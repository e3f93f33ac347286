# SPDX-License-Identifier: BSD-3-Clause
"""Limits of the response of a contact to one wave, and the pressure of a wave on a disc."""

import csv
import json
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from document_text import plain

from pyehl.theory import disc
from pyehl.theory.response import GAIN, fitted_range, inlet_fit, inlet_transfer
from pyehl.theory.transport import INLET, Zone, stiffness, transport, upstream

STATIONS = np.array([-0.5, 0.0, 0.5])


def zone(*, compressibility: float = 0.04, conductance: float = 1e-9) -> Zone:
    x = np.linspace(-1.0, 1.0, 81)
    pressure = np.sqrt(1.0 - x * x)
    same = np.ones_like(x)
    density = np.exp(compressibility * pressure)
    values = compressibility * same, 0.0 * same, 15.0 * same, conductance * same
    return Zone(x, pressure, 0.025 * same, density, *values)


def response(contact: Zone, qx: np.ndarray, qy: np.ndarray, ratio: float = 1.01) -> np.ndarray:
    """T at the stations, (m, 3)."""
    inlet = inlet_transfer(contact, qx, qy, (1000.0, 10.0), ratio)
    parts = transport(contact, qx, qy, ratio, STATIONS)
    turned = [np.exp(1j * qx * (ratio - 1.0) * (x + 1.0)) for x in STATIONS]
    pairs = zip(parts, turned, strict=True)
    return np.stack([driven + free * inlet * turn for (driven, free), turn in pairs], axis=1)


def test_short_waves_pass_undeformed_and_long_ones_not_at_all():
    angle = np.radians([0.0, 30.0, 60.0, 90.0])
    for wavelength, limit, tolerance in ((1e-4, 1.0, 0.02), (300.0, 0.0, 0.002)):
        q = 2.0 * np.pi / wavelength
        t = response(zone(), q * np.cos(angle), q * np.sin(angle), 1.0)
        assert np.abs(t - limit).max() < tolerance
    # between them |T| falls with the wavelength, in every direction, except for the very shortest
    q = 2.0 * np.pi / np.geomspace(0.05, 4.0, 30)
    for one in angle:
        t = np.abs(inlet_fit(q * np.cos(one), q * np.sin(one), (1000.0, 10.0), 1.0))
        top = int(np.argmax(t))
        assert top < 6
        assert np.all(np.diff(t[top:]) < 0.0)


@pytest.mark.parametrize("ratio", [0.8, 1.0, 1.2])
def test_ridges_along_the_motion_do_not_move(ratio: float):
    qy = 2.0 * np.pi / np.array([2.0, 1.0, 0.25])
    none = np.zeros_like(qy)
    t = response(zone(), none, qy, ratio)
    assert np.abs(t.imag).max() < 1e-14
    # and do not depend on the velocity of the surface
    assert t == pytest.approx(response(zone(), none, qy, 1.0), abs=1e-12)


def test_wave_of_a_stiff_lubricant_moves_at_the_mean_velocity():
    stiff = zone(compressibility=0.0, conductance=1e-20)
    qx, qy = np.array([3.0, 12.0, 50.0]), np.array([2.0, 0.0, 30.0])
    for ratio in (0.9, 1.0, 1.1):
        t = response(stiff, qx, qy, ratio)
        turn = np.exp(1j * np.outer(qx * (ratio - 1.0), STATIONS))
        assert t == pytest.approx(t[:, 1:2] * turn, abs=1e-12)


def test_compressibility_keeps_part_of_the_wave_on_the_roughness():
    qx, none = np.array([40.0]), np.zeros(1)
    (driven, _), _, _ = transport(zone(conductance=1e-20), qx, none, 1.3, STATIONS)
    c = stiffness(qx) * 0.025 * 0.04
    assert driven == pytest.approx(c / (1.0 + c), rel=1e-9)


def uniform(*, film: float = 0.03, conductance: float = 2e-4) -> Zone:
    """Uniform film, pressure and lubricant: C and the leakage enter, no gradient does."""
    x = np.linspace(-1.0, 1.0, 9)
    same = np.ones_like(x)
    return Zone(x, same, film * same, same, 0.05 * same, 0.0 * same, same, conductance * same)


def test_leaking_lubricant_does_not_deform_the_wave():
    # free waves decay as exp(-k_Y X)
    qx = np.array([100.0, 200.0])
    parts = transport(uniform(conductance=1e3), 0.5 * qx, qx, 1.01, STATIONS)
    assert [free == pytest.approx(0.0, abs=1e-12) for _, free in parts] == [True] * 3
    assert all(driven == pytest.approx(1.0, abs=1e-3) for driven, _ in parts)


def test_transport_of_ridges_in_a_uniform_contact_is_the_closed_form():
    qy = np.array([9.0, 25.0])
    c = stiffness(qy) * 0.03 * 0.05
    # mu' = leak (1 - mu) + spread mu''
    spread = 2e-4 * stiffness(qy) / (1.0 + c)
    leak = spread * qy**2
    rate = (np.sqrt(1.0 + 4.0 * spread * leak) - 1.0) / (2.0 * spread)
    parts = transport(uniform(), 0.0 * qy, qy, 1.1, STATIONS)
    for (driven, free), station in zip(parts, STATIONS, strict=True):
        left = np.exp(-rate * (station - INLET))
        assert driven == pytest.approx((c + 1.0 - left) / (1.0 + c), rel=1e-10)
        assert free == pytest.approx(left / (1.0 + c), rel=1e-10)


@pytest.mark.parametrize("ratio", [0.8, 1.0, 1.1])
def test_free_wave_in_a_uniform_contact_obeys_the_linearised_equation(ratio: float):
    """T = exp(r X) in the equation of the head of the module: a polynomial in r."""
    qx, qy, e, held = np.array([9.0, 25.0]), np.array([4.0, 0.0]), 2e-5, 0.03 * 0.05
    parts = transport(uniform(conductance=e), qx, qy, ratio, STATIONS)
    slip = qx * (ratio - 1.0)
    for i in range(qx.size):
        q2 = qx[i] ** 2 + qy[i] ** 2
        k = float(stiffness(np.sqrt(q2)))
        pressure = np.array([1j * k * qx[i] / q2, -k])
        mass = np.polysub([1.0], held * pressure)
        change = np.polymul([1.0, -1j * slip[i]], mass)
        flow = np.polymul([-e, -2j * qx[i] * e, e * q2], pressure)
        roots = np.roots(np.polysub(change, flow))
        r = roots[np.argmin(np.abs(roots - 1j * slip[i]))]
        assert r.real < -0.005
        for before, after in ((0, 1), (1, 2)):
            way = STATIONS[after] - STATIONS[before]
            grown = parts[after][1][i] / parts[before][1][i] * np.exp(1j * slip[i] * way)
            assert grown == pytest.approx(np.exp(r * way), abs=2e-3)


def test_flow_of_the_contact_turns_a_leaking_wave():
    """Where the film thins along the motion the pressure wave is not that of a uniform film."""
    x = np.linspace(-1.0, 1.0, 81)
    same = np.ones_like(x)
    qx, turned = np.array([15.0]), []
    for rising in (0.0, 0.2):
        thinner = 1e-3 * np.exp(-10.0 * rising * x)
        values = 0.05 * same, 0.0 * same, 10.0 * same, thinner
        contact = Zone(x, rising * x, 0.03 * same, same, *values)
        turned.append(np.array(transport(contact, qx, 0.0 * qx, 1.0, STATIONS))[:, :, 0].sum(1))
    uniform_film, thinning = turned
    # both parts add up to the roughness where there is no pressure
    assert uniform_film == pytest.approx(1.0, abs=1e-9)
    assert np.abs(thinning - 1.0).min() > 0.01


def test_cells_of_a_grid_are_stiffer():
    qx, none = np.array([20.0]), np.zeros(1)
    stiff = zone(conductance=1e-20)
    for spacing in (1.0 / 32.0, 1.0 / 64.0):
        (driven, _), _, _ = transport(stiff, qx, none, 1.0, STATIONS, spacing)
        c = stiffness(qx) * 0.025 * 0.04 / np.sinc(qx * spacing / (2.0 * np.pi))
        assert driven == pytest.approx(c / (1.0 + c), rel=1e-9)


def test_inlet_without_slip_or_leak_passes_the_wave():
    qx, qy = np.array([9.0, 60.0]), np.array([4.0, 0.0])
    # without leakage the wave is that of the undeformed roughness, where the film is not compressed
    stiff = zone(compressibility=0.0, conductance=0.0)
    assert upstream(stiff, qx, qy, 1.0) == pytest.approx(1.0, abs=1e-12)
    # nothing changes along the motion: ridges leak until the film is undeformed
    assert upstream(uniform(), 0.0 * qx, qx, 1.1) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("ratio", [0.8, 1.0, 1.2])
def test_wave_follows_the_roughness_until_the_leak_ends(ratio: float):
    """The leakage falls from far above the slip to zero at X = e: |B| = 1, free from e on."""
    x = np.linspace(-1.5, 1.0, 2001)
    same, end = np.ones_like(x), -0.95
    leak = 1e-2 * np.exp(-np.maximum(x - end, 0.0) / 1e-3)
    contact = Zone(x, 0.0 * x, 0.03 * same, same, 0.0 * x, 0.0 * x, 0.0 * x, leak)
    qx = np.array([20.0, 60.0])
    made = upstream(contact, qx, 0.0 * qx, ratio)
    assert made == pytest.approx(np.exp(-1j * qx * (ratio - 1.0) * (end + 1.0)), abs=0.1)


def cell(dx: np.ndarray, dy: np.ndarray, h: float) -> np.ndarray:
    """Integral of 1/r over a square cell of side h."""
    total = np.zeros(np.broadcast(dx, dy).shape)
    for i in (-0.5, 0.5):
        for j in (-0.5, 0.5):
            x, y = dx + i * h, dy + j * h
            r = np.hypot(x, y)
            total += 4.0 * i * j * (x * np.log(y + r) + y * np.log(x + r))
    return total


def test_pressure_of_a_wave_on_the_disc_is_that_of_a_dense_system():
    h = 2.0 / 45.0
    line = (np.arange(45) - 22.0) * h + 1e-9
    x, y = (values.ravel() for values in np.meshgrid(line, line, indexing="ij"))
    inside = np.hypot(x, y) < 1.0
    x, y = x[inside], y[inside]
    qx, qy = np.array([2.0, 5.0]), np.array([1.0, 0.0])
    wave = np.exp(1j * (np.outer(x, qx) + np.outer(y, qy)))
    n = x.size
    system = np.ones((n + 1, n + 1))
    system[:n, :n] = 2.0 / np.pi**2 * cell(x[:, None] - x, y[:, None] - y, h)
    system[n, n] = 0.0
    # the last unknown is the approach of the bodies, the last equation: zero load
    result = np.linalg.solve(system, np.vstack([wave, np.zeros((1, 2))]))[:n]
    middle = np.hypot(x, y) < 0.7
    terms = disc.monomials(x[middle], y[middle]) @ disc.disc_correction(qx, qy)
    closed = 0.25 * np.pi * np.hypot(qx, qy) * wave[middle] + terms
    size = np.abs(closed).max(axis=0)
    # first order in the cell at the edge, where the pressure is singular; and a truncated series
    assert np.abs(result[middle] - closed).max(axis=0) / size == pytest.approx(0.0, abs=0.03)


@pytest.fixture(scope="module")
def evidence(script: Callable[[str], ModuleType]) -> ModuleType:
    """The script that fits the response."""
    return script("docs/evidence/response/fit.py")


@pytest.mark.long
def test_coefficients_are_the_fit_to_the_measured_waves(
    evidence: ModuleType, root: Path, monkeypatch: pytest.MonkeyPatch
):
    everything = evidence.read()
    data = everything.chosen(evidence.select(everything))
    result = evidence.fit(data)
    shipped = json.loads((root / "pyehl" / "theory" / "response.json").read_text())
    anew = result.as_json()
    assert {k: shipped[k] for k in ("range", "parameter", "slope")} == {
        k: anew[k] for k in ("range", "parameter", "slope")
    }
    # the coefficients of many terms are similar, so T is compared and not they
    q = 2.0 * np.pi / np.geomspace(0.03, 3.0, 15)
    values = []
    for fitted in (shipped, anew):
        monkeypatch.setattr("pyehl.theory.response.stored_fit", lambda fitted=fitted: fitted)
        values.append(
            [
                inlet_fit(q * np.cos(a), q * np.sin(a), (m, ell), u)
                for a in (0.0, 0.7, 1.5)
                for m, ell, u in ((1000.0, 10.0, 1.01), (300.0, 15.0, 0.9), (2000.0, 5.0, 1.2))
            ]
        )
    assert np.array(values[0]) == pytest.approx(np.array(values[1]), abs=1e-3)
    # and the table of residuals is that of this fit
    with (Path(evidence.HERE) / "residuals.csv").open() as stream:
        stored = list(csv.reader(stream))[1:]
    for old, new in zip(stored, evidence.table(result, data), strict=True):
        assert old[:4] == new[:4]
        assert float(old[4]) <= 0.02, old
        assert [float(v) for v in old[4:]] == pytest.approx([float(v) for v in new[4:]], abs=1e-3)


def test_response_is_that_of_measured_waves(evidence: ModuleType):
    """T = driven + free F at all X, of waves of a/8 to a/32 at velocity ratios from 0.8 to 1.2."""
    everything = evidence.read()
    data = everything.chosen(evidence.select(everything) & (everything.points == 1025.0))
    runs = np.unique(np.stack([data.m, data.l, data.ratio], axis=1), axis=0)
    assert len(runs) == 22
    for m, ell, ratio in runs:
        waves = data.chosen((data.m == m) & (data.l == ell) & (data.ratio == ratio))
        fitted = inlet_fit(waves.kx, waves.ky, (m, ell), ratio)[:, np.newaxis]
        left = waves.driven + waves.free * fitted - waves.t
        assert np.abs(left).max() <= 0.02, (m, ell, ratio)


def test_gain_of_oblique_waves_is_that_of_the_measured_pressures(
    script: Callable[[str], ModuleType], root: Path
):
    """Waves too short for the edge of the disc, 513 x 513 nodes, M >= 200."""
    gain = script("docs/evidence/response/gain.py")
    waves = gain.read()
    assert np.abs(gain.residual(waves, gain.fit(waves)) - gain.residual(waves, GAIN)).max() < 2e-4
    left = gain.residual(waves, GAIN)
    points = {(m, ell) for m, ell in waves[:, :2]}
    assert len(points) >= 15
    each = [left[(waves[:, 0] == m) & (waves[:, 1] == ell)] for m, ell in points]
    rms = [float(np.sqrt(np.mean(np.square(here)))) for here in each]
    text = plain(root / "docs/evidence/response/README.md")
    assert f"rms residuals of {min(rms):.3f} to {max(rms):.3f} at the operating points" in text
    assert max(rms) <= 0.011
    assert max(np.abs(here).max() for here in each) <= 0.051


def test_range_of_the_fit_is_that_of_the_data(evidence: ModuleType):
    data = evidence.read()
    for name, values in (("moes_m", data.m), ("moes_l", data.l), ("velocity_ratio", data.ratio)):
        assert fitted_range()[name] == [values.min(), values.max()]
