# SPDX-License-Identifier: BSD-3-Clause
"""Rough surfaces at rest, slow ones and fast ones."""

import numpy as np
import pytest

# M = 200: 65 x 65 nodes resolve the contact, and a wave has eight of them
POINT, POINTS, WAVELENGTH = (200.0, 10.0), 65, 0.5
WAVE = {
    "surface.kind": "harmonic",
    "surface.amplitude": 0.01423,
    "surface.wavelength": WAVELENGTH,
    "time.estimate_error": False,
    "grid.x_inlet": -2.5,
    "grid.x_outlet": 1.5,
    "grid.y_extent": 2.0,
}
REST = WAVE | {"surface.velocity_ratio": 0.0}


@pytest.mark.long
def test_stationary_wave_is_the_limit_of_slow_motion(solve):
    """The mean over the positions of a wave at rest is that of a very slow wave."""
    positions = np.arange(8) / 8.0 * WAVELENGTH
    ratios = []
    for position in positions:
        done = solve(POINT, POINTS, REST | {"surface.x_start": position})
        assert done.converged
        assert abs(done["load_error"]) <= 1e-6
        ratios.append(done["mu_ratio"])
    assert np.ptp(ratios) > 0.2
    slow = solve(POINT, POINTS, WAVE | {"surface.velocity_ratio": 0.02})
    assert slow.converged
    # 2.117 and 2.118: eight positions integrate the wave and its first harmonics exactly, and at
    # 0.02 the lag of the film is still a fiftieth of that at 1
    assert np.mean(ratios) == pytest.approx(slow["mu_ratio"], rel=2e-3)


def test_vanishing_roughness_is_smooth(solve):
    done = solve(POINT, POINTS, REST | {"surface.amplitude": 7e-8})
    assert done.converged
    # the algebraic error of two friction integrals
    assert done["mu_ratio"] == pytest.approx(1.0, abs=2e-4)
    assert done["H_c_rough"] == pytest.approx(done["H_c"], rel=1e-4)


def test_stationary_wave_has_its_origin_at_x_start(solve):
    """The wave covers the domain without a front: A cos(2 pi (X - x_start)/l) cos(2 pi Y/l)."""
    done = solve(POINT, POINTS, REST | {"surface.x_start": 0.1}, fields=True)
    x, y = done.field("X")[:, None], done.field("Y")
    k = 2.0 * np.pi / WAVELENGTH
    expected = done["amplitude"] * np.cos(k * (x - 0.1)) * np.cos(k * y)
    # rounding of the cosine's argument
    assert done.field("RR") == pytest.approx(expected, abs=1e-12 * done["amplitude"])
    assert done.field("A_d") == pytest.approx(done.field("H_smooth") - done.field("H"), abs=1e-15)
    assert "x_start = 0.1000" in done.plan


def test_error_by_the_coarser_grid(solve):
    """The difference from the next coarser grid, with the same amplitude."""
    wave = REST | {"time.estimate_error": True, "surface.amplitude_over_film": 0.2}
    wave.pop("surface.amplitude")
    coarse, fine = (solve(POINT, points, wave) for points in (129, 257))
    assert coarse.converged
    assert fine.converged
    # the film to which the amplitude is relative is extrapolated, on any grid
    assert coarse["amplitude"] == pytest.approx(fine["amplitude"], rel=2e-3)
    again = REST | {"surface.amplitude": fine["amplitude"]}
    same = solve(POINT, 129, again)
    difference = abs(fine["mu_ratio"] - same["mu_ratio"])
    # the same problem from another initial state: equal to the algebraic errors
    tolerance = 2.0 * fine["mu_ratio_error_stop"]
    assert fine["mu_ratio_error_grid"] == pytest.approx(difference, abs=tolerance)
    assert fine["mu_ratio_error"] >= fine["mu_ratio_error_grid"] > 0.0
    shift = fine["mu_ratio_extrapolated"] - fine["mu_ratio"]
    assert abs(shift) == pytest.approx(fine["mu_ratio_error_grid"] / 3.0, rel=1e-9)


def test_map_at_rest_equals_wave_at_rest(solve, tmp_path):
    """SI units; the tile is the wave, sampled."""
    smooth = solve(None, 129)
    pixels, amplitude = 32, 4e-3
    wave = np.cos(2.0 * np.pi * np.arange(pixels) / pixels)
    np.save(tmp_path / "tile.npy", amplitude * smooth["film_scale_m"] * np.outer(wave, wave))
    length = 0.5 * smooth["hertz_radius_m"]
    rest = {"surface.velocity_ratio": 0.0, "surface.x_start": 0.05, "time.estimate_error": False}
    as_map = solve(
        None,
        129,
        rest
        | {
            "surface.kind": "map",
            "surface.file": f"'{tmp_path / 'tile.npy'}'",
            "surface.length_x": length,
            "surface.length_y": length,
            "solver.symmetry": "full",
        },
    )
    as_wave = solve(
        None,
        129,
        rest
        | {
            "surface.kind": "harmonic",
            "surface.amplitude": amplitude,
            "surface.wavelength": 0.5,
            "solver.symmetry": "full",
        },
    )
    assert as_map.converged
    # 32 pixels per wave: the tile is interpolated to 1e-9 of the amplitude
    assert as_map["mu_ratio"] == pytest.approx(as_wave["mu_ratio"], rel=1e-6)


def test_roughness_higher_than_the_film_is_added_in_parts(solve):
    """Waves that would pierce the film are added in parts, and the last one converges."""
    done = solve(POINT, POINTS, REST | {"surface.amplitude": 0.0712})
    assert done.converged
    assert done["rough_parts"] > 1
    assert done["H_min_rough"] > 0.0


@pytest.mark.parametrize("driver", ["ehl", "pyehl"])
def test_too_slow_is_refused(drive, tmp_path, driver: str):
    (tmp_path / "case.nml").write_text(
        "&surface kind = 'harmonic', velocity_ratio = 1e-5 /\n&grid points = 65 /\n"
    )
    done = drive(driver, "case.nml", "-o", "out")
    assert done.returncode == 2
    assert "surface.velocity_ratio = 1e-5" in done.stderr
    assert "time steps" in done.stderr
    assert not (tmp_path / "out").exists()
    # the suggestion works: the plan is made, and the run ends after the requested steps
    least = float(done.stderr.partition("at least ")[2].split()[0])
    assert 1e-5 < least < 1e-2
    options = ["--set", f"surface.velocity_ratio={least}", "--set", "surface.amplitude=0.001"]
    steps = ["--set", "time.steps=1"]
    assert drive(driver, "case.nml", "-o", "out", *options, *steps).returncode == 1
    assert drive(driver, "case.nml", "-o", "out", "--set", "time.steps=1").returncode == 1


@pytest.mark.parametrize("velocity_ratio", [0.1, 0.5, 1.5, 2.0])
def test_wave_at_other_velocities(solve, velocity_ratio: float):
    done = solve(POINT, POINTS, WAVE | {"surface.velocity_ratio": velocity_ratio})
    assert done.converged
    assert done["T_period"] == pytest.approx(WAVELENGTH / velocity_ratio, rel=1e-12)
    assert done["mu_ratio_min"] <= done["mu_ratio"] <= done["mu_ratio_max"]
    assert np.abs(done.history["load_error"]).max() <= 1e-6
