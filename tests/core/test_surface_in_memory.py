# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces in memory, in Python: the results of their files, their sizes, and refusals."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

import pyehl

WAVES = 1e-9 * np.random.default_rng(1).normal(size=(16, 12)) + 3e-7


def test_surface_in_memory_is_that_of_its_file(fractal: Path, tmp_path: Path):
    """Given as a tile or as an array, the results are those of the height map, bit for bit."""
    np.save(tmp_path / "map.npy", WAVES - WAVES.mean())
    size = {"surface.length_x": 1e-4, "surface.length_y": 8e-5}
    file = {"surface.kind": "map", "surface.file": tmp_path / "map.npy"} | size
    by_file = pyehl.solve(fractal, file, check=False)
    tile = pyehl.Topography(WAVES, size=(1e-4, 8e-5))
    # whatever surface the case states
    smooth = {"surface.kind": "smooth"}
    by_tile = pyehl.solve(fractal, smooth, surface=tile, check=False, output=tmp_path / "out")
    by_array = pyehl.solve(fractal, size, surface=WAVES, check=False)
    for data in (by_tile, by_array):
        for name in ("P", "H", "RR", "history_mu_ratio"):
            assert np.array_equal(data[name].values, by_file[name].values), name
    # the folder contains the surface, and its case can be solved again
    again = pyehl.solve(tmp_path / "out" / "case.nml", check=False)
    # except for the mean, which is subtracted once more, with rounding
    assert again.P.values == pytest.approx(by_tile.P.values, abs=1e-12)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert sorted(summary["files"]) == sorted(p.name for p in (tmp_path / "out").iterdir())
    mean = pyehl.predict(fractal, file).mu_ratio
    assert pyehl.predict(fractal, smooth, surface=tile).mu_ratio == mean
    assert pyehl.predict(fractal, size, surface=WAVES).mu_ratio == mean


def test_surface_in_memory_keeps_track_and_cut(fractal: Path, tmp_path: Path):
    tile = pyehl.predict(fractal).surface
    place = {"surface.track": 2e-5, "surface.shortest_wavelength": 2e-5}
    by_case = pyehl.solve(fractal, place, check=False)
    by_tile = pyehl.solve(fractal, place, surface=tile, check=False)
    assert by_tile.P.values == pytest.approx(by_case.P.values, abs=1e-9)
    assert np.abs(by_tile.P - pyehl.solve(fractal, check=False).P).max() > 1e-4
    result = pyehl.predict(fractal, place, surface=tile).mu_ratio
    assert result == pytest.approx(pyehl.predict(fractal, place).mu_ratio, rel=1e-9)


@pytest.mark.parametrize(
    ("surface", "part"),
    [
        (WAVES, "pyehl.Topography(heights, size)"),
        ("abc", "a matrix of numbers"),
        (np.where(WAVES > 3e-7, np.nan, WAVES), "finite"),
    ],
)
def test_no_surface(smooth: Path, surface: object, part: str):
    for call in (pyehl.solve, pyehl.predict, pyehl.Solver):
        with pytest.raises(pyehl.InputError, match=re.escape(part)):
            call(smooth, surface=surface)


@pytest.mark.parametrize("size", [3.0, (1e-4,), (1e-4, 0.0), (1e-4, "x"), None])
def test_no_size(size: object):
    with pytest.raises(pyehl.InputError, match="length"):
        pyehl.Topography(WAVES, size)


def test_missing_points_are_refused_as_heights():
    with pytest.raises(pyehl.InputError, match="not finite"):
        pyehl.Topography(np.ma.masked_less(WAVES, 3e-7), (1e-4, 1e-4))
