# SPDX-License-Identifier: BSD-3-Clause
"""Transient runs from Python: fields, frames, omissions, pictures, the step benchmark."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from PIL import Image

import pyehl
from pyehl import cli, results
from pyehl.netcdf import export
from pyehl.plots import transient
from pyehl.plots.figures import solution_figures
from pyehl.plots.style import new_figure
from pyehl.schema import summary_of

WAVE = (
    "&contact load = 20.0 /\n&grid points = 65 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    "&surface kind = 'harmonic' amplitude_over_film = 0.2 wavelength = 0.8 /\n"
    "&time estimate_error = .false. /\n&output frame_interval = 0.5 /\n"
)
# a^3 = 3wR/(2E')
RADIUS = (1.5 * 20.0 * 0.018 / 2.26e11) ** (1.0 / 3.0)


@pytest.fixture(scope="module")
def run_folder(tmp_path_factory) -> Path:
    """Results of a short run in SI units."""
    folder = tmp_path_factory.mktemp("run")
    (folder / "case.nml").write_text(WAVE)
    assert cli.main(["run", str(folder / "case.nml"), "-o", str(folder / "out"), "-q"]) == 0
    return folder / "out"


def test_fields_and_frames_with_units(run_folder: Path):
    data = pyehl.load(run_folder)
    assert isinstance(data, xr.Dataset)
    frames = data.sizes["T"]
    assert frames >= 3
    for name, si, unit, scale in (
        ("P_smooth", "p_smooth_Pa", "Pa", 30.0 / (np.pi * RADIUS**2)),
        ("H_smooth", "h_smooth_m", "m", RADIUS**2 / 0.018),
        ("RR", "rr_m", "m", RADIUS**2 / 0.018),
        ("A_d", "a_d_m", "m", RADIUS**2 / 0.018),
        ("frame_P", "frame_p_Pa", "Pa", 30.0 / (np.pi * RADIUS**2)),
        ("frame_H", "frame_h_m", "m", RADIUS**2 / 0.018),
    ):
        assert data[name].dims == (("X", "Y", "T") if "frame" in name else ("X", "Y"))
        assert data[name].shape == ((65, 65, frames) if "frame" in name else (65, 65))
        assert (data[name].units, data[si].units) == ("1", unit)
        assert data[name].long_name
        assert data[si].values == pytest.approx(data[name].values * scale, rel=1e-12)
    assert np.array_equal(data["A_d"].values, data["H_smooth"].values - data["H"].values)
    assert data["t_s"].units == "s"
    assert data["t_s"].values == pytest.approx(data["T"].values * RADIUS / 0.84, rel=1e-12)
    # frames at the first step past each multiple of the interval
    step = 4.0 / 64
    past = data["T"].values - 0.5 * np.floor(data["T"].values / 0.5)
    assert np.all((past >= 0.0) & (past < step))
    assert np.diff(np.floor(data["T"].values / 0.5)) == pytest.approx(1.0)
    assert float(np.abs(data["RR"]).max()) <= float(data.amplitude)

    with xr.open_dataset(export(run_folder), engine="scipy") as again:
        assert again["frame_p_Pa"].dims == ("T", "Y", "X")
        assert np.array_equal(again["frame_p_Pa"].values.T, data["frame_p_Pa"].values)
        assert again["a_d_m"].units == "m"
        assert np.array_equal(again["t_s"].values, data["t_s"].values)


def test_last_frame_is_of_its_step(drive, tmp_path: Path):
    (tmp_path / "case.nml").write_text(WAVE)
    # a step is 0.0625, and 13 were skipped
    done = drive("ehl", "case.nml", "-o", "out", "--set", "time.steps=11")
    assert done.returncode == 1
    run = pyehl.load(tmp_path / "out")
    assert run["T"].values.tolist() == [1.0, 1.5]
    assert run["history_T"].values[-1] == 1.5
    assert np.array_equal(run["frame_P"][:, :, -1], run["P"])
    assert np.array_equal(run["frame_H"][:, :, -1], run["H"])
    assert not np.array_equal(run["frame_H"][:, :, 0], run["H"])


def test_huge_ratios_are_printed(drive, tmp_path: Path):
    # A wave as high as the film of a thick oil with a large pressure-viscosity coefficient
    (tmp_path / "case.nml").write_text(
        "&contact moes_m = 500.0 moes_l = 15.0 /\n&grid points = 129 /\n"
        "&surface kind = 'harmonic' amplitude_over_film = 0.93 wavelength = 0.25 /\n"
    )
    words = ["--set", "time.steps=35", "--set", "time.estimate_error=.false."]
    done = drive("ehl", "case.nml", "-o", "out", *words)
    ratio = json.loads((tmp_path / "out" / "summary.json").read_text())["last_mu_ratio"]
    assert ratio > 1e3
    assert f"mu_r/mu_s {ratio:.5E}" in done.stdout


def test_plot_of_a_transient_run(run_folder: Path, tmp_path: Path, capsys):
    assert cli.main(["plot", str(run_folder), "-o", str(tmp_path), "--dpi", "40"]) == 0
    written = {Path(line).name for line in capsys.readouterr().out.splitlines()}
    assert {"friction.png", "deformed_roughness.png", "rough_and_smooth.png"} < written
    assert {path.name for path in tmp_path.iterdir()} == written


@pytest.mark.long
def test_movie_has_all_frames(run_folder: Path, tmp_path: Path, monkeypatch):
    monkeypatch.setattr("pyehl.plots.movie.DPI", 40)
    assert cli.main(["plot", str(run_folder), "-o", str(tmp_path), "--movie"]) == 0
    with Image.open(tmp_path / "movie.gif") as picture:
        assert picture.n_frames == pyehl.load(run_folder).sizes["T"]
    assert {path.name for path in tmp_path.iterdir()} == {"movie.gif"}


def test_friction_history_shows_the_averaging_window(run_folder: Path):
    data = pyehl.load(run_folder)
    mean, period = float(data.mu_ratio), float(data.T_mean)
    run = {name: data[name].values for name in ("history_T", "history_mu_ratio")}
    ax = transient.friction_history(
        run["history_T"],
        run["history_mu_ratio"],
        period=period,
        mean=mean,
        formula=2.0,
        ax=new_figure(5.4, 3.4).subplots(),
    )
    lines = {line.get_label(): line.get_xydata() for line in ax.get_lines()}
    assert np.array_equal(lines["rough"][:, 1], run["history_mu_ratio"])
    end = run["history_T"][-1]
    assert lines[f"mean {mean:.3f}"].tolist() == [[end - period, mean], [end, mean]]
    (window,) = ax.patches
    assert window.get_x() == pytest.approx(end - period)
    assert window.get_width() == pytest.approx(period)
    # every line is inside
    assert ax.get_ylim()[1] > 2.0
    assert lines["eq. 16: 2.000"][0, 1] == 2.0


def test_deformed_roughness_ends_at_the_circle_and_shares_a_scale(run_folder: Path):
    data = pyehl.load(run_folder)
    run = {name: data[name].values for name in ("X", "Y", "RR", "A_d")}
    figure = solution_figures(data, "hertz")["deformed_roughness"]
    images = [ax.images[0] for ax in figure.axes[:2]]
    assert images[0].get_clim() == images[1].get_clim()
    inside = (run["X"][:, None] ** 2 + run["Y"] ** 2 <= 1.0)[np.abs(run["X"]) <= 1.0]
    inside = inside[:, np.abs(run["Y"]) <= 1.0]
    for image, name in zip(images, ("RR", "A_d"), strict=True):
        shown = np.ma.filled(image.get_array(), np.nan).T
        assert np.array_equal(np.isnan(shown), ~inside)
        assert np.nanmax(np.abs(shown)) <= image.get_clim()[1]
        field = run[name][np.abs(run["X"]) <= 1.0][:, np.abs(run["Y"]) <= 1.0]
        assert shown[inside] == pytest.approx(1e3 * field[inside])


def test_eq_16_only_where_it_holds(run_folder: Path):
    data = pyehl.load(run_folder)
    # M = 31, outside the range of the fit
    assert transient.eq_16(summary_of(data), results.settings_of(data)) is None
    inside = {"moes_m": 1000.0, "moes_l": 10.0, "H_c": 0.0243, "amplitude": 9.72e-3}
    surface = {"kind": "harmonic", "wavelength_x": 0.5, "wavelength_y": 0.5}
    # theta_2 = 10^-1.1 1000^0.33 0.5^0.67 2.5, 1 + 0.546 theta_2^-2 + 0.219 theta_2^-4
    theta = 10**-1.1 * 1000**0.33 * 0.5**0.67 * 2.5
    assert transient.eq_16(inside, {"surface": surface}) == pytest.approx(
        1 + 0.546 / theta**2 + 0.219 / theta**4
    )
    for other in ({"kind": "fractal"}, {"wavelength_y": 0.6}):
        assert transient.eq_16(inside, {"surface": surface | other}) is None
