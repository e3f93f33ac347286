# SPDX-License-Identifier: BSD-3-Clause
"""Height maps at the nodes: heights, cut spectra, waves that a grid does not resolve, memory."""

import json
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.fft

from pyehl import Case, surfaces
from pyehl.solver import solver_on_heights
from pyehl.surfaces import Topography
from pyehl.surfaces.map_steps import mirrored
from pyehl.surfaces.reading import read_scan

# A light load, which 65 x 65 nodes resolve; at zero velocity the field RR has the heights of the
# tile at the nodes
REST = {
    "contact.load": 20.0,
    "surface.kind": "map",
    "surface.velocity_ratio": 0.0,
    "surface.x_start": 0.123,
    "time.estimate_error": False,
}
POINTS = 65


def rough(pixels: tuple[int, int], seed: int = 1, height: float = 1e-11) -> np.ndarray:
    """Noise that is too low to change the pressure."""
    return height * np.random.default_rng(seed).standard_normal(pixels)


def on_nodes(done: Any, z: np.ndarray, lengths: tuple[float, float], *, cut: bool) -> np.ndarray:
    """The Fourier series of a tile [a^2/R], summed at the nodes wave by wave."""
    a, scale = done["hertz_radius_m"], done["film_scale_m"]
    nx, ny = z.shape
    c = np.fft.fft2(z - z.mean()) / (nx * ny)
    x, y = done.field("X") - 0.123, done.field("Y")
    periods = (lengths[0] / a, lengths[1] / a)
    kx, ky = np.fft.fftfreq(nx, 1 / nx), np.fft.fftfreq(ny, 1 / ny)

    def factors(k: np.ndarray, n: int, at: np.ndarray, period: float) -> np.ndarray:
        e = np.exp(2j * np.pi * np.outer(at, k) / period)
        if n % 2 == 0:
            e[:, n // 2] = np.cos(2 * np.pi * (n // 2) * at / period)
        return e

    if cut:
        c[np.abs(kx) * 2 * done["x_mesh"] >= periods[0] * (1 - 1e-9), :] = 0.0
        c[:, np.abs(ky) * 2 * done["y_mesh"] >= periods[1] * (1 - 1e-9)] = 0.0
    total = factors(kx, nx, x, periods[0]) @ c @ factors(ky, ny, y, periods[1]).T
    return total.real / scale


# Tiles that are coarser or finer than the grid, odd, longer than the domain, and a small part of it
@pytest.mark.parametrize(
    ("pixels", "lengths"),
    [
        ((16, 16), (2.7e-4, 2.7e-4)),
        ((15, 21), (2.7e-4, 1.6e-4)),
        ((64, 48), (2.7e-4, 2.7e-4)),
        ((96, 301), (1.0e-3, 2.5e-3)),
        ((40, 4), (1.3e-4, 3.2e-5)),
    ],
)
def test_heights_are_the_fourier_series(solve, tmp_path: Path, pixels, lengths):
    z = rough(pixels)
    np.save(tmp_path / "z.npy", z)
    file = {"surface.file": f"'{tmp_path / 'z.npy'}'"}
    size = {"surface.length_x": lengths[0], "surface.length_y": lengths[1]}
    done = solve(None, POINTS, REST | file | size, fields=True)
    expected = on_nodes(done, z, lengths, cut=True)
    # along Y exact; along X the polynomial between points, of the shortest wave 2e-5
    assert done.field("RR") == pytest.approx(expected, abs=3e-5 * np.abs(expected).max())
    # and the fraction that is omitted
    total = np.var(z)
    kept = resolved_variance(z, lengths, done)
    assert done["variance_left_out"] == pytest.approx(1.0 - kept / total, abs=1e-12)


def resolved_variance(
    z: np.ndarray, lengths: tuple[float, float], done: Any, nodes: float = 2.0
) -> float:
    """Variance of waves of more nodes per period than `nodes` (for more than two: or as many)."""
    power = np.abs(np.fft.fft2(z - z.mean()) / z.size) ** 2
    a = done["hertz_radius_m"]
    slack = 1e-9 if nodes <= 2.0 else -1e-9
    for axis, (n, length, mesh) in enumerate(
        zip(z.shape, lengths, (done["x_mesh"], done["y_mesh"]), strict=True)
    ):
        k = np.abs(np.fft.fftfreq(n, 1 / n))
        lost = k * nodes * mesh >= length / a * (1 - slack)
        power[(lost, slice(None)) if axis == 0 else (slice(None), lost)] = 0.0
    return float(power.sum())


def test_unresolved_variance(solve, tmp_path: Path):
    z = rough((48, 40))
    np.save(tmp_path / "z.npy", z)
    lengths = (1.0e-3, 6.5e-4)
    size = {"surface.length_x": lengths[0], "surface.length_y": lengths[1]}
    done = solve(None, 129, REST | {"surface.file": f"'{tmp_path / 'z.npy'}'"} | size)
    expected = 1.0 - resolved_variance(z, lengths, done, 8.0) / np.var(z)
    assert 0.0 < expected < 1.0
    assert done["variance_unresolved"] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ("wavelength", "velocity", "share"), [(0.5, 1.01, 0.0), (0.45, 1.01, 1.0), (0.6, 1.9, 1.0)]
)
def test_unresolved_wave(solve, wavelength: float, velocity: float, share: float):
    """Eight nodes of 1/16, in space, and in time for waves faster than the mean velocity."""
    wave = {
        "surface.kind": "harmonic",
        "surface.amplitude": 1e-4,
        "surface.wavelength": wavelength * 1.01,
        "surface.velocity_ratio": velocity,
        "time.steps": 1,
        "grid.x_inlet": -2.5,
        "grid.x_outlet": 1.5,
        "grid.y_extent": 2.0,
    }
    done = solve((200.0, 10.0), POINTS, wave)
    assert done["variance_unresolved"] == share
    assert done["variance_left_out"] == 0.0


@pytest.mark.parametrize("driver", ["ehl", "pyehl"])
def test_a_wave_shorter_than_two_nodes_is_refused(drive, tmp_path: Path, driver: str):
    (tmp_path / "case.nml").write_text(
        "&contact moes_m = 200.0 /\n&grid points = 65 /\n"
        "&surface kind = 'harmonic', wavelength_x = 0.1, amplitude = 1e-3 /\n"
    )
    done = drive(driver, "case.nml", "-o", "out")
    assert done.returncode == 2
    assert "shorter than two mesh sizes" in done.stderr
    assert "65 x 65" in done.stderr


@pytest.mark.parametrize("kind", ["sharp", "gaussian"])
def test_cut_is_that_of_python(solve, tmp_path: Path, kind: str):
    """The filter of the solver against a map that was filtered before."""
    z = rough((64, 64))
    lengths = (2.7e-4, 2.7e-4)
    cut = surfaces.filtered(Topography(z - z.mean(), lengths), 2.2e-5, 1.6e-4, kind)
    np.save(tmp_path / "z.npy", z)
    np.save(tmp_path / "cut.npy", cut.heights)
    keys = {
        "surface.shortest_wavelength": 2.2e-5,
        "surface.longest_wavelength": 1.6e-4,
        "surface.filter": f"'{kind}'",
    }
    file, before = (f"'{tmp_path / name}'" for name in ("z.npy", "cut.npy"))
    size = {"surface.length_x": lengths[0], "surface.length_y": lengths[1]}
    done = solve(None, POINTS, REST | size | keys | {"surface.file": file}, fields=True)
    other = solve(None, POINTS, REST | size | {"surface.file": before}, fields=True)
    # the polynomial between points is finer where fewer waves remain
    scale = np.abs(other.field("RR")).max()
    assert done.field("RR") == pytest.approx(other.field("RR"), abs=3e-5 * scale)
    assert done["surface_rms_m"] == pytest.approx(cut.rms_height, rel=1e-12)
    assert done["variance_cut"] == pytest.approx(1.0 - (cut.rms_height / z.std()) ** 2, rel=1e-12)


def test_rms_height_is_that_before_the_cut(solve):
    keys = {
        "contact.load": 20.0,
        "surface.kind": "fractal",
        "surface.shortest_wavelength": 1e-4,
        "time.steps": 1,
    }
    done = solve(None, POINTS, keys)
    assert done["surface_rms_m"] == pytest.approx(
        0.05e-6 * np.sqrt(1.0 - done["variance_cut"]), rel=1e-12
    )
    assert 0.0 < done["variance_cut"] < 0.2


@pytest.mark.long
def test_long_text_lines(tmp_path: Path):
    """One row of more than a mebibyte, with any of the usual separators."""
    z = rough((4, 45000))
    cells = [[f"{v:.17e}" for v in row] for row in z]
    texts = {"blank.txt": " ", "comma.csv": ",", "semicolon.csv": ";", "tab.txt": "\t"}
    for name, separator in texts.items():
        lines = [separator.join(row) for row in cells]
        assert len(lines[0]) > 2**20
        (tmp_path / name).write_text("# heights in m\n" + "\n".join(lines))
        scan = read_scan(tmp_path / name, 8.29e-4, 8.29e-4)
        assert np.array_equal(scan.heights, z)


@pytest.mark.parametrize(
    ("row", "place"),
    [
        ("1 2 / 4", ":4:5: '/'"),
        ("1 2*3.0 4 5", ":4:3: '2*3.0'"),
        ("1 2\tthree 4", ":4:5: 'three'"),
        ("1,2 ,3,4 5", ":4:10:"),
        ("1 2 3", ":4:6:"),
    ],
)
def test_rows_that_are_not_numbers_are_refused(drive, tmp_path: Path, row: str, place: str):
    (tmp_path / "map.txt").write_text("1 2 3 4\n" * 3 + row + "\n")
    (tmp_path / "case.nml").write_text(
        "&surface kind = 'map', file = 'map.txt', length_x = 1e-3, length_y = 1e-3 /\n"
        "&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    )
    done = drive("pyehl", "case.nml", "-o", "out")
    assert done.returncode != 0
    assert f"map.txt{place}" in done.stderr or "map.txt:4:2: commas and blanks" in done.stderr


def test_map_larger_than_memory_is_refused(drive, tmp_path: Path):
    """A sparse file of 320 GB, which takes no space on the disk."""
    n = 200_000
    header = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({n}, {n}), }}"
    header += " " * (117 - len(header)) + "\n"
    with (tmp_path / "map.npy").open("wb") as stream:
        stream.write(b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header.encode())
        try:
            stream.truncate(128 + 8 * n * n)
        except OSError:
            pytest.skip("no files of this size here")
    (tmp_path / "case.nml").write_text(
        "&surface kind = 'map', file = 'map.npy', length_x = 1e-3, length_y = 1e-3 /\n"
        "&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    )
    done = drive("ehl", "case.nml", "-o", "out")
    assert done.returncode == 1
    assert "200000 x 200000 heights needs 640.0 GB" in done.stderr
    assert not (tmp_path / "out").exists()


# The grid resolves all waves of the coarser map, and a part of those of the finer one
@pytest.mark.parametrize(("pixel", "cut"), [(8e-6, 24e-6), (4e-5, 0.0)])
@pytest.mark.parametrize("shape", [(12, 12), (13, 9), (9, 12), (16, 7)])
def test_mirrored_map_is_its_tile(shape: tuple[int, int], pixel: float, cut: float):
    """The solver makes no mirror images: the cosines of the map are the spectrum of its tile."""
    z = 1e-8 * np.random.default_rng(1).normal(size=shape)
    x, y = (2.0 * n * pixel for n in shape)
    case = (
        f"&surface kind = 'map', file = 'none', tile_x = {x}, tile_y = {y}, "
        f"shortest_wavelength = {cut}, filter = 'gaussian' /\n"
        "&contact load = 20.0 /\n&grid points = 65 /\n"
        "&time steps = 2, skip_start = .false., estimate_error = .false. /\n"
    )
    result = []
    for given, images in ((mirrored(z), ".false."), (z, ".true.")):
        option = f"surface.tile_mirrored={images}"
        with solver_on_heights(
            Case.from_text(case, [option]), {"surface": np.asfortranarray(given)}
        ) as solver:
            solver.run()
            result.append((solver.field("RR"), solver.summary))
    (tile, whole), (folded, part) = result
    assert np.abs(tile).max() > 0.0
    assert folded == pytest.approx(tile, abs=1e-13 * np.abs(tile).max())
    for name in ("surface_rms_m", "variance_cut", "variance_unresolved", "variance_left_out"):
        assert part[name] == pytest.approx(whole[name], rel=1e-12, abs=1e-12), name


def test_symmetric_maps_are_recognised():
    """Half the domain suffices for a mirrored map that is even about its middle column."""
    half = 1e-8 * np.random.default_rng(2).normal(size=(12, 6))
    for z, even in ((np.hstack([half, half[:, -2::-1]]), True), (np.hstack([half, half]), False)):
        case = (
            "&surface kind = 'map', file = 'none', tile_x = 2e-4, tile_y = 2e-4, "
            "tile_mirrored = .true. /\n"
            "&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
            "&time steps = 1 /\n"
        )
        with solver_on_heights(Case.from_text(case), {"surface": np.asfortranarray(z)}) as solver:
            assert (solver.summary["half_domain"]) is even


MEASURE = """
import json, resource, subprocess, sys
done = subprocess.run(sys.argv[1:], capture_output=True, text=True)
use = resource.getrusage(resource.RUSAGE_CHILDREN)
print(json.dumps([done.returncode, use.ru_maxrss, use.ru_utime]))
"""


def measured(ehl: str, folder: Path, pixels: int) -> tuple[float, float]:
    """Peak memory [bytes] and processor time [s] of a run with a map, for one step."""
    np.save(folder / f"{pixels}.npy", rough((pixels, pixels)))
    # 0.03 m: the grid resolves all waves
    (folder / "case.nml").write_text(
        f"&surface kind = 'map', file = '{pixels}.npy', length_x = 0.03, length_y = 0.03 /\n"
        "&contact load = 20.0 /\n&grid points = 257 /\n&time steps = 1 /\n"
    )
    words = [ehl, str(folder / "case.nml"), "-o", str(folder / f"out{pixels}"), "-q"]
    done = subprocess.run(
        [sys.executable, "-c", MEASURE, *words], capture_output=True, text=True, check=True
    )
    code, kilobytes, seconds = json.loads(done.stdout)
    assert code == 1  # no mean over a period
    return 1024.0 * kilobytes, seconds


PREPARED = """
import resource, sys
from pyehl import Case, Solver
import scipy.fft, scipy.ndimage
z = 1024.0 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
with Solver(Case(sys.argv[1])) as solver:
    print(1024.0 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - z)
"""


@pytest.mark.parametrize(
    "keys",
    [
        *(
            pytest.param(keys, marks=pytest.mark.long)
            for keys in ("", "track = 1e-3", "detrend = 'tilt'", "edges = 'window'")
        ),
        "fill = 'harmonic'",
        "detrend = 'tilt', edges = 'mirror', shortest_wavelength = 1e-4, filter = 'gaussian'",
    ],
)
def test_memory_of_prepared_maps(tmp_path: Path, keys: str):
    """From Python, too, at most three times the size of the map."""
    pixels = 1536
    z = 1e3 * rough((pixels, pixels))
    if "fill" in keys:
        z[100:110, 200:205] = np.nan
    np.save(tmp_path / "map.npy", z)
    (tmp_path / "case.nml").write_text(
        f"&surface kind = 'map', file = 'map.npy', length_x = 0.03, length_y = 0.03, {keys} /\n"
        "&contact load = 20.0 /\n&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    )
    done = subprocess.run(
        [sys.executable, "-P", "-c", PREPARED, str(tmp_path / "case.nml")],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert float(done.stdout) <= 3.0 * 8.0 * pixels**2


def test_memory_and_work_of_large_maps(ehl: str, tmp_path: Path):
    """At most three times the size of the map, and a few times the work of its spectrum."""
    pixels = 2048
    small, large = (measured(ehl, tmp_path, n) for n in (16, pixels))
    assert large[0] - small[0] <= 3.0 * 8.0 * pixels**2
    z = rough((pixels, pixels))
    began = time.process_time()
    scipy.fft.rfft2(z)
    spectrum = time.process_time() - began
    # 7 here, including reading; summing the waves of a column for each row of the grid takes 33
    assert large[1] - small[1] <= 15.0 * spectrum
