# SPDX-License-Identifier: BSD-3-Clause
"""`pyehl response`: measured waves against the shipped response and a second solver."""

import csv
import json
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.image import imread
from second_solver import START, VELOCITY, X_MATTERS, SecondSolver, Wave, Z

import pyehl
from pyehl import cli, schema
from pyehl.case import Case
from pyehl.errors import EhlError, InputError
from pyehl.measured_response import measurement
from pyehl.measured_response.folder import destination
from pyehl.measured_response.superposition import SLOPE, WaveSet, superpose

# Long waves, and short ones in a thick film, which a coarse grid resolves
TINY = (
    measurement.Tier("long", 2.0, 65, 2.0, 0.5),
    measurement.Tier("middle", 1.0, 257, 0.5, 0.25),
)
CASE = "&contact moes_m = 200.0 moes_l = 10.0 /\n&surface velocity_ratio = 1.05 /\n"


@pytest.fixture
def tiny(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[str]:
    """Command line of a `pyehl response` that takes seconds."""
    monkeypatch.setattr(measurement, "TIERS", TINY)
    monkeypatch.setattr("pyehl.commands.response.TIERS", TINY)
    monkeypatch.setattr("pyehl.measured_response.folder.TIERS", TINY)
    (tmp_path / "case.nml").write_text(CASE)
    return ["response", str(tmp_path / "case.nml"), "-o", str(tmp_path / "out")]


@pytest.mark.long
def test_command(
    tiny: list[str],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
):
    assert cli.main(tiny) == 0
    folder = tmp_path / "out"
    with (folder / "response.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    with xr.open_dataset(folder / "response.nc", engine="scipy") as data:
        assert data.sizes["wave"] == len(rows)
        assert data["amplitude"].dims == ("wave", "X")
        assert all(data[name].attrs["units"] for name in data.variables if name != "tier")
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["velocity_ratio"] == 1.05
    assert set(summary) == {q.name for q in schema.QUANTITIES if "response" in q.kinds}
    assert imread(folder / "response.png").std() > 0.1
    fine = [row for row in rows if row["tier"] == "middle"]
    # the residual of the fit at this point, 0.018, and the error of the grid (film 1 % thin)
    assert max(float(row["shipped_difference_centre"]) for row in fine) < 0.03
    assert max(abs(float(row["pressure_ratio_centre"]) - 1.0) for row in fine) < 0.1
    # the second call runs nothing, and gives the same
    kept = {path.name: path.stat().st_mtime_ns for path in folder.glob("tier_*.npz")}
    before = (folder / "response.csv").read_text()
    assert cli.main(tiny) == 0
    assert {path.name: path.stat().st_mtime_ns for path in folder.glob("tier_*.npz")} == kept
    assert (folder / "response.csv").read_text() == before
    # a run that is lost is made again, with the same numbers
    (folder / "tier_long.npz").unlink()
    assert cli.main(tiny) == 0
    assert (folder / "response.csv").read_text() == before
    # the results are not used for another case or by another version
    capsys.readouterr()
    assert cli.main([*tiny, "--set", "surface.velocity_ratio=1.1"]) == 2
    assert "\n  velocity_ratio: there 1.05, here 1.1\n" in capsys.readouterr().err
    here = measurement.metadata.version("pyehl")
    monkeypatch.setattr(measurement.metadata, "version", lambda name: "9.9.9")
    assert cli.main(tiny) == 2
    assert f"\n  pyehl version: there {here}, here 9.9.9\n" in capsys.readouterr().err


@pytest.mark.long
def test_waves_on_an_ellipse(monkeypatch: pytest.MonkeyPatch):
    """A wide contact with a thick film, as the circle above."""
    case = Case.from_text(CASE, ["contact.radius_ratio=0.5438"])
    monkeypatch.setattr("pyehl.measured_response.folder.TIERS", TINY)
    result = pyehl.response(case)
    assert float(result.ellipticity) == pytest.approx(1.5, abs=1e-4)
    fine = result.where(result["tier"] == "middle", drop=True).sel(X=0.0)
    assert fine.sizes["wave"] >= 2
    assert float(fine["shipped_difference"].max()) < 0.03
    assert float(abs(fine["pressure_ratio"] - 1.0).max()) < 0.1


def test_bad_input_writes_nothing(
    tiny: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    assert cli.main([*tiny, "--set", "surface.velocity_ratio=0"]) == 2
    assert "at rest" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_foreign_folder_is_refused(
    tiny: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "letter.txt").write_text("dear")
    assert cli.main(tiny) == 2
    assert "letter.txt" in capsys.readouterr().err


def test_an_interrupt_of_the_first_tier_leaves_no_folder(tmp_path: Path, capsys, monkeypatch):
    def interrupted(*args, **words):
        raise KeyboardInterrupt

    monkeypatch.setattr(measurement, "_run_tier", interrupted)
    (tmp_path / "case.nml").write_text(CASE)
    words = ["response", str(tmp_path / "case.nml"), "-o", str(tmp_path / "out")]
    assert cli.main(words) == 130
    assert not (tmp_path / "out").exists()
    assert "interrupted; no run has ended: nothing is kept" in capsys.readouterr().err


def test_an_interrupt_keeps_the_finished_tiers(tmp_path: Path):
    def interrupt(name: str, done: int, total: int) -> None:
        if name == "middle" and done == 3:
            raise KeyboardInterrupt

    place = destination(tmp_path / "out")
    with pytest.raises(KeyboardInterrupt):
        measurement.measure(Case.from_text(CASE), place, tiers=TINY, progress=interrupt)
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["tier_long.npz"]


def test_failed_run_is_named(tmp_path: Path):
    """At this load the grid does not resolve the inlet."""
    case = Case.from_text("&contact moes_m = 20000.0 moes_l = 20.0 /\n")
    tier = measurement.Tier("long", 4.0, 17, 4.0, 2.0)
    with pytest.raises(EhlError, match="tier 'long': the run ended too early"):
        measurement.measure(case, destination(tmp_path / "out"), tiers=[tier])
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("name", ["line", "roller"])
def test_lines_and_rollers_are_refused(cases: Path, name: str):
    with pytest.raises(InputError, match=r"\Acontact\.shape = '\w+': this is for point"):
        pyehl.response(cases / f"{name}.nml")


@pytest.mark.parametrize("tier", measurement.TIERS, ids=lambda tier: tier.name)
def test_waves_of_a_tier(tier: measurement.Tier):
    waves = measurement.tier_waves(tier)
    nodes = 2.0 * np.pi / waves.q * (tier.points - 1) / 4.0
    assert nodes.min() >= measurement.NODES - 1e-9
    assert np.unique(waves.along).size == waves.along.size
    angle = np.degrees(np.arctan2(waves.ky, waves.kx))
    assert np.count_nonzero(angle == 0.0) >= 3
    assert np.count_nonzero((angle > 30.0) & (angle < 60.0)) >= 3
    assert angle.max() > 50.0


def test_too_coarse_a_grid_is_refused():
    with pytest.raises(ValueError, match="4 nodes for the shortest wave"):
        measurement.tier_waves(measurement.Tier("long", 4.0, 129, 4.0, 0.125))


def test_waves_of_one_frequency_are_refused():
    with pytest.raises(ValueError, match="different numbers"):
        WaveSet(1.0, np.array([2, 2]), np.array([0, 1]), np.zeros(2))


@pytest.mark.slow
def test_small_waves_are_linear():
    """Half the amplitude gives the same response."""
    settings = Case.from_text("&contact moes_m = 1000.0 moes_l = 10.0 /\n").resolve()
    waves = measurement.tier_waves(measurement.Tier("long", 4.0, 129, 4.0, 0.25))
    result = [
        superpose(
            settings, waves, points=129, velocity_ratio=1.01, slope=slope, solver={"accuracy": 1e-4}
        ).response
        for slope in (1.2e-3, 0.6e-3)
    ]
    within = slice(result[0].shape[1] // 4, -result[0].shape[1] // 4)
    # a term of second order in the amplitude would be halved, too
    assert np.abs(result[0] - result[1])[:, within].max() < 2e-3


@pytest.mark.long
def test_second_solver_has_the_same_response():
    """One wave, by a solver that shares only the equations with this one."""
    m, ell, points, wavelength = 500.0, 5.0, 65, 1.0
    settings = Case.from_text(
        f"&contact moes_m = {m} moes_l = {ell} /\n&lubricant roelands_z = {Z} /\n"
    ).resolve()
    waves = WaveSet(wavelength, np.array([1]), np.array([1]), np.zeros(1))
    result = superpose(
        settings,
        waves,
        points=points,
        velocity_ratio=VELOCITY,
        filling=3.3,
        solver={"deflection": "fft", "accuracy": 1e-5},
    )
    second = SecondSolver(m, ell, points)
    amplitude = SLOPE / waves.q[0]
    node = int(np.argmin(np.hypot(second.x, second.y)))
    # the front has left the domain; the last period counts
    steps, period = 94, round(wavelength / VELOCITY / second.h)
    states = islice(second.steps(Wave(amplitude, wavelength, wavelength)), steps)
    film = np.array([values[node] for _, values in states])[-period:]
    first = int((X_MATTERS - 0.5 * wavelength - START) / VELOCITY / second.h) + 1
    time = (first + np.arange(steps))[-period:] * second.h
    turn = waves.kx[0] * (VELOCITY * time + START)
    basis = np.stack([np.ones(period), np.cos(turn), np.sin(turn)], axis=1)
    _, cosine, sine = np.linalg.lstsq(basis, film, rcond=None)[0]
    t = -(cosine + 1j * sine) / amplitude
    at = int(np.argmin(np.abs(result.x)))
    assert 0.2 < abs(t) < 0.8
    # the difference is the algebraic error of both
    assert abs(result.response[0, at] - t) < 5e-4
