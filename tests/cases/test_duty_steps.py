# SPDX-License-Identifier: BSD-3-Clause
"""Time steps under a duty: their stated and their required error, and their cycles."""

import numpy as np
import pytest
from test_duty import columns, run, wave

import pyehl

DUTIES = {
    "speed": (wave(4.0, 0.4)[0], {"mean_velocity": wave(4.0, 0.4)[1], "interpolation": "cubic"}),
    "load": (wave(4.0, 0.4)[0], {"load": wave(4.0, 0.4)[1], "interpolation": "cubic"}),
    "radius": (wave(4.0, 0.3)[0], {"radius_x": wave(4.0, 0.3)[1], "interpolation": "cubic"}),
    "viscosity": (wave(4.0, 0.3)[0], {"viscosity": wave(4.0, 0.3)[1], "interpolation": "cubic"}),
    "load step": ([0.0, 0.5, 1.0, 3.5], {"load": [1.0, 1.0, 1.5, 1.5]}),
    "reversal": ([0.0, 0.5, 1.5, 4.0], {"mean_velocity": [1.0, 1.0, -1.0, -1.0]}),
}
BOTH_SIDES = {"points": 257, "x_inlet": -4.0, "x_outlet": 4.0}


def step_errors(time, grid=None, share=1.0, **duty):
    """Differences of films and pressure to an eighth of the step, and the stated errors."""
    one = run(time, grid, time_step=share, **duty)
    other = run(time, grid, time_step=share / 8.0, **duty)
    for name, column in (("H_c", "c"), ("H_min", "min"), ("P_max", "p")):
        errors = one[f"history_{column}_step_error"].values
        values = one[f"history_{name}"].values
        fine = np.interp(one.history_T, other.history_T, other[f"history_{name}"])
        yield name, np.abs(fine / values - 1.0), errors


# radius and viscosity, which vary as smoothly as speed and load, belong to the long tests
CASES = [
    pytest.param(n, marks=pytest.mark.long if n in ("radius", "viscosity") else ()) for n in DUTIES
]


@pytest.mark.parametrize("name", CASES)
def test_the_stated_error_of_time_steps_covers(name):
    """At 0.95 of all instants, and over the duty; the tolerance of a step contributes 5e-5."""
    time, duty = DUTIES[name]
    grid = BOTH_SIDES if name == "reversal" else None
    for what, error, stated in step_errors(time, grid, **duty):
        assert np.mean(error <= stated + 5e-5) > 0.95, what
        assert error.max() < 1.3 * stated.max(), what
        # the errors are not arbitrarily large
        assert what == "P_max" or stated.max() < 8.0 * error.max(), what


@pytest.mark.parametrize("name", CASES)
def test_the_required_error_is_held(name):
    """Compared with sixteen times as many steps."""
    time, duty = DUTIES[name]
    if len(time) > 8:
        time = time[::4]
        duty = {k: v if isinstance(v, str) else v[::4] for k, v in duty.items()}
    grid = BOTH_SIDES if name == "reversal" else None
    data = run(time, grid, target_error=0.02, **duty)
    fine = run(time, grid, time_step=1.0 / 16.0, **duty)
    for film in ("history_H_c", "history_H_min"):
        other = np.interp(data.history_T, fine.history_T, fine[film])
        assert np.abs(other / data[film].values - 1.0).max() < 0.02


def test_half_the_time_step_gives_a_quarter_of_the_error():
    """Errors by time steps fall with their square, and so do the stated ones."""
    time, duty = DUTIES["speed"]
    films, stated = [], []
    for share in (2.0, 1.0, 0.5, 0.125):
        data = run(time, time_step=share, **duty)
        h = columns(data)
        films.append(np.interp(np.linspace(1.0, 4.0, 40), h["T"], h["H_c"]))
        stated.append(float(data.history_c_step_error.max()))
    errors = [np.abs(film / films[-1] - 1.0).max() for film in films[:-1]]
    for values in (errors, stated[:-1]):
        assert values[1] < 0.45 * values[0]
        assert values[2] < 0.4 * values[1]


def test_steps_are_longer_where_the_error_allows():
    time, duty = DUTIES["speed"]
    usual = run(time, **duty)
    data = run(time[::4], target_error=0.02, **duty | {"mean_velocity": duty["mean_velocity"][::4]})
    assert data.history_T.size < 0.6 * usual.history_T.size
    assert np.diff(data.history_T).max() > 2.0 * np.diff(usual.history_T).max()


def test_an_error_of_the_steps_is_held():
    """A load step within a fortieth of a transit requires shorter steps; the film is the same."""
    duty = {"load": [1.0, 1.0, 1.3, 1.3]}
    time = [0.0, 0.5, 0.55, 2.0]
    usual = run(time, **duty)
    data = run(time, target_error=5e-3, **duty)
    assert data.history_T.size > usual.history_T.size
    worst = float(data.history_min_step_error.max())
    assert worst < 0.5 * float(usual.history_min_step_error.max())
    at = np.linspace(0.7, 2.0, 30)
    films = (np.interp(at, d.history_T, d.history_H_min) for d in (data, usual))
    assert np.abs(np.subtract(*films)).max() < 0.02 * float(usual.H_min)


@pytest.mark.parametrize("radius_y", [0.03, 0.06])
def test_steps_of_wide_contacts_take_few_cycles(radius_y):
    """Cells are long in them; undamped cycles would take some 80."""
    contact = {"radius_x": 6e-3, "radius_y": radius_y, "load": 400.0, "mean_velocity": 2.0}
    case = pyehl.Case(contact=contact, lubricant={"viscosity": 0.04}, grid={"points": 65})
    time = np.linspace(0.0, 1e-4, 9)
    load = 400.0 * (1.0 + 0.3 * np.sin(2e4 * np.pi * time))
    data = pyehl.solve(case, {"duty": {"time": time, "load": load, "interpolation": "cubic"}})
    assert float(data.cycles_per_step) < 15.0


def test_a_roller_takes_an_error_of_its_steps():
    """With `duty.target_error` films differ by less than that from those of short steps."""
    contact = {"shape": "roller", "radius": 0.01, "length": 0.004, "load": 200.0}
    contact |= {"mean_velocity": 1.0, "profile": "crown", "crown_radius": 0.5}
    table = {"time": (0.0, 1e-4, 2e-4, 4e-4), "load": (200.0, 200.0, 220.0, 220.0)}
    case = pyehl.Case(contact=contact, grid={"points": 65}, duty=table)
    usual, short = pyehl.solve(case), pyehl.solve(case, {"duty.time_step": 0.0625})
    asked = pyehl.solve(case, {"duty.target_error": 5e-3})
    assert asked.sizes["history"] > usual.sizes["history"]
    for name, column in (("H_c", "c"), ("H_min", "min")):
        fine = np.interp(asked.history_T, short.history_T, short[f"history_{name}"])
        assert np.abs(fine / asked[f"history_{name}"].values - 1.0).max() < 5e-3, name
        stated = (float(d[f"history_{column}_step_error"].max()) for d in (asked, usual))
        assert next(stated) < 0.6 * next(stated), name
