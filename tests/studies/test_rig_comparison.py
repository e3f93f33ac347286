# SPDX-License-Identifier: BSD-3-Clause
"""`pyehl compare --measured`: a study against the file of a rig."""

from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl.cli import main

CASE = Path(__file__).resolve().parents[2] / "cases" / "mtm.nml"
SPEEDS = np.geomspace(0.1, 2.0, 5).tolist()


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("rig") / "films"
    vary = {"contact.mean_velocity": SPEEDS}
    pyehl.sweep(CASE, vary, {"contact.slide_to_roll": 0.0}, run="film", output=folder)
    return folder


def rig(path: Path, factor: float, *, temperature: float = 40.0, steps: int = 1) -> Path:
    """An EHD file whose films are those of a formula times a factor."""
    case = {"contact.slide_to_roll": 0.0}
    lines = ["EHD261 Test Data File", ""]
    for number in range(1, steps + 1):
        lines += [f'Step {number} "films" started at 1/1/2020']
        lines += ["Rolling Speed (mm/s)\tAverage Film (nm)\tLube Temp (°C)\tBall Load (N)\tSRR (%)"]
        for speed in (0.1, 0.4, 1.5):
            formulas = pyehl.film(CASE, case | {"contact.mean_velocity": speed}).formulas
            film = next(formula["h_c_m"] for formula in formulas if formula["applies"])
            warm = temperature + 60.0 * (number - 1)
            lines.append(f"{speed * 1e3}\t{film * factor * 1e9:.6f}\t{warm}\t36.0\t0.0")
        lines.append("")
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def test_measured_films_and_a_study(
    study: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Films measured 5 % thinner; a step at another temperature is not compared."""
    file = rig(tmp_path / "films.txt", 1.0 / 1.05, steps=2)
    assert main(["compare", str(study), "--measured", str(file)]) == 0
    reported = capsys.readouterr().out
    assert "h_c_m over contact.mean_velocity: 3 measured points" in reported
    assert "3 points, mean +5.0%, rms 5.0%" in reported
    assert "lubricant.temperature = 100 degC, in the case 40 degC" in reported


def test_refused_comparisons(
    study: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    warm = rig(tmp_path / "warm.txt", 1.0, temperature=80.0)
    other = tmp_path / "load.csv"
    other.write_text("load (N),film (nm)\n10,100\n20,90\n")
    for words, expected in (
        ([str(warm)], "no step has the conditions of the case"),
        ([str(other)], "measured over contact.load; the results vary contact.mean_velocity"),
    ):
        assert main(["compare", str(study), "--measured", *words]) == 2
        assert expected in capsys.readouterr().err
    assert main(["compare", str(study)]) == 2
    assert "expected a table of references, or --measured FILE" in capsys.readouterr().err
