# SPDX-License-Identifier: BSD-3-Clause
"""Oils by name, laws with constants of an oil, tables of measured values, alpha* and alpha_film."""

import math
from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl import Case, InputError, Lubricant, cli
from pyehl.theory.oils import film_forming, known_oils, reciprocal_isoviscous

TABLE = (
    "pressure_Pa,temperature_degC,viscosity_Pa_s\n"
    "0,40,0.08\n2e8,40,6.0\n5e8,40,1100\n0,80,0.017\n2e8,80,0.5\n5e8,80,35\n"
)
T9 = {
    "lubricant.viscosity_law": "yasutomi",
    "lubricant.yasutomi_tg0": -83.2,
    "lubricant.yasutomi_a1": 188.86,
    "lubricant.yasutomi_a2": 0.719e-9,
    "lubricant.yasutomi_b1": 8.2e-9,
    "lubricant.yasutomi_b2": -0.5278,
    "lubricant.yasutomi_c1": 16.09,
    "lubricant.yasutomi_c2": 17.38,
    "lubricant.density_law": "murnaghan",
    "lubricant.murnaghan_modulus": 9.234e9,
    "lubricant.murnaghan_rate": 10.545,
    "lubricant.murnaghan_softening": 6.09e-3,
}
LIGHT = {"contact.load": 50.0, "grid.points": 65}


def of_case(*options: dict[str, object]) -> Lubricant:
    return Lubricant.from_settings(Case(Case.from_text(""), *options).resolve())


@pytest.fixture
def table(tmp_path: Path) -> Path:
    path = tmp_path / "oil.csv"
    path.write_text(TABLE)
    return path


@pytest.mark.parametrize("temperature", [20.0, 40.0, 60.0])
def test_fva3_is_that_of_its_source(temperature: float):
    """Table A1 of Wingertszahn et al. 2023 in their eqs. 7 and 8, in bar and mPa s."""
    oil = Lubricant.from_name("fva3", temperature)
    assert oil.viscosity == pytest.approx(
        1e-3 * 0.062 * math.exp(1021.7 / (temperature + 101.5517)), rel=1e-12
    )
    a, b = 327.7918 + 2.9862 * temperature, 4.419e-3 + 3.0115e-4 * temperature
    for bar in (500.0, 4000.0, 16000.0):
        assert float(oil.log_viscosity_ratio(1e5 * bar)) == pytest.approx(
            bar / (a + b * bar), rel=1e-12
        )
    assert oil.pressure_viscosity == pytest.approx(1e-5 / a, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "a1", "a2", "b1", "b2", "at_40", "at_100"),
    [
        ("n100", -7.23e7, 3.48e5, 5.00e-3, -1.83e-5, 97.9, 8.61),
        ("pao100", -5.73e7, 3.90e5, -39.50e-3, 23.54e-5, 94.1, 14.0),
    ],
)
def test_oils_of_mann(
    name: str, a1: float, a2: float, b1: float, b2: float, at_40: float, at_100: float
):
    """Tables 2 and 3 of Arana et al. 2019, with theta in K; density by the data sheet."""
    density = {c.key: c.value for c in known_oils()[name].constants}["density_15"]
    for temperature, kinematic in ((40.0, at_40), (100.0, at_100)):
        oil = Lubricant.from_name(name, temperature)
        rho = density * (1.0 - 6.5e-4 * (temperature - 15.0))
        assert oil.viscosity == pytest.approx(1e-6 * kinematic * rho, rel=1e-9)
        kelvin, p = temperature + 273.15, 3e8
        exponent = p / (a1 + a2 * kelvin + (b1 + b2 * kelvin) * p)
        assert float(oil.log_viscosity_ratio(p)) == pytest.approx(exponent, rel=1e-9)


def test_mineral_oils_of_one_grade_agree():
    """FVA 3, and its equivalent M100 of Arana et al., Table 2: 96 mm^2/s, 882 kg/m^3."""
    oil = Lubricant.from_name("fva3", 40.0)
    rho = 882.0 * (1.0 - 6.5e-4 * 25.0)
    assert oil.viscosity == pytest.approx(96e-6 * rho, rel=0.03)


def test_every_oil_has_sources_and_runs():
    for name, oil in pyehl.lubricants().items():
        assert oil.title
        assert oil.source
        assert oil.range
        assert all(c.place for c in oil.constants)
        data = pyehl.solve(Case.from_text(""), {"lubricant.name": name, **LIGHT})
        assert name in data.attrs["lubricant_note"]
        assert data.attrs["status"] == "converged"


def test_films_by_two_laws_with_one_alpha(root: Path):
    """FVA 3 by its own law and by Roelands', as the theory page states."""
    own = Case.from_text("", {"lubricant.name": "fva3", "lubricant.temperature": 40.0})
    known = own.resolve()["lubricant"]
    names = ("viscosity", "pressure_viscosity", "density_law")
    same = {f"lubricant.{name}": known[name] for name in names}
    keys = {"surface.kind": "smooth", "grid.points": 257}
    films = [float(pyehl.solve(case, keys).H_c) for case in (own, Case.from_text("", {**same}))]
    text = (root / "docs/theory/lubricants.md").read_text(encoding="utf-8")
    assert f"{100.0 * (films[0] / films[1] - 1.0):.1f} % thicker with its own law" in text


SHEET = "&lubricant kinematic_viscosity_40 = 46 kinematic_viscosity_100 = 6.8 {} /"
MINERAL_Z = 0.6


def exponent(oil: Lubricant) -> float:
    """Roelands exponent with the alpha of an oil at ambient pressure."""
    return oil.pressure_viscosity * 1.96e8 / (math.log(oil.viscosity) + 9.67)


def test_band_of_a_coefficient_that_was_not_given(root: Path):
    """The exponents of the oils by name are those in the note and the how-to."""
    cold, hot = (
        {name: exponent(Lubricant.from_name(name, t)) for name in pyehl.lubricants()}
        for t in (40.0, 100.0)
    )
    text = (root / "docs/howto/lubricants.md").read_text(encoding="utf-8")
    assert (
        f"Z is {cold['fva3']:.2f} (mineral), {cold['n100']:.2f} (naphthenic) and "
        f"{cold['pao100']:.2f} (polyalphaolefin) at 40 °C"
    ) in text
    assert all(hot[name] == pytest.approx(cold[name], rel=0.04) for name in cold)
    data = pyehl.solve(Case.from_text(SHEET.format("")), LIGHT)
    note = str(data.attrs["pressure_viscosity_note"])
    thinnest, thickest = (
        100.0 * ((pick(cold.values()) / MINERAL_Z) ** 0.53 - 1.0) for pick in (min, max)
    )
    band = f"Z = {min(cold.values()):.2f} to {max(cold.values()):.2f}"
    assert f"for {band} the film is {-thinnest:.0f} % thinner to {thickest:.0f} % thicker" in note
    assert (
        f"alpha is an estimate ({thinnest:.0f} to {thickest:+.0f} % of the film)"
        in data.attrs["assessment"]
    )


@pytest.mark.parametrize("temperature", [40.0, 80.0])
def test_coefficient_of_a_data_sheet_is_that_of_roelands(temperature: float):
    case = Case.from_text(SHEET.format(f"temperature = {temperature}"))
    lubricant = case.resolve()["lubricant"]
    alpha = MINERAL_Z * (math.log(lubricant["viscosity"]) + 9.67) / 1.96e8
    assert lubricant["pressure_viscosity"] == pytest.approx(alpha, rel=1e-12)
    assert lubricant["roelands_z"] == pytest.approx(MINERAL_Z, rel=1e-12)
    # a written case derives it again
    again = Case.from_text(case.text, ["lubricant.roelands_z=0.7"]).resolve()
    assert again["lubricant"]["pressure_viscosity"] == pytest.approx(alpha * 0.7 / 0.6, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "words", "judged"),
    [
        (SHEET.format(""), "is an estimate", "alpha is an estimate"),
        (SHEET.format("roelands_z = 0.65"), "", ""),
        (SHEET.format("pressure_viscosity = 1.8e-8"), "", ""),
        ("&lubricant viscosity = 0.05 /", "is the default", "alpha is that of another oil"),
        ("&lubricant viscosity = 0.05 pressure_viscosity = 1.8e-8 /", "", ""),
        ("&lubricant name = 'fva3' /", "", ""),
        ("", "", ""),
    ],
)
def test_a_coefficient_that_was_not_given_is_named(
    text: str, words: str, judged: str, tmp_path: Path
):
    (tmp_path / "case.nml").write_text(text)
    data = pyehl.solve(tmp_path / "case.nml", LIGHT)
    note = str(data.attrs.get("pressure_viscosity_note", ""))
    assert (words in note) if words else not note
    assessment = data.attrs["assessment"]
    assert (judged in assessment) if words else ("alpha" not in assessment)


def test_slopes_at_the_inlet_follow_from_the_law(table: Path):
    """Alpha and beta are the slopes of ln eta; with zero rise the viscosity is unchanged."""
    for oil in (
        Lubricant.from_name("fva3", 60.0),
        of_case(T9, {"lubricant.temperature": 60.0}),
        of_case({"lubricant.table": str(table), "lubricant.temperature": 60.0}),
    ):
        by_p = float(oil.log_viscosity_ratio(1e3) - oil.log_viscosity_ratio(0.0)) / 1e3
        by_t = float(oil.log_viscosity_ratio(0.0, 0.01) - oil.log_viscosity_ratio(0.0, -0.01))
        assert by_p == pytest.approx(oil.pressure_viscosity, rel=1e-3)
        assert by_t / 0.02 == pytest.approx(-oil.temperature_viscosity, rel=1e-6)
        assert float(oil.density_ratio(0.0)) == 1.0
        assert float(oil.density_ratio(0.0, 50.0)) < 1.0 < float(oil.density_ratio(5e8, 50.0))


def test_viscosity_at_another_inlet_temperature():
    """The temperature rise between two inlets gives the viscosity of the other one."""
    cold, warm = Lubricant.from_name("fva3", 40.0), Lubricant.from_name("fva3", 75.0)
    p = np.array([0.0, 3e8, 1e9])
    there = cold.viscosity * cold.viscosity_ratio(p, 35.0)
    assert there == pytest.approx(warm.viscosity * warm.viscosity_ratio(p), rel=1e-12)
    rho = 1.0 - cold.thermal_expansion * np.array([25.0, 60.0])
    assert float(cold.density_ratio(0.0, 35.0)) == pytest.approx(rho[1] / rho[0], rel=1e-12)


def test_alpha_star_and_alpha_film(root: Path):
    """Barus: all are equal; for a law with decreasing slope: less than at ambient pressure."""
    barus = Lubricant(viscosity_law="barus", pressure_viscosity=2e-8)
    assert reciprocal_isoviscous(barus) == pytest.approx(2e-8, rel=1e-4)
    assert film_forming(barus) == pytest.approx(2e-8, rel=1e-4)
    oil = Lubricant.from_name("fva3", 40.0)
    assert reciprocal_isoviscous(oil) < film_forming(oil) < oil.pressure_viscosity
    three = (reciprocal_isoviscous(oil), film_forming(oil), oil.pressure_viscosity)
    stated = "{:.1f}, {:.1f} and {:.1f} /GPa for FVA 3".format(*(1e9 * alpha for alpha in three))
    assert stated in (root / "docs/theory/lubricants.md").read_text(encoding="utf-8")
    # van Leeuwen 2009, as Arana et al. print it (eq. 35): for Roelands, approximately
    roelands = Lubricant()
    alpha, z, p0 = roelands.pressure_viscosity, roelands.roelands_z, roelands.roelands_p0
    assert reciprocal_isoviscous(roelands) == pytest.approx(
        alpha / (1.0 + (1.0 - z) / (alpha * p0)), rel=0.005
    )


def test_a_table_gives_its_values_and_its_range(table: Path):
    options = {"lubricant.table": str(table), "lubricant.temperature": 40.0}
    oil = of_case(options)
    assert oil.viscosity == pytest.approx(0.08)
    assert np.exp(oil.log_viscosity_ratio([2e8, 5e8])) * 0.08 == pytest.approx([6.0, 1100.0])
    warm = oil.viscosity * oil.viscosity_ratio([0.0, 2e8, 5e8], 40.0)
    assert warm == pytest.approx([0.017, 0.5, 35.0])
    data = pyehl.solve(Case.from_text(""), options, LIGHT)
    assert "the pressure is above it" in data.attrs["lubricant_note"]
    inside = {"contact.load": 1.0, "contact.mean_velocity": 0.01, "grid.points": 65}
    data = pyehl.solve(Case.from_text(""), options, inside)
    assert "the pressure is above it" not in data.attrs["lubricant_note"]
    assert "outside this range" not in data.attrs["lubricant_note"]
    assert "up to 5.000E+08 Pa" in data.attrs["lubricant_note"]
    hot = {**options, "lubricant.temperature": 100.0}
    assert "the temperature is outside this range" in str(pyehl.check(Case.from_text(""), hot))


def test_a_prediction_says_that_the_oil_was_not_measured_there():
    options = {"lubricant.name": "pao100", "surface.kind": "fractal", "surface.pixels": 32}
    note = pyehl.predict(Case.from_text(""), options, tracks=1).summary["note"]
    assert "the lubricant was measured up to 5.1e+08 Pa" in note
    assert "degC" not in note
    hot = pyehl.predict(Case.from_text(""), options, {"lubricant.temperature": 90.0}, tracks=1)
    assert "from 25 to 60 degC" in hot.summary["note"]
    options["lubricant.name"] = "fva3"
    other = pyehl.predict(Case.from_text(""), options, tracks=1)
    assert "measured" not in other.summary["note"]


def test_a_written_case_of_an_oil_reads_back(table: Path):
    single = table.with_name("single.csv")
    single.write_text("".join(x for x in TABLE.splitlines(True) if ",80," not in x))
    single.write_text(single.read_text().replace(",40,", ",50,"))
    for options in (
        {"lubricant.name": "pao100"},
        {"lubricant.table": str(table)},
        T9,
        {**T9, "lubricant.name": "fva3"},
        {
            "lubricant.table": str(table),
            "lubricant.name": "fva3",
            "lubricant.viscosity_law": "dicke",
        },
        {"lubricant.table": str(single), "lubricant.temperature_viscosity": 0.03},
    ):
        case = Case(Case.from_text("", {"lubricant.temperature": 50.0, **options}))
        assert Case.from_text(case.text).text == case.text
        if single.name in case.text:
            continue
        # another temperature gives another viscosity: derived values are not given
        warm = Case.from_text(case.text, {"lubricant.temperature": 70.0}).resolve()
        assert warm["lubricant"]["viscosity"] < 0.7 * case.resolve()["lubricant"]["viscosity"]


def test_keys_given_with_a_name_take_precedence():
    group = Case.from_text(
        "", {"lubricant.name": "fva3", "lubricant.thermal_conductivity": 0.15}
    ).resolve()["lubricant"]
    assert group["thermal_conductivity"] == 0.15
    assert group["viscosity_law"] == "dicke"
    group = Case.from_text(
        "", {"lubricant.name": "fva3", "lubricant.viscosity_law": "roelands"}
    ).resolve()["lubricant"]
    assert (group["viscosity_law"], group["pressure_viscosity"]) == (
        "roelands",
        pytest.approx(2.2359e-8, rel=1e-4),
    )
    constants = {f"lubricant.vogel_{k}": v for k, v in (("viscosity", 1e-4), ("b", 900), ("c", 95))}
    given = of_case({"lubricant.name": "n100", **constants})
    assert given.viscosity == pytest.approx(1e-4 * math.exp(900 / 135), rel=1e-12)
    with pytest.raises(InputError, match=r"viscosity contradicts lubricant\.name"):
        of_case({"lubricant.name": "n100", "lubricant.viscosity": 0.1})


def test_a_table_begins_at_ambient_pressure(table: Path):
    table.write_text("".join(x for x in TABLE.splitlines(True) if not x.startswith("0,40")))
    with pytest.raises(InputError, match=r"oil\.csv:2:1: error: the lowest pressure at 40"):
        of_case({"lubricant.table": str(table)})


def test_a_range_of_pressures_without_one_of_temperatures():
    """For the temperatures no range is known, and none is stated."""
    note = str(pyehl.check(Case.from_text(""), T9, {"lubricant.range_pressure_max": 1e9}))
    assert "measured up to 1.000E+09 Pa" in note
    assert "degC and up" not in note
    assert "the temperature is outside this range" not in note


@pytest.mark.parametrize(("speed", "srr"), [(2.0, 2.0), (5.0, 1.0), (40.0, 0.3)])
def test_heat_is_included_where_its_estimate_is_implausible(speed: float, srr: float):
    """The flash temperature by the isothermal stress is above 1500 degC, that with heat is not."""
    contact = {"load": 600.0, "mean_velocity": speed, "radius": 0.018, "slide_to_roll": srr}
    done = pyehl.solve(
        Case(
            contact=contact,
            lubricant={"name": "n100", "shear_law": "eyring", "flow": "newtonian"},
            grid={"points": 65},
        )
    )
    assert float(done.mu) < 0.5 * float(done.mu_isothermal)
    assert 100.0 < float(done.temperature_rise_max_K) < 700.0
    assert "hotter than the temperatures at which the viscosity" in done.attrs["mu_note"]


def test_film_of_an_oil_is_near_that_of_roelands_with_its_alpha():
    """M and L use alpha at ambient pressure, for every law: films differ by some per cent."""
    films = [
        pyehl.solve(
            Case.from_text(""),
            {"lubricant.name": "fva3", "lubricant.viscosity_law": law, "grid.points": 129},
        )
        for law in ("dicke", "roelands")
    ]
    assert float(films[0].moes_l) == float(films[1].moes_l)
    assert float(films[0].H_c) == pytest.approx(float(films[1].H_c), rel=0.04)


def test_a_pole_of_the_law_is_refused():
    """Dicke with b1 < 0 has a pole at p = a/|b1|: here below the pressures of the contact."""
    steep = {
        "lubricant.viscosity_law": "dicke",
        "lubricant.kinematic_viscosity_40": 68.0,
        "lubricant.kinematic_viscosity_100": 8.7,
        "lubricant.dicke_a1": 5e7,
        "lubricant.dicke_b1": -0.05,
    }
    with pytest.raises(InputError, match="no viscosity that increases with pressure"):
        Case.from_text("", steep)
    assert Case.from_text("", {**steep, "contact.load": 1.0}).resolve()


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    assert cli.main(["lubricants", "fva3", "-o", str(tmp_path / "oils")]) == 0
    printed = capsys.readouterr().out
    assert "Wingertszahn" in printed
    assert "alpha = 22.36/GPa" in printed
    assert [path.name for path in (tmp_path / "oils").iterdir()] == ["fva3.png"]
    # a picture of the command is replaced, another file is not
    assert cli.main(["lubricants", "fva3", "-o", str(tmp_path / "oils")]) == 0
    (tmp_path / "oils" / "n100.png").write_bytes(b"mine")
    assert cli.main(["lubricants", "-o", str(tmp_path / "oils")]) == 2
    assert (tmp_path / "oils" / "n100.png").read_bytes() == b"mine"
    assert not (tmp_path / "oils" / "pao100.png").exists()
    capsys.readouterr()
    assert cli.main(["lubricants", "fva4"]) == 2
    assert "did you mean 'fva3'" in capsys.readouterr().err
