# SPDX-License-Identifier: BSD-3-Clause
"""Cases in Python: Python reads the values that Fortran resolves; the documents agree."""

import math
import re
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from pyehl import Case, cli, library, namelist
from pyehl.case import KEYS, resolve, roller
from pyehl.case.settings import MACHINES
from pyehl.errors import InputError

CASES = Path(__file__).resolve().parents[2] / "cases"
# files of bearings and gears are no cases
CASE_FILES = [
    path
    for path in sorted(CASES.glob("*.nml"))
    if not any(f"&{group}\n" in path.read_text() for group in MACHINES)
]


@pytest.mark.parametrize("path", CASE_FILES, ids=[path.name for path in CASE_FILES])
def test_resolved_case_reads_back(path: Path):
    case = Case(path)
    assert Case.from_text(case.text).text == case.text
    groups = case.resolve()
    excluded = {
        "contact.moes_m", "contact.moes_l", "contact.load", "contact.mean_velocity",
        "contact.radius", "contact.reduced_modulus", "contact.radius_x", "contact.radius_y",
        "contact.radius_ratio", "surface.amplitude", "surface.amplitude_over_film",
        "surface.width", "lubricant.temperature", "lubricant.density_15",
        "lubricant.thermal_expansion", "lubricant.name", "lubricant.table",
        "contact.thermal_conductivity_2", "contact.thermal_diffusivity_2", "contact.hardness",
        "lubricant.alpha_origin", "lubricant.inlet_law", "lubricant.table_temperature",
        "lubricant.table_pressure", "lubricant.table_viscosity",
        "contact.shape", "contact.load_per_length", "contact.moes_m_line", "contact.moes_l_line",
        *(f"contact.{key}" for key in roller.KEYS),
    }  # fmt: skip
    assert ("inlet" in groups) == (path.name == "greased.nml")
    if groups["contact"].get("shape") == "line":
        excluded |= {"contact.angle", "grid.y_extent", "grid.points_y"}
    if groups["contact"].get("shape") == "roller":
        excluded |= {"contact.angle", "grid.y_extent"}
    names = {f"{group}.{key}" for group, keys in groups.items() for key in keys}
    unused = set(KEYS) - names
    laws = ("vogel", "dicke", "yasutomi", "doolittle", "murnaghan", "tait", "range")
    others = ("bodies.", "second_surface.", "inlet.", "duty.", *(f"{group}." for group in MACHINES))
    others += tuple(f"lubricant.{law}_" for law in laws)
    assert {name for name in unused if not name.startswith(others)} <= excluded
    assert ("second_surface" in groups) == (path.name == "gear_pair.nml")
    assert ("duty" in groups) == (path.name == "duty.nml")
    for key in KEYS.values():
        if key.name in names:
            group, _, name = key.name.partition(".")
            assert isinstance(groups[group][name], bool | int | float | str | tuple)


def test_lines_that_no_writer_makes_are_refused():
    with pytest.raises(InputError, match="load = 1 2"):
        namelist.values("&contact\n   load = 1 2\n/\n")
    with pytest.raises(InputError, match="contact"):
        namelist.values("contact\n   load = 1\n/\n")


def test_values_are_read_as_written():
    """Words with quotes and exclamation marks, numbers to the last digit, signs, truth values."""
    groups = {
        "surface": {"file": "a 'b' ! c.npy", "x_start": -2.5e-300, "sign": -1, "rms": 0.1 + 0.2},
        "time": {"skip_start": False, "steps": 0, "big": 1e22},
    }
    text = namelist.text_of(groups)
    assert namelist.values(text) == groups


def test_cases_are_there():
    assert {p.name for p in CASE_FILES} >= {"table1.nml", "smooth_m1000_l10.nml", "quick.nml"}


def test_defaults_are_those_of_the_paper():
    groups = Case.from_text("").resolve()
    assert groups["contact"] == {
        "load": 600.0,
        "mean_velocity": 0.84,
        "radius": 0.018,
        "reduced_modulus": 2.26e11,
        "angle": 0.0,
        "slide_to_roll": 0.02,
        "rough_surface": 1,
        "thermal_conductivity": 46.0,
        "thermal_diffusivity": 1.25e-5,
    }
    assert groups["surface"]["velocity_ratio"] == 1.01
    assert groups["grid"]["points"] == 513
    z = 2.2e-8 * 1.96e8 / (math.log(0.04) + 9.67)
    assert groups["lubricant"]["roelands_z"] == pytest.approx(z, rel=1e-15)
    assert groups["psd"]["viscosity_law"] == "roelands"


def test_moes_numbers_default_to_each_other():
    assert Case.from_text("&contact moes_l = 5 /").resolve()["contact"] == {
        "moes_m": 1000.0,
        "moes_l": 5.0,
        "radius_ratio": 1.0,
        "angle": 0.0,
        "slide_to_roll": 0.02,
        "rough_surface": 1,
        "thermal_conductivity": 46.0,
        "thermal_diffusivity": 1.25e-5,
    }


def test_options_replace_values():
    case = Case.from_text("&grid points = 65 /", ["grid.points=129", "surface.kind='fractal'"])
    assert case.resolve()["grid"]["points"] == 129
    assert case.resolve()["surface"]["kind"] == "fractal"
    assert case.with_options("grid.points=257").resolve()["grid"]["points"] == 257


def test_map_is_found_beside_its_case(tmp_path: Path, monkeypatch):
    folder = tmp_path / "a folder"
    folder.mkdir()
    (folder / "it's.npy").write_bytes(b"")
    (folder / "case.nml").write_text("&surface kind = 'map' file = 'it''s.npy' /\n")
    monkeypatch.chdir(tmp_path)
    case = Case("a folder/case.nml")
    assert case.resolve()["surface"]["file"] == str(folder / "it's.npy")
    assert Case.from_text(case.text).text == case.text


def check_message(error: InputError, place: str = "text:") -> None:
    """One message of four lines, with the caret below a character."""
    lines = str(error).split("\n")
    assert lines[0].startswith(place)
    assert "error: " in lines[0]
    assert lines[2].rstrip().endswith("^")
    assert lines[3].startswith("expected: ")
    assert len(lines) == 4


@settings(max_examples=300, deadline=None)
@given(st.text(max_size=60))
@example("&grid points = 65 /")
@example("'")
@example("&")
@example("&grid points")
@example("&grid points=-")
@example("&grid points=e")
@example("&surface file=''''/")
def test_any_text_is_read_or_refused(text: str):
    for whole in (text, f"&grid {text} /", f"&contact load = {text}", f"&surface file='{text}"):
        try:
            resolved = resolve(whole, "text")
        except InputError as error:
            check_message(error)
        else:
            assert resolve(resolved, "text") == resolved


@settings(max_examples=200, deadline=None)
@given(st.data())
def test_damaged_cases_are_read_or_refused(data):
    text = CASE_FILES[data.draw(st.integers(0, len(CASE_FILES) - 1))].read_text()
    at = data.draw(st.integers(0, len(text) - 1))
    mode = data.draw(st.sampled_from(["drop", "insert", "cut"]))
    if mode == "drop":
        text = text[:at] + text[at + 1 :]
    elif mode == "insert":
        text = text[:at] + data.draw(st.sampled_from(list("&/=,'!.0x\t\n\"*("))) + text[at:]
    else:
        text = text[:at]
    try:
        resolve(text, "text")
    except InputError as error:
        check_message(error)


@settings(max_examples=200, deadline=None)
@given(st.text(max_size=30).filter(lambda text: "\n" not in text))
def test_any_option_is_read_or_refused(text: str):
    for option in (text, f"grid.{text}", f"contact.load={text}", f"surface.kind={text}"):
        if not option or "\x00" in option:
            continue
        try:
            resolve("", "text", [option])
        except InputError as error:
            check_message(error, option)


@settings(max_examples=200, deadline=None)
@given(st.floats(min_value=0.011, max_value=99.0))
def test_numbers_keep_their_bits(value: float):
    case = Case.from_text(f"&surface wavelength = {value!r} /")
    assert case.resolve()["surface"]["wavelength"] == value


def test_readme_of_cases_lists_every_key(root: Path):
    text = (root / "cases" / "README.md").read_text()
    rows = {
        cells[0].strip("`"): [cell.replace("`", "").replace("\\|", "|") for cell in cells[1:]]
        for cells in (
            [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
            for line in text.splitlines()
            if re.match(r"\| `\w+\.(?!nml|csv)\w+`", line)
        )
    }
    keys = dict(KEYS)
    second = {name for name in keys if name.startswith("second_surface.")}
    assert list(rows) == [name for name in keys if name not in second]
    # the same keys with the same defaults, described once
    assert {name.removeprefix("second_") for name in second} == {
        name for name in keys if name.startswith("surface.")
    }
    for name in second:
        key, like = keys[name], keys[name.removeprefix("second_")]
        assert (key.unit, key.default, key.allowed) == (like.unit, like.default, like.allowed)
    for name, (unit, default, allowed, meaning) in rows.items():
        key = keys[name]
        assert unit == ("" if key.unit == "-" else key.unit), name
        assert allowed == key.allowed, name
        assert meaning, name
        # defaults that follow from other keys are described in words
        if default not in {"derived", "none"}:
            assert default == key.default, name


def test_check_prints_the_resolved_case_and_the_plan(capsys, cases: Path):
    assert cli.main(["check", str(cases / "quick.nml"), "--set", "grid.points=65"]) == 0
    printed = capsys.readouterr().out
    assert "points = 65" in printed
    text, _, plan = printed.rpartition("/\n")
    assert resolve(text + "/\n", "text").strip() == (text + "/").strip()
    assert plan.strip()


@pytest.mark.parametrize("words", [[], ["rnu"], ["run"], ["export"]])
def test_bad_subcommands(words: list[str], capsys):
    try:
        status = cli.main(words)
    except SystemExit as end:
        status = end.code
    assert status == 2
    printed = capsys.readouterr()
    assert "run" in printed.out + printed.err or "export" in printed.err


def test_info(capsys):
    assert cli.main(["info"]) == 0
    printed = capsys.readouterr().out
    assert "GCC" in printed
    assert "numpy" in printed


FIG_2 = (
    "&contact moes_m = 1000.0 moes_l = 10.0 /\n&surface kind = 'harmonic' wavelength = 0.5 {} /\n"
)


@pytest.mark.parametrize(
    ("given", "option", "followers"),
    [
        ("", "surface.wavelength=0.25", {"wavelength_x": 0.25, "wavelength_y": 0.25}),
        ("wavelength_x = 1.0", "surface.wavelength=0.25", {"wavelength_x": 1.0}),
        ("wavelength_x = 0.5", "surface.wavelength=0.25", {"wavelength_x": 0.5}),
        ("", "contact.slide_to_roll=0.1", {"velocity_ratio": 1.05}),
        ("velocity_ratio = 1.05", "surface.velocity_ratio=1.1", {"velocity_ratio": 1.1}),
        ("", "contact.rough_surface=2", {"velocity_ratio": 0.99}),
        ("", "grid.x_inlet=-4.0", {"x_start": -4.0}),
        ("x_start = -3.0", "grid.x_inlet=-4.0", {"x_start": -3.0}),
        ("", "lubricant.viscosity=0.08", {"roelands_z": 2.2e-8 * 1.96e8 / (math.log(0.08) + 9.67)}),
        ("/ &lubricant roelands_z = 0.68", "lubricant.viscosity=0.08", {"roelands_z": 0.68}),
        ("", "lubricant.viscosity_law=barus", {"viscosity_law": "barus"}),
        ("/ &psd viscosity_law = 'roelands'", "lubricant.viscosity_law=barus", {}),
        ("amplitude = 0.01", "surface.amplitude=0.02", {"amplitude": 0.02}),
        ("", "surface.amplitude=0.02", {"amplitude": 0.02}),
        (
            "/ &lubricant kinematic_viscosity_40 = 46.0 kinematic_viscosity_100 = 6.8 "
            "temperature = 40.0",
            "lubricant.temperature=80.0",
            {"temperature": 80.0},
        ),
    ],
)
def test_derived_values_follow_an_override(given: str, option: str, followers: dict):
    """An override of a resolved case acts as on the original case."""
    text = FIG_2.format(given)
    first = Case.from_text(text)
    changed = first.with_options(option)
    assert changed.text == Case.from_text(text, [option]).text
    groups = changed.resolve()
    values = groups["surface"] | groups["lubricant"]
    for name, value in followers.items():
        assert values[name] == pytest.approx(value, rel=1e-14) if value != "barus" else True
    if "viscosity_law" in option:
        expected = "roelands" if "psd" in given else "barus"
        assert groups["psd"]["viscosity_law"] == expected
    # and back
    assert changed.with_options(option).text == changed.text


def test_given_keys_replace_defaults_of_the_other_contact():
    case = Case.from_text("").with_options("contact.moes_m=500.0")
    assert case.resolve()["contact"]["moes_m"] == 500.0
    with pytest.raises(InputError, match="contradicts"):
        Case.from_text("&contact load = 600.0 /").with_options("contact.moes_m=500.0")


def test_an_edited_value_counts_as_given():
    text = Case.from_text(FIG_2.format("")).text
    assert re.search(r"wavelength_y = 0\.5 .*! default", text)
    assert re.search(r"roelands_z = 0\.66\d+ .*! derived", text)
    assert not re.search(r"wavelength = 0\.5 .*! de", text)
    edited = text.replace("wavelength_y = 0.5 ", "wavelength_y = 0.7 ")
    case = Case.from_text(edited, ["surface.wavelength=0.25"])
    surface = case.resolve()["surface"]
    assert (surface["wavelength_x"], surface["wavelength_y"]) == (0.25, 0.7)
    assert not re.search(r"wavelength_y = 0\.7 .*! de", case.text)


@pytest.mark.parametrize(
    ("groups", "option"),
    [
        ("&contact moes_m = 100.0 moes_l = 5.0 /", "lubricant.viscosity=0.08"),
        (
            "&contact load = 20.0 radius = 0.01 /\n&lubricant viscosity_law = 'dicke' "
            "vogel_viscosity = 1e-4 vogel_b = 800.0 vogel_c = 95.0 dicke_a1 = 1e8 dicke_a2 = 1e6 "
            "dicke_b1 = 0.6 /",
            "lubricant.temperature=60.0",
        ),
    ],
)
def test_overrides_of_a_written_case_are_whole(drive, tmp_path: Path, groups, option):
    """By both drivers, on the case.nml of a result."""
    (tmp_path / "case.nml").write_text(f"{groups}\n&grid points = 65 /\n")
    assert drive("ehl", "case.nml", "-o", "first").returncode == 0
    texts = []
    for driver, case in (
        ("ehl", "case.nml"),
        ("ehl", "first/case.nml"),
        ("pyehl", "first/case.nml"),
    ):
        assert drive(driver, case, "--set", option, "-o", "out").returncode == 0
        # pyehl also writes the meanings of keys
        texts.append(Case(tmp_path / "out" / "case.nml").text)
    assert texts[0] == texts[1] == texts[2]
    assert texts[0] != Case(tmp_path / "first" / "case.nml").text


def test_table_of_a_duty_remains_that_of_its_file(drive, tmp_path: Path):
    """In the case of a result of ehl, also after an option."""
    (tmp_path / "duty.csv").write_text("time [s], load [N]\n0, 20\n2e-6, 21\n")
    case, option = tmp_path / "case.nml", "contact.radius=0.02"
    case.write_text(
        "&contact load = 20.0 radius = 0.01 /\n&duty file = 'duty.csv' /\n&grid points = 65 /\n"
    )
    (tmp_path / "resolved.nml").write_text(Case(case).text)
    assert drive("ehl", "resolved.nml", "-o", "out", "--set", option).returncode == 0
    assert Case(tmp_path / "out" / "case.nml").text == Case(case, option).text


@pytest.mark.parametrize(
    ("text", "key", "value"),
    [
        ("&surface kind = 'fractal' rq = 5e-8 /", "surface.rms_height", 5e-8),
        (
            "&contact shape = 'line' load_per_length = 1e5 /\n&bodies radius_x1 = 0.018 /",
            "contact.radius",
            0.018,
        ),
    ],
)
def test_derived_values_may_equal_their_defaults(drive, tmp_path: Path, text, key, value):
    case = Case.from_text(f"{text}\n&grid points = 65 /\n&time steps = 1 /\n")
    group, name = key.split(".")
    assert case.resolve()[group][name] == value
    (tmp_path / "case.nml").write_text(case.text)
    # 1: the friction of a rough contact has not settled
    assert drive("ehl", "case.nml", "-o", "out").returncode in (0, 1)
    assert Case(tmp_path / "out" / "case.nml").text == case.text


@pytest.mark.parametrize(
    ("text", "option", "message"),
    [
        (
            "&surface kind = 'fractal' rq = 6e-8 /",
            "surface.rq=1e-7",
            "surface.rms_height",
        ),
        ("&surface finish = 'ground' /", "surface.finish='honed'", "without surface.kind"),
        ("&lubricant name = 'n100' /", "lubricant.name='n7'", "without lubricant.viscosity"),
    ],
)
def test_ehl_does_not_keep_values_that_an_option_changes(drive, tmp_path, text, option, message):
    """The values of a resolved case that pyehl derived do not follow an option of ehl."""
    (tmp_path / "case.nml").write_text(Case.from_text(f"{text}\n&grid points = 65 /\n").text)
    run = drive("ehl", "case.nml", "-o", "out", "--set", option)
    assert run.returncode == 2
    assert message in run.stderr
    assert not (tmp_path / "out").exists()


def test_version_is_one_line(capsys):
    assert cli.main(["--version"]) == 0
    printed = capsys.readouterr().out
    assert printed == f"pyehl {library.version()}\n"


def test_a_missing_compiled_part_is_one_message():
    code = (
        "import sys; sys.modules |= {'pyehl._core': None, 'pyehl._core_v3': None}; "
        "from pyehl import cli; sys.exit(cli.main(['check', 'case.nml']))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr.startswith("pyehl: error: the compiled part of pyehl is missing")
    assert len(done.stderr.splitlines()) == 1


def test_info_without_the_compiled_part(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyehl.library", None)
    monkeypatch.delattr("pyehl.library", raising=False)
    assert cli.main(["info"]) == 0
    printed = capsys.readouterr().out
    assert "missing" in printed
    assert "numpy" in printed
