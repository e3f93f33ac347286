# SPDX-License-Identifier: BSD-3-Clause
"""Bearings and gears: films and friction of their contacts, case files, pages."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from document_text import fences, is_shown
from machine_options import BALLS, FZG, OIL, ROLLERS, bearing, gear, made

import pyehl
from pyehl import cli
from pyehl.machines.contact import CROSSED
from pyehl.machines.perform import Prepared


def test_mean_friction_of_a_constant_coefficient():
    """With the same mu everywhere the mean is that mu, and the loss mu H_V P."""
    result = gear(FZG, OIL)
    table, s = result.table, result.summary
    sliding = table["load_N"] * (table["slide_to_roll"] * table["mean_velocity_m_per_s"]).abs()
    power = np.trapezoid(0.05 * sliding, table["s_m"]) / s["base_pitch_m"]
    assert power / (s["loss_factor"] * s["input_power_W"]) == pytest.approx(0.05)
    assert table["mu"].min() < s["mu_mean"] < table["mu"].max()
    # H_V of Ohlendorf for equal load sharing: pi (u+1)/(z1 u cos(beta)) (1 - eps + e1^2 + e2^2)
    equal = gear(FZG, OIL, {"spur_gear.load_sharing": "equal"}).summary
    pitch = equal["base_pitch_m"]
    _, pair = made(FZG)
    e_1, e_2 = pair.mesh.ends[1] / pitch, -pair.mesh.ends[0] / pitch
    ohlendorf = math.pi * 2.5 / (16 * 1.5) * (1.0 - equal["contact_ratio"] + e_1**2 + e_2**2)
    assert equal["loss_factor"] == pytest.approx(ohlendorf, rel=1e-3)


def test_friction_of_lines_and_ellipses():
    """Without heat: tau_0 asinh(eta u/(h tau_0)) over the mean pressure, integrated by SciPy."""
    options = {**FZG, **OIL, "lubricant.thermal_friction": "never"}
    for crowning, weight in ((0.0, 0.0), (3e-4, 1.0)):
        result = gear(options, {"spur_gear.crowning_1": crowning})
        row = result.table.iloc[5]
        oil = pyehl.Lubricant.from_name("fva3", 60.0)
        r = (np.arange(20000) + 0.5) / 20000
        pressure = row["hertz_pressure_Pa"] * np.sqrt(1.0 - r**2)
        speed = abs(row["slide_to_roll"]) * row["mean_velocity_m_per_s"]
        newton = oil.viscosity * oil.viscosity_ratio(pressure) * speed / row["h_c_m"]
        stress = 6e6 * np.arcsinh(newton / 6e6)
        ratio = np.average(stress, weights=r**weight) / np.average(pressure, weights=r**weight)
        assert row["mu"] == pytest.approx(ratio, rel=1e-4)
    # heating reduces the friction
    warm = gear(FZG, OIL)
    cold = gear(options)
    assert np.all((warm.table["mu"] < cold.table["mu"]) | warm.table["mu"].isna())


def test_friction_by_formulas_agrees_with_solved_contacts(root: Path):
    """Within 3 %: crowned flanks on 129 nodes, whose films are 7 to 14 % thinner."""
    options = {
        "spur_gear.crowning_1": 2e-4,
        "spur_gear.torque": 40.0,
        "spur_gear.stations": 5,
        "grid.points": 129,
    }
    path = root / "cases" / "fzg_c.nml"
    formula, solved = (
        pyehl.gear(path, options, run=run, jobs=1).table for run in ("film", "solve")
    )
    assert set(solved["status"]) == {"converged"}
    ratio = (formula["mu"] / solved["mu"]).dropna()
    assert len(ratio) == len(formula) - 1
    assert ratio.between(0.97, 1.03).all()
    assert (formula["h_c_m"] / solved["h_c_m"]).between(1.0, 1.15).all()


def test_lines_are_solved(root: Path):
    """The page states 4 % for films and friction, and a mean coefficient of 0.0357."""
    page = (root / "docs" / "howto" / "gear.md").read_text()
    path = root / "cases" / "fzg_c.nml"
    options = {"spur_gear.stations": 9}
    formula, solved = (pyehl.gear(path, options, run=run, jobs=1) for run in ("film", "solve"))
    assert set(solved.table["shape"]) == {"line"}
    assert set(solved.table["status"]) == {"converged"}
    assert (formula.table["h_c_m"] / solved.table["h_c_m"]).between(0.96, 1.01).all()
    assert (formula.table["mu"] / solved.table["mu"]).dropna().between(0.96, 1.04).all()
    fine = pyehl.gear(path, options, {"grid.points": 1025}, run="solve", jobs=1).table
    error = solved.table["h_c_error_m"]
    assert ((fine["h_c_m"] - solved.table["h_c_m"]).abs() <= error).all()
    assert (error < 0.02 * solved.table["h_c_m"]).all()
    assert solved.summary["mu_mean"] == pytest.approx(0.0357, abs=2e-4)
    assert "0.0357" in page


def test_rollers_of_a_bearing_are_solved_and_predicted():
    """Bodies of another material: the line has their reduced modulus."""
    hybrid = {"bodies.modulus_1": 3.1e11, "bodies.poisson_1": 0.26}
    rollers = bearing(ROLLERS, hybrid, run="solve", jobs=1).table
    by_formula = bearing(ROLLERS, hybrid).table
    assert rollers["hertz_pressure_Pa"].to_numpy() == pytest.approx(by_formula["hertz_pressure_Pa"])
    steel = bearing(ROLLERS).table
    assert (by_formula["hertz_pressure_Pa"] > 1.05 * steel["hertz_pressure_Pa"]).all()
    # a prediction includes the roughness on lines, too
    rough = {
        "surface.kind": "fractal",
        "surface.rms_height": 2e-8,
        "surface.pixels": 32,
        "grid.points": 257,
        "psd.positions": 2,
        # the same load per roller, and one loaded roller
        "roller_bearing.rollers": 3,
        "roller_bearing.radial_load": 700.0,
    }
    predicted = bearing(ROLLERS, rough, run="predict", jobs=1).table
    assert set(predicted["status"]) == {"predicted"}
    assert (predicted["h_min_rough_m"] < predicted["h_min_m"]).all()


def test_rolling_resistance_agrees_with_solved_contacts(root: Path):
    """Both formulas against a 6204 with a short and a long inlet, as on the page."""
    page = (root / "docs" / "howto" / "bearing.md").read_text()
    case = root / "cases" / "ball_bearing.nml"
    point = pyehl.OperatingPoint.from_settings(pyehl.Case(case).resolve())
    shape, radius, alpha = point.ellipse, point.radius, point.pressure_viscosity
    moment = 7.5 * shape.ellipticity**2 * shape.kernel_ratio**0.25 / point.moes_m
    load = 0.5 * math.pi * point.hertz_radius * point.hertz_pressure
    flow = alpha * point.viscosity * point.mean_velocity / radius
    line = 4.318 * radius / alpha * flow**0.658
    line *= (load / (point.reduced_modulus * radius)) ** 0.0126
    shares = []
    for inlet in (None, -2.5, -10.0):
        ds = pyehl.solve(case, {} if inlet is None else {"grid.x_inlet": inlet})
        p, h = ds.P.values, ds.H.values
        middle = p.shape[1] // 2
        row = 0.25 * np.sum((h[1:, middle] + h[:-1, middle]) * np.diff(p[:, middle]))
        solved = row * point.hertz_pressure * point.film_scale
        shares.append((float(ds.rolling_moment) / moment, 1.0 - line / solved))
    assert "0.95 times the asymptote on the default domain, and 1.02 times with" in page
    assert [shares[k][0] for k in (0, 2)] == pytest.approx([0.95, 1.02], abs=0.006)
    assert "10 to 29 %" in page
    assert [below for _, below in shares[1:]] == pytest.approx([0.10, 0.29], abs=0.006)


def test_films_of_a_loaded_gear_pair():
    """302 N m, FVA 3 at 60 degC: crowned flanks have 229 to 356 nm and 0.036 to 0.043."""
    result = gear(FZG, OIL, {"spur_gear.torque": 302.0})
    films = result.table["h_c_m"] * 1e9
    assert films.min() > 229.0
    assert films.max() < 1.15 * 356.0
    assert 0.033 < result.summary["mu_mean"] < 0.043


def test_sliding_in_a_groove():
    """Limits: an Eyring stress far below the Newtonian one; spin has the power of its torque."""
    options = {"lubricant.shear_law": "limiting", "lubricant.limiting_stress": 1e5}
    result = bearing(BALLS, options)
    row = result.table.iloc[0]
    # a constant stress k: P = k integral of |du|, du = c (y0^2 - y^2) with the balancing y0
    inner = row["half_width_m"], row["half_width_m"] * row["ellipticity"]
    groove, ball = 0.52 * 9.525e-3, 0.5 * 9.525e-3
    factor = row["mean_velocity_m_per_s"] / row["radius_m"] * 0.25 * (1 / ball + 1 / groove)
    y = (np.arange(400000) + 0.5) / 400000 * inner[1]
    chord = 2.0 * inner[0] * np.sqrt(1.0 - (y / inner[1]) ** 2)
    share = np.cumsum(chord) / chord.sum()
    y_0 = y[np.searchsorted(share, 0.5)]
    power = 1e5 * 2.0 * np.sum(chord * factor * np.abs(y_0**2 - y**2)) * (y[1] - y[0])
    assert row["sliding_power_W"] == pytest.approx(power, rel=5e-3)
    # a Newtonian oil has no absolute friction
    newtonian = bearing(BALLS)
    assert math.isnan(newtonian.summary["torque_N_m"])
    assert newtonian.summary["rolling_torque_N_m"] > 0.0
    pair = gear(FZG)
    for result in (newtonian, pair):
        lines = repr(result).splitlines()
        assert sum("not reported: give a lubricant.shear_law" in line for line in lines) == 3
        assert not any("no result" in line or "nan" in line for line in lines)


def test_rolling_resistance_of_a_line():
    """Per length, whatever the length: 4.318 (alpha eta0 u/R)^0.658 W^0.0126 R/alpha."""
    short, long = (
        bearing(ROLLERS, {f"roller_bearing.{k}": v * f for k, v in
                      (("roller_length", 9e-3), ("radial_load", 3000.0))}).table.iloc[0]
        for f in (1.0, 2.0)
    )  # fmt: skip
    assert long["rolling_power_W"] == pytest.approx(2.0 * short["rolling_power_W"], rel=2e-3)


def test_solved_contacts_and_resuming(tmp_path: Path):
    """Formulas and solutions agree; equal balls are solved once; a second call runs nothing."""
    options = [
        BALLS,
        OIL,
        {"grid.points": 129},
        {"ball_bearing.balls": 5, "ball_bearing.radial_load": 100.0},
    ]
    by_formula = bearing(*options)
    folder = tmp_path / "out"
    solved = bearing(*options, run="solve", output=folder, jobs=1)
    assert set(solved.table["status"]) == {"converged"}
    assert solved.table["h_c_m"].to_numpy() == pytest.approx(by_formula.table["h_c_m"], rel=0.1)
    assert (solved.table["h_c_error_m"] > 0.0).all()
    assert solved.table["load_N"].to_numpy() == pytest.approx(by_formula.table["load_N"])
    names = {path.name for path in folder.iterdir()}
    assert {
        "contacts.csv",
        "summary.json",
        "contacts.png",
        "machine.nml",
        "journal.sqlite",
    } == names
    again = bearing(*options, run="solve", output=folder, jobs=1)
    assert again.table.equals(solved.table)
    with pytest.raises(pyehl.InputError, match="another study"):
        bearing(*options, {"ball_bearing.clearance": 1e-6}, run="solve", output=folder)
    with pytest.raises(pyehl.InputError, match="formulas would replace"):
        bearing(*options, output=folder)
    assert solved.data["h_c_m"].attrs["units"] == "m"


FILES = {
    "bearing_6206": ("bearing", "ball_bearing"),
    "bearing_nu206": ("bearing", "roller_bearing"),
    "fzg_c": ("gear", "spur_gear"),
}


@pytest.mark.parametrize(
    "name",
    ["bearing_6206", pytest.param("bearing_nu206", marks=pytest.mark.long), "fzg_c"],
)
def test_case_files_by_formulas(root: Path, tmp_path: Path, name: str, capfd):
    folder, (command, group) = tmp_path / "out", FILES[name]
    assert cli.main([command, str(root / "cases" / f"{name}.nml"), "-o", str(folder)]) == 0
    reported = capfd.readouterr().out
    for word in ("h_c [nm]", "Lambda", "omitted", str(folder / "contacts.csv")):
        assert word in reported
    assert (folder / "contacts.png").stat().st_size > 10_000
    # the resolved group reads back as the same machine
    text = (folder / "machine.nml").read_text()
    assert text.startswith(f"&{group}\n")
    assert cli.main([command, str(folder / "machine.nml"), "-o", str(tmp_path / "again")]) == 0
    tables = [(place / "contacts.csv").read_text() for place in (folder, tmp_path / "again")]
    assert tables[0] == tables[1]
    assert cli.main(["report", str(folder)]) == 0
    shown = (folder / "report.html").read_text()
    for word in ("minimum Lambda", "omitted", f"&amp;{group}", "data:image/png"):
        assert word in shown
    # the command wrote the page, which is replaced with the result
    assert (
        cli.main([command, str(folder / "machine.nml"), "-o", str(tmp_path / "more"), "--json"])
        == 0
    )
    assert '"kind": ' in capfd.readouterr().out


def test_the_path_of_contact_is_a_duty(root: Path, tmp_path: Path):
    """The table along the path, and a case that runs with it; the load has steps at B and D."""
    folder = tmp_path / "out"
    assert cli.main(["gear", str(root / "cases/fzg_c.nml"), "-q", "-o", str(folder)]) == 0
    table = pd.read_csv(folder / "contacts.csv")
    duty = pd.read_csv(folder / "duty.csv")
    columns = ["time [s]", "load [N/m]", "u1 [m/s]", "u2 [m/s]", "radius_x [m]"]
    assert list(duty.columns) == columns
    mean = 0.5 * (duty["u1 [m/s]"] + duty["u2 [m/s]"])
    np.testing.assert_allclose(
        (duty["u1 [m/s]"] - duty["u2 [m/s]"]) / mean, table["slide_to_roll"], atol=1e-9
    )
    np.testing.assert_allclose(duty["load [N/m]"] * 14e-3, table["load_N"], rtol=1e-9)
    # the contact moves along the line of action with the velocity of the base circle
    path = np.diff(table["s_m"]).sum()
    base = 4.5e-3 * 16 / 2 * math.cos(math.radians(20.0))
    whole = path / (base * 2.0 * math.pi * 1450.0 / 60.0)
    assert duty["time [s]"].iloc[-1] == pytest.approx(whole, rel=1e-6)
    case = pyehl.Case(folder / "duty.nml")
    np.testing.assert_allclose(case["duty"]["load"], duty["load [N/m]"], rtol=1e-12)
    data = pyehl.solve(case, {"grid.points": 257})
    assert float(data.duty_end_s) == pytest.approx(whole, rel=1e-6)
    # the minimum film is close to that of the stations by formulas
    assert 0.6 < float(data.duty_h_c_min_m) / table["h_c_m"].min() < 1.2


@pytest.mark.parametrize("page", ["bearing", "gear"])
def test_pages_show_what_is_printed(root: Path, page: str, monkeypatch, capfd):
    monkeypatch.chdir(root)
    path = root / "docs" / "howto" / f"{page}.md"
    blocks = [text for language, text in fences(path) if language == "console"]
    for block in blocks:
        command, *shown = block.removeprefix("$ pyehl ").splitlines()
        assert cli.main(command.split()) == 0
        printed = capfd.readouterr().out.splitlines()
        missing = [s for s in shown if s != "..." and not any(is_shown(s, p) for p in printed)]
        assert not missing
    assert len(blocks) == 1


@pytest.mark.parametrize("name", FILES)
def test_interrupted_before_any_contact(root: Path, name: str):
    """No film and no friction that needs it, and nothing in their place."""
    path = root / "cases" / f"{name}.nml"
    result = Prepared(path, [], (FILES[name][1],), "solve").result({})
    assert not result.complete
    assert set(result.table["status"]) == {"not run"}
    assert result.table[["h_c_m", "h_min_m"]].isna().all(axis=None)
    assert math.isnan(result.summary["h_min_m"])
    assert "minimum film                  not reported: a contact has no result" in repr(result)


def test_crown_of_a_nanometre_is_a_line():
    tables = [gear(FZG, OIL, {"spur_gear.crowning_1": crown}).table for crown in (0.0, 1e-9)]
    assert tables[0].equals(tables[1])


def test_contradicting_film_formulas_are_noted():
    """A minimum film above the central one, far outside the ranges of both formulas, is noted."""
    options = {"lubricant.viscosity": 0.004, "ball_bearing.inner_speed": 100.0}
    for load, crossed in ((3000.0, True), (10.0, False)):
        table = bearing(BALLS, options, {"ball_bearing.radial_load": load}).table
        above = table["h_min_m"] > table["h_c_m"]
        assert above.any() == crossed
        assert (table["note"].str.contains(CROSSED) == above).all()


def test_pressure_above_the_static_limit_is_noted():
    for load, yields in ((3000.0, False), (30000.0, True)):
        result = bearing(BALLS, {"ball_bearing.radial_load": load})
        assert (result.summary["hertz_pressure_max_Pa"] > 4.2e9) == yields
        assert ("steel      yields" in repr(result)) == yields


@pytest.mark.long
def test_plot_draws_the_folder_of_a_machine(root: Path, tmp_path: Path):
    """The path of contact and the ring, drawn again; the command may then replace its picture."""
    for kind, name in (("gear", "fzg_c"), ("bearing", "bearing_6206")):
        words = [kind, str(root / "cases" / f"{name}.nml"), "-o", str(tmp_path / kind), "-q"]
        assert cli.main(words) == 0
        drawn = pyehl.plot(tmp_path / kind)
        assert list(drawn) == ["contacts"]
        assert len(drawn["contacts"].axes) == (4 if kind == "gear" else 2)
        assert cli.main(["plot", str(tmp_path / kind)]) == 0
        assert cli.main(words) == 0
        assert cli.main(["plot", str(tmp_path / kind), "-o", str(tmp_path), "--format", "pdf"]) == 0
    assert (tmp_path / "contacts.pdf").stat().st_size > 1000
