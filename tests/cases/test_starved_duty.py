# SPDX-License-Identifier: BSD-3-Clause
"""A layer of oil that arrives at a contact under a duty: inflow leaves the contact or stays."""

import subprocess
from pathlib import Path

import numpy as np
import pytest
import starved_newton
from test_duty import LINE, LOAD, RADIUS, SPEED, UNIT, WIDTH, L, M
from test_duty_steps import BOTH_SIDES

import pyehl

LAYER = 1.18e-7
"""For the line: h_c is 0.57 of the flooded one [m]."""
SCALE = WIDTH**2 / RADIUS
RATIOS = {"load": LOAD, "mean_velocity": SPEED, "radius_x": RADIUS}
POINT = {
    "contact": {"load": 60.0, "mean_velocity": 1.0, "radius": 0.01, "reduced_modulus": 2.2e11},
    "lubricant": {"viscosity": 0.05, "pressure_viscosity": 2e-8},
    "inlet": {"film": 1.4e-7},
    "grid": {"points": 65},
}


def line(time=None, grid=None, film=LAYER, **duty):
    """A line with a layer, over times in b/u; values over those of the case."""
    ratios = RATIOS | {"inlet_film": film}
    values = {k: np.asarray(v) * ratios[k] if k in ratios else v for k, v in duty.items()}
    table = {"duty": {"time": np.asarray(time) * UNIT, **values}} if duty else {}
    groups = LINE | {"grid": LINE["grid"] | (grid or {})}
    return pyehl.Case(**groups, inlet={"film": film}, **table)


def point(time, **duty):
    """A ball with a layer, times in a/u."""
    case = pyehl.Case(**POINT)
    unit = float(pyehl.solve(case).hertz_radius_m)
    ratios = {"load": 60.0, "mean_velocity": 1.0, "inlet_film": 1.4e-7}
    values = {k: np.asarray(v) * ratios[k] for k, v in duty.items()}
    return pyehl.solve(case, {"duty": {"time": np.asarray(time) * unit, **values}})


def history(data, *names):
    return [data[f"history_{name}"].values for name in names]


def wave(length, amplitude=0.4):
    time = np.linspace(0.0, length, 33)
    values = 1.0 + amplitude * np.sin(2.0 * np.pi * time / length)
    values[-1] = values[0]
    return time, values


def sums(data):
    """Times from the first step on; inflow, outflow, side flow, gain [a^4/R, a line: a^3/R].

    BDF2 with the steps of the run integrates the flows, so that only losses of the steps remain.
    """
    time, enters, leaves, sides, content, gain, begun = history(
        data, "T", "oil_in", "oil_out", "oil_at_sides", "oil_content", "oil_gain", "cycles"
    )
    first = int((begun > 0).argmax())
    steps = np.diff([time[first - 1] if first else 0.0, *time[first:]])
    flows = np.array([enters, leaves, sides])[:, first:]
    passed = np.zeros((len(steps) + 2, 3))
    ratio = 1.0
    for k, step in enumerate(steps):
        if k:
            ratio = step / steps[k - 1]
        past = (1.0 + ratio) * passed[k + 1] - ratio**2 / (1.0 + ratio) * passed[k]
        passed[k + 2] = (step * flows[:, k] + past) * (1.0 + ratio) / (1.0 + 2.0 * ratio)
    # the steady contact in the discretisation of the steps, which is not in the history
    before = content[first] - gain[first] * steps[0] / 1.5
    return np.column_stack([time[first:], passed[2:], content[first:] - before])


def lost(data):
    """Inflow less outflow and gain, over all inflow."""
    _, enters, leaves, sides, gained = sums(data).T
    return (enters - leaves - sides - gained) / enters[-1]


def balance(data):
    """The same at the end of the duty by the trapezoidal rule, independent of the scheme."""
    time, enters, leaves, sides, content = history(
        data, "T", "oil_in", "oil_out", "oil_at_sides", "oil_content"
    )
    # after the first step: before it the content is that of the steady contact
    moves = slice(int((data.history_cycles.values > 0).argmax()), None)
    net = np.trapezoid((enters - leaves - sides)[moves], time[moves])
    return (net - np.diff(content[moves][[0, -1]])[0]) / np.trapezoid(enters[moves], time[moves])


DUTIES = {
    "speed": (wave(8.0)[0], {"mean_velocity": wave(8.0)[1], "interpolation": "cubic"}),
    "load step": ([0.0, 0.5, 1.0, 4.0], {"load": [1.0, 1.0, 1.5, 1.5]}),
    "layer falls": ([0.0, 0.5, 1.0, 7.0], {"inlet_film": [1.0, 1.0, 0.5, 0.5]}),
    "layer floods": ([0.0, 0.5, 1.0, 6.0], {"inlet_film": [1.0, 1.0, 4.0, 4.0]}),
    "radius": ([0.0, 0.5, 1.0, 4.0], {"radius_x": [1.0, 1.0, 1.3, 1.3]}),
    "stop": ([0.0, 0.5, 1.5, 3.0, 4.0, 7.0], {"mean_velocity": [1.0, 1.0, 0.0, 0.0, 1.0, 1.0]}),
    "reversal": ([0.0, 0.5, 1.5, 8.0], {"mean_velocity": [1.0, 1.0, -1.0, -1.0]}),
}


@pytest.mark.parametrize("film", [0.5 * LAYER, LAYER, 1.9e-7])
@pytest.mark.parametrize("name", DUTIES)
def test_no_oil_is_lost_on_a_line(name, film):
    """In each step and over the duty to 1e-6 of the flow."""
    time, duty = DUTIES[name]
    case = line(time, BOTH_SIDES if name == "reversal" else None, film, **duty)
    data = pyehl.solve(case)
    assert np.abs(data.history_oil_imbalance).max() <= 1e-6
    assert np.abs(lost(data)).max() <= 1e-6
    # and to the error of the steps in time
    assert abs(balance(data)) < 5e-4
    layer = data.history_oil_layer.values * SCALE
    ends = duty.get("inlet_film", [1.0, 1.0])
    assert layer[0] == pytest.approx(film, rel=1e-9)
    if name in ("layer falls", "layer floods"):
        assert layer[-1] == pytest.approx(ends[-1] * film, rel=1e-6)


def test_the_balance_by_trapezia_is_of_second_order():
    """Half the step gives less than a third of the difference."""
    time, values = wave(8.0)
    errors = [
        abs(balance(pyehl.solve(line(time, mean_velocity=values, interpolation="cubic",
                                     time_step=share))))
        for share in (1.0, 0.5, 0.25)
    ]  # fmt: skip
    assert errors[1] < 0.34 * errors[0]
    assert errors[2] < 0.34 * errors[1]


@pytest.mark.parametrize(
    "duty",
    [
        {"load": [1.0, 1.0, 1.5, 1.5]},
        {"inlet_film": [1.0, 1.0, 0.5, 0.5]},
        {"mean_velocity": [1.0, 1.0, 1.4, 1.4]},
    ],
    ids=["load", "layer", "speed"],
)
def test_against_newton(duty):
    """Films within 0.4 % of an independent solver with the same steps; 0.31 % at most here."""
    data = pyehl.solve(line([0.0, 0.5, 1.0, 6.5], **duty))
    time, h_c, h_min, speed, load, layer = history(
        data, "T", "H_c", "H_min", "speed", "load", "oil_layer"
    )
    other = starved_newton.StarvedLine(M, L, 176, (-4.0, 1.5), 0.6684)
    states = [{"speed": u, "load": w} for u, w in zip([1.0, *speed], [1.0, *load], strict=True)]
    films = starved_newton.march(other, 0.0856, np.array([0.0, *time]), states, [layer[0], *layer])[
        1:
    ]
    assert np.abs(h_c / films[:, 0] - 1.0).max() < 4e-3
    assert np.abs(h_min / films[:, 1] - 1.0).max() < 4e-3


def test_a_constant_duty_is_the_steady_contact_in_bits():
    steady = pyehl.solve(line())
    data = pyehl.solve(line([0.0, 1.0], mean_velocity=[1.0, 1.0]))
    np.testing.assert_array_equal(data.P, steady.P)
    np.testing.assert_array_equal(data.H, steady.H)
    assert data.history_cycles.values.max() == 0
    np.testing.assert_allclose(data.history_oil_in[0], float(steady.oil_in), rtol=1e-5)


def test_the_first_step_is_within_the_stated_error():
    """The time scheme and the steady contact are discretised differently; that change is stated."""
    data = point([0.0, 0.001, 0.002], mean_velocity=[1.0, 1.0, 1.000001])
    h_c, error = history(data, "H_c", "c_step_error")
    jump = abs(h_c[1] / h_c[0] - 1.0)
    assert 0.01 < jump < error[1]
    # on the way to finer grids: 0.0493 on 257 nodes
    assert h_c[0] < h_c[1]
    assert jump < float(data.H_c_error) / float(data.H_c)


def test_a_slow_duty_is_a_sequence_of_steady_contacts():
    """The deviation falls with the rate, at three rates."""
    film = float(pyehl.solve(line(film=1.1 * LAYER)).h_c_m)
    away = []
    for length in (10.0, 20.0, 40.0):
        data = pyehl.solve(line([0.0, length], inlet_film=[1.0, 1.2]))
        middle = np.interp(0.5 * length, data.history_T, data.history_h_c_m)
        away.append(1.0 - middle / film)
    assert away[0] > 0.02
    assert away[1] == pytest.approx(0.5 * away[0], rel=0.1)
    assert away[2] == pytest.approx(0.5 * away[1], rel=0.1)


def test_a_decreasing_layer_ends_in_its_steady_contact():
    """The film is constant until the old layer has passed, then it is that of the new layer."""
    data = pyehl.solve(line([0.0, 0.5, 1.0, 10.0], inlet_film=[1.0, 1.0, 0.5, 0.5]))
    time, h_c = history(data, "T", "H_c")
    # the layer comes from X = -4, the full film begins at about X = -1.3
    assert np.abs(h_c[time < 3.0] / h_c[0] - 1.0).max() < 2e-3
    assert h_c[-1] == pytest.approx(float(pyehl.solve(line(film=0.5 * LAYER)).H_c), rel=1e-3)


@pytest.mark.parametrize(
    "duty",
    [
        {"mean_velocity": [1.0, 1.0, 1.4, 1.4]},
        {"load": [1.0, 1.0, 1.5, 1.5]},
        {"inlet_film": [1.0, 1.0, 0.5, 0.5]},
    ],
    ids=["speed", "load", "layer"],
)
def test_no_oil_is_lost_around_a_ball(duty):
    """Side flow is included; the final contact is the steady one of the last row."""
    data = point([0.0, 0.2, 0.5, 6.0], **duty)
    assert np.abs(data.history_oil_imbalance).max() <= 1e-6
    assert np.abs(lost(data)).max() <= 1e-6
    assert abs(balance(data)) < 1e-3
    last = {key: numbers[-1] for key, numbers in duty.items()}
    contact = {
        "load": 60.0 * last.get("load", 1.0),
        "mean_velocity": last.get("mean_velocity", 1.0),
    }
    steady = pyehl.solve(
        pyehl.Case(**POINT | {"contact": POINT["contact"] | contact}),
        {"grid.border": "zero", "inlet.film": 1.4e-7 * last.get("inlet_film", 1.0)},
    )
    assert float(data.history_h_c_m[-1]) == pytest.approx(
        float(steady.h_c_m), abs=float(steady.h_c_error_m)
    )


def test_a_resumed_run_makes_the_same_bits(tmp_path: Path):
    """Also a run whose state was kept before its first step."""
    case = line([0.0, 0.2, 0.4, 1.5], inlet_film=[1.0, 1.0, 0.5, 0.5])
    for number, step in enumerate((1, 9)):
        folder = tmp_path / str(number)
        with pyehl.Solver(case) as solver:
            solver.checkpoint(folder)
            while not solver.done:
                solver.advance()
                if solver.summary.get("steps") == step:
                    solver.save_state(at_once=True)
            assert solver.converged
            films = solver.field("H")
        with pyehl.Solver(case) as again:
            again.resume(folder)
            while not again.done:
                again.advance()
            np.testing.assert_array_equal(again.field("H"), films)


def test_ehl_makes_the_same_bits(tmp_path: Path, ehl: Path):
    """From a table, in nanometres."""
    table = "time [us], inlet_film [nm]\n0, 118\n100, 118\n200, 80\n700, 80\n"
    (tmp_path / "duty.csv").write_text(table, encoding="utf-8")
    case = pyehl.Case(**LINE, inlet={"film": LAYER}, duty={"file": str(tmp_path / "duty.csv")})
    data = pyehl.solve(case, output=tmp_path / "python")
    assert float(data.history_oil_layer[-1]) * SCALE == pytest.approx(8e-8, rel=1e-5)
    (tmp_path / "case.nml").write_text(case.text, encoding="utf-8")
    subprocess.run([ehl, tmp_path / "case.nml", "-o", tmp_path / "ehl"], check=True)
    for name in ("history.csv", "P.npy", "H.npy"):
        assert (tmp_path / "ehl" / name).read_bytes() == (tmp_path / "python" / name).read_bytes()


def test_steady_contacts_of_a_duty():
    """They have the layer of their instant."""
    data = pyehl.solve(line([0.0, 0.5, 1.0, 12.0], inlet_film=[1.0, 1.0, 0.5, 0.5]))
    result = pyehl.quasi_static(data, [0.0, float(data.history_t_s[-1])])
    films = data.history_h_c_m.values[[0, -1]]
    np.testing.assert_allclose(result.steady_h_c_m, films, rtol=2e-3)
    assert "duty" in pyehl.plot(result)
    assert "duty" in pyehl.plot(data)


def test_refusals():
    with pytest.raises(pyehl.InputError, match="without inlet"):
        pyehl.Case(**LINE, duty={"time": [0.0, 1.0], "inlet_film": [1e-7, 1e-7]})
    for key, value, message in (
        ("duty.inlet_film", (1e-7, 0.0), "positive"),
        ("lubricant.boundary_film", 1e-7, "below the boundary film"),
        ("inlet.passages", 3, "passages with a duty"),
    ):
        case = line([0.0, 1.0], inlet_film=[1.0, 0.5])
        with pytest.raises(pyehl.InputError, match=message):
            pyehl.Case.from_text(str(case.text), {key: value})
