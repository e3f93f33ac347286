# SPDX-License-Identifier: BSD-3-Clause
"""Errors over time of contacts under a duty, and of their extremes and means."""

import numpy as np
import pytest
from test_duty import LINE, LOAD, SPEED, UNIT

import pyehl


@pytest.fixture(scope="module")
def stops():
    """A contact that touches after it nearly stops; also with short steps, and on a fine grid."""
    time = np.array([0.0, 1.0, 5.0, 7.0, 11.0, 16.0])
    speed = SPEED * np.array([1.0, 1.0, 0.02, 0.02, 1.0, 1.0])
    case = pyehl.Case(**LINE, duty={"time": time * UNIT, "mean_velocity": speed}).with_options(
        {
            "contact.slide_to_roll": 0.1, "lubricant.shear_law": "eyring",
            "lubricant.boundary_film": 1e-7, "lubricant.boundary_friction": 0.1,
            "grid.points": 353,
        }
    )  # fmt: skip
    finer = {"duty.time_step": 0.25}, {"grid.points": 705}
    return [pyehl.solve(case, options) for options in ({}, *finer)]


SHARE = {
    "load_share": "load_share_error", "mu": "mu_error", "power_W": "power_error_W",
    "flash_K": "flash_error_K", "h_c_m": "h_c_error_m", "h_min_m": "h_min_error_m",
}  # fmt: skip


@pytest.mark.parametrize("name", SHARE)
def test_errors_over_time_cover(stops, name):
    """Shorter steps and a finer grid differ by less than the stated error nearly always."""
    one = stops[0]
    values, stated = (one[f"history_{n}"].values for n in (name, SHARE[name]))
    assert np.isfinite(stated).all()
    for other in stops[1:]:
        fine = np.interp(one.history_t_s, other.history_t_s, other[f"history_{name}"])
        error = np.abs(fine - values)
        assert np.mean(error <= stated) > 0.95
        assert error.max() < 1.3 * stated.max()


def test_the_load_share_of_a_duty(stops):
    """Its maximum is a row of the history, and its mean is that over time."""
    one, _, fine = stops
    share, time = one.history_load_share.values, one.history_t_s.values
    at = share.argmax()
    assert 0.1 < share[at] < 0.5
    assert float(one.duty_load_share_max) == share[at]
    assert float(one.duty_load_share_max_t_s) == time[at]
    assert float(one.duty_load_share_max_error) == one.history_load_share_error.values[at]
    later = time >= 0.0
    mean = np.trapezoid(share[later], time[later]) / np.ptp(time[later])
    assert float(one.contact_load_share) == pytest.approx(mean, rel=1e-12)
    difference = abs(float(fine.contact_load_share) - mean)
    assert difference < float(one.contact_load_share_error) < 0.5 * mean


def test_extremes_have_the_errors_of_their_rows():
    case = pyehl.Case(**LINE).with_options(
        {"contact.slide_to_roll": 0.1, "lubricant.shear_law": "eyring", "grid.points": 353}
    )
    data = pyehl.solve(case, {"duty": {"time": [0.0, UNIT], "load": [LOAD, 0.8 * LOAD]}})
    for name, unit in (("p_max", "_Pa"), ("mu_max", ""), ("power_max", "_W"), ("flash_max", "_K")):
        column = name if name == "p_max" else name.removesuffix("_max")
        at = data[f"history_{column}{unit}"].values.argmax()
        error = float(data[f"duty_{name}_error{unit}"])
        assert error == data[f"history_{column}_error{unit}"].values[at] > 0.0
