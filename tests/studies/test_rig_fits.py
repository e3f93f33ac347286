# SPDX-License-Identifier: BSD-3-Clause
"""`pyehl fit-lubricant` and `pyehl stribeck --measured` with rig files made by the solver."""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import pyehl
from pyehl.cli import main

CASE = """
&contact load = 20.0 mean_velocity = 1.0 radius = 0.009525 slide_to_roll = 0.0
  reduced_modulus = 1.17e11 /
&lubricant viscosity = 0.02 pressure_viscosity = 1.8e-8 temperature = 40.0
  temperature_viscosity = 0.04 /
&grid points = 65 /
"""
TRACTION = """
&contact load = 50.0 mean_velocity = 2.0 radius = 0.01 /
&lubricant name = 'fva3' temperature = 60.0 /
&grid points = 33 /
"""
SPEEDS = np.geomspace(0.16, 2.0, 8)
FINE = {"grid.points": 129}
ALPHA, STRESS = 1.8e-8, 6.3e6


def films(path: Path, values: np.ndarray, temperature: float = 40.0) -> Path:
    """An EHD file with repeats (repeats, speeds) of films [m], one step each."""
    lines = ["EHD261 Test Data File", ""]
    for number, row in enumerate(values, 1):
        lines += [f'Step {number} "films" started at 1/1/2020']
        lines += ["Rolling Speed (mm/s)\tAverage Film (nm)\tLube Temp (°C)\tBall Load (N)\tSRR (%)"]
        for speed, film in zip(SPEEDS, row, strict=True):
            lines.append(f"{speed * 1e3:.9g}\t{film * 1e9:.9g}\t{temperature}\t20.0\t0.0")
        lines.append("")
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("rig") / "case.nml"
    path.write_text(CASE)
    return path


@pytest.fixture(scope="module")
def solved(case: Path) -> np.ndarray:
    """Central films of the solver [m], extrapolated."""
    result = pyehl.sweep(case, {"contact.mean_velocity": SPEEDS.tolist()}, FINE, run="solve")
    scale = result.h_c_m / result.H_c
    films = np.asarray((result.H_c_extrapolated * scale).values)
    assert np.isfinite(films).all()
    return films


def test_fitted_alpha_is_in_its_interval(case: Path, solved: np.ndarray, tmp_path: Path) -> None:
    """In about 95 % of 40 noisy records; the interval is as wide as by linear statistics."""
    random = np.random.default_rng(3)
    inside, widths = 0, []
    for _ in range(40):
        noise = 1.0 + 0.03 * random.standard_normal((3, SPEEDS.size))
        file = films(tmp_path / "films.txt", solved * noise)
        (alpha,) = pyehl.fit_lubricant(file, case).parameters
        inside += alpha.low < ALPHA < alpha.high
        widths.append(0.5 * np.log(alpha.high / alpha.low))
    # fewer than 34 of 40 have a probability of 0.3 %
    assert inside >= 34
    # t of 7 degrees of freedom is 2.36; the film follows alpha to the power 0.53
    assert np.mean(widths) == pytest.approx(2.36 * 0.03 / np.sqrt(24.0) / 0.53, rel=0.2)


def test_alpha_without_noise(
    case: Path, solved: np.ndarray, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """From an initial guess three times too small, by the command; a hot step is left out."""
    file = films(tmp_path / "films.txt", solved[np.newaxis])
    hot = films(tmp_path / "hot.txt", solved[np.newaxis] / 3.0, 90.0).read_text(encoding="utf-8")
    file.write_text(file.read_text(encoding="utf-8") + hot.partition("\n")[2], encoding="utf-8")
    out = tmp_path / "out"
    words = ["fit-lubricant", str(file), "--case", str(case), "-o", str(out)]
    assert main([*words, "--set", "lubricant.pressure_viscosity=6e-9"]) == 0
    reported = capsys.readouterr().out
    assert "left out: Step 1" in reported
    assert re.search(r"a viscosity 10 % too high makes pressure_viscosity 1[12]% too low", reported)
    group = (out / "lubricant.nml").read_text()
    value = float(group.partition("pressure_viscosity =")[2].split()[0])
    assert value == pytest.approx(ALPHA, rel=2e-3)
    assert (out / "fit.png").is_file()


@pytest.mark.long
def test_eyring_stress_is_in_its_interval(tmp_path: Path) -> None:
    """From MTM traction steps with noise; most intervals contain the true stress."""
    case = tmp_path / "case.nml"
    case.write_text(TRACTION)
    ratios = np.array([0.01, 0.02, 0.05, 0.1, 0.2])
    law = {"lubricant.shear_law": "eyring", "lubricant.eyring_stress": STRESS}
    result = pyehl.sweep(case, {"contact.slide_to_roll": ratios.tolist()}, law, run="solve")
    random, inside = np.random.default_rng(5), 0
    head = "Step Time (s)\tTraction Coeff (-)\tLube RTD Temp (degC)\tBall Load (N)\t"
    head += "Rolling Speed (mm/s)\tSRR (%)"
    for _ in range(20):
        lines = ["MTM311 Test Data File"]
        for step in range(1, 5):
            noise = 1.0 + 0.02 * random.standard_normal(ratios.size)
            lines += [f"Step {step} started at 1/1/2020", head]
            lines += [
                f"{k}\t{mu:.9g}\t60.0\t50.0\t2000.0\t{srr * 100.0:.9g}"
                for k, (srr, mu) in enumerate(zip(ratios, result.mu.values * noise, strict=True))
            ]
            lines.append("")
        file = tmp_path / "traction.txt"
        file.write_text("\n".join(lines), encoding="utf-8")
        (stress,) = pyehl.fit_lubricant(file, case, law="eyring", points=33).parameters
        inside += stress.low < STRESS < stress.high
    assert inside >= 17


@pytest.mark.long
def test_record_of_measured_films(root: Path) -> None:
    """Coefficient and residual as on the page; fringe orders as stated there."""
    folder = root / "docs" / "evidence" / "rig"
    page = (folder / "README.md").read_text(encoding="utf-8")
    data, case = folder / "nynas-t3-40.csv", folder / "nynas-t3.nml"
    fit = pyehl.fit_lubricant(data, case, between=(0.13, 1.0))
    (alpha,) = fit.parameters
    interval = f"{alpha.value * 1e9:.1f} ({alpha.low * 1e9:.1f} to {alpha.high * 1e9:.1f})"
    off = np.sqrt(np.mean((fit.fitted / fit.measured - 1.0) ** 2))
    assert (
        f"| 3.2 | {interval} | {fit.residual_rms * 1e9:.1f} nm, {off:.1%} |".replace("%", " %")
        in page
    )
    assert np.abs(fit.fitted - fit.measured).max() < 1.25e-9
    hot = pd.read_csv(folder / "nynas-t3-80.csv", comment="#")
    assert (hot["average film (nm)"] > 200).sum() == 7


def test_stribeck_compared_with_a_rig(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Measured 5 % lower, films and friction deviate by 5.3 %; the range is stated."""
    case = Path(__file__).resolve().parents[2] / "cases" / "mtm.nml"
    words = [str(case), "--speed", "0.5:2:3log", "--set", "grid.points=65", "-o"]
    curve = tmp_path / "curve"
    assert main(["stribeck", *words, str(curve)]) == 0
    table = pd.read_csv(curve / "stribeck.csv")
    file = tmp_path / "mtm.csv"
    lines = ["speed (mm/s),film (nm),friction coefficient"]
    for row in table.itertuples():
        values = row.h_c_m * 0.95e9, row.mu * 0.95
        lines.append(",".join(f"{v:.9g}" for v in (row[1] * 1e3, *values)))
    file.write_text("\n".join(lines))
    capsys.readouterr()
    assert main(["stribeck", *words, str(tmp_path / "beside"), "--measured", str(file)]) == 0
    reported = capsys.readouterr().out
    for name in ("h_c_m", "mu"):
        assert f"{name} over contact.mean_velocity: 3 measured points" in reported
    assert reported.count("3 points, mean +5.3%, rms 5.3%") == 2
    assert "0.5 to 0.5: 1 points" not in reported
    file.write_text("load (N),friction coefficient\n10,0.05\n20,0.06\n")
    assert main(["stribeck", *words, str(tmp_path / "no"), "--measured", str(file)]) == 2
    assert "measured over contact.load; the results vary" in capsys.readouterr().err
    assert not (tmp_path / "no").exists()


def test_refused_fits(
    case: Path, solved: np.ndarray, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = str(films(tmp_path / "films.txt", solved[np.newaxis]))
    unknown = tmp_path / "other.txt"
    unknown.write_text("torque (Nm)\tspeed (mm/s)\n1\t100\n2\t200\n")
    words = ["--case", str(case)]
    for more, expected in (
        ([file, "--law", "eyring"], "measured over contact.mean_velocity"),
        ([file, "--set", "lubricant.temperature=80"], "no step has the conditions of the case"),
        ([file, "--law", "pressure"], "pressure-viscosity"),
        ([file, "--set", "contact.load=40"], "contact.load = 20 N, in the case 40 N"),
        ([str(unknown)], "no column of film thickness or friction; columns: contact.mean_velocity"),
    ):
        assert main(["fit-lubricant", *more, *words]) == 2
        assert expected in capsys.readouterr().err
