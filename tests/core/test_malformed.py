# SPDX-License-Identifier: BSD-3-Clause
"""Malformed cases: exit status 2, one message with its position, nothing solved or written.

In the table a section sign marks the character below which the first caret must be.
"""

import re
from pathlib import Path

import pytest

from pyehl import Case, InputError, cli

MARK = "§"

# Name, case with mark, --set options, necessary words of the message
FAULTS: list[tuple[str, str, list[str], list[str]]] = [
    ("unknown key", "&grid\n  §pionts = 65\n/\n", [], ["'pionts'", "'points'", "&grid"]),
    ("unknown key, nothing near", "&grid §qqq = 1 /", [], ["'qqq'", "points, points_y, x_inlet"]),
    ("key of another group", "&psd §slide_to_roll = 0.01 /", [], ["belongs to &contact"]),
    ("its option", "", ["psd.limiting_coefficient=0.1"], ["belongs to &lubricant"]),
    (
        "two velocities",
        "&contact slide_to_roll = 0.1 / &surface §velocity_ratio = 1.01 /",
        [],
        ["contact.slide_to_roll = 0.1", "&surface, on body 1", "1.05", "1.01", "slide_to_roll = 0.02 "],
    ),
    (
        "two velocities, surface 2",
        "&surface velocity_ratio = 1.05 / &contact rough_surface = 2 §slide_to_roll = 0.1 /",
        [],
        ["&surface, on body 2", "0.95", "1.05"],
    ),
    ("two limits", "&lubricant limiting_stress = 1e8 §limiting_coefficient = 0.1 /", [], ["one of"]),
    (
        "shear law without a speed",
        "&contact moes_m = 200.0 / &lubricant shear_law = §'eyring' /",
        [],
        ["moes_m", "sliding speed", "mean_velocity"],
    ),
    (
        "shear law without numbers",
        "&lubricant shear_law = §'carreau' carreau_stress = 1e6 /",
        [],
        ["carreau_exponent"],
    ),
    ("oil that is not there", "&lubricant name = §'fva' /", [], ["'fva3'", "did you mean 'fva3'"]),
    ("oil too cold", "&lubricant name = 'fva3' temperature = §-80.0 /", [], ["[-60, 250]"]),
    (
        "oil and its viscosity",
        "&lubricant name = 'fva3'\n§viscosity = 0.05 /",
        [],
        ["contradicts lubricant.name", "0.08454 at 40.0 degC"],
    ),
    ("law without constants", "&lubricant viscosity_law = §'yasutomi' /", [], ["yasutomi_tg0"]),
    ("law without a table", "&lubricant viscosity_law = §'table' /", [], ["table = '...'"]),
    ("density without constants", "&lubricant density_law = §'murnaghan' /", [], ["murnaghan_rate"]),
    ("density without its volume", "&lubricant density_law = §'tait' /", [], ["tait_modulus"]),
    (
        "free volume without constants",
        "&lubricant viscosity_law = §'doolittle' tait_modulus = 9e9 tait_rate = 11.0 /",
        [],
        ["doolittle_r0"],
    ),
    (
        "free volume without a volume",
        "&lubricant viscosity_law = §'doolittle'\n"
        "doolittle_viscosity = 0.02 doolittle_b = 4.5 doolittle_r0 = 0.66 /",
        [],
        ["without the volume under pressure", "tait_modulus"],
    ),
    (
        "no free volume",
        "&lubricant viscosity_law = §'doolittle' temperature = 0.0\n"
        "doolittle_viscosity = 0.02 doolittle_b = 4.5 doolittle_r0 = 0.97\n"
        "doolittle_temperature = 40.0 tait_temperature = 40.0\n"
        "tait_modulus = 9e9 tait_rate = 11.0 tait_expansion = 1e-3 /",
        [],
        ["no viscosity at 0.0 degC", "the oil is liquid"],
    ),
    (
        "two expansions",
        "&lubricant density_law = 'tait' tait_modulus = 9e9 tait_rate = 11.0\n"
        "thermal_expansion = §7e-4 /",
        [],
        ["has its own", "tait_expansion"],
    ),
    (
        "a liquid without a volume",
        "&lubricant density_law = §'tait' tait_modulus = 2e8 tait_rate = 1.0 /",
        [],
        ["no density that increases with pressure", "lower load"],
    ),
    (
        "range upside down",
        "&lubricant range_temperature_min = 60.0 range_temperature_max = §20.0 /",
        [],
        ["below range_temperature_min"],
    ),
    (
        "law of the prediction alone",
        "&psd viscosity_law = §'dicke' /",
        [],
        ["that of the lubricant"],
    ),
    ("exponent out of range", "&lubricant carreau_exponent = §1.2 /", [], ["0 or [0.05, 1]"]),
    ("negative boundary film", "&lubricant boundary_film = §-1e-9 /", [], ["0 or [1e-11, 1e-5]"]),
    ("boundary friction alone", "&lubricant boundary_friction = §0.1 /", [], ["a boundary_film in m"]),
    (
        "boundary film without a size",
        "&contact moes_m = 200.0 / &lubricant boundary_film = §1e-9 /",
        [],
        ["no size in m", "load, mean_velocity"],
    ),
    (
        "hardness without a boundary film",
        "&contact hardness = §3e9 /",
        [],
        ["no solid contact", "a boundary_film in m"],
    ),
    (
        "hardness below the Hertz pressure",
        "&contact hardness = §1.5e9 / &lubricant boundary_film = 1e-9 /",
        [],
        ["contact.hardness = 1.5e9 Pa", "the Hertz pressure is 1.66e9 Pa"],
    ),
    ("negative hardness", "&contact hardness = §-1.0 /", [], ["0 or [1e5, 1e12]"]),
    (
        "boundary film and Alcouffe",
        "&lubricant boundary_film = 1e-9 / &solver §coarsening = 'alcouffe' /",
        [],
        ["lubricant.boundary_film", "'auto' or 'classical'"],
    ),
    ("no Eyring stress", "&lubricant eyring_stress = §0.0 /", [], ["[1e4, 1e9]"]),
    ("temperature alone", "&lubricant temperature = §80.0 /", [], ["kinematic_viscosity_40"]),
    (
        "heat of friction without a size",
        "&contact moes_m = 200.0 / &lubricant thermal_friction = §'always' /",
        [],
        ["no sliding speed", "'auto'"],
    ),
    (
        "heat of an oil that nothing is known of",
        "&lubricant thermal_friction = §'always' /",
        [],
        ["temperature_viscosity", "kinematic_viscosity_40"],
    ),
    ("a heat that is no word", "&lubricant thermal_friction = §'on' /", [], ["'auto', 'always', or 'never'"]),
    (
        "body that conducts nothing",
        "&contact thermal_conductivity_2 = §0.01 /",
        [],
        ["0 or [0.1, 500]"],
    ),
    (
        "bodies that make no ellipse",
        "&bodies radius_x1 = 9.5 radius_y1 = §9.5e-3 /",
        [],
        ["radius_x/radius_y", "30 to 1"],
    ),
    ("half a data sheet", "&lubricant kinematic_viscosity_40 = §68.0 /", [], ["both"]),
    (
        "data sheet upside down",
        "&lubricant kinematic_viscosity_40 = 8.7 kinematic_viscosity_100 = §68.0 /",
        [],
        ["the smaller one"],
    ),
    (
        "two viscosities",
        "&lubricant kinematic_viscosity_40=68.0 kinematic_viscosity_100=8.7 §viscosity=0.04 /",
        [],
        ["0.04", "40.0 degC"],
    ),
    (
        "too cold an oil",
        "&lubricant temperature=§-60.0 kinematic_viscosity_40=460.0 kinematic_viscosity_100=30.0/",
        [],
        ["lubricant.viscosity", "-60.0 degC"],
    ),
    (
        "too hot an oil",
        "&lubricant temperature=250.0 kinematic_viscosity_40=§1.2 kinematic_viscosity_100=0.6 "
        "pressure_viscosity=2.2e-8 /",
        [],
        ["lubricant.roelands_z"],
    ),
    (
        "heat without a slope",
        "&lubricant thermal_reduction = §T /",
        [],
        ["temperature_viscosity", "kinematic_viscosity_40"],
    ),
    (
        "heat without a speed",
        "&contact moes_m=200.0/ &lubricant thermal_reduction=§T temperature_viscosity=0.03/",
        [],
        ["moes_m", "m/s"],
    ),
    (
        "heat beyond the formula",
        "&contact mean_velocity=200.0/ &lubricant thermal_reduction=§T temperature_viscosity=0.03/",
        [],
        ["thermal loading", "slower"],
    ),
    ("key of another group", "&grid §load = 600.0 /", [], ["'load'", "belongs to &contact"]),
    ("unknown group", "§&contcat load = 600 /", [], ["&contcat", "'&contact'"]),
    ("group without a name", "§& load = 600 /", [], ["unknown group"]),
    ("word for a real", "&contact load = §heavy /", [], ["contact.load = heavy", "a number"]),
    ("string for a real", "&contact load = §'600' /", [], ["contact.load", "a number", "N"]),
    ("real for an integer", "&grid points = §65.0 /", [], ["grid.points = 65.0", "whole number"]),
    ("word for an integer", "&grid points = §many /", [], ["grid.points", "whole number"]),
    ("number for a word", "&surface kind = §1 /", [], ["surface.kind", "'smooth'", "quotes"]),
    ("word without quotes", "&surface kind = §smooth /", [], ["surface.kind", "quotes"]),
    ("number for a truth value", "&output fields = §1 /", [], ["output.fields", ".true."]),
    ("string for a truth value", "&output fields = §'T' /", [], ["output.fields", ".true."]),
    ("wrong choice", "&surface kind = §'smoth' /", [], ["surface.kind", "'smooth'?", "'fractal'"]),
    ("wrong choice, nothing near", "&solver deflection = §'fem' /", [], ["deflection", "'mlmi'"]),
    ("empty choice", "&solver cycle = §'' /", [], ["solver.cycle", "'W'"]),
    ("decimal comma", "&contact mean_velocity = 0§,84 /", [], ["decimal comma", "mean_velocity"]),
    ("decimal comma, negative", "&grid\nx_inlet = -2§,5\n/", [], ["decimal comma", "grid.x_inlet"]),
    ("decimal comma in an exponent", "&lubricant viscosity = 4§,0e-2/", [], ["decimal comma"]),
    ("list of values", "&grid points = 65, §129 /", [], ["second value", "grid.points"]),
    ("list without a comma", "&grid points = 65 §129 /", [], ["grid.points"]),
    ("repeat count", "&grid points = §2*65 /", [], ["grid.points", "a single number"]),
    ("unit", "&contact load = 600 §N /", [], ["unit", "contact.load", "unit N, not written"]),
    ("unit with a slash", "&contact mean_velocity = 0.84 §m/s /", [], ["unit", "mean_velocity"]),
    ("unit without a blank", "&contact load = 600§N /", [], ["contact.load", "after the number"]),
    ("unit before a key", "&contact load = 600 §kN, radius = 1 /", [], ["unit", "contact.load"]),
    ("unit as a string", "&contact load = 600 §'N' /", [], ["contact.load"]),
    ("nan", "&contact load = §nan /", [], ["contact.load", "finite"]),
    ("inf", "&contact load = §+Infinity /", [], ["contact.load", "finite"]),
    ("overflow", "&contact load = §1e999 /", [], ["contact.load", "too large"]),
    ("overflow by digits", "&contact load = §" + "9" * 400 + " /", [], ["contact.load", "too large"]),
    ("integer overflow", "&surface seed = §99999999999 /", [], ["surface.seed", "out of range"]),
    ("two points in a number", "&contact load = 6.0§.0 /", [], ["contact.load = 6.0.0"]),
    ("hexadecimal", "&grid points = 0§x41 /", [], ["grid.points"]),
    ("negative load", "&contact load = §-600 /", [], ["contact.load = -600", "out of range"]),
    ("zero load", "&contact load = §0 /", [], ["contact.load = 0", "out of range"]),
    ("millimetres", "&contact radius = §18 /", [], ["contact.radius", "[1e-5, 10]", "18 mm is 18e-3"]),
    ("gigapascals", "&contact reduced_modulus = §226 /", [], ["reduced_modulus", "unit Pa"]),
    ("centistokes", "&lubricant viscosity = §40 /", [], ["lubricant.viscosity", "unit Pa s"]),
    ("per gigapascal", "&lubricant pressure_viscosity = §22 /", [], ["pressure_viscosity", "1/Pa"]),
    ("nanometres", "&surface rms_height = §50 /", [], ["surface.rms_height", "unit m"]),
    ("impossible pressure", "&contact load = §9e4 radius = 5e-3/", [], ["Hertz", "contact.load"]),
    (
        "radius of a body in mm",
        "&contact load = 37.0 mean_velocity = 3.0 / &bodies radius_x1 = §9.5 radius_y1 = 9.5 /",
        [],
        ["M is", "bodies.radius_x1 = 9.5", "9.5 mm is 9.5e-3"],
    ),
    ("radius in mm", "&contact load = 10.0 radius = §9.525 /", [],
     ["M is", "contact.radius = 9.525\n", "9.525 mm is 9.525e-3"]),
    ("E in the contact", "&contact §youngs_modulus = 2e11 /", [], ["keys of &bodies (modulus_1, "]),
    ("E1 in the contact", "&contact §E1 = 2e11 /", [], ["keys of &bodies", "2/E' = sum of (1 - nu^2)/E"]),
    ("nu in the contact", "&contact §nu1 = 0.3 /", [], ["keys of &bodies", "poisson_1"]),
    ("E as an option", "", ["contact.E=2e11"], ["unknown key 'E'", "keys of &bodies"]),
    ("E star", "&contact §e_star = 1e11 /", [], ["twice the modulus E*"]),
    ("Hertz pressure", "&contact §hertz_pressure = 1e9 /", [], ["follows from load", "pyehl film"]),
    ("maximum pressure", "&contact §max_pressure = 1e9 /", [], ["no input"]),
    ("speed of a body", "&contact §speed_1 = 1.0 /", [], ["mean_velocity = (u1 + u2)/2"]),
    ("u1", "&contact §u1 = 1.0 /", [], ["slide_to_roll = (u1 - u2)/mean_velocity"]),
    ("velocity of a surface", "&surface §velocity = 1.0 /", [], ["did you mean 'velocity_ratio'"]),
    ("line load", "&contact §line_load = 1e5 /", [], ["contact.load_per_length [N/m]"]),
    ("length of a line", "&contact length = §0.01 /", [], ["without contact.shape = 'roller'"]),
    ("length of a lubricant", "&lubricant §length = 0.01 /", [], ["belongs to &contact"]),
    ("spin", "&contact §spin = 0.1 /", [], ["spin is not modelled"]),
    ("starvation", "&contact §starved = .true. /", [], ["inlet.position [m]"]),
    ("wear", "&contact §wear = 1e-8 /", [], ["wear is not modelled"]),
    ("group of wear", "§&wear k = 1e-8 /", [], ["unknown group &wear", "wear is not modelled"]),
    ("its option, of wear", "", ["wear.k=1e-8"], ["unknown group 'wear'", "wear is not modelled"]),
    ("group of plasticity", "§&plasticity hardness = 7e9 /", [], ["contact.hardness [Pa]", "4.2 GPa"]),
    ("unit that is none", "&surface height_unit = §'Å' /", [], ["\nexpected: 'm', 'mm', 'um', or 'nm'\n"]),
    ("modulus far too low", "&contact load=5e4 reduced_modulus=§1e8/", [], ["contact.reduced_modulus"]),
    ("another value replaced", "&grid points=66/ &contact load=§-1 /", ["grid.points=65"], ["load = -1"]),
    ("option as bad as the value", "&grid points = 66 /", ["grid.points=68"], ["grid.points = 68"]),
    ("pipe as a map", "&surface kind='map' file=§'/dev/zero'/", [], ["surface.file", "a device"]),
    ("heavy Moes number", "&contact moes_m = §5e5 /", [], ["M of the round contact", "1e5 at most"]),
    ("negative Moes number", "&contact moes_m = §-1 /", [], ["contact.moes_m", "(0, 1e6]"]),
    ("inlet inside the contact", "&grid x_inlet = §-0.5 /", [], ["grid.x_inlet", "-1.05"]),
    ("accuracy of zero", "&solver accuracy = §0 /", [], ["solver.accuracy"]),
    ("target error too small", "&grid target_error = §1e-9 /", [], ["grid.target_error", "0 or"]),
    ("both kinds of contact", "&contact moes_m = 100\n §load = 600 /", [], ["contradicts", "moes_m"]),
    ("both amplitudes", "&surface kind='harmonic' amplitude=0.1 §amplitude_over_film=0.4/", [],
     ["surface.amplitude", "contradicts"]),
    ("steps and periods", "&time steps = 5, max_periods = §3 /", [], ["contradicts", "time.steps"]),
    ("even points", "&grid points = §512 /", [], ["grid.points = 512", "even", "513"]),
    ("points without levels", "&grid points = §131 /", [], ["grid.points", "129", "145"]),
    ("too few points", "&grid points = §9 /", [], ["grid.points", "[17, 4097]"]),
    ("too many points", "&grid points = §8193 /", [], ["grid.points", "[17, 4097]"]),
    ("map without a file", "&surface kind = §'map' /", [], ["surface.file", "'map'"]),
    ("two widths", "&surface kind='dent' width=0.5 §width_m=1e-4 /", [], ["contradicts", "surface.width"]),
    ("metres without a size", "&contact moes_m=100.0/\n&surface kind='dent' width_m = §1e-4 /", [],
     ["surface.width_m", "Moes numbers", "surface.width"]),
    ("feature inside the contact", "&surface kind='bump' x_start = §-0.5 /", [], ["surface.x_start", "-1.25"]),
    ("spectrum of a feature", "&surface kind='ridge' shortest_wavelength = §1e-5 /", [], ["closed form"]),
    ("sign of zero", "&surface sign = §0 /", [], ["surface.sign = 0", "1 or -1"]),
    ("crop backwards", "&surface crop_x_min=2e-4 crop_x_max = §1e-4 /", [], ["crop_x_max", "beyond crop_x_min"]),
    ("crop of nothing", "&surface crop_y_min=2e-4 crop_y_max = §2e-4 /", [], ["crop_y_max", "beyond crop_y_min"]),
    ("channel without quotes", "&surface channel = §Height /", [], ["surface.channel", "quotes", "a text"]),
    ("threshold too small", "&surface outliers = §1 /", [], ["surface.outliers", "0 or [3, 1e6]"]),
    ("unknown form", "&surface detrend = §'plane' /", [], ["surface.detrend", "'tilt'"]),
    ("map that is not there", "&surface kind='map' file = §'no.npy' /", [], ["surface.file", "no.npy"]),
    ("no slash at the end", "&grid\n  points = 65§\n\n", [], ["&grid", "line 1", "'/'"]),
    ("no slash before a group", "&grid\n points = 65\n§&solver threads = 2 /", [], ["&grid", "'/'"]),
    ("old end of a group", "&grid points = 65 §&end", [], ["&grid", "'/'"]),
    ("no group", "§points = 65", [], ["outside of a group", "&grid"]),
    ("text after a group", "&grid /\n§x", [], ["outside of a group"]),
    ("key twice", "&grid points = 65\n §points = 129 /", [], ["grid.points", "twice"]),
    ("group twice", "&grid points = 65 /\n§&grid x_inlet = -3 /", [], ["&grid", "twice"]),
    ("no value", "&grid points = §/", [], ["no value", "grid.points"]),
    ("no value before a comma", "&grid points = §, x_inlet = -3 /", [], ["no value", "grid.points"]),
    ("no value before a key", "&grid points =\n §x_inlet = -3 /", [], ["no value", "grid.points"]),
    ("no value at the end", "&grid points =§", [], ["no value", "grid.points"]),
    ("no equals sign", "&grid points§ 65 /", [], ["'='", "grid.points"]),
    ("index", "&grid §points(1) = 65 /", [], ["points(1)", "'points'"]),
    ("two commas", "&grid points = 65,§, x_inlet = -3 /", [], ["two commas", "grid.points"]),
    ("comma first", "&grid §, points = 65 /", [], ["&grid"]),
    ("two values with an equals sign", "&grid points = 65 §= 129 /", [], ["grid.points"]),
    ("open quote", "&surface kind = §'smooth /\n/", [], ["surface.kind", "quote"]),
    ("binary file", "&grid\n§\x01\x02 /", [], ["not a text file"]),
    ("tab before the fault", "&grid\n\t§pionts = 65 /", [], ["'points'"]),
    ("letters beyond ASCII before the fault", "&surface file = 'Höhe µm.npy' §knd = 1 /", [], ["'kind'"]),
    ("line ends of Windows", "&grid\r\n  §pionts = 65\r\n/\r\n", [], ["'points'"]),
    ("comment does not hide the fault", "! &grid /\n&grid ! points\n §pionts=65 ! 1\n/", [], ["'points'"]),
    ("option with an unknown key", "", ["grid.pionts=65"], ["--set grid.pionts=65", "'points'"]),
    ("option with an unknown group", "", ["gird.points=65"], ["--set gird.points=65", "'grid'"]),
    ("option without a group", "", ["points=65"], ["--set points=65", "group.key=value"]),
    ("option without a value", "", ["grid.points="], ["no value", "grid.points"]),
    ("option without an equals sign", "", ["grid.points"], ["group.key=value"]),
    ("option out of range", "", ["grid.points=8193"], ["--set grid.points=8193", "out of range"]),
    ("option with a decimal comma", "", ["grid.x_inlet=-2,5"], ["decimal comma", "grid.x_inlet"]),
    ("option with a unit", "", ["contact.load=600 N"], ["--set contact.load=600 N", "contact.load"]),
    ("option twice", "", ["grid.points=65", "grid.points=129"], ["twice", "grid.points"]),
    ("option against the file", "&contact moes_m=100 /", ["contact.load=1"], ["contradicts", "--set"]),
    ("option that is not finite", "", ["contact.load=inf"], ["finite", "contact.load"]),
    ("empty option", "", ["="], ["group.key=value"]),
]  # fmt: skip


def place(marked: str) -> tuple[str, str]:
    """The text without its mark, and the line:column of the mark."""
    before, mark, after = marked.partition(MARK)
    if not mark:
        return marked, ""
    line = before.count("\n") + 1
    column = len(before) - (before.rfind("\n") + 1) + 1
    return before + after, f":{line}:{column}"


@pytest.mark.parametrize(("name", "marked", "options", "parts"), FAULTS, ids=[f[0] for f in FAULTS])
def test_malformed_case(tmp_path: Path, capsys, monkeypatch, name, marked, options, parts):
    text, where = place(marked)
    (tmp_path / "case.nml").write_bytes(text.encode())
    monkeypatch.chdir(tmp_path)
    assert cli.main(["run", *words_of(options)]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    message = printed.err.splitlines()
    if where:
        assert message[0].startswith(f"case.nml{where}: error: ")
    else:
        assert message[0].startswith("--set ")
    assert "| " in message[1]
    assert message[1].partition("|")[2].strip() == shown_line(text, where, options)
    assert set(message[2].strip()) <= set("|^ \t")
    assert "^" in message[2]
    assert caret_column(message) == marked_column(text, where, message)
    assert message[3].startswith("expected: ")
    assert len(message) == 4
    for part in parts:
        assert part in printed.err
    assert [path.name for path in tmp_path.iterdir()] == ["case.nml"]


# Faults in the text before any name, and in the operating point, whose quantity is named
NAMELESS = (
    *("open quote", "unit with a slash", "no free volume", "a liquid without a volume"),
    *("impossible pressure", "radius in mm"),
)


@pytest.mark.parametrize(("name", "marked", "options", "parts"), FAULTS, ids=[f[0] for f in FAULTS])
def test_program_refuses_it(drive, tmp_path: Path, name, marked, options, parts):
    """Without line and column, but with the key or unknown name, and the expected values."""
    (tmp_path / "case.nml").write_bytes(place(marked)[0].encode())
    done = drive("ehl", *words_of(options))
    assert (done.returncode, done.stdout) == (2, "")
    assert "error: " in done.stderr
    assert done.stderr.splitlines()[-1].startswith("expected: ")
    assert [path.name for path in tmp_path.iterdir()] == ["case.nml"]
    with pytest.raises(InputError) as reported:
        Case.from_text(
            place(marked)[0], [f"--set {option}" for option in options], origin="case.nml"
        )
    what = str(reported.value).splitlines()[0].partition("error: ")[2]
    names = re.findall(r"[a-z]\w+(?=\.)|\b\w+_\w+|&\w+|'\w+'", what)
    named = any(name.strip("&'").lower() in done.stderr.lower() for name in names)
    assert named or not names or name in NAMELESS


def words_of(options: list[str]) -> list[str]:
    """Command line after the name of the driver."""
    return ["case.nml", "-o", "out", *(word for option in options for word in ("--set", option))]


def shown_line(text: str, where: str, options: list[str]) -> str:
    """The line that the message must show, control characters as blanks."""
    line = text.split("\n")[int(where.split(":")[1]) - 1] if where else options[-1]
    # For a long line its beginning is shown, if that contains the fault
    return "".join(c if ord(c) >= 32 or c == "\t" else " " for c in line)[:100].strip()


def caret_column(message: list[str]) -> int:
    return message[2].index("^") - message[2].index("|") - 1


def marked_column(text: str, where: str, message: list[str]) -> int:
    """The column of the caret after the bar; options have no column, any position will do."""
    if not where:
        return caret_column(message)
    return int(where.split(":")[2])


def test_table_is_large_enough():
    assert len(FAULTS) >= 40
