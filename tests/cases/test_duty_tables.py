# SPDX-License-Identifier: BSD-3-Clause
"""Keys and tables of a duty: files, units, refusals."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from test_duty import POINT, run

import pyehl
from pyehl.theory.operating import OperatingPoint

TABLE = "time [ms], load [N], mean_velocity [m/s]\n0, 40, 2\n1, 30, 1\n2, 40, 2\n"


def test_a_file_and_arrays_are_the_same_case(tmp_path: Path):
    (tmp_path / "duty.csv").write_text(f"# a cam\n{TABLE}", encoding="utf-8")
    (tmp_path / "case.nml").write_text("&duty file = 'duty.csv', periodic = .true. /\n")
    read = pyehl.Case(tmp_path / "case.nml", POINT)
    assert read["duty"]["time"] == (0.0, 1e-3, 2e-3)
    given = pyehl.Case(
        **POINT, duty={"time": [0.0, 1e-3, 2e-3], "load": [40.0, 30.0, 40.0],
                       "mean_velocity": [2.0, 1.0, 2.0], "periodic": True},
    )  # fmt: skip
    without = {k: v for k, v in read["duty"].items() if k != "file"}
    assert without == given["duty"]
    # a resolved case contains its table
    (tmp_path / "duty.csv").unlink()
    assert pyehl.Case.from_text(read.text)["duty"] == read["duty"]


@pytest.mark.parametrize(
    "oil",
    [{"name": "fva3"}, {"kinematic_viscosity_40": 100.0, "kinematic_viscosity_100": 11.0}],
    ids=["law", "sheet"],
)
def test_temperature_of_the_inlet(tmp_path: Path, oil):
    """Viscosity by the law of the oil, as in a case at that temperature."""
    (tmp_path / "duty.csv").write_text("time [ms], temperature [degC]\n0, 60\n1, 80\n2, 60\n")
    (tmp_path / "case.nml").write_text("&duty file = 'duty.csv' /\n", encoding="utf-8")
    groups = {"contact": POINT["contact"]}
    if "name" not in oil:
        oil = oil | {"pressure_viscosity": 2e-8}
    read = pyehl.Case(tmp_path / "case.nml", groups | {"lubricant": oil | {"temperature": 60.0}})
    hot = pyehl.Case(**groups, lubricant=oil | {"temperature": 80.0})
    cold = pyehl.Case(**groups, lubricant=oil | {"temperature": 60.0})
    wanted = [case["lubricant"]["viscosity"] for case in (cold, hot, cold)]
    np.testing.assert_allclose(read["duty"]["viscosity"], wanted, rtol=1e-12)
    with pytest.raises(
        pyehl.InputError, match="column 'temperature', and one viscosity of the oil"
    ):
        pyehl.Case(tmp_path / "case.nml", POINT)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (TABLE.replace("1, 30", "2, 30").replace("2, 40, 2\n", "2, 40, 2\n"), r"csv:4.*increase"),
        (TABLE.replace("load [N]", "lod [N]"), r"csv:1.*unknown column 'lod \[N\]'.*'load'"),
        (TABLE.replace("load [N]", "load"), r"csv:1.*without a unit.*N, kN"),
        (TABLE.replace("[ms]", "[h]"), r"csv:1.*unit 'h'.*s, ms, us"),
        (TABLE.replace("40", "0"), r"case.nml:1.*a load of 0\.0 at .* s, line \d of .*at least"),
        (TABLE.replace("0, 40", "0, x"), r"csv:2.*load = 'x'"),
        (TABLE.replace("2, 40, 2\n", "2, 40, 1.5\n"), r"ends at 1\.5 and begins at 2\.0"),
        ("time [s], load [N]\n0, 40\n", r"fewer than two times"),
        ("load [N]\n40\n30\n", r"no column 'time'"),
    ],
)  # fmt: skip
def test_bad_duty_tables_are_refused(tmp_path: Path, table, message):
    (tmp_path / "duty.csv").write_text(table, encoding="utf-8")
    (tmp_path / "case.nml").write_text("&duty file = 'duty.csv', periodic = .true. /\n")
    with pytest.raises(pyehl.InputError, match=rf"(?s){message}"):
        pyehl.Case(tmp_path / "case.nml", POINT)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"duty.load": (40.0,) * 3}, "3 values of duty.load at 2 times"),
        ({"duty.u1": (1.0, 2.0)}, "one of duty.u1 and duty.u2"),
        ({"time.steps": 3}, "none of &time"),
        ({"grid.target_error": 0.01}, "duty.target_error"),
        ({"duty.mean_velocity": (1.0, -1.0), "grid.x_outlet": 1.5}, "an inlet on both sides"),
        ({"grid.border": "flooded"}, "'zero'"),
    ],
)
def test_keys_that_a_duty_refuses(options, message):
    duty = {"duty.time": (0.0, 1.0)} | (
        {} if "duty.load" in options else {"duty.load": (40.0, 30.0)}
    )
    with pytest.raises(pyehl.InputError, match=message):
        pyehl.Case(..., {"contact": POINT["contact"]}, duty | options)


def test_other_commands_refuse_a_duty():
    case = pyehl.Case(**POINT, duty={"time": [0.0, 1.0], "load": [40.0, 30.0]})
    with pytest.raises(pyehl.InputError, match="without &duty"):
        pyehl.predict(case, {"surface.kind": "harmonic"})
    assert any("&duty" in line for line in pyehl.film(case).summary["left_out"])


def test_a_load_below_the_minimum_is_refused():
    with pytest.raises(pyehl.InputError, match=r"at least 182\.85, 0\.001 of that of the case"):
        run([0.0, 1.0], load=[1.0, 5e-4])


def test_default_domain_contains_a_contact_that_widens_across(drive, tmp_path: Path):
    """The sides are twice as far from the centre as the contact reaches, by both drivers."""
    contact = {"load": 50.0, "mean_velocity": 1.0, "radius": 0.01, "slide_to_roll": 0.0}
    duty = {"time": [0.0, 2e-4, 4e-4], "radius_y": [0.01, 0.08, 0.08]}
    case = pyehl.Case(contact=contact, grid={"points": 33}, duty=duty)
    grid, first = case["grid"], OperatingPoint(load=50.0, mean_velocity=1.0, radius=0.01)
    along, across = replace(first, radius_ratio=0.125).semi_axes
    assert along < first.hertz_radius
    assert grid["x_inlet"] == pyehl.Case(contact=contact)["grid"]["x_inlet"]
    sides = 2.0 * across / first.hertz_radius
    assert grid["y_extent"] == pytest.approx(sides, rel=1e-6)
    # cells as square as in the round contact
    assert grid["points_y"] == pytest.approx(32 * 2.0 * sides / 4.0 + 1, abs=4)
    # with both radii in proportion the contact keeps its shape
    larger = {"time": [0.0, 1e-4], "radius_x": [0.01, 0.02], "radius_y": [0.01, 0.02]}
    other = pyehl.Case(contact=contact, grid={"points": 33}, duty=larger)["grid"]
    assert other["x_inlet"] == pytest.approx(2.0 ** (1 / 3) * grid["x_inlet"], rel=1e-12)
    assert other["y_extent"] == pytest.approx(2.0 ** (1 / 3) * 2.0, rel=1e-12)
    assert other["points_y"] == 33

    data = pyehl.solve(case, output=tmp_path / "pyehl")
    assert np.abs(data.history_Y_min.values).max() < 0.6 * grid["y_extent"]
    derived = ("y_extent", "points_y", "x_inlet", "x_outlet", "border")
    lines = [line for line in case.text.splitlines() if line.split("=")[0].strip() not in derived]
    (tmp_path / "case.nml").write_text("\n".join(lines) + "\n")
    assert drive("ehl", "case.nml", "-o", "ehl").returncode == 0
    one, two = ((tmp_path / by / "history.csv").read_text() for by in ("ehl", "pyehl"))
    assert one == two
