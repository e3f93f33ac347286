# SPDX-License-Identifier: BSD-3-Clause
"""Maps with known tilt, curvature, missing points, spikes and steps."""

import json

import numpy as np
import pytest

from pyehl import surfaces
from pyehl.surfaces import Options, Scan, Topography, prepare
from pyehl.surfaces.areal import areal_numbers, extent, texture_aspect_ratio
from pyehl.surfaces.map_steps import (
    cropped,
    filled,
    jump,
    level,
    mirrored,
    prominence,
    rotated,
    unmirrored,
    windowed,
)
from pyehl.surfaces.prepare import write_map

PIXEL = (1e-6, 1e-6)


def rough(shape=(64, 48), seed=1):
    return surfaces.fractal(shape, 64e-6, 48e-6, rms_height=2e-8, hurst=0.8, seed=seed).heights


def axes(shape):
    return np.meshgrid(*(np.linspace(-1, 1, n) for n in shape), indexing="ij")


def instrument(z, **changes):
    nx, ny = z.shape
    return Scan(z, nx * 1e-6, ny * 1e-6, "a scan", **({"is_array": False} | changes))


def levelled(z, what, valid=None):
    work = z.copy()
    level(work, what, valid)
    return work


@pytest.mark.parametrize(("what", "count"), [("centre", 1), ("tilt", 2), ("curvature", 3)])
def test_form_is_taken_off_exactly(what, count):
    x, y = axes((40, 31))
    forms = [
        np.full(x.shape, 5e-6),
        1e-6 * x - 3e-6 * y,
        4e-7 * x * x - 2e-7 * x * y + 1e-7 * y * y,
    ]
    assert levelled(sum(forms[:count]), what) == pytest.approx(0.0, abs=1e-20)
    assert np.abs(levelled(sum(forms), what)).max() > 1e-8 or count == len(forms)


def test_form_is_fitted_to_valid_points():
    x, y = axes((40, 31))
    z = 1e-6 * x - 3e-6 * y
    holed = z.copy()
    holed[5:9, 5:9] = np.nan
    valid = np.ones(z.shape, dtype=bool)
    valid[20, 20] = False
    holed[20, 20] += 1e-3
    there = valid & np.isfinite(holed)
    left = levelled(holed, "tilt", valid)
    assert left[there] == pytest.approx(0.0, abs=1e-20)
    assert left[20, 20] == pytest.approx(1e-3, abs=1e-18)
    with pytest.raises(ValueError, match="do not determine a polynomial of degree 1"):
        levelled(np.where(x == x[0, 0], z, np.nan), "tilt")


@pytest.mark.parametrize("many", [False, True])
def test_holes_in_harmonic_heights_are_filled_exactly(monkeypatch, many):
    """x, y, x y and x^2 - y^2 are harmonic, also for five-point differences."""
    if many:
        monkeypatch.setattr("pyehl.surfaces.map_steps.DIRECT_POINTS", 0)
    i, j = np.meshgrid(np.arange(40.0), np.arange(30.0), indexing="ij")
    z = 1e-9 * (3 * i - 2 * j + 0.1 * i * j + 0.2 * (i * i - j * j)) + 1e-6
    holed = z.copy()
    holed[10:20, 8:15] = np.nan
    holed[30, 20] = np.nan
    assert filled(holed, PIXEL) == pytest.approx(z, abs=1e-14 if many else 1e-19)
    assert np.isnan(holed[10, 8])


def test_filling_has_no_peaks_and_uses_the_pixel_size():
    z = rough()
    z[20:26, 20:24] = np.nan
    z[0:2, 0:2] = np.nan
    full = filled(z, (1e-6, 2e-6))
    assert full[20:26, 20:24].max() < np.nanmax(z[19:27, 19:25])
    assert full[20:26, 20:24].min() > np.nanmin(z[19:27, 19:25])
    # x^2 - y^2 in metres, not in pixels
    i, j = np.meshgrid(np.arange(20.0), np.arange(20.0), indexing="ij")
    quadratic = 1e-9 * (i * i - (2.0 * j) ** 2)
    holed = quadratic.copy()
    holed[5:9, 6:12] = np.nan
    assert filled(holed, (1e-6, 2e-6)) == pytest.approx(quadratic, abs=1e-19)


def test_more_than_a_tenth_missing_is_refused():
    z = rough((50, 40))
    z[:5] = np.nan
    assert np.isfinite(prepare(instrument(z)).tile).all()
    z[5, 0] = np.nan
    with pytest.raises(ValueError, match=r"a scan: 201 of 2000 heights are missing \(10"):
        prepare(instrument(z))


def test_a_part_without_heights_is_refused():
    z = rough((50, 40))
    z[:10] = np.nan
    with pytest.raises(ValueError, match=r"400 of 400 heights are missing \(100"):
        prepare(instrument(z), Options(crop=(0.0, 10e-6, 0.0, 0.0)))


def test_fill_none_refuses_missing_points():
    z = rough()
    z[3, 4] = np.nan
    with pytest.raises(ValueError, match=r"1 of 3072 heights are missing, the first at row 3, col"):
        prepare(instrument(z), Options(fill="none"))


def test_prominence_of_spikes_in_noise():
    """In standard deviations of normal noise; a median changes them by a few per cent."""
    z = np.random.default_rng(3).normal(0.0, 1e-9, (200, 200))
    z[50, 60] += 1e-7
    z[120, 30] -= 5e-8
    away = prominence(z)
    # minus the median of 25 points, whose variance is 0.06 of that of one
    assert away[50, 60] == pytest.approx(100.0, rel=0.1)
    assert away[120, 30] == pytest.approx(50.0, rel=0.1)
    assert np.argwhere(away > 8.0).tolist() == [[50, 60], [120, 30]]
    with pytest.raises(ValueError, match=r"surface\.outliers: at least half of the map"):
        prominence(np.zeros((20, 20)))


def test_spikes_are_removed_and_nothing_else():
    clean = rough()
    z = clean.copy()
    spikes = [(10, 10), (10, 11), (40, 30), (63, 0)]
    for i, j in spikes:
        z[i, j] += 1e-6
    made = prepare(instrument(z, is_array=True), Options(outliers=50.0))
    step = {s.name: s for s in made.steps}
    assert step["outliers"].changed == step["fill"].changed == len(spikes)
    assert step["outliers"].before.peak > 9e-7
    assert made.prepared.std() == pytest.approx(clean.std(), rel=1e-2)
    same = np.ones(z.shape, dtype=bool)
    for i, j in spikes:
        same[i, j] = False
    difference = (made.prepared - clean)[same]
    assert difference == pytest.approx(difference.mean(), abs=1e-20)


def test_defaults_by_the_kind_of_file():
    z = rough() + 1e-6 * axes((64, 48))[0]
    array = prepare(instrument(z, is_array=True))
    assert array.tile == pytest.approx(z - z.mean(), abs=1e-20)
    assert [s.name for s in array.steps] == ["edges"]
    assert "the edges do not match" in array.steps[0].note
    measured = prepare(instrument(z))
    assert [(s.name, s.value) for s in measured.steps] == [("detrend", "tilt"), ("edges", "mirror")]
    assert measured.tile.shape == (128, 96)
    assert measured.lengths == pytest.approx((128e-6, 96e-6))
    own = prepare(instrument(rough(), is_periodic=True))
    assert own.steps == ()
    assert own.tile == pytest.approx(rough(), abs=1e-20)
    # a part of a tile, or a rotated one, is no tile
    for options in (Options(crop=(0.0, 30e-6, 0.0, 0.0)), Options(rotate=10.0)):
        assert prepare(instrument(rough(), is_array=True), options).options.edges == "mirror"
    assert prepare(instrument(rough(), is_array=True), Options(rotate=90.0)).steps[-1].name == (
        "rotate"
    )


def test_mirrored_tile():
    z = rough()[:, :33]
    tile = mirrored(z)
    assert tile.shape == (128, 66)
    # each height four times: the same distribution
    assert np.array_equal(np.sort(tile.ravel())[::4], np.sort(z.ravel()))
    # the centre of the map is on row 0
    assert np.array_equal(tile[:64, 0], z[:, 16])
    assert np.array_equal(tile[:64, 1], z[:, 17])
    # heights are continuous at every seam, where simple repetition has a step
    ramp = np.add.outer(np.arange(64.0), np.arange(33.0))
    assert jump(ramp) > 20.0
    assert jump(mirrored(ramp)) < 1.1
    # no step is larger than those inside
    around = mirrored(z)
    steps = np.abs(np.diff(np.concatenate([around, around[:1]]), axis=0)).max()
    assert steps == np.abs(np.diff(z, axis=0)).max()
    for i, j in ((0, 0), (63, 20), (64, 20), (100, 65), (127, 40)):
        assert tile[i, j] == z[unmirrored(i, j, z.shape)]


def test_mirroring_removes_the_waves_of_a_jump():
    """A step makes waves of all lengths; a ramp of 1 um without and with mirror images."""
    x, _ = axes((64, 64))
    above = []
    for tile in (x, mirrored(x)):
        q, c = surfaces.psd_isotropic(Topography(1e-6 * (tile - tile.mean()), (1e-4, 1e-4)))
        above.append(c[q > q[-1] / 4].sum())
    assert above[1] < 0.05 * above[0]


def test_windowed_tile():
    z = rough()
    tile = windowed(z)
    back = np.roll(tile, 24, axis=1)
    assert np.array_equal(back[7:57, 5:43], z[7:57, 5:43])
    assert np.abs(back[[0, -1]] - z.mean()).max() < 0.01 * np.abs(z).max()
    assert jump(np.add.outer(np.arange(64.0), np.zeros(48))) > 10.0
    assert jump(windowed(np.add.outer(np.arange(64.0), np.zeros(48)))) < 0.5


def test_crop():
    z = rough()
    part = cropped(z, (1e-6, 2e-6), (10e-6, 30e-6, 4e-6, 0.0))
    assert np.array_equal(part, z[10:30, 2:])
    with pytest.raises(ValueError, match=r"crop_x_max = 6\.5e-05 m reaches beyond .* 6\.4e-05 m"):
        cropped(z, PIXEL, (0.0, 6.5e-5, 0.0, 0.0))
    with pytest.raises(ValueError, match="leave 2 pixels"):
        cropped(z, PIXEL, (0.0, 2e-6, 0.0, 0.0))


def test_quarter_turns_are_exact():
    """Counter-clockwise: the x direction becomes y, and large x becomes large y."""
    z = np.zeros((8, 6))
    z[7, 0] = 1.0
    turned, pixel = rotated(z, (1e-6, 2e-6), 90.0)
    assert turned.shape == (6, 8)
    assert pixel == (2e-6, 1e-6)
    assert np.argwhere(turned == 1.0).tolist() == [[5, 7]]
    half, same = rotated(z, (1e-6, 2e-6), 180.0)
    assert np.array_equal(half, z[::-1, ::-1])
    assert same == (1e-6, 2e-6)


@pytest.mark.parametrize("angle", [30.0, -20.0, 45.0, 135.0])
def test_turned_lay(angle):
    """A wave along x points in the direction of the angle, in the remaining part of the map."""
    n, wavelength = 160, 16.0
    across = np.cos(2 * np.pi * (np.arange(n) - (n - 1) / 2) / wavelength)
    z = np.repeat(across[:, None], n, axis=1)
    turned, pixel = rotated(z, PIXEL, angle)
    assert pixel == PIXEL
    nx, ny = turned.shape
    # the largest square inside a rotated square
    side = n / (abs(np.cos(np.radians(angle))) + abs(np.sin(np.radians(angle))))
    assert nx * ny >= 0.9 * side * side * (1.0 if angle % 45 else 0.95)
    x, y = np.meshgrid(np.arange(nx) - (nx - 1) / 2, np.arange(ny) - (ny - 1) / 2, indexing="ij")
    along = x * np.cos(np.radians(angle)) + y * np.sin(np.radians(angle))
    inside = (slice(4, -4), slice(4, -4))
    assert turned[inside] == pytest.approx(np.cos(2 * np.pi * along / wavelength)[inside], abs=2e-3)


def test_sign_and_origin_of_a_map():
    z = rough()
    made = prepare(instrument(z), Options(sign=-1, detrend="centre"))
    assert made.prepared == pytest.approx(-(z - z.mean()), abs=1e-20)
    i, j = np.unravel_index(np.argmax(made.tile), made.tile.shape)
    x, y = made.place(i, j)
    p, q = np.unravel_index(np.argmin(z), z.shape)
    assert (x, y) == pytest.approx((p * 1e-6, q * 1e-6))


def test_record_is_json_and_lines():
    z = rough() + 1e-6 * axes((64, 48))[0]
    z[3, 4] = np.nan
    made = prepare(instrument(z))
    summary = json.loads(json.dumps(made.record.summary, allow_nan=False))
    assert [s["key"] for s in summary["steps"]] == [
        "surface.fill", "surface.detrend", "surface.edges",
    ]  # fmt: skip
    assert summary["missing"] == summary["steps"][0]["points_changed"] == 1
    level = summary["steps"][1]
    assert level["rms_before_m"] == pytest.approx(np.nanstd(z), rel=1e-3)
    assert level["rms_after_m"] == pytest.approx(made.prepared.std(), rel=1e-12)
    assert level["peak_after_m"] < level["peak_before_m"]
    assert "the tilt of a scan is that of the stage" in "\n".join(made.record.report())


def test_implausible_units_are_refused():
    with pytest.raises(ValueError, match=r"rms height .* are the heights in m"):
        prepare(instrument(rough() * 1e6, is_array=True))


# --- numbers


def test_areal_numbers_of_a_wave():
    """A sine: Sa = 2 A/pi, Sq = A/sqrt 2, Sku = 1.5; Sdq from differences of neighbours."""
    n, a = 256, 1e-7
    wave = a * np.sin(2 * np.pi * (np.arange(n) + 0.5) / 32)
    values = areal_numbers(np.repeat(wave[:, None], n, axis=1), PIXEL)
    assert values["Sq"] == pytest.approx(a / np.sqrt(2), rel=1e-12)
    assert values["Sa"] == pytest.approx(2 * a / np.pi, rel=2e-3)
    assert values["Sz"] == pytest.approx(2 * a, rel=5e-3)
    assert values["Ssk"] == pytest.approx(0.0, abs=1e-12)
    assert values["Sku"] == pytest.approx(1.5, rel=1e-12)
    assert values["Sdq"] == pytest.approx(a / np.sqrt(2) * 2 * np.pi / 32e-6, rel=1e-2)
    # lines across x: short along x, as long as the map along y
    assert values["Str"] < 0.1


def test_areal_numbers_are_those_of_the_library():
    library = pytest.importorskip("SurfaceTopography")
    z = rough()
    scan = library.Topography(z, (64e-6, 48e-6), unit="m", periodic=False)
    result = areal_numbers(z, PIXEL)
    assert result["Sq"] == pytest.approx(scan.Sq(), rel=1e-9)
    assert result["Sdq"] == pytest.approx(scan.rms_gradient(), rel=1e-9)


def test_texture_aspect_ratio_of_a_gaussian_surface():
    """White noise smoothed over lengths of 1 to 3: both autocorrelations are Gaussian."""
    from scipy.ndimage import gaussian_filter

    noise = np.random.default_rng(5).normal(size=(400, 400))
    z = gaussian_filter(noise, (3.0, 9.0), mode="wrap")
    assert texture_aspect_ratio(z, PIXEL) == pytest.approx(1 / 3, rel=0.15)
    assert texture_aspect_ratio(gaussian_filter(noise, 5.0), PIXEL) > 0.75


def test_extent_ignores_missing_points():
    z = np.outer(np.arange(10.0), np.ones(8))
    z[4, 4] = np.nan
    spread = extent(z, (2.0, 1.0))
    assert spread.slope == pytest.approx(0.5)
    assert spread.peak == pytest.approx(4.5, rel=0.01)


# --- files


@pytest.mark.parametrize("suffix", [".npy", ".txt", ".nc"])
def test_written_tiles_are_read_as_they_are(tmp_path, suffix):
    if suffix == ".nc":
        pytest.importorskip("SurfaceTopography")
    tile = Topography(rough(), (64e-6, 48e-6), "made here")
    path = write_map(tile, tmp_path / f"tile{suffix}")
    sizes = (64e-6, 48e-6) if suffix == ".npy" else (None, None)
    back = surfaces.tile_of(surfaces.read_scan(path, *sizes))
    assert back.heights == pytest.approx(tile.heights - tile.heights.mean(), abs=1e-22)
    assert (back.length_x, back.length_y) == pytest.approx((64e-6, 48e-6))
    assert back.preparation.steps == ()
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


def test_netcdf_for_xarray(tmp_path):
    import xarray as xr

    tile = Topography(rough(), (64e-6, 48e-6), "made here")
    data = xr.load_dataset(write_map(tile, tmp_path / "tile.nc"), engine="scipy")
    assert data.heights.dims == ("x", "y")
    assert np.array_equal(data.heights.values, tile.heights)
    assert float(data.x[1]) == pytest.approx(1e-6)
    assert data.heights.units == "m"


def test_unknown_suffix(tmp_path):
    with pytest.raises(ValueError, match=r"\.npy, \.txt, \.nc"):
        write_map(Topography(rough(), (1e-4, 1e-4)), tmp_path / "tile.x3p")
    assert not list(tmp_path.iterdir())
