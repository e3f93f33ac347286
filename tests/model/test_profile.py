# SPDX-License-Identifier: BSD-3-Clause
"""Profiles of stylus instruments: files, spectra, and surfaces derived from them."""

import math

import numpy as np
import pytest

import pyehl
from pyehl import cli
from pyehl.errors import InputError
from pyehl.surfaces import fractal, profile_file
from pyehl.surfaces.profile import fit, levelled
from pyehl.surfaces.profile_file import Profile, is_profile, read_profile

# these tests use only the surface of a prediction
UNSOLVED = {"psd.smooth": "hertz"}
N, DX = 600, 0.5e-6


@pytest.fixture(scope="module")
def z():
    """Heights of a fractal profile in whole nanometres, tilted."""
    made = fractal(
        (1024, 64), 1024 * DX, 64 * DX, rms_height=3e-7, hurst=0.8, rolloff_wavenumber=2e5,
        modulus="gaussian",
    ).heights[:N, 3]  # fmt: skip
    return np.rint(1e9 * (made + 1e-3 * DX * np.arange(N))) * 1e-9


def mahr(z, unit="MM", factor=1e-6):
    head = (
        f"1 2\nSAMPLE 0.0 PRF\nCX M {z.size:.6e} MM 1.0e+00 D\n"
        f"CZ M {z.size:.6e} {unit} {factor:g} L\n"
        "EOR\nSTYLUS_RADIUS 2.0e-003 MM\nSPACING CX 5.0e-04\nMAP 1.0 CZ CZ 1.0 1.0\nEOR\n"
    )
    return head + "\n".join(f"{v:.0f}" for v in z * 1e9) + "\nEOR\n"


def two(z, form, x_unit=1e-6, z_unit=1e-6, head=""):
    rows = (form.format(k * DX / x_unit, v / z_unit) for k, v in enumerate(z))
    return head + "\n".join(rows) + "\n"


FILES = {
    "mahr.prf": mahr,
    "mountains.txt": lambda z: two(z, "{:.4f}\t{:.4f}", head=f"Profile curve\n{N}\t0.5\tµm\n"),
    "comma.txt": lambda z: two(
        z, "{:.4f};{:.4f}", x_unit=1e-3, head="Profil;R\nX [mm];Z [µm]\n"
    ).replace(".", ","),
    "dektak.csv": lambda z: two(
        z, "{:.3f},{:.1f},", z_unit=1e-10,
        head="Scan Data\nStylus Type,Radius: 12.5 um\nLateral um,Total Profile Å,\n",
    ),
    "mitutoyo.csv": lambda z: "Surftest\nMeasuring length,0.3,mm\nPitch,0.5,um\nHeight [um]\n"
    + "\n".join(f"{v * 1e6:.4f}" for v in z),
    "index.txt": lambda z: "No X(mm) Z(um)\n"
    + "\n".join(f"{k} {k * DX * 1e3:.5f} {v * 1e6:.4f}" for k, v in enumerate(z)),
    "inches.dat": lambda z: two(z, "{:.9f} {:.9f}", 0.0254, 2.54e-8, head="X (in)  Z (uin)\n"),
    "pairs.csv": lambda z: two(z, "{:.4f},{:.4f}", head="x (um),z (um)\n"),
}  # fmt: skip


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_profiles_are_read_with_their_units(tmp_path, z, name, encoding):
    path = tmp_path / name
    path.write_text(FILES[name](z), encoding=encoding, newline="\r\n")
    result = read_profile(path)
    assert result.spacing == pytest.approx(DX, rel=1e-3)
    assert result.heights == pytest.approx(z, abs=2e-10)
    assert is_profile(path)


def test_one_column_asks_for_its_length_and_unit(tmp_path, z):
    path = tmp_path / "one.pro"
    path.write_text("\n".join(f"{v * 1e6:.4f}" for v in z))
    with pytest.raises(
        InputError, match=r"unit of the heights.*not known\nexpected: surface\.height"
    ):
        read_profile(path)
    with pytest.raises(InputError, match=r"one column\nexpected: surface\.length_x"):
        read_profile(path, height_unit="um")
    result = read_profile(path, N * DX, "um")
    assert result.heights == pytest.approx(z, abs=1e-10)
    assert result.spacing == pytest.approx(DX)
    np.save(tmp_path / "one.npy", z)
    assert np.array_equal(read_profile(tmp_path / "one.npy", N * DX, "m").heights, z)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 2\n" * 10, "no column of 32 heights"),
        (
            mahr(np.zeros(40)).replace("4.000000e+01 MM 1e-06", "5.000000e+01 MM 1e-06"),
            "40 heights",
        ),
        (mahr(np.zeros(40), unit="FURLONG"), "unit 'FURLONG' of CZ"),
        (mahr(np.zeros(40)).replace("CX M 4.0", "CX M x4.0"), "'x4.0.*' in the record CX"),
        (mahr(np.zeros(40)).replace("MM 1e-06 L", "MM one L"), "'one' in the record CZ"),
        (mahr(np.zeros(40)).replace("CX 5.0e-04", "CX nan"), "'nan' in the record SPACING"),
        (two(np.arange(40) * 1e-6, "{:.4f} {:.4f}", head="x [um]  z [m]\n"), "rms slope of 2e"),
        (
            "0 1\n" + "\n".join(f"{k} {k % 3}" for k in range(40)) + "\n41\n",
            "line 42 has 1 numbers",
        ),
        (two(np.full(40, np.nan), "{:.3f} {:.3f}", head="x [um]  z [um]\n"), "height 1 .* missing"),
    ],
)
def test_bad_profiles_are_refused(tmp_path, text, message):
    path = tmp_path / "p.txt"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_profile(path, height_unit="um" if "41" in message or "line" in message else None)


def made(hurst, rolloff, seed, n=4096, rms=3e-7):
    """Half of a periodic Gaussian profile with a spectrum max(q, q_r)^(-1 - 2 H)."""
    random = np.random.default_rng(seed)
    q = 2.0 * np.pi * np.fft.rfftfreq(n, 1e-6)
    power = np.maximum(np.maximum(q, rolloff), q[1]) ** (-1.0 - 2.0 * hurst)
    power[0] = 0.0
    waves = np.sqrt(power) * (random.normal(size=q.size) + 1j * random.normal(size=q.size))
    heights = np.fft.irfft(waves)
    scale = rms / math.sqrt(4.0 * float(power[1:].sum())) * n
    return Profile(heights[: n // 2] * scale, 1e-6, "made")


@pytest.mark.parametrize(("hurst", "rolloff"), [(0.5, 0.0), (0.8, 6e4), (0.3, 1e5), (0.9, 0.0)])
def test_bands_contain_the_true_values(hurst, rolloff):
    """For 20 profiles nearly all bands of 95 % contain the true value."""
    contained = {"hurst": 0, "rolloff": 0, "rms": 0}
    for seed in range(20):
        result = fit(made(hurst, rolloff, seed), ridges=True)
        contained["hurst"] += result.hurst_band[0] <= hurst <= result.hurst_band[1]
        # a roll-off that cannot be distinguished from none is none
        reported = result.rolloff_band[0] <= rolloff <= result.rolloff_band[1]
        contained["rolloff"] += reported or result.rolloff == 0.0
        contained["rms"] += result.rms_band[0] <= 3e-7 <= result.rms_band[1]
        assert result.hurst_band[1] - result.hurst_band[0] < 0.5
    assert contained["hurst"] >= 17
    assert contained["rolloff"] >= 17
    if rolloff:
        assert contained["rms"] >= 17


@pytest.mark.long
def test_an_isotropic_surface_follows_from_its_profile():
    """The spectral exponent of the profile is lower by one than that of the surface."""
    result = []
    for seed in range(6):
        tile = fractal(
            (2048, 512), 1.024e-3, 2.56e-4, rms_height=3e-7, hurst=0.7, seed=seed,
            rolloff_wavenumber=1e5, modulus="gaussian",
        )  # fmt: skip
        result.append(fit(Profile(tile.heights[::2, 5], 1e-6, "made")))
    assert np.mean([f.hurst for f in result]) == pytest.approx(0.7, abs=0.07)
    assert np.median([f.rolloff for f in result]) == pytest.approx(1e5, rel=0.15)
    assert np.mean([f.rms for f in result]) == pytest.approx(3e-7, rel=0.1)


@pytest.mark.long
def test_a_profile_extended_to_ridges(tmp_path, z):
    path = tmp_path / "ridges.prf"
    path.write_text(mahr(z))
    case = pyehl.Case.from_text(f"&surface kind = 'map' file = '{path}' profile = 'ridges' /")
    about = pyehl.predict(case, UNSOLVED, tracks=1).summary
    flat = levelled(read_profile(path))
    assert about["rms_height_m"] == pytest.approx(flat.std(), rel=1e-6)
    assert about["length_x_m"] == pytest.approx(2 * N * DX)
    made = about["surface_preparation"]
    assert "extended across" in made["note"]
    assert [step["value"] for step in made["steps"]] == ["tilt", "mirror"]
    assert f"rms height  {flat.std():.2E} m".replace("  ", " ") in str(pyehl.check(case)).replace(
        "  ", " "
    )


def test_a_profile_extended_to_an_isotropic_surface(tmp_path, z):
    path = tmp_path / "p.prf"
    path.write_text(mahr(z))
    case = pyehl.Case.from_text(
        f"&surface kind = 'map' file = '{path}' profile = 'isotropic' pixels = 128 /"
    )
    result = pyehl.predict(case, UNSOLVED, tracks=1)
    fitted = fit(read_profile(path))
    tile = result.surface
    assert tile.shape == (128, 128)
    assert tile.size == pytest.approx((N * DX, N * DX))
    assert 0.8 * fitted.rms < tile.rms_height <= fitted.rms
    assert f"Hurst exponent {fitted.hurst:.2f}" in tile.preparation.record.note
    # the same along and across, and another seed gives another surface
    slopes = [np.std(np.diff(tile.heights, axis=axis)) for axis in (0, 1)]
    assert slopes[0] == pytest.approx(slopes[1], rel=0.1)
    other = pyehl.predict(case, UNSOLVED, {"surface.seed": 2}, tracks=1).surface
    assert abs(np.mean(other.heights * tile.heights)) < 0.5 * tile.rms_height**2
    assert f"{tile.rms_height:.2E} m" in str(pyehl.check(case))


@pytest.mark.parametrize("points", [False, True])
def test_a_text_map_is_no_profile(tmp_path, points):
    """Neither many columns, nor a list of x, y and z."""
    heights = 1e-8 * np.random.default_rng(1).normal(size=(40, 40))
    x, y = (1e-6 * axis.ravel() for axis in np.mgrid[:40, :40])
    table = np.column_stack([x, y, heights.ravel()]) if points else heights
    np.savetxt(tmp_path / "map.txt", table)
    assert not is_profile(tmp_path / "map.txt")


@pytest.mark.parametrize("name", ["map.txt", "map.sur"])
def test_a_map_is_not_read_whole_as_a_profile(tmp_path, monkeypatch, name):
    """Maps are large: neither lines of many numbers nor binary data are parsed."""
    random = np.random.default_rng(1)
    if name == "map.txt":
        np.savetxt(tmp_path / name, random.normal(size=(40, 40)))
    else:
        (tmp_path / name).write_bytes(random.bytes(4096))
    monkeypatch.setattr(profile_file, "read_profile", pytest.fail)
    assert not is_profile(tmp_path / name)


def test_a_profile_in_place_of_a_map_names_the_key(tmp_path, z, capsys):
    path = tmp_path / "p.prf"
    path.write_text(mahr(z))
    case = pyehl.Case.from_text(f"&surface kind = 'map' file = '{path}' /")
    with pytest.raises(InputError, match=r"surface\.profile = 'isotropic'"):
        pyehl.predict(case)
    assert cli.main(["surface", str(path)]) == 0
    out = capsys.readouterr().out
    result = fit(read_profile(path))
    assert f"Hurst      {result.hurst:.2f} ({result.hurst_band[0]:.2f} to" in out
    keys = next(line for line in out.splitlines() if "&surface kind" in line)
    there = pyehl.Case.from_text(keys.strip()).resolve()["surface"]
    assert there["rms_height"] == pytest.approx(result.rms, rel=5e-3)
    assert there["rolloff_wavenumber"] == pytest.approx(result.rolloff, rel=5e-3)
    assert math.isclose(there["hurst"], result.hurst, abs_tol=5e-3)
