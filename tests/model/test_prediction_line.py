# SPDX-License-Identifier: BSD-3-Clause
"""Prediction and stress of line contacts: rough strips."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from numpy.polynomial import chebyshev
from scipy.special import k0

import pyehl
from pyehl.contact.smooth import solve_contact, zone_of
from pyehl.surfaces import Topography
from pyehl.theory.disc import RADIUS
from pyehl.theory.inlet import at_inlet
from pyehl.theory.line_contact import LineContact, contact_of
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.strip_edge import DEGREE, ORDERS, StripEdge
from pyehl.theory.transport import transport

EVIDENCE = Path("docs") / "evidence" / "prediction_lines"


def strip(**options: object) -> pyehl.Case:
    return pyehl.Case(
        contact={"shape": "line", "moes_m_line": 20.0, "moes_l_line": 10.0},
        surface={"kind": "harmonic", "amplitude": 0.02, "wavelength": 1.0},
    ).with_options(options)


@pytest.mark.parametrize(("kx", "ky"), [(3.0, 0.0), (3.0, 2.0), (0.0, 6.0), (8.0, 0.5)])
def test_pressure_of_a_wave_on_the_strip(kx: float, ky: float):
    """It deflects the strip into the wave plus, at k_Y = 0, a constant (K_0 by hand)."""
    edge = StripEdge(np.array([ky]), 2.0 * math.pi / (ky or 1.0))
    ((_, _, weights),) = edge.waves_and_weights(np.array([kx]), np.array([ky]))
    n = 20000
    x = np.cos((np.arange(n) + 0.5) * (math.pi / n))
    product = chebyshev.chebvander(x, ORDERS) @ weights[:, 0]
    places = np.linspace(-0.9, 0.9, 9)
    distance = np.abs(places[:, np.newaxis] - x)
    kernel = k0(ky * distance) if ky else -np.log(distance)
    miss = kernel @ product / n - np.exp(1j * kx * places)
    miss -= miss.mean() if ky == 0.0 else 0.0
    assert np.abs(miss).max() < 3e-3


def test_correction_of_a_strip():
    """Excess over the half-space: polynomials against the series."""
    kx, ky = np.array([4.0]), np.array([-2.0])
    edge = StripEdge(np.abs(ky), math.pi)
    ((_, _, weights),) = edge.waves_and_weights(kx, ky)
    x, y = np.linspace(-0.7, 0.7, 15), np.linspace(0.0, 1.0, 5)
    series = chebyshev.chebvander(x, ORDERS) @ weights[:, 0] / np.sqrt(1.0 - x**2)
    wanted = series - math.hypot(4.0, 2.0) * np.exp(4j * x)
    parts = edge.correction(kx, ky)[:, 0].reshape(-1, DEGREE + 1)
    result = edge.polynomials(x) @ (parts.T @ edge.waves(y))
    assert result == pytest.approx(
        np.outer(wanted, np.exp(-2j * y)), abs=0.02 * np.abs(wanted).max()
    )
    # constant near the edge
    assert edge.polynomials(np.array([0.95])) == pytest.approx(edge.polynomials(np.array([RADIUS])))


def test_circle_with_the_dry_inlet_of_a_line():
    """Equal alpha_bar; lambda_bar over the square of the stiffness (by hand, M = 20, L = 10)."""
    line = LineContact.from_moes(20.0, 10.0)
    moes_m, moes_l = line.equivalent_moes
    assert moes_m == pytest.approx((128.0 * math.pi**3 / 3.0 / (6.0 / 400.0) ** 3) ** 0.25)
    assert moes_l / math.pi * (1.5 * moes_m) ** (1.0 / 3.0) == pytest.approx(line.alpha_bar)


def test_transverse_waves_in_pure_rolling():
    """A_d/A_i of Venner (1997) at M = 100, L = 11, A_i = 0.1 H_c, from a secondary source.

    Waves of b/4 and less keep 3 to 6 % more than there, where grids were coarser.
    """
    lengths = np.array([4.0, 2.0, 1.0, 0.5, 0.25, 0.125])
    table = np.array([0.030, 0.073, 0.183, 0.394, 0.660, 0.839])
    case = strip(**{"contact.moes_m_line": 100.0, "contact.moes_l_line": 11.0})
    settings = case.resolve()
    zone = zone_of(solve_contact(settings), contact_of(settings), Lubricant.from_settings(settings))
    k, none = 2.0 * math.pi / lengths, np.zeros(lengths.size)
    made = at_inlet(zone, k, none, 1.0)
    ((driven, free),) = transport(zone, k, none, 1.0, np.array([0.0]))
    kept = np.abs(driven + free * made)
    assert kept[1:4] == pytest.approx(table[1:4], rel=0.01)
    assert kept == pytest.approx(table, rel=0.11)


def test_a_strip_repeated_along_the_line_changes_nothing():
    """Nor does a shift of the tile along the line."""
    case = strip()
    b = contact_of(case.resolve()).hertz_radius
    rng = np.random.default_rng(3)
    q = np.fft.rfft2(rng.normal(size=(48, 48)))
    i, j = np.meshgrid(np.fft.fftfreq(48, 1 / 48), np.arange(25), indexing="ij")
    heights = np.fft.irfft2(q * (np.hypot(i, j) < 5.5) * (np.hypot(i, j) > 0.0), (48, 48))
    heights *= 2e-8 / heights.std()
    single = pyehl.predict(case, surface=Topography(heights, (b, b)))
    doubled = Topography(np.tile(heights, (1, 2)), (b, 2.0 * b))
    moved = Topography(np.roll(heights, 7, axis=1), (b, b))
    for other in (doubled, moved):
        result = pyehl.predict(case, surface=other)
        assert result.mu_ratio - 1.0 == pytest.approx(single.mu_ratio - 1.0, rel=0.01)
    assert single.summary["mu_ratio_tracks"] is None
    assert single.summary["shape"] == "line"
    assert single.model_error > 0.0


def test_surfaces_may_be_exchanged():
    first = {"surface.velocity_ratio": 1.03, "second_surface.kind": "harmonic"}
    wave = {"second_surface.amplitude": 0.01, "second_surface.wavelength": 0.5}
    other = {"second_surface.amplitude": 0.02, "second_surface.wavelength": 1.0}
    mine = {"surface.amplitude": 0.01, "surface.wavelength": 0.5, "surface.velocity_ratio": 0.97}
    one = pyehl.predict(strip(**first, **wave))
    two = pyehl.predict(strip(**mine, **other, **{"second_surface.kind": "harmonic"}))
    assert one.mu_ratio == pytest.approx(two.mu_ratio, rel=1e-6)
    assert one.mu_ratio > 1.0


def _rows(root: Path, name: str) -> dict[str, dict[str, str]]:
    with (root / EVIDENCE / name).open(newline="", encoding="utf-8") as stream:
        return {row["name"]: row for row in csv.DictReader(stream)}


def test_predicted_before_simulated(root: Path):
    """Deviations of committed predictions: 2 % to a ratio of 1.5, 6 % to 2.5; 0.5 % with a law."""
    stated, result = _rows(root, "committed.csv"), _rows(root, "simulated.csv")
    assert set(stated) == set(result)
    held = []
    for name, row in result.items():
        p, s = float(stated[name]["mu_ratio"]), float(row["mu_ratio"])
        held.append(abs(p - s) <= float(stated[name]["mu_ratio_model_error"]))
        limit = 0.005 if name[0] == "e" else 0.02 if s < 1.5 else 0.06
        # one transverse wave deviates by 2.3 %, one random strip by 2.7 %: the page states both
        assert abs(p / s - 1.0) < {"across2": 0.025, "d3": 0.028}.get(name, limit)
    assert len(held) >= 25
    assert np.mean(held) >= 0.9


def test_stress_under_a_line(root: Path):
    """0.300 p_h at 0.786 b (Johnson 1985, section 4.2); a strip with equal rows gives the same."""
    result = pyehl.solve(root / "cases" / "line.nml", {"grid.points": 513})
    x = result.X.values[:, np.newaxis]
    dry = np.sqrt(np.maximum(0.0, 1.0 - x**2))
    below = pyehl.stress(result.assign(P=(("X", "Y"), dry)), friction="none")
    assert float(below.principal_shear_max) == pytest.approx(0.300, abs=1e-3)
    assert float(below.principal_shear_max_depth) == pytest.approx(0.786, abs=0.01)
    # plane strain
    s = {name: below[f"sigma_{name}"].values for name in ("xx", "yy", "zz")}
    assert s["yy"] == pytest.approx(0.3 * (s["xx"] + s["zz"]), abs=2e-3)


@pytest.mark.long
def test_stress_of_a_predicted_strip():
    predicted = pyehl.predict(strip())
    below = pyehl.stress(predicted, friction="none")
    assert float(below.near_surface_shear) > 1.05 * float(below.near_surface_shear_smooth)
    assert float(below.principal_shear_max_smooth) == pytest.approx(0.297, abs=0.005)


def test_curve_over_the_speed_of_a_line():
    result = pyehl.stribeck(
        pyehl.Case(
            contact={"shape": "line", "load_per_length": 1.8e5, "radius": 0.01},
            lubricant={"shear_law": "eyring"},
            surface={"kind": "harmonic", "amplitude": 0.01, "wavelength": 1.0},
            grid={"points": 257},
        ),
        {"contact.mean_velocity": [0.3, 0.45]},
        jobs=1,
    )
    assert list(result.status.values) == ["full film"] * 2
    assert np.all(np.diff(result.h_c_m.values) > 0.0)
    assert np.all((result.mu.values > 0.01) & (result.mu.values < 0.1))
    assert result.hersey.values[0] == pytest.approx(0.04 * 0.3 / 1.8e5)
