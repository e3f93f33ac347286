# SPDX-License-Identifier: BSD-3-Clause
"""Rough surfaces on both bodies: exact special cases, sums of waves, means, features."""

from collections.abc import Mapping

import numpy as np
import pytest

# M = 200: 65 x 65 nodes resolve the contact
POINT, POINTS = (200.0, 10.0), 65
BASE = {
    "grid.x_inlet": -2.5,
    "grid.x_outlet": 1.5,
    "grid.y_extent": 2.0,
    "time.estimate_error": False,
}
WAVE = {"kind": "harmonic", "amplitude": 5e-3, "wavelength": 1.0}
OTHER = {"kind": "harmonic", "amplitude": 3e-3, "wavelength": 0.8}
DENT = {"kind": "dent", "amplitude": 5e-3, "width": 0.5}
FIELDS = ("P", "H", "RR", "A_d")


def surfaces_of(
    first: Mapping[str, object], second: Mapping[str, object], **contact: object
) -> dict[str, object]:
    """Keys of a case with these surfaces."""
    keys = BASE | {f"contact.{key}": value for key, value in contact.items()}
    keys |= {f"surface.{key}": value for key, value in first.items()}
    return keys | {f"second_surface.{key}": value for key, value in second.items()}


def test_exchange_of_the_two_bodies(solve):
    """The roughness of body 1 and of body 2, as either group: the same bits."""
    one = solve(POINT, POINTS, surfaces_of(WAVE, OTHER, slide_to_roll=0.5), fields=True)
    other = solve(
        POINT, POINTS, surfaces_of(OTHER, WAVE, slide_to_roll=0.5, rough_surface=2), fields=True
    )
    assert one.converged
    for name in FIELDS:
        assert np.array_equal(one.field(name), other.field(name)), name
    assert one["mu_ratio"] == other["mu_ratio"] > 1.05
    assert (one["amplitude"], one["second_amplitude"]) == (5e-3, 3e-3)
    assert (other["amplitude"], other["second_amplitude"]) == (3e-3, 5e-3)


def test_one_smooth_body(solve):
    """Roughness on body 2 gives the same as either group."""
    one = solve(POINT, POINTS, surfaces_of({}, WAVE, slide_to_roll=0.5), fields=True)
    other = solve(
        POINT, POINTS, surfaces_of(WAVE, {}, slide_to_roll=0.5, rough_surface=2), fields=True
    )
    assert one.converged
    for name in FIELDS:
        assert np.array_equal(one.field(name), other.field(name)), name
    assert one["mu_ratio"] == other["mu_ratio"]


def test_two_surfaces_without_sliding_are_one(solve):
    """Without sliding the two act as one surface with the sum of the heights."""
    both = solve(
        POINT, POINTS, surfaces_of(WAVE, WAVE | {"amplitude": 3e-3}, slide_to_roll=0), fields=True
    )
    one = solve(
        POINT, POINTS, surfaces_of(WAVE | {"amplitude": 8e-3}, {}, slide_to_roll=0), fields=True
    )
    assert both.converged
    assert both["T_period"] == one["T_period"] == 1.0
    for name in FIELDS:
        assert both.field(name) == pytest.approx(one.field(name), abs=1e-12), name
    assert both["mu_ratio"] == pytest.approx(one["mu_ratio"], rel=1e-12)
    assert both["mu_ratio"] > 1.02


def test_at_rest_in_each_notation(solve):
    """One rough surface at rest beside a smooth moving one: the same bits in each notation."""
    still = OTHER | {"velocity_ratio": 0.0}
    runs = [
        solve(POINT, POINTS, keys, fields=True)
        for keys in (
            surfaces_of(still, {}),
            surfaces_of({}, still),
            surfaces_of({}, OTHER, slide_to_roll=2),
            surfaces_of(OTHER, {}, slide_to_roll=-2),
            surfaces_of(OTHER, {}, slide_to_roll=2, rough_surface=2),
            surfaces_of(OTHER, WAVE | {"amplitude": 0.0}, slide_to_roll=-2),
        )
    ]
    assert runs[0].converged
    assert abs(runs[0]["mu_ratio"] - 1.0) > 1e-4
    for other in runs[1:]:
        for name in FIELDS:
            assert np.array_equal(runs[0].field(name), other.field(name)), name
        assert other["mu_ratio"] == runs[0]["mu_ratio"]


@pytest.mark.parametrize(
    "flat",
    [
        WAVE | {"amplitude": 0.0},
        {"kind": "harmonic", "amplitude_over_film": 0.0},
        {"kind": "fractal", "rms_height": 0.0},
        DENT | {"amplitude": 0.0},
    ],
    ids=["wave", "share", "fractal", "dent"],
)
@pytest.mark.parametrize("rough", [WAVE, DENT], ids=["wave", "dent"])
def test_no_height_is_smooth(solve, rough, flat):
    """A second surface of zero height costs nothing and changes no bit."""
    steps = {"time.steps": 12}
    alone = solve(POINT, POINTS, surfaces_of(rough, {}, slide_to_roll=0.5) | steps, fields=True)
    beside = solve(POINT, POINTS, surfaces_of(rough, flat, slide_to_roll=0.5) | steps, fields=True)
    for name in FIELDS:
        assert np.array_equal(alone.field(name), beside.field(name)), name
    assert alone["last_mu_ratio"] == beside["last_mu_ratio"]
    assert "second_amplitude" not in beside.summary


def test_one_body_at_rest(solve):
    """At SRR = 2 body 2 is at rest: with almost no roughness on body 1 the contact is steady."""
    faint = WAVE | {"amplitude": 1e-14}
    moving = solve(POINT, POINTS, surfaces_of(faint, OTHER, slide_to_roll=2), fields=True)
    steady = solve(POINT, POINTS, surfaces_of({}, OTHER, slide_to_roll=2), fields=True)
    assert moving.converged
    assert steady.converged
    assert moving.field("RR") == pytest.approx(steady.field("RR"), abs=2e-14)
    # to the accuracy of time steps and cycles: 3e-6
    assert moving["mu_ratio"] == pytest.approx(steady["mu_ratio"], abs=2e-5)
    assert moving.field("H") == pytest.approx(steady.field("H"), abs=2e-5)
    assert moving["mu_ratio_max"] - moving["mu_ratio_min"] < 1e-5
    # solved further the two approach each other: the difference is the remaining residual
    exact = {"solver.accuracy": 1e-6}
    moving = solve(POINT, POINTS, surfaces_of(faint, OTHER, slide_to_roll=2) | exact, fields=True)
    further = solve(POINT, POINTS, surfaces_of({}, OTHER, slide_to_roll=2) | exact, fields=True)
    # 1.3e-9, 1.6e-9, where 2.6e-6 and 3.1e-8 are left with an accuracy of 1e-2 and 1e-4
    assert moving["mu_ratio"] == pytest.approx(further["mu_ratio"], abs=5e-9)
    assert moving.field("H") == pytest.approx(further.field("H"), abs=5e-9)
    # and with roughness on both the heights add up, to the bit
    both = solve(POINT, POINTS, surfaces_of(WAVE, OTHER, slide_to_roll=2), fields=True)
    alone = solve(
        POINT,
        POINTS,
        surfaces_of(WAVE, {}, slide_to_roll=2) | {"time.steps": both["steps"]},
        fields=True,
    )
    assert both.converged
    assert alone["T"] == both["T"]
    assert np.array_equal(both.field("RR"), alone.field("RR") + steady.field("RR"))


def test_small_waves_superpose(solve):
    """To first order each wave is deformed as if alone, at 1.25 and 0.75 times u."""
    apart = []
    for amplitude in (2e-3, 1e-3):
        wave, other = WAVE | {"amplitude": amplitude}, OTHER | {"amplitude": amplitude}
        exactly = {"solver.accuracy": 0.01, "time.steps": 140, "time.skip_start": False}
        deformed = [
            solve(POINT, POINTS, surfaces_of(*pair, slide_to_roll=0.5) | exactly, fields=True)
            for pair in ((wave, other), (wave, {}), ({}, other))
        ]
        assert len({run["T"] for run in deformed}) == 1
        both, first, second = (run.field("A_d") / amplitude for run in deformed)
        assert min(np.abs(first).max(), np.abs(second).max()) > 1.0
        apart.append(np.abs(both - first - second).max())
    # 0.052 and 0.026: the remainder is of second order
    assert apart[1] < 0.03
    assert apart[0] / apart[1] == pytest.approx(2.0, rel=0.1)


def test_increases_of_small_waves_add(solve):
    """Over a common period the waves meet in all positions: cross terms have no mean."""
    apart = []
    for amplitude in (2e-3, 1e-3):
        wave, other = WAVE | {"amplitude": amplitude}, OTHER | {"amplitude": amplitude}
        increase = [
            solve(POINT, POINTS, surfaces_of(*pair, slide_to_roll=0.5) | {"solver.accuracy": 0.01})[
                "mu_ratio"
            ]
            - 1.0
            for pair in ((wave, other), (wave, {}), ({}, other))
        ]
        apart.append(abs(increase[0] - increase[1] - increase[2]) / increase[0])
    # 0.0055 and 0.0014: of second order in the amplitude once more
    assert apart[0] < 0.01
    assert apart[0] / apart[1] == pytest.approx(4.0, rel=0.15)


def test_common_period(solve):
    """Waves of 1 and 0.8 at 1.25 and 0.75: periods of 0.8 and 16/15, both in 3.2."""
    done = solve(POINT, POINTS, surfaces_of(WAVE, OTHER, slide_to_roll=0.5))
    assert done["T_period"] == done["T_mean"] == pytest.approx(3.2, rel=1e-12)
    assert done["T_mismatch"] == 0.0
    assert "mu_ratio_error_window" not in done.summary
    assert "both repeat after" in done.plan


def test_no_common_period(solve):
    """The stated error of a short window covers the result of a long one."""
    known = surfaces_of(WAVE | {"velocity_ratio": 1.3137}, OTHER)
    short = solve(POINT, POINTS, known | {"time.max_periods": 6})
    long = solve(POINT, POINTS, known | {"time.max_periods": 60})
    assert short.converged
    assert long.converged
    assert short["T_period"] < 6.5 * 0.8 / (2.0 - 1.3137) < long["T_period"]
    assert 0.02 < short["T_mismatch"] < 0.5
    assert long["T_mismatch"] <= 0.02
    for done in (short, long):
        spread = done["mu_ratio_max"] - done["mu_ratio_min"]
        assert done["mu_ratio_error_window"] == pytest.approx(done["T_mismatch"] * spread)
    stated = short["mu_ratio_error_window"] + long["mu_ratio_error_window"]
    assert abs(short["mu_ratio"] - long["mu_ratio"]) < stated < 0.3 * (long["mu_ratio"] - 1.0)
    assert "no common period" in short.plan


@pytest.mark.long
def test_surfaces_with_little_relative_motion(solve):
    """At SRR = 0.02 waves of one length are back where they began after 99 periods, not before."""
    keys = surfaces_of(WAVE, WAVE, slide_to_roll=0.02)
    short = solve(POINT, POINTS, keys, words=True)
    assert short.converged
    assert short["mu_ratio_error"] is None
    assert short["T_mismatch"] is None
    assert "time.max_periods = 99" in short["mu_ratio_error_note"]
    whole = solve(POINT, POINTS, keys | {"time.max_periods": 99})
    assert whole["T_period"] == pytest.approx(100.0, rel=1e-12)
    # a third of the increase is in positions that the mean omits: docs/theory/transient.md
    assert short["mu_ratio"] == pytest.approx(1.0124, abs=5e-5)
    assert whole["mu_ratio"] == pytest.approx(1.0181, abs=5e-5)


def test_window_is_part_of_the_error(solve):
    keys = surfaces_of(WAVE | {"velocity_ratio": 1.3137}, OTHER) | {
        "time.max_periods": 6,
        "time.estimate_error": True,
    }
    done = solve(POINT, POINTS, keys)
    names = ("grid", "stop", "window", "left_out", "domain")
    parts = [done[f"mu_ratio_error_{name}"] for name in names]
    assert min(parts[:3]) > 0.0
    assert done["mu_ratio_error"] == pytest.approx(sum(parts), rel=1e-12)


@pytest.mark.parametrize("stationary", [False, True], ids=["moving", "stationary"])
def test_dent_over_roughness(solve, stationary):
    """A dent enters when the roughness fills the contact; the mean takes whole periods of it."""
    srr = 2.0 if stationary else 0.5
    done = solve(POINT, POINTS, surfaces_of(DENT, WAVE, slide_to_roll=srr), fields=True)
    assert done.converged
    plan = done.plan
    assert "&surface: a dent passes once" in plan
    assert ("then that with the roughness at rest" in plan) == stationary
    smooth = solve(POINT, POINTS, surfaces_of(DENT, {}, slide_to_roll=srr))
    assert done["H_min_rough"] < smooth["H_min_rough"]
    assert done["P_rise_max"] > smooth["P_rise_max"]
    if stationary:
        assert done["T_period"] == pytest.approx(smooth["T_period"], rel=1e-12)
    else:
        periods = done["T_period"] * 0.75
        assert periods == pytest.approx(round(periods), abs=1e-9)
        assert done["T_period"] >= smooth["T_period"]


def test_dent_on_both(solve):
    """Two dents: the run ends when both have left; the film is no thicker than with either."""
    both = solve(POINT, POINTS, surfaces_of(DENT, DENT | {"amplitude": 2e-3}, slide_to_roll=0.5))
    first = solve(POINT, POINTS, surfaces_of(DENT, {}, slide_to_roll=0.5))
    second = solve(POINT, POINTS, surfaces_of({}, DENT | {"amplitude": 2e-3}, slide_to_roll=0.5))
    assert both.converged
    assert both["T_period"] >= max(first["T_period"], second["T_period"])
    assert both["H_min_rough"] <= min(first["H_min_rough"], second["H_min_rough"]) * 1.001


def test_composite_statistics(solve):
    """Rms height and slope of the sum of both, and the film over them."""
    si = {"contact.load": 120.0, "contact.slide_to_roll": 0.5, "time.steps": 2}
    tile = {"kind": "fractal", "pixels": 32, "rms_height": 3e-8}
    wave = {"kind": "harmonic", "amplitude": 5e-3, "wavelength": 1.0}
    runs = [
        solve(None, POINTS, surfaces_of(*pair) | si)
        for pair in ((tile, wave), (tile, {}), ({}, wave))
    ]
    both, first, second = runs
    for name in ("surface_rms_m", "surface_slope"):
        assert both[name] == pytest.approx(np.hypot(first[name], second[name]), rel=1e-12)
    assert first["surface_rms_m"] == pytest.approx(3e-8, rel=1e-9)
    a, height = both["hertz_radius_m"], both["film_scale_m"]
    assert second["surface_rms_m"] == pytest.approx(0.5 * 5e-3 * height, rel=1e-12)
    assert second["surface_slope"] == pytest.approx(
        second["surface_rms_m"] * np.sqrt(2.0) * 2.0 * np.pi / a, rel=1e-12
    )
    sigma = both["surface_rms_m"] / height
    assert both["lambda_ratio"] == pytest.approx(both["H_min"] / sigma, rel=1e-12)
    assert "composite rms height" in both.plan


def test_amplitude_by_the_film(solve):
    """Shares of the variance include an amplitude that is given relative to the film."""
    si = {"contact.load": 120.0, "contact.slide_to_roll": 0.5, "time.steps": 2}
    tile = {"kind": "fractal", "pixels": 32, "rms_height": 3e-8}
    wave = {"kind": "harmonic", "wavelength": 1.0}
    relative = solve(None, POINTS, surfaces_of(tile, wave | {"amplitude_over_film": 0.2}) | si)
    amplitude = relative["second_amplitude"]
    given = solve(None, POINTS, surfaces_of(tile, wave | {"amplitude": amplitude}) | si)
    alone = solve(None, POINTS, surfaces_of(tile, {}) | si)
    assert 0.0 < given["variance_unresolved"] < alone["variance_unresolved"]
    for name in ("variance_unresolved", "variance_left_out", "surface_rms_m", "mu_ratio_min"):
        assert relative[name] == given[name], name
