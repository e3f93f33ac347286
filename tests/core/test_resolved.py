# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl check --resolved`` writes a case that ``ehl`` reads: the same bits by both."""

from pathlib import Path

import numpy as np
import pytest

from pyehl import Case, cli

SMALL = "&grid points = 65 /\n"
STEPS = "&time steps = 2 /\n"
CASES = {
    "scan": "&surface kind = 'map' file = 'scan.x3p' /\n",
    "track": "&surface finish = 'ground' track = 1e-4 pixels = 64 /\n",
    "oil": "&lubricant name = 'fva3' temperature = 60.0 viscosity_law = 'barus' /\n"
    "&bodies radius_x1 = 0.02 radius_y1 = 0.03 /\n"
    "&surface kind = 'fractal' ra = 1e-8 pixels = 64 /\n",
    "table": "&lubricant table = 'oil.csv' /\n&surface kind = 'dent' amplitude_over_film = 0.2 /\n",
    "sheet": "&lubricant kinematic_viscosity_40 = 68.0 kinematic_viscosity_100 = 8.7 /\n"
    "&surface kind = 'harmonic' wavelength = 1.0 /\n",
    "starved ellipse": "&contact load = 200.0 radius_x = 0.01 radius_y = 0.03 /\n"
    "&inlet film = 3e-7 /\n",
    "line": "&contact shape = 'line' load_per_length = 1e5 mean_velocity = 0.01 hardness = 2e9 /\n"
    "&lubricant boundary_film = 3e-8 boundary_friction = 0.1 /\n",
    "roller": "&contact shape = 'roller' length = 0.01 load = 2000.0 radius = 0.005 /\n",
    "duty": "&contact load = 20.0 /\n&duty file = 'duty.csv' /\n",
    "rest": "&contact load = 20.0 slide_to_roll = 2.0 rough_surface = 2 /\n"
    "&lubricant shear_law = 'carreau' carreau_stress = 5e6 carreau_exponent = 0.5 /\n"
    "&surface kind = 'dent' amplitude_over_film = 0.3 /\n",
    "pair": "&contact load = 20.0 slide_to_roll = 0.3 /\n"
    "&surface kind = 'bump' amplitude = 0.02 /\n"
    "&second_surface kind = 'harmonic' wavelength = 0.5 /\n",
}
TABLE = """pressure_Pa, temperature_degC, viscosity_Pa_s
0, 40, 0.05
1e9, 40, 5e4
4e9, 40, 1e12
"""
DUTY = "time_s, load_N\n0, 20\n1e-3, 40\n"


@pytest.mark.parametrize("name", CASES)
def test_ehl_reads_what_is_written(
    drive, tmp_path: Path, monkeypatch, capsys, cases: Path, name: str
):
    (tmp_path / "scan.x3p").write_bytes((cases / "scan.x3p").read_bytes())
    (tmp_path / "oil.csv").write_text(TABLE)
    (tmp_path / "duty.csv").write_text(DUTY)
    moves = "&surface" in CASES[name]
    (tmp_path / "case.nml").write_text(CASES[name] + SMALL + STEPS * moves)
    monkeypatch.chdir(tmp_path)
    assert cli.main(["check", "case.nml", "--resolved", "out.nml"]) == 0
    tiles = ["out_surface.npy"] if name in ("scan", "track") else []
    assert capsys.readouterr().out.split() == ["out.nml", *tiles]
    ended = drive("ehl", "out.nml", "-o", "by_ehl"), drive("pyehl", "case.nml", "-o", "by_pyehl")
    assert ended[0].returncode == ended[1].returncode != 2
    for field in ("P", "H"):
        one, other = (np.load(tmp_path / f"by_{by}" / f"{field}.npy") for by in ("ehl", "pyehl"))
        np.testing.assert_array_equal(one, other)
    history = [(tmp_path / f"by_{by}" / "history.csv").read_text() for by in ("ehl", "pyehl")]
    assert history[0] == history[1]
    written = Case(tmp_path / "out.nml").resolve()
    assert written["lubricant"] == Case(tmp_path / "case.nml").resolve()["lubricant"]


def test_no_existing_file_is_overwritten(tmp_path: Path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.nml").write_text(SMALL)
    (tmp_path / "other.nml").write_text("&grid points = 65 /\n")
    for name, part in (("case.nml", "reads it"), ("other.nml", "did not write")):
        before = (tmp_path / name).read_text()
        assert cli.main(["check", "case.nml", "--resolved", name]) == 2
        assert part in capsys.readouterr().err
        assert (tmp_path / name).read_text() == before
