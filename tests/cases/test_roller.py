# SPDX-License-Identifier: BSD-3-Clause
"""Rollers of finite length: against line, ellipse and dry contact, misaligned, refusals."""

import math
import subprocess

import numpy as np
import pytest
from matplotlib import pyplot as plt

import pyehl
from pyehl.plots.figures import solution_figures
from pyehl.results import settings_of
from pyehl.theory.line_contact import scaling_contact

ROLLER = {
    "shape": "roller",
    "load": 2000.0,
    "length": 0.01,
    "radius": 0.01,
    "mean_velocity": 1.0,
}
LOGARITHMIC = {"profile": "logarithmic", "log_amplitude": 3e-6}


def roller(points: int = 257, grid: dict[str, object] | None = None, **contact: object):
    return pyehl.Case(contact=ROLLER | contact, grid={"points": points} | (grid or {}))


def test_long_roller_is_a_line_in_the_middle():
    chamfer = {"profile": "chamfer", "chamfer_length": 1e-3, "chamfer_drop": 1e-5}
    ds = pyehl.solve(roller(length=0.02, load=4000.0, **chamfer))
    middle = ds.Y.size // 2
    per_length = float(ds.p_Pa[:, middle].sum() * (ds.x_m[1] - ds.x_m[0]))
    assert per_length == pytest.approx(2e5, rel=0.03)
    line = {"shape": "line", "load_per_length": per_length, "radius": 0.01, "mean_velocity": 1.0}
    b = scaling_contact(settings_of(ds)).hertz_radius
    width = math.sqrt(8.0 * per_length * 0.01 / (math.pi * 2.26e11))
    ends = {"x_inlet": float(ds.X[0]) * b / width, "x_outlet": float(ds.X[-1]) * b / width}
    flat = pyehl.solve(pyehl.Case(contact=line, grid={"points": 257, "border": "zero"} | ends))
    scale = scaling_contact(settings_of(ds)).film_scale
    other = scaling_contact(settings_of(flat)).film_scale
    for name in ("H_c", "H_c_extrapolated"):
        assert float(ds[name]) * scale == pytest.approx(float(flat[name]) * other, rel=3e-3)
    row = ds.h_m[:, middle].values
    assert row.min() == pytest.approx(float(flat.H_min) * other, rel=3e-3)


def test_crown_shorter_than_the_roller_is_an_ellipse():
    crown = {"profile": "crown", "crown_radius": 0.4, "load": 400.0, "mean_velocity": 0.2}
    ds = pyehl.solve(roller(513, **crown))
    ellipse = {"load": 400.0, "radius_x": 0.01, "radius_y": 0.4, "mean_velocity": 0.2}
    wide = pyehl.solve(pyehl.Case(contact=ellipse, grid={"points": 513}))
    assert float(ds.P_end) < 1e-3
    assert float(wide.semi_axis_y_m) < 0.9 * 0.005
    scales = [scaling_contact(settings_of(one)).film_scale for one in (ds, wide)]
    for name in ("H_c_extrapolated", "H_min_extrapolated"):
        limits = [float(one[name]) * scale for one, scale in zip((ds, wide), scales, strict=True)]
        assert limits[0] == pytest.approx(limits[1], rel=3e-3)
    assert float(ds.p_max_Pa) == pytest.approx(float(wide.p_max_Pa), rel=3e-3)
    # the profile does not end within the contact: the errors are known
    assert math.isfinite(float(ds.H_min_error))


@pytest.fixture
def dry(script):
    pytest.importorskip("ContactMechanics")
    return script("docs/evidence/rollers/dry.py")


@pytest.mark.parametrize(
    ("points", "misalignment"),
    [
        pytest.param(513, 0.0, marks=pytest.mark.long),
        (257, 0.0),
        pytest.param(257, 2e-4, marks=pytest.mark.long),
    ],
)
def test_low_speed_is_the_dry_contact(dry, points, misalignment):
    """Rms difference over the nodes in contact at 0.07 m/s."""
    ds = dry.solved(points, 0.07, misalignment)
    pressure = dry.dry_pressure(ds)
    step = (ds.x_m[1] - ds.x_m[0]) * (ds.y_m[1] - ds.y_m[0])
    assert float(pressure.sum() * step) == pytest.approx(4000.0, rel=1e-6)
    difference = dry.rms(ds, pressure)
    assert difference < 0.01
    (row,) = (one for one in dry.read() if (one["points"], one["mean_velocity"]) == (points, 0.07))
    if not misalignment:
        assert difference == pytest.approx(row["rms"], rel=1e-3)


def test_difference_vanishes_with_the_speed(dry):
    """The recorded difference falls with about the square root of the speed, on both grids."""
    rows = dry.read()
    for points in (257, 513):
        of_grid = [row for row in rows if row["points"] == points]
        logs = np.log([[row["mean_velocity"], row["rms"]] for row in of_grid])
        assert len(of_grid) > 2
        assert np.polyfit(*logs.T, 1)[0] == pytest.approx(0.53, abs=0.03)
        assert of_grid[-1]["rms"] < 0.009


def test_misalignment_either_way_is_a_mirror_image():
    one, other = (
        pyehl.solve(roller(129, **LOGARITHMIC, misalignment=angle)) for angle in (5e-4, -5e-4)
    )
    assert float(one.P_max_Y) == pytest.approx(-float(other.P_max_Y), abs=1e-12)
    np.testing.assert_allclose(one.P.values, other.P.values[:, ::-1], atol=1e-6)
    # the gap closes where y is negative
    assert float(one.P_max_Y) < 0.0
    straight = pyehl.solve(roller(129, **LOGARITHMIC))
    assert straight.attrs["half_domain"]
    assert not one.attrs["half_domain"]
    assert float(one.P_max) > float(straight.P_max)


def test_profiles_of_both_bodies_are_added(ehl, tmp_path):
    whole = pyehl.solve(roller(65, **LOGARITHMIC))
    parts = {"profile": "logarithmic", "log_amplitude": 1e-6}
    both = roller(65, **parts, profile_2="logarithmic", log_amplitude_2=2e-6)
    result = pyehl.solve(both)
    np.testing.assert_allclose(result.P.values, whole.P.values, atol=1e-9)
    # body 2 alone, also by the program
    two = roller(65, profile_2="logarithmic", log_amplitude_2=3e-6)
    np.testing.assert_array_equal(pyehl.solve(two).P.values, whole.P.values)
    case = tmp_path / "case.nml"
    case.write_text(two.text)
    subprocess.run([ehl, case, "-q", "-o", tmp_path / "out"], check=True)
    np.testing.assert_array_equal(pyehl.load(tmp_path / "out").P.values, whole.P.values)
    # a crown against a chamfered ring has a larger gap than either alone
    mixed = {"profile": "crown", "crown_radius": 2.0, "profile_2": "chamfer"}
    mixed |= {"chamfer_length_2": 1e-3, "chamfer_drop_2": 5e-6}
    crown, chamfer = dict(list(mixed.items())[:2]), {"profile": "chamfer"}
    chamfer |= {"chamfer_length": 1e-3, "chamfer_drop": 5e-6}
    films = [float(pyehl.solve(roller(65, **keys)).H_c) for keys in (mixed, crown, chamfer)]
    assert films[0] < min(films[1:])


def test_ends_under_load_have_no_error():
    ds = pyehl.solve(roller(129))
    assert float(ds.P_end) == float(ds.P_max) > 2.0
    assert abs(float(ds.P_max_Y)) == pytest.approx(float(ds.Y[-2]))
    assert float(ds.cell_at_end) == pytest.approx(float(ds.Y[1] - ds.Y[0]))
    for name in ("H_min", "P_max"):
        assert math.isnan(float(ds[f"{name}_error"]))
        assert "end under load" in ds.attrs[f"{name}_error_note"]
    assert math.isfinite(float(ds.H_c_error))


@pytest.mark.parametrize(
    ("amplitude", "near_ends"),
    [pytest.param(4e-6, False, marks=pytest.mark.long), (1e-6, True)],
)
def test_ends_agree_with_a_longer_domain(tmp_path, amplitude, near_ends):
    """The roller within a domain 1.2 times as long, with an open gap of 0.1 mm beyond its ends.

    P = 0 and the conductance at its ends are then those of the oil there.
    """
    logarithm = {"profile": "logarithmic", "log_amplitude": amplitude, "radius": 0.005}
    short = pyehl.solve(roller(129, **logarithm))
    y = np.linspace(-0.005, 0.005, 2001)
    drop = -amplitude * np.log(1.0 - np.minimum(0.998, np.abs(y) / 0.005) ** 2)
    places = [-0.006, -0.005001, *y, 0.005001, 0.006]
    table = tmp_path / "profile.csv"
    rows = zip(places, [1e-4, 1e-4, *drop, 1e-4, 1e-4], strict=True)
    table.write_text("\n".join(f"{a:.9e}, {b:.9e}" for a, b in rows))
    # the same mesh and inlet in metres: b follows the root of the mean load per length
    wider = math.sqrt(1.2)
    ends = {"x_inlet": float(short.X[0]) * wider, "x_outlet": float(short.X[-1]) * wider}
    keys = {"profile": "file", "profile_file": str(table), "length": 0.012, "radius": 0.005}
    long = pyehl.solve(roller(129, ends, **keys))
    assert float(long.h_c_m) == pytest.approx(float(short.h_c_m), rel=5e-4)
    assert float(long.p_max_Pa) == pytest.approx(float(short.p_max_Pa), rel=5e-4)
    difference = abs(float(long.h_min_m) - float(short.h_min_m))
    if near_ends:
        # within the last hundredth of the length, as accurate as the cells there allow
        assert abs(float(short.H_min_Y)) > 0.98 * float(short.Y[-1])
        assert difference < float(short.h_min_error_m) + float(long.h_min_error_m)
    else:
        assert difference < 5e-4 * float(short.h_min_m)


def test_table_of_a_profile(tmp_path, ehl):
    y = np.linspace(-0.005, 0.005, 4001)
    table = tmp_path / "profile.csv"
    table.write_text("# y, drop [m]\n" + "\n".join(f"{a:.9e}, {a * a / 2.0:.9e}" for a in y))
    case = roller(129, profile="file", profile_file=str(table))
    (tmp_path / "case.nml").write_text(case.text)
    option = "contact.profile_file=other.csv"
    command = [ehl, "case.nml", "-o", "out", "--set", option]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert run.returncode == 2
    # its table would be that of the file in the case
    assert "contact.profile_file without contact.profile_y, which pyehl derives" in run.stderr
    result = pyehl.solve(case)
    crown = pyehl.solve(roller(129, profile="crown", crown_radius=1.0))
    for name in ("H_c", "H_min", "P_max"):
        assert float(result[name]) == pytest.approx(float(crown[name]), rel=1e-4)
    relative = case.text.replace(str(table), table.name)
    assert relative != case.text
    (tmp_path / "relative.nml").write_text(relative)
    command = [ehl, "relative.nml", "-o", "relative", "--quiet"]
    subprocess.run(command, cwd=tmp_path, check=True)
    written = pyehl.Case(tmp_path / "relative" / "case.nml").resolve()
    assert written["contact"]["profile_file"] == str(table)
    # a resolved case contains the table
    text = result.attrs["case"]
    table.unlink()
    again = tmp_path / "again.nml"
    again.write_text(text)
    assert float(pyehl.solve(again).H_c) == float(result.H_c)


def test_ehl_reads_what_pyehl_resolves(tmp_path, ehl):
    case = roller(65, **LOGARITHMIC)
    (tmp_path / "case.nml").write_text(case.text)
    subprocess.run([ehl, tmp_path / "case.nml", "-o", tmp_path / "out"], check=True)
    result, ds = pyehl.load(tmp_path / "out"), pyehl.solve(case)
    np.testing.assert_array_equal(result.P.values, ds.P.values)


@pytest.mark.parametrize(
    ("contact", "words"),
    [
        ({"length": None}, "without contact.length"),
        ({"load_per_length": 1e5}, "contact.load_per_length with contact.shape = 'roller'"),
        ({"moes_m_line": 9.0}, "contact.moes_m_line with contact.shape = 'roller'"),
        ({"profile": "crown"}, "without contact.crown_radius"),
        ({"crown_radius": 1.0}, "contact.crown_radius with contact.profile = 'none'"),
        ({"profile": "chamfer", "chamfer_length": 6e-3, "chamfer_drop": 1e-5}, "more than half"),
        ({"profile": "crown", "crown_radius": 1e-3}, "the profile drops by"),
        ({"profile": "file"}, "without contact.profile_file"),
        ({"profile_2": "crown"}, "without contact.crown_radius_2"),
        ({"chamfer_drop_2": 1e-5}, "chamfer_drop_2 with contact.profile_2 = 'none'"),
        ({"radius_y": 0.1}, "contact.radius_y with contact.shape"),
        ({"angle": 3.0}, "contact.angle with contact.shape"),
        ({"length": 1.0, "load": 1000.0}, "contact.length is"),
        ({"misalignment": 0.2}, "misalignment"),
    ],
)
def test_bad_input(contact, words):
    keys = {name: value for name, value in (ROLLER | contact).items() if value is not None}
    with pytest.raises(pyehl.InputError, match=words):
        pyehl.Case(contact=keys).resolve()


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        (b"# y, drop\n-0.005, 0\n0.005; 0\n", r"profile\.csv:3:1: error: 1 cells"),
        (b"-0.005, 0\n0.005, deep\n", r"profile\.csv:2:1: error: drop = 'deep'"),
        (b"\xff\xfe-0.005, 0\n", r"profile\.csv:1:1: error: y = "),
        (b"", "without contact.profile_file"),
        (b"-0.004, 0\n0.004, 0\n", "does not cover the roller"),
    ],
)
def test_a_bad_table(tmp_path, lines, words):
    """The message names the file and the line."""
    table = tmp_path / "profile.csv"
    table.write_bytes(lines)
    with pytest.raises(pyehl.InputError, match=words):
        roller(profile="file", profile_file=str(table)).resolve()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"surface.kind": "harmonic", "surface.amplitude": 0.01}, "surface.kind"),
        ({"grid.border": "flooded"}, "flow around the ends beyond the border is not known"),
        ({"grid.y_extent": 20.0}, "grid.y_extent"),
        ({"lubricant.boundary_film": 1e-9}, "boundary_film"),
        ({"inlet.position_hertz": 2.0}, "inlet.position"),
        ({"bodies.radius_x1": 0.01, "bodies.radius_y1": 1.0}, "bodies.radius_y1"),
    ],
)
def test_keys_that_a_roller_does_not_take(options, words):
    case = (
        roller()
        if "bodies.radius_x1" not in options
        else pyehl.Case(contact={k: v for k, v in ROLLER.items() if k != "radius"})
    )
    with pytest.raises(pyehl.InputError, match=words):
        case.with_options(options).resolve()


def test_keys_of_a_roller_in_a_point_contact():
    with pytest.raises(pyehl.InputError, match=r"contact\.length without contact\.shape"):
        pyehl.Case(contact={"length": 0.01}).resolve()


def test_commands_that_do_not_take_rollers():
    case = roller(65)
    for command in (pyehl.film, pyehl.response):
        with pytest.raises(pyehl.EhlError, match="roller"):
            command(case)
    # a prediction is for a rough surface
    with pytest.raises(pyehl.InputError, match="rough surface"):
        pyehl.predict(case)
    with pytest.raises(pyehl.InputError, match="roller"):
        pyehl.stress(pyehl.solve(case))


def test_pictures_show_the_whole_roller():
    """The strip over the length, on a map as wide as the roller; no Hertz pressure along it."""
    result = pyehl.solve(roller(129, **LOGARITHMIC))
    figures = solution_figures(result)
    half = 0.5 * 10.0  # [mm]
    top = figures["film"].axes[0]
    assert top.get_xlim() == pytest.approx((-half, half), rel=0.01)
    (edge,) = top.patches
    assert edge.get_bbox().width == pytest.approx(2.0 * half, rel=1e-3)
    along = [line.get_label() for line in figures["centre_lines"].axes[1].get_lines()]
    assert along == ["pressure"]
    plt.close("all")
