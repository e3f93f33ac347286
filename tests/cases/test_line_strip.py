# SPDX-License-Identifier: BSD-3-Clause
"""Roughness on a line contact: waves on one row, strips, the middle of a wide ellipse."""

import math
import re

import numpy as np
import pytest
from scipy.optimize import brentq
from test_line import moes, si_line

import pyehl
from pyehl.theory.ellipse import ellipse
from pyehl.theory.line_contact import LineContact

TRANSVERSE = {
    "surface.kind": "harmonic",
    "surface.wavelength_y": 1e6,
    "contact.slide_to_roll": 0.0,
    "time.estimate_error": False,
}


@pytest.mark.parametrize(
    ("moes_m", "wavelength", "points"), [(20, 1.0, 513), (50, 1.0, 513), (100, 0.5, 1025)]
)
def test_amplitude_reduction(moes_m, wavelength, points):
    """Small transverse waves in pure rolling: Venner 1997, 1/(1 + 0.17 x + 0.03 x^2)."""
    wave = {"surface.wavelength_x": wavelength, "surface.amplitude_over_film": 0.05}
    result = pyehl.solve(moes(moes_m, 10, points), TRANSVERSE, wave)
    x = wavelength * moes_m**0.75 / 10**0.5
    assert float(result.amplitude_ratio) == pytest.approx(
        1.0 / (1.0 + 0.17 * x + 0.03 * x**2), rel=0.1
    )
    assert result.P.shape == (points, 1)
    # of one wave; a product of two waves has A/2
    rms = float(result.amplitude) / math.sqrt(2.0)
    assert float(result.lambda_ratio_central) == pytest.approx(float(result.H_c) / rms, rel=1e-6)


def test_strip_of_a_transverse_wave(tmp_path):
    """A map that is uniform across, on a strip, is the wave on one row."""
    row = si_line(129, **TRANSVERSE, **{"surface.amplitude": 0.01, "surface.wavelength_x": 1.0})
    wave = pyehl.solve(row)
    unit = float(wave.film_scale_m)
    length = float(wave.hertz_radius_m)
    x = np.arange(64) / 64.0
    heights = np.repeat(0.01 * unit * np.cos(2.0 * np.pi * x)[:, np.newaxis], 8, axis=1)
    np.save(tmp_path / "wave.npy", heights)
    strip = si_line(
        129,
        **{
            "surface.kind": "map",
            "surface.file": str(tmp_path / "wave.npy"),
            "surface.length_x": length,
            "surface.length_y": length,
            "contact.slide_to_roll": 0.0,
            "time.estimate_error": False,
        },
    )
    result = pyehl.solve(strip)
    assert result.P.shape[1] == int(result.points_y) > 8
    # nothing varies across but the remaining residual
    assert float(np.ptp(result.H.values, axis=1).max()) < 1e-5
    assert float(result.mu_ratio) == pytest.approx(float(wave.mu_ratio), abs=2e-4)
    assert float(result.H_c) == pytest.approx(float(wave.H_c), rel=1e-4)


def test_strip_of_waves_across():
    """Long crests act as transverse waves; friction grows by half, as the square of the heights."""
    small = {"surface.wavelength_x": 1.0, "surface.amplitude_over_film": 0.05}
    row = pyehl.solve(moes(20, 10, 129), TRANSVERSE, small)
    long = pyehl.solve(moes(20, 10, 129), {**TRANSVERSE, "surface.wavelength_y": 4.0}, small)
    assert float(long.amplitude_ratio) == pytest.approx(float(row.amplitude_ratio), rel=0.02)
    increases = [float(result.mu_ratio) - 1.0 for result in (row, long)]
    assert increases[1] == pytest.approx(0.5 * increases[0], rel=0.05)


@pytest.mark.parametrize("coarsening", ["classical", "alcouffe"])
def test_half_a_strip_equals_the_whole_one(coarsening):
    """Waves that are even in Y: half the rows give the same, to the rounding of the steps."""
    wave = {"surface.kind": "harmonic", "surface.amplitude": 0.02, "surface.wavelength": 1.0}
    few = {"time.steps": 6, "time.skip_start": False, "solver.coarsening": coarsening}
    case = moes(20, 10, 129).with_options(wave | few)
    half, whole = (
        pyehl.solve(case.with_options({"solver.symmetry": one}), check=False)
        for one in ("auto", "full")
    )
    assert half.attrs["half_domain"]
    assert not whole.attrs["half_domain"]
    np.testing.assert_allclose(half.Y.values, whole.Y.values, atol=1e-15)
    for name in ("P", "H", "RR"):
        np.testing.assert_allclose(half[name].values, whole[name].values, atol=1e-9)
    assert np.ptp(half.H.values, axis=1).max() > 0.01
    # with a dent off its middle the strip is not symmetric
    dent = {"surface.kind": "dent", "surface.width": 0.5, "surface.amplitude": 0.02}
    aside = moes(20, 10, 65).with_options(dent | few | {"surface.y_start": 0.2})
    assert not pyehl.solve(aside, check=False).attrs["half_domain"]


@pytest.mark.long
def test_strip_is_the_middle_of_a_wide_ellipse():
    """Isotropic waves in an ellipse of kappa = 8, with the same a, p_h and speed parameter."""
    ratio = brentq(lambda d: ellipse(d).ellipticity - 8.0, 1e-3, 0.5)
    kernel = ellipse(ratio).kernel_ratio
    line = LineContact.from_moes(20.0, 10.0)
    round_m = (128.0 * math.pi**3 / (3.0 * line.speed_parameter**3)) ** 0.25
    moes_m = 8.0 * round_m * kernel**0.25
    moes_l = line.alpha_bar * math.pi / (1.5 * round_m) ** (1.0 / 3.0) / kernel**0.75
    domain = {"grid.x_inlet": -2.5, "grid.x_outlet": 1.5, "grid.border": "zero"}
    wave = {"surface.kind": "harmonic", "surface.wavelength": 1.0, "surface.amplitude": 0.004}
    rolling = {"contact.slide_to_roll": 0.0, "time.estimate_error": False, "grid.points": 97}
    wide = pyehl.Case(
        contact={"moes_m": moes_m, "moes_l": moes_l, "radius_ratio": ratio},
        grid={"points": 97, "y_extent": 9.0, "points_y": 433},
    )
    strip = pyehl.Case(contact={"shape": "line", "moes_m_line": 20.0, "moes_l_line": 10.0})
    result = [pyehl.solve(case, domain, wave, rolling) for case in (wide, strip)]
    speeds, films, kept = (
        [float(f[name]) for f in result] for name in ("speed_parameter", "H_c", "amplitude_ratio")
    )
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-6)
    assert films[0] == pytest.approx(films[1], rel=0.01)
    assert kept[0] == pytest.approx(kept[1], rel=0.01)


def wide_and_line() -> list[pyehl.Case]:
    """Give an ellipse of kappa = 8 and a line in SI units, of one alpha_bar and speed parameter."""
    ratio = brentq(lambda d: ellipse(d).ellipticity - 8.0, 1e-3, 0.5)
    kernel = ellipse(ratio).kernel_ratio
    line = LineContact.from_moes(20.0, 10.0)
    modulus, radius = line.reduced_modulus, line.radius
    round_m = (128.0 * math.pi**3 / (3.0 * line.speed_parameter**3)) ** 0.25
    moes_m = 8.0 * round_m * kernel**0.25
    moes_l = line.alpha_bar * math.pi / (1.5 * round_m) ** (1.0 / 3.0) / kernel**0.75
    # U by L = G (2U)^(1/4), load by M = w/(E' R^2) (2U)^(-3/4)
    speed = 0.5 * (moes_l / (2.2e-8 * modulus)) ** 4
    point = {
        "load": moes_m * (2.0 * speed) ** 0.75 * modulus * radius**2,
        "radius_x": radius,
        "radius_y": radius / ratio,
        "mean_velocity": speed * modulus * radius / 0.04,
    }
    flat = {"load_per_length": line.load_per_length, "mean_velocity": line.mean_velocity}
    flat |= {"shape": "line", "radius": radius}
    bodies, oil = {"reduced_modulus": modulus}, {"viscosity": 0.04, "pressure_viscosity": 2.2e-8}
    domain = {"points": 97, "x_inlet": -2.5, "x_outlet": 1.5, "border": "zero"}
    sides = {"y_extent": 9.0, "points_y": 433}
    return [
        pyehl.Case(contact=point | bodies, lubricant=oil, grid=domain | sides),
        pyehl.Case(contact=flat | bodies, lubricant=oil, grid=domain),
    ]


@pytest.mark.parametrize(("film", "touching"), [(0.08, False), (0.1, True), (0.12, True)])
def test_boundary_film_in_the_middle_of_a_wide_ellipse(film, touching):
    """Film and pressure along the motion; without a boundary film both differ by 0.6 %."""
    rows = []
    for case in wide_and_line():
        scale = float(pyehl.solve(case).film_scale_m)
        options = {"lubricant.boundary_film": film * scale, "lubricant.boundary_friction": 0.1}
        result = pyehl.solve(case, options)
        middle = result.Y.size // 2
        rows.append((result.X.values, result.P.values[:, middle], result.H.values[:, middle]))
        # oil flows around an ellipse; on a line all of it passes through
        assert (float(result.contact_load_share) > 0.7) == touching
    (x, p, h), (x_line, p_line, h_line) = rows
    np.testing.assert_allclose(x, x_line)
    inner = np.abs(x) < 1.0
    np.testing.assert_allclose(h_line[inner], h[inner], rtol=0.01)
    assert np.sqrt(np.mean((p_line - p)[inner] ** 2)) < 0.007


DENT = {"surface.kind": "dent", "surface.width": 0.8, "surface.amplitude": 0.05}
ROLLING = {"contact.slide_to_roll": 0.0, "time.estimate_error": False}


@pytest.mark.long
def test_dent_in_the_middle_of_a_wide_ellipse():
    """Pressure and film change by a dent along its centre line, while it is in the contact."""
    rolling = ROLLING | {"time.steps": 38}
    wide, line = wide_and_line()
    changes = []
    for case, spacing in ((wide, 0.0), (line, 0.0), (line, 2.0)):
        result = pyehl.solve(case, DENT, rolling, {"surface.spacing_y": spacing}, check=False)
        rows = 96 if spacing == 0.0 else 48
        assert case is wide or result.Y.size == rows
        smooth = pyehl.solve(case)
        row = result.Y.size // 2, smooth.Y.size // 2
        changes.append([(result[f][:, row[0]] - smooth[f][:, row[1]]).values for f in ("P", "H")])
    inner = np.abs(result.X.values) < 1.0
    for strip in changes[1:]:
        for change, expected in zip(strip, changes[0], strict=True):
            off = np.sqrt(np.mean((change - expected)[inner] ** 2))
            assert off < 0.005 * np.abs(expected).max()


def test_dents_along_a_line():
    """Twice as many dents on the same length have twice the share of friction."""
    _, line = wide_and_line()
    few, many = (
        float(pyehl.solve(line, DENT, ROLLING, spacing).mu_ratio) - 1.0
        for spacing in ({"surface.spacing_y": 4.0}, {"surface.spacing_y": 2.0})
    )
    assert many == pytest.approx(2.0 * few, rel=0.02)


def test_features_that_do_not_repeat_along_a_line():
    case = moes(20, 10, 97)
    for options, what in (
        ({"surface.kind": "ridge", "surface.angle": 30.0}, "does not repeat along a line"),
        ({"surface.kind": "dent", "surface.spacing_y": 0.5}, "takes up 6.000E-01 b along the line"),
        (
            {"surface.kind": "harmonic", "surface.spacing_y": 2.0},
            "no single feature repeats along Y",
        ),
    ):
        with pytest.raises(pyehl.InputError, match=re.escape(what)):
            pyehl.check(case, {**options, "surface.amplitude": 0.01})
    with pytest.raises(pyehl.InputError, match="no single feature repeats along Y"):
        pyehl.check("cases/quick.nml", {"surface.kind": "dent", "surface.spacing_y": 2.0})


def test_alcouffe_on_a_strip():
    """Transfers by the conductance over the repeating edge: the same to the algebraic error."""
    wave = {"surface.kind": "harmonic", "surface.wavelength": 1.0, "time.estimate_error": False}
    wave |= {"surface.amplitude_over_film": 0.6, "contact.slide_to_roll": 0.0}
    domain = {"x_inlet": -2.5, "x_outlet": 1.5}
    classical, alcouffe = (
        pyehl.solve(moes(20, 10, 129, **domain), wave, {"solver.coarsening": name})
        for name in ("classical", "alcouffe")
    )
    increase = float(classical.mu_ratio) - 1.0
    assert increase > 1.0
    assert float(alcouffe.mu_ratio) - 1.0 == pytest.approx(increase, rel=1e-3)
    assert (alcouffe.P.values != classical.P.values).any()
    np.testing.assert_allclose(alcouffe.P.values, classical.P.values, atol=5e-3)
    # one row has no neighbour along the line
    row = {"surface.wavelength_x": 1.0, "surface.wavelength_y": 1e6}
    with pytest.raises(pyehl.InputError, match="nothing varies along a line"):
        pyehl.solve(moes(20, 10, 129), wave, row, {"solver.coarsening": "alcouffe"})


def test_strip_that_is_too_wide():
    """Tens of thousands of rows are an oversight; the message states the number."""
    wave = {"surface.kind": "harmonic", "surface.wavelength_x": 1.0, "surface.wavelength_y": 1e3}
    with pytest.raises(pyehl.InputError, match=r"repeat after 1\.000E\+03 b has .* rows") as info:
        pyehl.solve(moes(20, 10, 129), wave)
    assert "wavelength_y = 1e6" in str(info.value)
    assert pyehl.check(moes(20, 10, 129), {**wave, "surface.wavelength_y": 20.0})


def test_fractal_surface_on_a_strip():
    tile = {
        "surface.kind": "fractal",
        "surface.pixels": 64,
        "surface.length_x": 1.4e-4,
        "surface.length_y": 1.0e-4,
        "surface.rms_height": 5e-9,
        "surface.shortest_wavelength": 3e-5,
        "time.steps": 6,
    }
    result = pyehl.solve(si_line(129), tile, check=False)
    b = float(result.hertz_radius_m)
    assert result.attrs["status"] == "not settled"
    assert int(result.points_y) * float(result.y_mesh) * b == pytest.approx(1.0e-4, rel=1e-9)
    again = pyehl.solve(si_line(129), {**tile, "solver.threads": 2}, check=False)
    np.testing.assert_array_equal(result.P, again.P)
    other = {**tile, "second_surface.kind": "harmonic", "second_surface.wavelength_y": 0.51}
    with pytest.raises(pyehl.InputError, match="no common period across the motion"):
        pyehl.solve(si_line(129), other)
