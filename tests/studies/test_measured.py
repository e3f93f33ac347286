# SPDX-License-Identifier: BSD-3-Clause
"""Measured friction over a curve of ``pyehl stribeck``: what is read, refused and counted."""

import io
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyehl.cli import main
from pyehl.errors import InputError
from pyehl.studies.measured_friction import Measured, read_measured
from pyehl.theory.transition import Curve

KEY = "contact.mean_velocity"


def run(*words: str, expect: int = 0) -> str:
    """Run the command in this process; returns its standard error."""
    complaint = io.StringIO()
    with redirect_stdout(io.StringIO()), redirect_stderr(complaint):
        status = main(["stribeck", *words])
    assert status == expect, complaint.getvalue()
    return complaint.getvalue()


def test_measured_data_over_other_abscissae(tmp_path: Path):
    (tmp_path / "m.csv").write_text("u,mu\n2.0,0.05\n8.0,0.04\n99.0,0.03\n")
    measured = read_measured(tmp_path / "m.csv", "u")
    # lambda is proportional to u^2 on this curve
    table = {"u": [1.0, 4.0, 16.0], "lambda_ratio": [1.0, 16.0, 256.0]}
    curve = Curve("", "u", pd.DataFrame(table))
    assert measured.over("u", curve) == pytest.approx([2.0, 8.0, 99.0])
    result = measured.over("lambda_ratio", curve)
    assert result[:2] == pytest.approx([4.0, 64.0])
    assert np.isnan(result[2])
    back = Measured("lambda_ratio", np.array([9.0]), "mu", np.array([0.1]), np.zeros(1))
    assert back.over("u", curve) == pytest.approx([3.0])


@pytest.mark.parametrize(
    ("text", "states"),
    [
        ("", "columns: none"),
        ("speed,mu\n1,2\n", "expected: one of u, hersey"),
        ("u,hersey,mu\n1,1,2\n", "expected: one of u, hersey"),
        ("u,mu\n1,high\n", ":2: error: mu = 'high'"),
        ("u,mu\n1,0.1\n-1,0.1\n", ":3: error: u = '-1'"),
        ("u,mu,error\n1,0.1,0.01\n2,0.1,0\n", ":3: error: error = '0'"),
        ("u,mu,error\n1,0.1,-0.01\n2,0.1,0.01\n", ":2: error: error = '-0.01'"),
        ("u,mu,error\n1,0.1,0.01\n2,0.1,\n", ":3: error: error = ''"),
        ("u,mu,Sigma_mu\n1,0.1,0.01\n", ":1: error: the column 'Sigma_mu'"),
        ("u,mu,error,error\n1,0.1,0.01,0.01\n", ":1: error: two columns error"),
        ("u,mu,error\n1,0.1,-0.01\n", "or no column 'error' where the errors are not known"),
        ("u,mu\n1\n", ":2: error: 1 values for 2 columns"),
        ("u,mu\n", "there are no rows"),
    ],
)
def test_measured_data_that_are_refused(tmp_path: Path, text: str, states: str):
    (tmp_path / "m.csv").write_text(text)
    with pytest.raises(InputError) as refusal:
        read_measured(tmp_path / "m.csv", "u")
    assert states in str(refusal.value)


@pytest.mark.parametrize(
    ("law", "text", "states"),
    [
        ("newtonian", f"{KEY},mu\n1,0.05\n", "it has mu, the curve mu_ratio (give a lubricant"),
        ("eyring", f"{KEY},mu_ratio\n1,1.2\n", "it has mu_ratio, the curve mu"),
        ("eyring", f"{KEY},mu\n0.1,0.05\n9,0.05\n", "2 of 2 values of contact.mean_velocity are"),
        ("eyring", f"{KEY},mu\n1,0.05\n9,0.05\n", "beyond the curve, which goes from 0.5 to 2"),
        ("eyring", "speed,mu\n1,0.05\n", "expected: one of contact.mean_velocity"),
        ("eyring", f"{KEY};mu\n1;0.05\n", "with commas between columns, not ';'"),
        ("eyring", f"{KEY},mu\n1,0,0,05\n", "4 values for 2 columns"),
        ("eyring", f"{KEY},mu\n1,0\n", "mu = '0'"),
        ("eyring", "", "m.csv: cannot read: No such file"),
    ],
)
def test_measured_data_are_refused_before_the_first_case(
    cases: Path, tmp_path: Path, law: str, text: str, states: str
):
    file = tmp_path / "m.csv"
    if text:
        file.write_text(text)
    words = ("--set", f"lubricant.shear_law={law}", "--speed", "0.5,2", "--measured", str(file))
    complaint = run(str(cases / "table1.nml"), *words, "-o", str(tmp_path / "o"), expect=2)
    assert str(file) in complaint
    assert states in complaint
    assert "Errno" not in complaint
    assert not (tmp_path / "o").exists()


def test_measured_points_beyond_the_curve_are_counted(cases: Path, tmp_path: Path):
    """The range of the Hersey number is known only when all points are computed."""
    (tmp_path / "m.csv").write_text("hersey,mu\n1e-8,0.05\n1.5e-6,0.05\n1e-3,0.05\n")
    words = ("--set", "lubricant.shear_law=eyring", "--set", "surface.kind=smooth", "--set")
    words += ("grid.points=129", "--speed", "0.8,1.6", "--measured", str(tmp_path / "m.csv"))
    complaint = run(str(cases / "table1.nml"), *words, "-o", str(tmp_path / "o"))
    assert complaint == "note: 2 of 3 measured points are beyond the curve\n"
