# SPDX-License-Identifier: BSD-3-Clause
"""Files of rigs: formats, units, repeats, and comparisons with results.

The form of the PCS files is that of public examples of the package `tribology` (M. Ploss, MIT
licence): demo_3.txt of an EHD261, demo-mtm-output.txt of an MTM311. Their films are some of its
rows.
"""

from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl.rigs.comparison import deviations
from pyehl.rigs.quantities import FILM, FRICTION, SLIP, SPEED
from pyehl.rigs.reading import read_rig
from pyehl.rigs.repeats import averaged, varied

# speed [mm/s], film [nm], oil [degC], load [N] of step 2 and of step 5
FILMS_40 = [(20.2, 24.4, 40.4, 20.025), (100.3, 82.2, 40.3, 19.94), (1002.0, 367.0, 39.9, 19.842)]
FILMS_100 = [(20.1, 4.8, 101.1, 20.067), (100.3, 17.1, 101.0, 19.967), (1002.1, 79.3, 99.5, 19.845)]
HEAD = (
    "Rolling Speed (mm/s)\tAverage Film (nm)\t\t\tStep Time (s)\tLube Temp (°C)\tPot Temp (°C)\t"
    "Ball Load (N)\t\tBall Speed 1\tRolling Speed (mm/s)\tSRR (%)\t\tTraction Coeff (-)\t\t"
    "Average Film (nm)\tStandard Deviation (nm)\tOrder\t"
)


def ehd() -> str:
    """Text of an EHD file with two film steps and a zero check."""
    lines = ["EHD261 Test Data File", "Profile description:\tNew EHD profile", ""]
    for number, rows in ((2, FILMS_40), (5, FILMS_100)):
        lines += [f'Step {number} "New film step" started at 28/02/2017 16:09']
        lines += ["Step type\tFILM\tStep description\tNew film step", HEAD]
        for u, h, t, w in rows:
            lines.append(
                f"{u}\t{h}\t\t\t10\t{t}\t41.2\t{w}\t\t{u}\t{u:.2f}\t0.000\t\t\t\t{h}\t0.50\t3\t"
            )
        lines += ["", 'Step 3 "zero check" started at 28/02/2017 16:13', "Step type\tZERO_CHECK"]
        lines += ["                 Ball load = 20.0 N", "            Film thickness = 0.9 nm", ""]
    return "\n".join(lines)


@pytest.mark.parametrize("encoding", ["utf-8", "cp1252", "utf-16"])
def test_film_steps_of_an_ehd_file(tmp_path: Path, encoding: str) -> None:
    path = tmp_path / "film.txt"
    path.write_bytes(ehd().encode(encoding))
    result = read_rig(path)
    assert result.format == "PCS"
    assert [step.title for step in result.steps] == [f'Step {n} "New film step"' for n in (2, 5)]
    for step, rows in zip(result.steps, (FILMS_40, FILMS_100), strict=True):
        speed, film, temperature, load = np.array(rows).T
        assert step.columns["contact.mean_velocity"] == pytest.approx(speed * 1e-3)
        assert step.columns["h_c_m"] == pytest.approx(film * 1e-9)
        assert step.columns["h_c_error_m"] == pytest.approx(0.5e-9)
        assert step.columns["lubricant.temperature"] == pytest.approx(temperature)
        assert step.columns["contact.load"] == pytest.approx(load)
        assert "mu" not in step.columns  # the column is empty
        assert "Order" in step.left_out


def test_traction_steps_of_an_mtm_file(tmp_path: Path) -> None:
    """The first columns summarise the step, which is repeated among the full ones."""
    head = (
        "SRR (%)\tTraction Coeff (-)\t\tStep Time (s)\tLube RTD Temp (degC)\tBall Load (N)\t\t"
        "Rolling Speed (mm/s)\tSRR (%)\t\tTraction Coeff (-)"
    )
    rows = [
        f"{s}\t{mu}\t\t1\t40.1\t36.0\t\t2500\t{s}\t\t{mu}" for s, mu in ((5, 0.031), (50, 0.042))
    ]
    path = tmp_path / "mtm.txt"
    lines = ["MTM311 Test Data File", "", "Step 1 started at 23/03/2018", head, *rows, ""]
    path.write_text("\n".join(lines))
    (step,) = read_rig(path).steps
    assert step.columns["contact.slide_to_roll"] == pytest.approx([0.05, 0.5])
    assert step.columns["contact.mean_velocity"] == pytest.approx(2.5)
    assert step.columns["mu"] == pytest.approx([0.031, 0.042])
    assert varied([step]) is SLIP
    curve = averaged([step], FRICTION, SLIP)
    assert curve.values == pytest.approx([0.031, 0.042])
    assert curve.conditions["contact.load"] == (36.0, 36.0)


@pytest.mark.parametrize(
    "text",
    [
        "speed (m/s),film (nm)\n0.1,80\n1,360\n",
        "# a comment\nEntrainment speed [mm/s];Central film [µm]\n100;0,08\n1000;0,36\n",
        "u (mm/s)\tfilm thickness (nm)\tremark\n100\t80\ta\n1000\t360\tb\n",
        "contact.mean_velocity,h_c_m\n0.1,8e-8\n1,3.6e-7\n",
    ],
)
def test_tables_with_units(tmp_path: Path, text: str) -> None:
    path = tmp_path / "table.csv"
    path.write_text(text, encoding="utf-8")
    (step,) = read_rig(path).steps
    assert step.columns["contact.mean_velocity"] == pytest.approx([0.1, 1.0])
    assert step.columns["h_c_m"] == pytest.approx([8e-8, 3.6e-7])


def test_kelvin(tmp_path: Path) -> None:
    path = tmp_path / "kelvin.csv"
    path.write_text("temperature (K),mu\n313.15,0.04\n")
    assert read_rig(path).steps[0].columns["lubricant.temperature"] == pytest.approx([40.0])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "the file is empty"),
        ("a,b\n1,2\n", "no column of film thickness or friction; columns: a, b"),
        ("speed,film (nm)\n1,2\n", "column 'speed'\nexpected: a unit in brackets"),
        ("speed (knots),film (nm)\n1,2\n", "one of m/s, mm/s, cm/s"),
        ("speed (m/s),film (nm)\n1,2,3\n", ":2: error: 3 values for 2 columns"),
        ("SLIM Mapper Analysis File\nX\tY\n", "analysis of a SLIM picture is not read"),
    ],
)
def test_files_that_are_not_read(tmp_path: Path, text: str, expected: str) -> None:
    path = tmp_path / "rig.txt"
    path.write_text(text)
    with pytest.raises(pyehl.InputError) as caught:
        read_rig(path)
    assert expected in str(caught.value)
    assert str(path) in str(caught.value)


def test_repeats_are_averaged(tmp_path: Path) -> None:
    """Two sweeps over the same set points with small deviations; a fine curve is unchanged."""
    path = tmp_path / "repeats.csv"
    path.write_text(
        "speed (mm/s),film (nm)\n19.9,24\n25.2,30\n31.7,36\n20.1,26\n25.3,32\n31.8,35\n"
    )
    steps = read_rig(path).steps
    assert varied(steps) is SPEED
    curve = averaged(steps, FILM, SPEED)
    assert curve.count.tolist() == [2, 2, 2]
    assert curve.values * 1e9 == pytest.approx([25.0, 31.0, 35.5])
    assert curve.scatter * 1e9 == pytest.approx(np.sqrt([2.0, 2.0, 0.5]))
    fine = tmp_path / "fine.csv"
    speeds = np.linspace(1.0, 1.2, 40)
    fine.write_text("speed (m/s),film (nm)\n" + "".join(f"{u},{300 * u**0.67}\n" for u in speeds))
    assert averaged(read_rig(fine).steps, FILM, SPEED).count.tolist() == [1] * 40


def test_deviations_per_decade(tmp_path: Path) -> None:
    """A computed power law against one that is 5 % lower; the last point is beyond the results."""
    speeds = np.geomspace(0.01, 3.0, 12)
    path = tmp_path / "law.csv"
    rows = "".join(f"{u!r},{100.0 * u**0.67!r}\n" for u in speeds.tolist())
    path.write_text("speed (m/s),film (nm)\n" + rows)
    curve = averaged(read_rig(path).steps, FILM, SPEED)
    places = np.array([0.005, 0.1, 2.0])
    result = deviations(curve, places, 1.05 * 100e-9 * places**0.67)
    assert [d.count for d in result] == [5, 4, 2, 11]
    for part in result:
        assert (part.mean, part.rms, part.largest) == pytest.approx((0.05, 0.05, 0.05))
    assert "11 points, mean +5.0%" in str(result[-1])
    with pytest.raises(pyehl.InputError, match="none is reached"):
        deviations(curve, np.array([5.0, 6.0]), np.array([1e-7, 2e-7]))
