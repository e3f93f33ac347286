# SPDX-License-Identifier: BSD-3-Clause
"""A run without a result states the reason, the position and a remedy, in one line."""

import re
from typing import Any

import pytest

from pyehl import Case, Solver

WAVE = (
    "&contact moes_m = 100.0 moes_l = 5.0 /\n"
    "&grid points = 65 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    "&surface kind = 'harmonic' amplitude_over_film = 0.2 wavelength = 0.5 /\n"
)
"""A wave of 8 nodes; at 1.01 times the mean velocity it has fewer time steps per wave."""
IN_METRES = "&contact load = 20.0 /\n&grid points = 65 /\n&surface kind = 'bump' {} /\n"


def end(text: str, *options: str, stop: int | None = None) -> dict[str, Any]:
    """Summary of a run that ends without a result, or is stopped after a number of advances."""
    with Solver(Case.from_text(text, options)) as solver:
        if stop is None:
            assert not solver.run()
        else:
            for _ in range(stop):
                solver.advance()
            assert not solver.summary.get("message")
            solver.interrupt()
        summary = solver.summary
        assert solver.conclusion().endswith(f"assessment {summary['assessment']}")
    assert "\n" not in summary["assessment"]
    return summary


def test_film_breakdown_of_a_run():
    result = end(WAVE, "surface.amplitude_over_film=0.8")
    assert result["status"] == "negative film"
    # T of the failed step
    place = f"the time step to T = {result['T'] + result['x_mesh']:.4f} on 65 x 65 nodes"
    assert result["assessment"].startswith(
        f"film breakdown: no solution with a positive film for {place}, "
        "minimum film before H_min = "
    )
    assert result["assessment"].endswith(
        "; the shortest waves have 7 nodes, and as high as the film they need 32: give a finer "
        "grid (grid.points = 129), a smoother surface; pyehl predict reports where the film ends"
    )


def test_film_breakdown_of_a_feature_in_metres():
    """A feature has no prediction; a boundary film is suggested only if the film is in metres."""
    reported = end(IN_METRES.format("height_m = 6e-7 width = 0.5"))["assessment"]
    assert reported.startswith(
        "film breakdown: no solution with a positive film for the time step to "
    )
    assert ", minimum film before " in reported
    assert " nm; " in reported
    assert reported.endswith("a smoother surface or lubricant.boundary_film")


@pytest.mark.parametrize(
    ("options", "stop", "status", "words"),
    [
        (
            ["contact.moes_m=3000"],
            None,
            "negative film",
            "the smooth contact on 65 x 65 nodes has no positive film: the grid is too coarse for "
            "a solution at this load: grid.points = 129 or more",
        ),
        (
            ["solver.max_cycles=3", "solver.accuracy=1e-6"],
            None,
            "cycle limit",
            "the residual of the smooth contact on 65 x 65 nodes is 8.3E-04 after cycle 3; give a "
            "finer grid (grid.points = 129), or a larger solver.max_cycles where the residual "
            "still falls",
        ),
        (
            ["surface.amplitude_over_film=8", "surface.velocity_ratio=0"],
            None,
            "diverged",
            "the roughness at rest times 0.156 on 65 x 65 nodes has a value that is not a number; "
            "give a finer grid (grid.points = 129) or solver.cycle = 'W'",
        ),
        (
            ["time.steps=50"],
            None,
            "not settled",
            "the mean of mu_r/mu_s has not settled at T = 4.0625; give a larger time.steps with "
            "--resume",
        ),
        (
            ["time.max_periods=2", "time.tolerance=1e-8"],
            None,
            "not settled",
            "time.tolerance allows 1.0E-08 of it; give a larger time.max_periods with --resume",
        ),
        ([], 2, "interrupted", "interrupted in the smooth contact on 33 x 33 nodes"),
        (
            ["time.estimate_error=.false."],
            30,
            "interrupted",
            "interrupted in the time step to T = 2.3750 on 65 x 65 nodes; --resume "
            "continues from there",
        ),
    ],
)
def test_messages_of_other_statuses(options: list[str], stop: int | None, status: str, words: str):
    result = end(WAVE, *options, stop=stop)
    assert result["status"] == status
    assert result["assessment"] == f"no result: the status is '{status}': {result['message']}"
    assert result["message"].endswith(words)


@pytest.mark.parametrize(
    ("contact", "viscosity", "rows"),
    [
        (
            "length = 5.2e-3 radius = 9.581e-3 load = 3036.0 mean_velocity = 3.13 "
            "profile = 'chamfer' chamfer_length = 5.69e-4 chamfer_drop = 1.666e-5 "
            "misalignment = 5.568e-4",
            0.0116,
            (289, 577),
        ),
        pytest.param(
            "length = 9.644e-3 radius = 4.803e-3 load = 5654.0 mean_velocity = 3.13 "
            "profile = 'logarithmic' log_amplitude = 2.584e-6",
            0.0116,
            (769, 1537),
            marks=pytest.mark.long,
        ),
        pytest.param(
            "length = 0.0104 radius = 9.581e-3 load = 6073.0 mean_velocity = 0.4115 "
            "profile = 'chamfer' chamfer_length = 1.138e-3 chamfer_drop = 1.666e-5 "
            "misalignment = 2.784e-4",
            0.009753,
            (577, 1153),
            marks=pytest.mark.long,
        ),
    ],
)
def test_roller_names_a_profile_with_a_solution(
    contact: str, viscosity: float, rows: tuple[int, int]
):
    text = (
        f"&contact shape = 'roller' {contact} /\n"
        f"&lubricant viscosity = {viscosity} /\n&grid points = 257 /\n"
    )
    message = end(text)["message"]
    before, after = message.split("(", 1)
    keys, after = after.split(")", 1)
    assert before == (
        f"the smooth contact on 257 x {rows[0]} nodes has no positive film: give a profile that "
        "drops more "
    )
    assert after == f", or shorter cells along the roller (grid.points_y = {rows[1]})"
    keys, *old = keys.split(" in place of ")
    options = [key.replace(" ", "") for key in keys.split(", ")]
    if old:
        assert old == ["'chamfer' and its keys"]
        text = re.sub(r"profile = .*(?= misalignment)", "", text)
    with Solver(Case.from_text(text, options)) as solver:
        assert solver.run()


def test_roller_names_the_amplitude_of_its_profile():
    text = (
        "&contact shape = 'roller' length = 4.822e-3 radius = 4.803e-3 load = 2827.0 "
        "mean_velocity = 3.13 profile = 'logarithmic' log_amplitude = 2.584e-6 /\n"
        "&lubricant viscosity = 0.0116 /\n&grid points = 129 /\n"
    )
    assert end(text)["message"] == (
        "the smooth contact on 129 x 193 nodes has no positive film: give a profile that drops "
        "more (contact.log_amplitude = 5.2E-06), or shorter cells along the roller "
        "(grid.points_y = 385)"
    )


def test_a_converged_result_has_no_message():
    with Solver(Case.from_text(WAVE, ["surface.kind=smooth"])) as solver:
        assert solver.run()
        assert "message" not in solver.summary


@pytest.mark.parametrize(
    ("ratio", "at"), [(1.25, "the time step to T = "), (0.0, "the roughness at rest")]
)
def test_interrupted_in_the_run_for_the_grid_error(ratio: float, at: str):
    case = Case.from_text(WAVE, {"surface.velocity_ratio": ratio})
    begun = ": step " if ratio else "mu_r/mu_s"
    with Solver(case) as solver:
        while "on the next coarser grid" not in solver.progress or begun not in solver.progress:
            assert not solver.done
            solver.advance()
        solver.interrupt()
        reported = solver.summary["message"]
    assert reported.startswith(f"interrupted in the run for the grid error: {at}")
    assert " on 33 x 33 nodes" in reported
