# SPDX-License-Identifier: BSD-3-Clause
"""Limits of the response of a contact to one wave, and the pressure of a wave on a disc."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from pyehl.theory import disc
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import (
    INLET,
    Zone,
    edge_gain,
    fitted_range,
    inlet_transfer,
    stiffness,
    transport,
)

STATIONS = np.array([-0.5, 0.0, 0.5])
# Of a measured T: what the fit leaves, see docs/evidence/response
RESIDUAL = 0.025


def zone(*, compressibility: float = 0.04, conductance: float = 1e-9) -> Zone:
    x = np.linspace(-1.0, 1.0, 81)
    pressure = np.sqrt(1.0 - x * x)
    same = np.ones_like(x)
    density = np.exp(compressibility * pressure)
    return Zone(x, 0.025 * same, density, compressibility * same, conductance * same)


def response(contact: Zone, qx: np.ndarray, qy: np.ndarray, ratio: float = 1.01) -> np.ndarray:
    """T at the stations, (m, 3)."""
    inlet = inlet_transfer(qx, qy, 1000.0, 10.0, ratio)
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
    # between them |T| falls with the wavelength, in every direction; of the shortest waves, as
    # measured on 1025 x 1025 nodes, the inlet leaks a little
    q = 2.0 * np.pi / np.geomspace(0.05, 4.0, 30)
    for one in angle:
        t = np.abs(inlet_transfer(q * np.cos(one), q * np.sin(one), 1000.0, 10.0, 1.0))
        top = int(np.argmax(t))
        assert top < 6
        assert np.all(np.diff(t[top:]) < 0.0)
        assert t[: top + 1].min() > t[top] - 0.015


@pytest.mark.parametrize("ratio", [0.8, 1.0, 1.2])
def test_ridges_along_the_motion_do_not_move(ratio: float):
    qy = 2.0 * np.pi / np.array([2.0, 1.0, 0.25])
    none = np.zeros_like(qy)
    t = response(zone(), none, qy, ratio)
    assert np.abs(t.imag).max() < 1e-14
    # nor do they know how fast the surface is, but for what the fit makes of it
    assert t == pytest.approx(response(zone(), none, qy, 1.0), abs=RESIDUAL)


def test_stiff_lubricant_carries_the_wave_at_the_mean_velocity():
    stiff = zone(compressibility=0.0, conductance=1e-20)
    qx, qy = np.array([3.0, 12.0, 50.0]), np.array([2.0, 0.0, 30.0])
    for ratio in (0.9, 1.0, 1.1):
        t = response(stiff, qx, qy, ratio)
        turn = np.exp(1j * np.outer(qx * (ratio - 1.0), STATIONS))
        assert t == pytest.approx(t[:, 1:2] * turn, abs=1e-12)


def test_compressible_lubricant_leaves_a_part_with_the_roughness():
    qx, none = np.array([40.0]), np.zeros(1)
    (driven, _), _, _ = transport(zone(conductance=1e-20), qx, none, 1.3, STATIONS)
    c = stiffness(qx) * 0.025 * 0.04
    assert driven == pytest.approx(c / (1.0 + c), rel=1e-9)


def test_leaking_lubricant_does_not_deform_the_wave():
    qx = np.array([10.0, 40.0])
    parts = transport(zone(conductance=1e3), qx, np.zeros(2), 1.01, STATIONS)
    assert [free == pytest.approx(0.0, abs=1e-12) for _, free in parts] == [True] * 3
    # the density at the station is not yet that of the film a step before
    assert all(driven == pytest.approx(1.0, abs=2e-3) for driven, _ in parts)


def test_transport_of_constant_coefficients_is_the_closed_form():
    x = np.linspace(-1.0, 1.0, 9)
    same = np.ones_like(x)
    # rho is 1, so that nothing but C and the leak D enters
    contact = Zone(x, 0.03 * same, same, 0.05 * same, 2e-4 * same)
    qx, qy, ratio = np.array([9.0, 25.0]), np.array([4.0, 0.0]), 1.1
    q = np.hypot(qx, qy)
    c = stiffness(q) * 0.03 * 0.05
    leak = 2e-4 * q**2 * stiffness(q) / (1.0 + c)
    rate = 1j * qx * (ratio - 1.0) - leak
    for (driven, free), station in zip(
        transport(contact, qx, qy, ratio, STATIONS), STATIONS, strict=True
    ):
        way = station - INLET
        made = leak * (np.exp(rate * way) - 1.0) / rate
        assert driven == pytest.approx((c + made) / (1.0 + c), rel=1e-10)
        assert free == pytest.approx(np.exp(-leak * way) / (1.0 + c), rel=1e-10)


def test_cells_of_a_grid_are_stiffer():
    qx, none = np.array([20.0]), np.zeros(1)
    stiff = zone(conductance=1e-20)
    for spacing in (1.0 / 32.0, 1.0 / 64.0):
        (driven, _), _, _ = transport(stiff, qx, none, 1.0, STATIONS, spacing)
        c = stiffness(qx) * 0.025 * 0.04 / np.sinc(qx * spacing / (2.0 * np.pi))
        assert driven == pytest.approx(c / (1.0 + c), rel=1e-9)


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
    # the last unknown is the approach of the bodies, the last equation: no load
    found = np.linalg.solve(system, np.vstack([wave, np.zeros((1, 2))]))[:n]
    middle = np.hypot(x, y) < 0.7
    closed = disc.disc_pressure(qx, qy, x[middle], y[middle])
    size = np.abs(closed).max(axis=0)
    # first order in the cell at the edge, where the pressure is singular
    assert np.abs(found[middle] - closed).max(axis=0) / size == pytest.approx(0.0, abs=0.03)
    terms = disc.monomials(x[middle], y[middle]) @ disc.disc_correction(qx, qy)
    periodic = 0.25 * np.pi * np.hypot(qx, qy) * wave[middle]
    assert np.abs(periodic + terms - closed).max(axis=0) / size == pytest.approx(0.0, abs=0.015)


def test_pressure_of_a_wave_on_the_disc_carries_no_load():
    # Gauss points in z = sqrt(1 - r^2) and equal angles: dx dy = z dz dtheta
    nodes, weights = np.polynomial.legendre.leggauss(40)
    z, weights = 0.5 * (nodes + 1.0), 0.5 * weights
    theta = np.arange(48) * 2.0 * np.pi / 48
    r = np.sqrt(1.0 - z * z)
    x, y = (np.outer(r, f(theta)).ravel() for f in (np.cos, np.sin))
    pressure = disc.disc_pressure(np.array([3.0]), np.array([4.0]), x, y)[:, 0]
    share = np.repeat(weights * z, theta.size)
    assert abs((pressure * share).sum()) < 1e-10 * np.abs(pressure * share).sum()


@pytest.fixture(scope="module")
def evidence(script: Callable[[str], ModuleType]) -> ModuleType:
    """The script that fits the response."""
    return script("docs/evidence/response/fit.py")


def test_coefficients_are_the_fit_to_the_measured_waves(
    evidence: ModuleType, root: Path, monkeypatch: pytest.MonkeyPatch
):
    everything = evidence.read()
    data = everything.chosen(evidence.select(everything))
    found = evidence.fit(data)
    shipped = json.loads((root / "pyehl" / "theory" / "response.json").read_text())
    anew = found.as_json()
    assert {k: shipped[k] for k in ("range", "parameter", "slope", "oblique")} == {
        k: anew[k] for k in ("range", "parameter", "slope", "oblique")
    }
    # the coefficients of many terms are alike, so T is compared and not they
    q = 2.0 * np.pi / np.geomspace(0.03, 3.0, 15)
    values = []
    for fitted in (shipped, anew):
        monkeypatch.setattr("pyehl.theory.response._fit", lambda fitted=fitted: fitted)
        values.append(
            [
                inlet_transfer(q * np.cos(a), q * np.sin(a), m, ell, u)
                for a in (0.0, 0.7, 1.5)
                for m, ell, u in ((1000.0, 10.0, 1.01), (300.0, 15.0, 0.9), (2000.0, 5.0, 1.2))
            ]
        )
    assert np.array(values[0]) == pytest.approx(np.array(values[1]), abs=1e-3)
    # and the table of residuals is of this fit
    with (Path(evidence.HERE) / "residuals.csv").open() as stream:
        stored = list(csv.reader(stream))[1:]
    for old, new in zip(stored, evidence.table(found, data), strict=True):
        assert old[:4] == new[:4]
        assert [float(v) for v in old[4:]] == pytest.approx([float(v) for v in new[4:]], abs=1e-3)


def test_gain_of_oblique_waves_is_that_of_the_measured_pressures(evidence: ModuleType):
    """Waves too short for the edge of the disc, 513 x 513 nodes, M >= 200."""
    lines = (Path(evidence.HERE) / "waves.csv").read_text().splitlines()
    deviations: dict[tuple[float, float], list[float]] = {}
    for row in csv.DictReader(line for line in lines if not line.startswith("#")):
        moes = float(row["moes_m"]), float(row["moes_l"])
        kx, ky = float(row["kx"]), float(row["ky"])
        if row["points"] != "513" or float(row["x"]) or moes[0] < 200 or np.hypot(kx, ky) < 14:
            continue
        point = OperatingPoint.from_moes(*moes)
        film = central_film(point, Lubricant()) / point.film_scale
        # pressures that are constant over the cells of the grid deflect less
        cells = np.sinc(0.5 * kx / 128 / np.pi) * np.sinc(0.5 * ky / 128 / np.pi)
        measured = float(row["pressure_ratio"]) * cells
        deviations.setdefault(moes, []).append(measured - float(edge_gain(kx, ky, film)))
    assert len(deviations) >= 15
    for moes, values in deviations.items():
        assert np.sqrt(np.mean(np.square(values))) <= 0.011, moes
        assert np.abs(values).max() <= 0.051, moes


def test_range_of_the_fit_is_that_of_the_data(evidence: ModuleType):
    data = evidence.read()
    for name, values in (("moes_m", data.m), ("moes_l", data.l), ("velocity_ratio", data.ratio)):
        assert fitted_range()[name] == [values.min(), values.max()]
