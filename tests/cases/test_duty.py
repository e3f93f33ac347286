# SPDX-License-Identifier: BSD-3-Clause
"""Contacts under a duty: steady limits, slow duties, steps in time, an independent solver."""

import subprocess
from pathlib import Path

import line_newton
import numpy as np
import pytest
from PIL import Image

import pyehl
from pyehl import cli

LOAD, SPEED, RADIUS, MODULUS = 1.8285e5, 0.4622, 0.01, 2.26e11
LINE = {
    "contact": {
        "shape": "line", "load_per_length": LOAD, "mean_velocity": SPEED, "radius": RADIUS,
        "reduced_modulus": MODULUS, "slide_to_roll": 0.0,
    },
    "lubricant": {"viscosity": 0.04, "pressure_viscosity": 2.2e-8, "roelands_z": 0.6684},
    "grid": {"points": 177, "x_inlet": -4.0, "x_outlet": 1.5},
}  # fmt: skip
WIDTH = np.sqrt(8.0 * LOAD * RADIUS / (np.pi * MODULUS))
UNIT = WIDTH / SPEED
NUMBER = 2.0 * 0.04 * SPEED / (MODULUS * RADIUS)
M, L = LOAD / (MODULUS * RADIUS) / np.sqrt(NUMBER), 2.2e-8 * MODULUS * NUMBER**0.25


def run(time, grid=None, **duty):
    """History of a line contact over times in b/u; loads and speeds over those of the case."""
    scales = {"load": LOAD, "mean_velocity": SPEED, "radius_x": RADIUS, "viscosity": 0.04}
    values = {k: np.asarray(v) * scales[k] if k in scales else v for k, v in duty.items()}
    groups = LINE | {"grid": LINE["grid"] | (grid or {})}
    case = pyehl.Case(**groups, duty={"time": np.asarray(time) * UNIT, **values})
    return pyehl.solve(case)


def columns(data):
    return {name: data[f"history_{name}"].values for name in ("T", "H_c", "H_min", "speed", "load")}


def test_a_constant_duty_is_the_steady_contact_in_bits():
    """Nothing moves, and no time step is solved."""
    data = run([0.0, 1.0, 2.0], mean_velocity=[1.0, 1.0, 1.0])
    steady = pyehl.solve(pyehl.Case(**LINE), {"grid.border": "zero"})
    np.testing.assert_array_equal(data.P, steady.P)
    np.testing.assert_array_equal(data.H, steady.H)
    h = columns(data)
    np.testing.assert_array_equal(h["H_c"], float(steady.H_c))
    np.testing.assert_array_equal(h["H_min"], float(steady.H_min))
    assert h["T"][-1] == pytest.approx(2.0, rel=1e-12)
    assert data.history_cycles.values.max() == 0
    assert float(data.duty_p_max_Pa) == float(steady.p_max_Pa)
    case = pyehl.Case(**LINE, duty={"time": [0.0, UNIT], "load": [LOAD] * 2})
    with pyehl.Solver(case) as solver:
        assert "nothing changes" in solver.describe()


@pytest.mark.parametrize("radius_y", [0.005, 0.01, 0.03])
@pytest.mark.parametrize("inlet", [{}, {"position": 2.4e-4}, {"film": 1.4e-7}])
def test_a_constant_duty_of_points_is_the_steady_contact_in_bits(radius_y, inlet):
    contact = {"load": 60.0, "mean_velocity": 1.0, "radius_x": 0.01, "radius_y": radius_y}
    case = pyehl.Case(contact=contact, inlet=inlet, grid={"points": 65})
    steady = pyehl.solve(case, {"grid.border": "zero"})
    data = pyehl.solve(case, {"duty": {"time": [0.0, 1e-4], "load": [60.0, 60.0]}})
    np.testing.assert_array_equal(data.P, steady.P)
    np.testing.assert_array_equal(data.H, steady.H)


def test_roughness_moves_under_a_constant_duty():
    """As without a duty, up to the steps of the front and those of the scheme.

    Without a duty, errors of the load may leave noise about the mean friction: both runs use a
    small residual.
    """
    wave = {
        "surface.kind": "harmonic", "surface.amplitude": 0.02,
        "grid.border": "zero", "surface.wavelength": 1.0, "solver.accuracy": 0.01,
    }  # fmt: skip
    step = 5.5 / 176
    data = pyehl.solve(
        pyehl.Case(**LINE, duty={"time": [0.0, 128 * step * UNIT], "load": [LOAD] * 2}), wave
    )
    plain = pyehl.solve(
        pyehl.Case(**LINE),
        wave | {"time.steps": 128, "time.scheme": "paper", "time.start": "front"}
        | {"time.skip_start": False, "time.estimate_error": False},
        check=False,
    )  # fmt: skip
    assert float(data.cycles_per_step) > 0.0
    assert data.history_step.size == 128
    np.testing.assert_allclose(data.history_H_c, plain.history_H_c, rtol=2e-3)
    assert np.ptp(data.history_H_c.values) > 0.02 * float(data.H_c)


@pytest.mark.parametrize("key", ["load", "mean_velocity", "radius_x"])
def test_a_table_that_begins_away_from_the_case(key):
    """When the table begins, the film has changed to that of its first row."""
    data = run([0.0, 0.5], **{key: [0.8, 0.8]})
    name = {"load": "load_per_length", "radius_x": "radius"}.get(key, key)
    steady = pyehl.solve(
        pyehl.Case(**LINE | {"contact": LINE["contact"] | {name: 0.8 * LINE["contact"][name]}}),
        {"grid.border": "zero"},
    )
    h = columns(data)
    assert h["T"][0] < 0.0
    assert data.history_cycles.values.min() > 0
    film = data.history_h_c_m.values[np.argmin(np.abs(h["T"]))]
    assert film == pytest.approx(float(steady.h_c_m), rel=1e-2)


def test_a_constant_beginning_is_the_steady_contact():
    """Up to the row at which the load begins to rise; time steps are solved from there on."""
    duty = {"load": [1.0, 1.0, 1.0, 1.1], "mean_velocity": [1.0] * 4}
    h = run([0.0, 1.0, 2.0, 3.0], **duty)
    assert h.history_T.values[:2] == pytest.approx([1.0, 2.0])
    assert (h.history_cycles.values > 0).tolist() == [False] * 2 + [True] * (h.history_T.size - 2)
    # cubic: the parabola through the last rows has a slope from the second row on
    cubic = run([0.0, 1.0, 2.0, 3.0], interpolation="cubic", **duty)
    assert cubic.history_T.values[0] == pytest.approx(1.0)
    assert cubic.history_cycles.values[1] > 0


def test_a_slow_duty_is_a_sequence_of_steady_contacts():
    """The deviation is proportional to the rate: three rates, speed from 1 to 1.2."""
    steady = pyehl.solve(
        pyehl.Case(
            **LINE | {"contact": LINE["contact"] | {"mean_velocity": 1.1 * SPEED}},
        ),
        {"grid.border": "zero"},
    )
    film = float(steady.h_c_m)
    deviations = []
    for length in (10.0, 20.0, 40.0):
        data = run([0.0, length], mean_velocity=[1.0, 1.2])
        time, h = data.history_T.values, data.history_h_c_m.values
        deviations.append(1.0 - np.interp(length / 2.0, time, h) / film)
    assert all(d > 0.0 for d in deviations)
    assert deviations[0] / deviations[1] == pytest.approx(2.0, rel=0.15)
    assert deviations[1] / deviations[2] == pytest.approx(2.0, rel=0.15)


def test_reference_of_a_periodic_speed():
    """H_c of another one-dimensional solver, 264 intervals on -4 <= X <= 1.5, third period.

    ubar0 (1 + 0.5 sin(2 pi T/8)): maximum 0.1119 at T/8 = 0.355 to 0.36, minimum 0.0535 at 0.96,
    mean 0.0868 [b^2/R]. The film lags behind the speed, largest at 0.25, by about the transit b/u.
    """
    time = np.linspace(0.0, 8.0, 65)
    speed = 1.0 + 0.5 * np.sin(2.0 * np.pi * time / 8.0)
    speed[-1] = speed[0]
    data = run(
        time, {"points": 257}, mean_velocity=speed, interpolation="cubic", periodic=True, periods=3
    )
    h = columns(data)
    last = h["T"] >= 16.0 - 1e-9
    t, film = (h["T"][last] - 16.0) / 8.0, h["H_c"][last]
    assert film.max() == pytest.approx(0.1119, rel=3e-3)
    assert t[film.argmax()] == pytest.approx(0.357, abs=0.005)
    assert film.min() == pytest.approx(0.0535, rel=3e-3)
    assert t[film.argmin()] == pytest.approx(0.96, abs=0.005)
    assert np.trapezoid(film, t) / (t[-1] - t[0]) == pytest.approx(0.0868, rel=3e-3)
    assert float(data.duty_h_c_max_m) == pytest.approx(film.max() * float(data.film_scale_m))
    assert float(data.duty_period_change) < 1e-3


@pytest.mark.parametrize(
    ("ends", "points", "time", "duty"),
    [
        ((-4.0, 1.5), 177, [0.0, 0.5, 1.0, 3.5], {"load": [1.0, 1.0, 1.5, 1.5]}),
        ((-4.0, 4.0), 257, [0.0, 0.5, 1.5, 4.0], {"mean_velocity": [1.0, 1.0, -1.0, -1.0]}),
    ],
    ids=["load", "reversal"],
)
def test_against_newton(ends, points, time, duty):
    """A load change and a reversal against Newton's method in each step, within 0.5 %."""
    grid = {"points": points, "x_inlet": ends[0], "x_outlet": ends[1]}
    h = columns(run(time, grid, **duty))
    line = line_newton.Line(M, L, points - 1, ends, 0.6684)
    states = [
        {"speed": u, "load": w} for u, w in zip([1.0, *h["speed"]], [1.0, *h["load"]], strict=True)
    ]
    films = line_newton.march(line, 0.0856, np.array([0.0, *h["T"]]), states)[1:]
    assert np.abs(h["H_c"] / films[:, 0] - 1.0).max() < 5e-3
    assert np.abs(h["H_min"] / films[:, 1] - 1.0).max() < 5e-3


def wave(period, amplitude):
    """One period of a sine about 1 at 33 times."""
    time = np.linspace(0.0, period, 33)
    values = 1.0 + amplitude * np.sin(2.0 * np.pi * time / period)
    values[-1] = values[0]
    return time, values


def test_ehl_makes_the_same_bits(tmp_path: Path, ehl: Path):
    case = pyehl.Case(
        **LINE, duty={"time": [0.0, UNIT, 2.0 * UNIT], "load": [LOAD, 0.6 * LOAD, LOAD]}
    )
    pyehl.solve(case, output=tmp_path / "python")
    (tmp_path / "case.nml").write_text(case.text, encoding="utf-8")
    subprocess.run([ehl, tmp_path / "case.nml", "-o", tmp_path / "ehl"], check=True)
    names = "history.csv", "P.npy", "H.npy"
    for name in names:
        assert (tmp_path / "ehl" / name).read_bytes() == (tmp_path / "python" / name).read_bytes()
    assert pyehl.Case(tmp_path / "case.nml") == case


POINT = {
    "contact": {
        "load": 40.0, "mean_velocity": 2.0, "radius": 0.01, "reduced_modulus": MODULUS,
        "slide_to_roll": 0.5,
    },
    "lubricant": {"viscosity": 0.1, "pressure_viscosity": 1.8e-8},
    "grid": {"points": 33, "x_inlet": -2.5, "x_outlet": 2.5, "y_extent": 2.5},
}  # fmt: skip


ROLLER = {
    "contact": {
        "shape": "roller", "length": 4e-3, "radius": 6e-3, "load": 600.0, "mean_velocity": 2.0,
        "profile": "crown", "crown_radius": 1.0, "slide_to_roll": 0.1,
    },
    "lubricant": {"viscosity": 0.04},
    "grid": {"points": 65},
}  # fmt: skip


def test_a_roller_follows_the_line_in_its_middle():
    """Under a speed over time; under a changing load the film differs."""
    steady = pyehl.solve(pyehl.Case(**ROLLER))
    unit = float(steady.hertz_radius_m) / 2.0
    time = np.linspace(0.0, 4.0, 17) * unit
    speed = 2.0 * wave(4.0, 0.3)[1][::2]
    constant = pyehl.solve(pyehl.Case(**ROLLER, duty={"time": time[:2], "load": [600.0] * 2}))
    np.testing.assert_array_equal(constant.H, steady.H)
    data = pyehl.solve(pyehl.Case(**ROLLER, duty={"time": time, "mean_velocity": speed}))
    assert float(data.cycles_per_step) < 15.0
    # with the load per length of the middle
    middle = steady.P.values[:, steady.Y.size // 2]
    share = float(np.trapezoid(middle, steady.X)) / (np.pi / 2.0)
    contact = LINE["contact"] | {
        "load_per_length": share * 600.0 / 4e-3, "mean_velocity": 2.0, "radius": 6e-3,
    }  # fmt: skip
    ends = (("x_inlet", 0), ("x_outlet", -1))
    grid = {key: float(data.X[n]) / np.sqrt(share) for key, n in ends}
    line = pyehl.Case(contact=contact, lubricant=ROLLER["lubricant"], grid={"points": 65, **grid})
    other = pyehl.solve(line, {"duty": {"time": time, "mean_velocity": speed}})
    films = [d.history_H_c.values / float(d.H_c) for d in (data, other)]
    assert np.ptp(films[0]) > 0.3
    same = np.interp(data.history_t_s, other.history_t_s, films[1])
    np.testing.assert_allclose(films[0], same, rtol=3e-3)
    lighter = pyehl.Case(**ROLLER, duty={"time": [0.0, 4.0 * unit], "load": [600.0, 400.0]})
    assert float(pyehl.solve(lighter).history_h_c_m[-1]) > 1.01 * float(steady.h_c_m)
    with pytest.raises(pyehl.InputError, match=r"duty\.radius_y of a roller"):
        pyehl.Case(**ROLLER, duty={"time": time[:2], "radius_y": [0.1, 0.2]})


def test_a_reversed_motion_is_the_mirror_image():
    """A duty and its negative give mirror images of the films, to the tolerance of the steps."""
    time = np.array([0.0, 1e-4, 2e-4, 4e-4])
    forth = [2.0, 1.0, 1.0, 1.0]
    case = pyehl.Case(**POINT)
    there = pyehl.solve(case, duty(time, mean_velocity=forth))
    back = pyehl.solve(case, duty(time - 1e-3, mean_velocity=[-2.0, -1.0, -1.0, -1.0]))
    np.testing.assert_allclose(there.H.values, back.H.values[::-1], rtol=5e-3)


def duty(time, **values):
    return {"duty": {"time": np.asarray(time) - time[0], **values}}


@pytest.mark.parametrize(
    "more",
    [
        {},
        {"lubricant.shear_law": "eyring"},
        {"lubricant.boundary_film": 2e-8, "lubricant.boundary_friction": 0.1},
        {"surface.kind": "harmonic", "surface.amplitude": 0.01},
        {"contact.radius_x": 0.01, "contact.radius_y": 0.02},
    ],
    ids=["newtonian", "eyring", "boundary film", "wave", "ellipse"],
)
def test_a_resumed_run_makes_the_same_bits(tmp_path: Path, more):
    time = np.linspace(0.0, 3e-4, 7)
    options = {
        k: v
        for k, v in POINT["contact"].items()
        if not (k == "radius" and "contact.radius_x" in more)
    }
    if "contact.radius_x" in more:
        options |= {"radius_x": 0.01, "radius_y": 0.02}
    more = {k: v for k, v in more.items() if not k.startswith("contact.radius")}
    case = pyehl.Case(
        contact=options, lubricant=POINT["lubricant"], grid=POINT["grid"],
        duty={
            "time": time, "load": 40.0 - 10.0 * np.sin(2.0 * np.pi * time / 6e-4),
            "u1": 2.5 - 5e3 * time, "u2": 1.5 - 5e3 * time,
        },
    ).with_options(more)  # fmt: skip
    with pyehl.Solver(case) as solver:
        solver.checkpoint(tmp_path / "run")
        while not solver.done:
            solver.advance()
            if solver.summary.get("steps") == 5:
                solver.save_state(at_once=True)
        assert solver.converged
        films = solver.field("H")
    with pyehl.Solver(case) as again:
        again.resume(tmp_path / "run")
        while not again.done:
            again.advance()
        np.testing.assert_array_equal(again.field("H"), films)


def test_roughness_under_a_reversal():
    """The wave returns the way it came: the displacements of both directions cancel."""
    time = np.array([0.0, 1.0, 2.0, 3.0]) * 3e-4
    turn = {"duty": {"time": time, "mean_velocity": [2.0, 2.0, -2.0, -2.0]}}
    rough = {"surface.kind": "harmonic", "surface.amplitude": 0.02, "surface.wavelength": 1.0}
    case = pyehl.Case(**POINT | {"grid": POINT["grid"] | {"points": 65}})
    smooth = pyehl.solve(case, turn)
    data = pyehl.solve(case, turn, rough)
    assert data.attrs["status"] == "converged"
    speed = data.history_speed.values
    assert speed[0] > 0.0 > speed[-1]
    films = [d.history_H_c.values for d in (data, smooth)]
    times = [d.history_T.values for d in (data, smooth)]
    difference = films[0] - np.interp(times[0], times[1], films[1])
    # a wave in the film before and after the reversal
    for way in (speed > 0.5, speed < -0.5):
        assert np.ptp(difference[way]) > 5e-3
    assert (data.history_H_min.values > 0.0).all()


@pytest.mark.parametrize("low", [0.1, 0.01])
def test_a_load_near_zero(low):
    """A film remains, and the force balance holds; squeeze keeps the film above the steady one."""
    time = [0.0, 2.0, 4.0, 6.0]
    data = run(time, load=[1.0, low, low, 1.0])
    h = columns(data)
    assert data.attrs["status"] == "converged"
    assert np.abs(data.history_load_error).max() < 1e-5
    assert h["load"].min() == pytest.approx(low)
    assert (h["H_min"] > 0.0).all()
    assert h["H_c"].max() > 1.2 * h["H_c"][0]


STEADY = {
    "circle": {"load": 40.0, "mean_velocity": 2.0, "radius": 0.01},
    "ellipse": {"load": 60.0, "mean_velocity": 2.0, "radius_x": 0.01, "radius_y": 0.02},
    "line": LINE["contact"],
    # a thick film, which 65 nodes resolve
    "roller": ROLLER["contact"] | {"load": 200.0, "mean_velocity": 4.0},
}


@pytest.mark.parametrize(
    "shape", ["circle", pytest.param("ellipse", marks=pytest.mark.long), "line", "roller"]
)
def test_steady_contacts_of_a_duty(shape):
    """At constant values they equal the contact of the case; under a slow duty its films."""
    contact = {"reduced_modulus": MODULUS, "slide_to_roll": 0.0} | STEADY[shape]
    case = pyehl.Case(contact=contact, lubricant={"viscosity": 0.04}, grid={"points": 65})
    speed, radius = contact["mean_velocity"], contact.get("radius", contact.get("radius_x"))
    unit = float(pyehl.solve(case).hertz_radius_m) / speed
    time = np.linspace(0.0, 30.0, 4)
    duty = {
        "time": time * unit, "mean_velocity": speed * (1.0 + 0.003 * time),
        "radius_x": radius * (1.0 + 0.002 * time), "viscosity": 0.04 * (1.0 - 0.002 * time),
    }  # fmt: skip
    if shape == "roller":
        duty = {key: duty[key] for key in ("time", "mean_velocity")}
    data = pyehl.solve(case, {"duty": duty})
    result = pyehl.quasi_static(data, [0.0, 20.0 * unit])
    assert float(result.steady_h_c_m[0]) == pytest.approx(float(data.h_c_m), rel=2e-3)
    film = float(np.interp(result.steady_t_s[1], data.history_t_s, data.history_h_c_m))
    assert abs(film / float(data.h_c_m) - 1.0) > 0.01
    # the lag of the film: a transit of 1.2 in time
    assert float(result.steady_h_c_m[1]) == pytest.approx(film, rel=6e-3)
    assert (result.steady_h_c_error_m > 0.0).all()
    assert "duty" in pyehl.plot(result)


def test_steady_contacts_of_a_reversal(tmp_path: Path):
    """They are equal for both directions, absent at zero velocity, and drawn by the command."""
    turn = duty(np.linspace(0.0, 2e-4, 5), mean_velocity=[2.0, 1.0, 0.0, -1.0, -2.0])
    data = pyehl.solve(pyehl.Case(**POINT), turn, output=tmp_path / "out")
    films = pyehl.quasi_static(data, [0.0, 5e-5, 1e-4, 1.5e-4, 2e-4]).steady_h_c_m.values
    assert np.isnan(films[2])
    assert films[1] == pytest.approx(films[3], rel=1e-9)
    assert films[0] > 1.3 * films[1]
    assert cli.main(["plot", str(tmp_path / "out"), "--steady", "3"]) == 0
    assert (tmp_path / "out" / "duty.png").is_file()
    for wrong in (0, [-1.0], "three"):
        with pytest.raises(pyehl.InputError, match="instants"):
            pyehl.quasi_static(data, wrong)
    with pytest.raises(pyehl.InputError, match="without a duty"):
        pyehl.quasi_static(pyehl.solve(pyehl.Case(**POINT)))


def test_a_step_without_a_film_proposes_a_finer_grid():
    """Not a smoother surface, as both surfaces are smooth."""
    contact = ROLLER["contact"] | {"load": 600.0, "mean_velocity": 0.5, "crown_radius": 0.3}
    unit = 1e-4
    table = {"time": [0.0, unit, 4.0 * unit], "mean_velocity": [0.5, 0.01, 0.01]}
    case = pyehl.Case(contact=contact, lubricant={"viscosity": 0.04}, grid={"points": 65})
    failed = pyehl.solve(case, {"duty": table}, check=False)
    assert failed.attrs["status"] == "negative film"
    assert "grid.points = 129" in failed.attrs["message"]
    assert "smoother" not in failed.attrs["message"]


@pytest.mark.parametrize("roller", [False, True])
def test_a_movie_of_smooth_surfaces(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, roller: bool
):
    """Film and pressure: there is no roughness to show."""
    monkeypatch.setattr("pyehl.plots.movie.DPI", 30)
    point = {"contact": {"load": 60.0, "mean_velocity": 1.0, "radius": 0.01}}
    groups = ROLLER if roller else point | {"grid": {"points": 33}}
    load = groups["contact"]["load"]
    case = pyehl.Case(
        **groups,
        output={"frame_interval": 0.5},
        duty={"time": [0.0, 1e-4, 3e-4], "load": [load, load, 0.7 * load]},
    )
    pyehl.solve(case, output=tmp_path / "out")
    assert cli.main(["plot", str(tmp_path / "out"), "--movie"]) == 0
    with Image.open(tmp_path / "out/movie.gif") as picture:
        assert picture.n_frames > 1
