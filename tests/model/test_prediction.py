# SPDX-License-Identifier: BSD-3-Clause
"""The prediction by the response of the contact: its parts and its limits."""

import importlib
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import scipy.interpolate
import scipy.ndimage

import pyehl
from pyehl.contact.result_folder import read_contact
from pyehl.contact.smooth import hertz_contact, solve_contact, zone_of
from pyehl.prediction import model, response
from pyehl.prediction.breakdown import ways_into_range
from pyehl.prediction.friction import run
from pyehl.prediction.model import KNOWN_RATIO, Model, ModelOptions
from pyehl.prediction.moving_tile import WaveFactors, WaveTiles
from pyehl.prediction.predict import predict
from pyehl.prediction.response import Transfer, leaking_at_amplitude
from pyehl.prediction.spectrum import Spectrum
from pyehl.schema import summary_of
from pyehl.simulation.resolution import resolution
from pyehl.surfaces import Topography, filtered
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.transport import Zone, free_stiffness, stiffness

CASES = Path(__file__).resolve().parents[2] / "cases"
POINT, OIL = OperatingPoint(), Lubricant()


def one_transfer(spectrum, zone, moes, ratio, **options) -> Transfer:
    return Transfer.of_all([(spectrum, ratio)], zone, moes, **options)[0]


def passage(contact, tile, ratio=1.01, **options):
    return Model.of_one(tile, contact, POINT, OIL, ModelOptions(**options), ratio)


def test_smooth_contact_is_that_of_a_fine_grid(contact):
    # the Richardson limit of two solvers (z = 0.6684), good to 0.2 %
    assert contact.central_film == pytest.approx(0.02459, rel=3e-3)
    assert contact.pressure.max() == pytest.approx(1.004, abs=0.01)


def test_every_function_of_the_table_of_equations_exists(root):
    """In the head of the module, and on the theory page."""
    page = (root / "docs" / "theory" / "prediction.md").read_text(encoding="utf-8")
    for kind, name in re.findall(r":(\w+):`([\w.]+)`", model.__doc__):
        parts = (name if name.startswith("pyehl.") else f"pyehl.prediction.{name}").split(".")
        module, rest = (parts, []) if kind == "mod" else (parts[:3], parts[3:])
        result = importlib.import_module(".".join(module))
        for part in rest:
            result = getattr(result, part)
    table = page[page.index("## From equation to module") :]
    rows = re.findall(r"^\|.*\|(.*)\|$", table, re.M)
    for path in re.findall(r"`(pyehl/[\w/]+\.py)`", table):
        text = (root / path).read_text(encoding="utf-8")
        names = re.findall(rf"((?:`[\w.]+`, )+)`{path}`", table)
        for name in re.findall(r"`([\w.]+)`", "".join(names)):
            assert f" {name.split('.')[-1]}(" in text or f"class {name}" in text, (path, name)
    assert len(rows) > 10


def test_no_roughness_no_change(contact, table_1):
    flat = Topography(1e-9 * table_1(pixels=64).heights, (8.29e-4, 8.29e-4))
    friction, tracks, bands = run(passage(contact, flat))
    assert friction.mu_ratio == pytest.approx(1.0, abs=1e-7)
    assert tracks[0] == pytest.approx(1.0, abs=1e-7)
    assert sum(band.increase for band in bands) == pytest.approx(friction.mu_ratio - 1.0, abs=1e-12)


def test_a_tile_of_one_wave_follows_the_transfer():
    """Tiles of one wave against cos and sin, driven and free, the surface 20 % faster."""
    n, side, turns = 48, 2.0, 3
    x = np.arange(n) * side / n
    q = 2.0 * np.pi * turns / side
    spectrum = Spectrum.of(np.tile(np.cos(q * x)[:, np.newaxis], n), side, side)
    t = np.full(spectrum.values.shape, 0.4 * np.exp(0.6j))
    transfer = Transfer([t] * 3, [0.5 * t] * 3, [0.1 * t] * 8, bent=False)
    waves = WaveTiles.of(spectrum, WaveFactors.of(spectrum, transfer, 0.0, 1.2))
    k = float(stiffness(q))
    film, pressure = np.moveaxis(waves.driven[1], -1, 0)
    assert film[:, 7] == pytest.approx(np.real(0.4 * np.exp(1j * (q * x + 0.6))), abs=1e-6)
    expected = k * np.real((1.0 - 0.4 * np.exp(0.6j)) * np.exp(1j * q * x))
    assert pressure[:, 7] == pytest.approx(expected, abs=1e-5)
    fine = np.arange(4 * n) * side / (4 * n)
    free = np.real(0.2 * np.exp(1j * (q * fine + 0.6)))
    # amplified by the loss of linear interpolation between four points per pixel
    assert waves.free[0][:, 5, 0] == pytest.approx(free, abs=2e-3 * 0.2)
    # the free wave has the wavenumber of a surface that moves at the mean velocity
    assert waves.free[0][:, 5, 1] == pytest.approx(-1.2 * k * free, abs=2e-3 * 0.2 * k)


def test_real_amplitude_ratio_moves_with_the_roughness(table_1, settings):
    """Without slip, lag and a solved contact it is the model of the paper."""
    film = 0.2333e-6
    tile = table_1(seed=4)
    options = {"reduction": "amplitude", "smooth": "hertz"}
    contact = hertz_contact(film / POINT.film_scale, "given")
    ours = run(passage(contact, tile, **options), tracks=1)[0].mu_ratio
    settings["surface"]["seed"] = 4
    paper = predict(settings).mu_ratio
    # the edge of the contact affects long waves, which the model of the paper omits
    assert ours == pytest.approx(paper, rel=0.02)


def test_slip_shifts_the_free_wave(contact, table_1):
    """One per cent of slip in either direction causes the increase for a Table 1 surface."""
    tile = table_1(seed=21)
    ratio = {u: run(passage(contact, tile, u), tracks=1)[0].mu_ratio for u in (0.99, 1.0, 1.01)}
    assert ratio[1.0] < 1.0 < min(ratio[0.99], ratio[1.01])
    assert ratio[0.99] == pytest.approx(ratio[1.01], rel=0.1)


def test_a_surface_in_motion_and_its_mirror_image(contact, table_1):
    """The contact is symmetric in Y."""
    rough = table_1(seed=3)
    mirrored = Topography(np.roll(rough.heights[:, ::-1], 1, axis=1), rough.size)
    one, other = (run(passage(contact, tile), 1)[0].mu_ratio for tile in (rough, mirrored))
    assert one == pytest.approx(other, rel=1e-5)


def test_table_is_fine_enough(contact, table_1, monkeypatch):
    """Finer tables of responses, stations and points of friction change the result negligibly."""
    tile = table_1(seed=5)
    usual = run(passage(contact, tile), tracks=1)[0].mu_ratio
    monkeypatch.setattr("pyehl.prediction.spectrum.TABLE", (145, 49))
    assert run(passage(contact, tile), 1)[0].mu_ratio == pytest.approx(usual, rel=5e-4)
    monkeypatch.setattr("pyehl.prediction.model.PIXEL_POINTS", 128)
    assert run(passage(contact, tile), 1)[0].mu_ratio == pytest.approx(usual, rel=1e-3)


def test_film_breakdown_has_no_ratio(contact, table_1):
    high = Topography(12.0 * table_1().heights, (8.29e-4, 8.29e-4))
    friction, tracks, bands = run(passage(contact, high))
    assert friction.status == "film breakdown"
    assert np.isnan(friction.mu_ratio)
    assert np.isnan(tracks[0])
    assert not bands


def test_transfer_is_interpolated_from_its_table(contact):
    """Components between the points of the table: T to 2e-3."""
    rng = np.random.default_rng(2)
    spectrum = Spectrum.of(rng.standard_normal((40, 36)), 1.7, 1.9)
    zone = zone_of(contact, POINT, OIL)
    coarse = one_transfer(spectrum, zone, (1000.0, 10.0), 1.02)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("pyehl.prediction.spectrum.TABLE", (217, 73))
        fine = one_transfer(spectrum, zone, (1000.0, 10.0), 1.02)
    for a, b in zip(coarse.driven + coarse.free, fine.driven + fine.free, strict=True):
        assert np.abs(a - b)[spectrum.q > 0].max() < 2e-3


@pytest.mark.filterwarnings("error")
def test_a_flat_surface_has_no_share_of_short_waves():
    assert Spectrum.of(np.zeros((8, 8)), 1.0, 1.0).share_below(0.5) == 0.0


def test_outside_the_range_is_reported(settings):
    settings["psd"] |= {"reduction": "response", "smooth": "solved"}
    settings["surface"]["velocity_ratio"] = 1.6
    summary = predict(settings).summary
    assert summary["outside_range"] == ["velocity_ratio"]
    assert summary["mu_ratio_model_error"] is None
    settings["surface"]["velocity_ratio"] = 1.01
    summary = predict(settings).summary
    assert summary["outside_range"] == []
    assert 0.0 < summary["mu_ratio_model_error"] < 0.1


def test_options_of_the_paper_alone(settings):
    settings["psd"] |= {"reduction": "response", "load_balance": True}
    with pytest.raises(ValueError, match="belong to the model of the paper"):
        predict(settings)


def test_smooth_contact_from_a_result_folder(tmp_path):
    """A folder of the smooth contact replaces the solution; another contact is refused."""
    case = pyehl.Case(CASES / "table1.nml", "surface.kind=smooth", "grid.points=257")
    folder = tmp_path / "smooth"
    pyehl.solve(case, output=folder)
    given = pyehl.predict(CASES / "table1.nml", smooth=folder)
    on_the_spot = pyehl.predict(CASES / "table1.nml")
    # extrapolated films, with their errors, and mu_r/mu_s: the same numbers
    names = "h_c_m", "h_c_error_m", "h_min_m", "h_min_error_m", "mu_ratio", "mu_ratio_model_error"
    assert [given.summary[n] for n in names] == [on_the_spot.summary[n] for n in names]
    assert given.film_source == f"smooth contact in {folder}, extrapolated"
    barus = {"lubricant.viscosity_law": "barus"}
    with pytest.raises(pyehl.InputError, match=r"viscosity_law is 'roelands' there and 'barus' in"):
        pyehl.predict(CASES / "table1.nml", barus, smooth=folder)
    with pytest.raises(pyehl.InputError, match=r"grid\.border is 'zero' there and 'flooded' in"):
        pyehl.predict(CASES / "table1.nml", {"grid.border": "flooded"}, smooth=folder)
    with pytest.raises(pyehl.InputError, match="moes_m is"):
        pyehl.predict(CASES / "table1.nml", "contact.load=500.0", smooth=folder)
    with pytest.raises(pyehl.InputError, match="not a result folder"):
        pyehl.predict(CASES / "table1.nml", smooth=tmp_path)
    point = OperatingPoint.from_moes(given.operating.moes_m, given.operating.moes_l)
    assert read_contact(folder, point, given.settings).central_film > 0.0
    with pytest.raises(pyehl.InputError, match=r"radius_ratio is 1 there and 0\.5"):
        read_contact(folder, replace(point, radius_ratio=0.5), given.settings)
    thinning = {"lubricant.shear_law": "eyring", "contact.slide_to_roll": 0.2}
    with pytest.raises(pyehl.InputError, match="the flow is newtonian there and eyring at 5e"):
        pyehl.predict(CASES / "table1.nml", thinning, smooth=folder)


def test_turned_ellipse_is_no_smooth_contact_of_another(tmp_path):
    ellipse = {"contact.radius_ratio": 0.5, "contact.moes_m": 50.0, "contact.moes_l": 5.0}
    case = pyehl.Case.from_text("", ellipse | {"grid.points": 65, "contact.angle": 30.0})
    pyehl.solve(case, output=tmp_path / "turned")
    case = pyehl.Case.from_text("", ellipse | {"surface.kind": "harmonic"})
    with pytest.raises(pyehl.InputError, match=r"contact\.angle is 30 there and 0 in the case"):
        pyehl.predict(case, smooth=tmp_path / "turned")


def test_what_a_grid_does_not_resolve():
    """On a coarser grid more friction is unresolved; the parts agree with the bands."""
    result = {}
    for points in (129, 513):
        case = pyehl.Case(CASES / "table1.nml", f"grid.points={points}")
        result[points] = resolution(case)
    assert result[129].mu_ratio == result[513].mu_ratio
    assert result[129].matters
    assert result[129].resolved < result[513].resolved < result[513].mu_ratio
    assert resolution(pyehl.Case(CASES / "quick.nml")) is None


def test_waves_left_out_are_in_the_error():
    """A coarse transient run: its error is that of the grids plus the omitted waves."""
    # M = 200, L = 10
    options = "contact.load=119.0", "surface.rms_height=5e-9", "surface.length_x=4e-4"
    options = *options, "surface.length_y=4e-4", "contact.mean_velocity=0.832", "grid.points=65"
    options = *options, "grid.x_inlet=-2.5", "grid.x_outlet=1.5", "grid.y_extent=2.0"
    summary = summary_of(pyehl.solve(CASES / "table1.nml", *options))
    assert summary["variance_left_out"] > 0.0
    # grids that do not resolve all waves have no common limit to extrapolate to
    assert "mu_ratio_extrapolated" not in summary
    assert abs(summary["mu_ratio_unresolved"]) > summary["mu_ratio_error_left_out"] > 0.0
    parts = [summary[f"mu_ratio_error_{part}"] for part in ("grid", "stop", "left_out", "domain")]
    assert summary["mu_ratio_error"] == pytest.approx(sum(parts), rel=1e-12)


def test_beyond_the_linear_response(contact, table_1):
    """Short waves as high as the film: no number, but the cut-off that would give one."""
    rough = table_1(seed=21, rms_height=8e-8, hurst=0.4)
    model = passage(contact, rough, 1.03)
    friction, _, _ = run(model)
    assert friction.status == "beyond linear response"
    assert np.isnan(friction.mu_ratio)
    cut = float(re.search(r"shortest_wavelength = (\S+)", ways_into_range(model))[1])
    # the suggestion is correct
    taken, _, _ = run(passage(contact, filtered(rough, shortest_wavelength=cut), 1.03))
    assert taken.status == "predicted"
    assert 1.0 < taken.mu_ratio <= KNOWN_RATIO


def test_leak_at_amplitude_for_gaussian_pressure():
    """The mean of exp(b p) falls at the rate of small waves over its gain, by a random field."""
    rng = np.random.default_rng(7)
    n, b = 4096, 3.0
    k = np.fft.rfftfreq(n, 1.0 / n)
    strength = np.where((k > 20) & (k < 120), 1.0, 0.0)
    rates = []
    for _ in range(20):
        p = np.fft.irfft(strength * np.exp(2j * np.pi * rng.random(k.size)), n)
        p *= 0.3 / p.std()
        weight = np.exp(b * p)

        def curvature(values):
            return np.fft.irfft(-(k**2) * np.fft.rfft(values), n)

        leak, small = curvature(-np.exp(-b * p) / b), curvature(p)
        rates.append((np.mean(weight * leak), np.mean(weight * small)))
    measured, linear = np.mean(rates, axis=0)
    places = np.array([0.0])
    one = places + 1.0
    leaking = leaking_at_amplitude(
        Zone(places, one, one, one, places, places, b * one, one), 0.3**2
    )
    assert measured / linear == pytest.approx(leaking.conductance[0], rel=0.03)


def test_second_order_keeps_the_mass_of_every_column(contact, monkeypatch):
    """The weighted mean of the pressure, taken point by point, is that of the convolution."""
    monkeypatch.setattr(response, "INLET_PRESSURE", 0.0)
    rng = np.random.default_rng(4)
    n, length, ratio = 64, 1.0, 1.02
    zone = zone_of(contact, POINT, OIL)
    film, c, r = (
        np.interp(0.0, zone.x, v) for v in (zone.film, zone.compressibility, zone.curvature)
    )
    weighted = []
    for _ in range(40):
        rough = scipy.ndimage.gaussian_filter(rng.standard_normal((n, n)), 1.5, mode="wrap")
        spectrum = Spectrum.of(3e-3 * rough, length, length)
        transfer = one_transfer(spectrum, zone, (1000.0, 10.0), ratio)
        gain, variance = transfer.second.of(spectrum.power)
        t, k = transfer.at_centre(spectrum, ratio), stiffness(spectrum.q)
        pressure = spectrum.tile(transfer.pressure_at_centre(spectrum, ratio))
        lost = spectrum.tile(t)
        assert variance[1] == pytest.approx(pressure.var(), rel=0.04)
        source = c * pressure * lost - 0.5 * r * film * pressure**2
        second = Spectrum.of(source, length, length).tile(k / (1.0 + k * film * c))
        raised = Spectrum.of(second, length, length).tile(1.0 / np.maximum(k, 1e-9))
        left = []
        for p, h in ((pressure, film - lost), (pressure + second, film - lost + raised)):
            mass = (1.0 + c * p + 0.5 * r * p**2) * h - film * c * pressure + lost
            left.append(mass.std())
        # of third order
        assert left[1] < 0.15 * left[0]
        weight = np.exp(12.0 * pressure)
        pointwise = gain[1] * (pressure**2 - pressure.var())
        weighted.append([np.mean(p2 * weight) / weight.mean() for p2 in (pointwise, second)])
    pointwise, convolution = np.mean(weighted, axis=0)
    assert pointwise == pytest.approx(convolution, rel=0.05)


@pytest.mark.parametrize(
    ("ratio", "low", "high"), [(1.0, 0.9, 1.3), (1.01, 0.1, 0.9), (1.1, 0.0, 0.03)]
)
def test_second_order_of_the_inlet_fades_with_slip(contact, monkeypatch, ratio, low, high):
    """It is convected: only the part that is correlated with the pressure has an effect."""
    length, n = 1.0, 64
    zone = zone_of(contact, POINT, OIL)
    heights = np.random.default_rng(5).standard_normal((n, n))
    rough = scipy.ndimage.gaussian_filter(heights, 1.5, mode="wrap")
    spectrum = Spectrum.of(3e-3 * rough, length, length)
    transfer = one_transfer(spectrum, zone, (1000.0, 10.0), ratio)
    whole, _ = transfer.second.of(spectrum.power)
    monkeypatch.setattr(response, "INLET_PRESSURE", 0.0)
    without, _ = transfer.second.of(spectrum.power)
    turn = np.exp(1j * spectrum.qx[:, np.newaxis] * (ratio - 1.0))
    free = free_stiffness(spectrum.qx[:, np.newaxis], spectrum.qy, ratio) * transfer.free[1]
    convected = spectrum.tile(turn * (stiffness(spectrum.q) - free))
    pressure = spectrum.tile(transfer.pressure_at_centre(spectrum, ratio))
    share = np.mean(convected * pressure) / pressure.var()
    assert (whole - without)[1] == pytest.approx(0.5 * share**2, rel=0.05, abs=2e-3)
    assert low <= share**2 <= high


def test_leak_depends_on_the_square_of_the_amplitude():
    """The leakage depends on the amplitude by its square."""
    case = pyehl.Case.from_text("&contact moes_m = 200.0 moes_l = 10.0 /").resolve()
    point, oil = OperatingPoint.from_settings(case), Lubricant.from_settings(case)
    smooth = solve_contact(case)
    zone = zone_of(smooth, point, oil)
    heights = np.random.default_rng(3).standard_normal((32, 32))
    changes = []
    for rms in (1e-5, 2e-5):
        spectrum = Spectrum.of(rms * heights, 1.0, 1.0)
        small = one_transfer(spectrum, zone, (200.0, 10.0), 1.05)
        result = one_transfer(spectrum, zone, (200.0, 10.0), 1.05, at_amplitude=True)
        changes.append(np.abs(result.free[1] - small.free[1]).max())
    assert 0.0 < changes[0] < 1e-3
    assert changes[1] == pytest.approx(4.0 * changes[0], rel=0.01)
