# SPDX-License-Identifier: BSD-3-Clause
"""Moving waviness: reference values, the start, symmetry, sign, and maps."""

import csv
import itertools
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference import FIG_2, WAVINESS, WavinessRow

# The period means agree with an independent program to this tolerance, with equal grid and scheme
AGREEMENT = 5e-3
# Residual of a time step a hundred times below the default
TIGHT = {"solver.accuracy": 0.001}
POINT = (1000.0, 10.0)


def identify(row: WavinessRow) -> str:
    wave = f"A{row.amplitude:.3g}-{row.wavelength}"
    return f"{row.points}-{row.scheme}-z{row.roelands_z:g}-{wave}"


def settings(row: WavinessRow) -> dict[str, object]:
    return {
        "lubricant.roelands_z": row.roelands_z,
        "surface.kind": "harmonic",
        "surface.amplitude": row.amplitude,
        "surface.wavelength": row.wavelength,
        "time.scheme": row.scheme,
        # The run on the coarser grid is only for the error estimate
        "time.estimate_error": False,
    }


def small(scheme: str) -> WavinessRow:
    """The case on the smallest grid."""
    return next(row for row in WAVINESS if (row.points, row.scheme) == (129, scheme))


def of_size(points: int, *, equal: bool) -> list[Any]:
    rows = [row for row in WAVINESS if (row.points == points) == equal]
    # one row per scheme on 129 nodes and one row on 257 are always run, the others with the long
    # tests
    first = {
        (row.points, row.scheme if row.points == 129 else ""): row for row in reversed(rows)
    }.values()
    return [
        pytest.param(row, id=identify(row), marks=[] if row in first else pytest.mark.long)
        for row in rows
    ]


def check(row: WavinessRow, done: Any, table: Any) -> None:
    assert done.converged
    assert done["scheme"] == row.scheme
    assert done["mu_ratio"] == pytest.approx(row.mu_ratio, rel=AGREEMENT)
    assert done["mu_ratio_min"] == pytest.approx(row.mu_ratio_min, rel=AGREEMENT)
    assert done["mu_ratio_max"] == pytest.approx(row.mu_ratio_max, rel=AGREEMENT)
    assert np.abs(done.history["load_error"]).max() <= 1e-6
    assert done.history["residual"].max() <= done["step_residual_allowed"]
    for line in table("amplitude_ratio.csv"):
        names = ("points", "roelands_z", "amplitude", "wavelength")
        if line["scheme"] == row.scheme and all(
            float(line[name]) == getattr(row, name) for name in names
        ):
            expected = float(line["amplitude_ratio"])
            steps = int(done["T_period"] / done["x_mesh"]) + 1
            deformed = 0.5 * np.ptp(done.history["H_c"][-steps:]) / row.amplitude
            assert deformed == pytest.approx(expected, rel=AGREEMENT)
            # The summary has the standard deviation of film over that of roughness: the same
            # for a sine and many steps in a period, here up to 2 % more
            assert done["amplitude_ratio"] == pytest.approx(expected, rel=0.03)


@pytest.mark.parametrize("row", of_size(513, equal=False))
def test_reference_rows(solve, table, row: WavinessRow):
    check(row, solve(POINT, row.points, settings(row)), table)


@pytest.mark.slow
@pytest.mark.parametrize("row", of_size(513, equal=True))
def test_reference_rows_on_the_finest_grid(solve, table, row: WavinessRow):
    done = solve(POINT, row.points, settings(row))
    check(row, done, table)
    if row.scheme == "paper":
        # The number printed in figure 2 of the paper
        assert done["mu_ratio"] == pytest.approx(FIG_2["mu_ratio"], rel=AGREEMENT)


SCHEMES = ["narrow", pytest.param("paper", marks=pytest.mark.long)]


@pytest.mark.parametrize("scheme", SCHEMES)
def test_only_the_algebraic_error_differs(solve, scheme: str):
    """With tight tolerances the same discrete problem gives the same digits: five are known."""
    row = small(scheme)
    done = solve(POINT, row.points, settings(row) | TIGHT)
    assert done.converged
    # Besides the digits, the means are over periods that ended at other times (2e-5)
    assert done["mu_ratio"] == pytest.approx(row.mu_ratio, rel=1e-4)


@pytest.mark.parametrize(
    ("point", "wavelength", "share"),
    [
        ((500.0, 5.0), 0.5, 0.4),
        pytest.param((500.0, 15.0), 1.0, 1.0, marks=pytest.mark.long),
        pytest.param((800.0, 8.0), 0.7, 0.2, marks=pytest.mark.long),
        ((1500.0, 12.0), 0.25, 0.1),
    ],
)
def test_other_cases_converge(solve, point: tuple[float, float], wavelength: float, share: float):
    wave = {
        "surface.kind": "harmonic",
        "surface.amplitude_over_film": share,
        "surface.wavelength": wavelength,
        "time.estimate_error": False,
    }
    done = solve(point, 129, wave)
    assert done.converged
    assert done["mu_ratio_min"] <= done["mu_ratio"] <= done["mu_ratio_max"]
    assert done["mu_ratio"] > 1.0
    assert np.abs(done.history["load_error"]).max() <= 1e-6


@pytest.mark.long
def test_extrapolated_ratio_is_nearer_to_finer_grids(solve):
    """The run on the coarser grid that gives the error also gives a better value."""
    finest = next(r for r in WAVINESS if (r.points, r.scheme) == (513, "narrow"))
    wave = settings(finest) | {"time.estimate_error": True}
    done = solve((1000.0, 10.0), 257, wave)
    plain, better = done["mu_ratio"], done["mu_ratio_extrapolated"]
    assert abs(better - finest.mu_ratio) < 0.3 * abs(plain - finest.mu_ratio)


@pytest.mark.parametrize(
    ("point", "wavelength", "share"),
    [
        ((1000.0, 10.0), 0.5, 0.4),
        pytest.param((500.0, 5.0), 1.0, 0.4, marks=pytest.mark.long),
        ((500.0, 15.0), 0.5, 0.5),
    ],
)
@pytest.mark.long
def test_coarsening_does_not_matter(
    solve, point: tuple[float, float], wavelength: float, share: float
):
    """Transfers by the conductance, and Galerkin operators, have the same solution."""
    wave = {
        "surface.kind": "harmonic",
        "surface.amplitude_over_film": share,
        "surface.wavelength": wavelength,
        "time.estimate_error": False,
        "solver.accuracy": 0.0001,
    }
    classical, alcouffe = (
        solve(point, 129, wave | {"solver.coarsening": word}) for word in ("classical", "alcouffe")
    )
    for done in (classical, alcouffe):
        assert done.converged
        assert np.abs(done.history["load_error"]).max() <= 1e-6
        assert done.history["residual"].max() <= done["step_residual_allowed"]
    # Each to its algebraic error, which follows solver.accuracy
    assert alcouffe["mu_ratio"] == pytest.approx(classical["mu_ratio"], rel=2e-5)
    same = min(classical["steps"], alcouffe["steps"])
    assert alcouffe.history["mu_ratio"][:same] == pytest.approx(
        classical.history["mu_ratio"][:same], rel=1e-4
    )


# The hardest wave of those with 500 <= M <= 2000, 5 <= L <= 15, length 0.25 to 1: up to 2.8 p_h
HARDEST = {
    "surface.kind": "harmonic",
    "surface.amplitude_over_film": 1.0,
    "surface.wavelength": 0.25,
    "time.estimate_error": False,
}


def hardest(root: Path) -> dict[str, dict[str, float]]:
    """Means of mu_r/mu_s over windows of a long run, by coarsening."""
    path = root / "docs" / "evidence" / "steps" / "hardest.csv"
    with path.open(encoding="utf-8") as stream:
        rows = {row.pop("coarsening"): row for row in csv.DictReader(stream)}
    assert all(row.pop("status") == "converged" for row in rows.values())
    return {name: {k: float(v) for k, v in row.items()} for name, row in rows.items()}


def test_page_has_the_cost_of_both_coarsenings(root: Path):
    text = (root / "docs" / "theory" / "coarse-grids.md").read_text(encoding="utf-8")
    auto, classical = (hardest(root)[name] for name in ("auto", "classical"))
    cost = "{:.1f} cycles per step, classical coarsening {:.1f}"
    assert cost.format(auto["cycles"], classical["cycles"]) in text
    assert "agree within 0.1 %" in text
    assert classical["mean"] == pytest.approx(auto["mean"], rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("coarsening", ["auto", "classical"])
def test_hardest_wave_converges(root: Path, solve, coarsening: str):
    """Friction depends on single nodes: the mean takes several periods, and states its error."""
    done = solve((500.0, 15.0), 513, HARDEST | {"solver.coarsening": coarsening}, timeout=1800.0)
    assert done.converged
    assert done["mu_ratio_error_stop"] <= 0.02 * done["mu_ratio"]
    # means over equally long windows scatter as much
    record = hardest(root)[coarsening]
    allowed = done["mu_ratio_error_stop"] + record["greatest"] - record["mean"]
    assert done["mu_ratio"] == pytest.approx(record["mean"], abs=allowed)


@pytest.mark.parametrize(
    ("moes_m", "moes_l"),
    # the others of this range belong to the long tests
    [(500.0, 5.0), (1000.0, 10.0), (2000.0, 15.0)]
    + [
        pytest.param(*point, marks=pytest.mark.long)
        for point in itertools.product((500.0, 1000.0, 2000.0), (5.0, 10.0, 15.0))
        if point not in ((500.0, 5.0), (1000.0, 10.0), (2000.0, 15.0))
    ],
)
def test_first_steps_on_the_default_grid(solve, moes_m: float, moes_l: float):
    """Each step converges where the grid is fine and the viscosity in the contact is moderate."""
    wave = {
        "surface.kind": "harmonic",
        "surface.x_start": -1.25,
        "time.steps": 4,
        "time.estimate_error": False,
    }
    done = solve((moes_m, moes_l), 513, wave)
    # The steps were made, but there is no mean over a period
    assert (done["status"], done["steps"]) == ("not settled", 4)
    # Line relaxation that overshoots smooth changes would take many cycles, or never converge
    assert done.history["cycles"].max() <= 4
    assert done.history["residual"].max() <= done["step_residual_allowed"]
    assert np.abs(done.history["load_error"]).max() <= 1e-6


@pytest.mark.parametrize("scheme", SCHEMES)
def test_start_does_not_matter(solve, scheme: str):
    row = small(scheme)
    inlet = solve(POINT, row.points, settings(row) | TIGHT)
    near = solve(POINT, row.points, settings(row) | TIGHT | {"surface.x_start": -1.25})
    assert near.converged
    assert near["steps_skipped"] == 0
    assert near["steps"] < inlet["steps"] + inlet["steps_skipped"]
    # Remainder of the start after the first whole period, by the position where the mean begins
    assert near["mu_ratio"] == pytest.approx(inlet["mu_ratio"], rel=2e-4)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_skipped_steps_do_not_matter(solve, scheme: str):
    row = small(scheme)
    short = solve(POINT, row.points, settings(row) | TIGHT)
    long = solve(POINT, row.points, settings(row) | TIGHT | {"time.skip_start": False})
    assert long.converged
    assert (long["steps_skipped"], long["T"]) == (0, short["T"])
    assert short["steps_skipped"] == long["steps"] - short["steps"] > 0
    # Before the contact the film is thick compared with the roughness and the viscosity low, so
    # that the omitted part changes next to nothing. A part in a million is 100 times less than the
    # algebraic error of the steps by default.
    assert short["mu_ratio"] == pytest.approx(long["mu_ratio"], rel=1e-6)
    tail = -short["steps"]
    assert short.history["T"] == pytest.approx(long.history["T"][tail:], abs=1e-12)
    assert short.history["mu_ratio"] == pytest.approx(long.history["mu_ratio"][tail:], rel=1e-6)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_half_domain(solve, scheme: str):
    row = small(scheme)
    half, whole = (
        solve(POINT, row.points, settings(row) | TIGHT | {"solver.symmetry": symmetry})
        for symmetry in ("auto", "full")
    )
    assert (half["half_domain"], whole["half_domain"]) == (True, False)
    # Both to the algebraic error: a tenth of the default, which is 5e-4
    assert half["mu_ratio"] == pytest.approx(whole["mu_ratio"], rel=5e-5)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_film_is_thinner_under_a_peak(solve, scheme: str):
    # The front has passed the contact, which is rough at once; a quarter of the amplitude leaves a
    # film under every peak
    row = small(scheme)
    amplitude = 0.25 * row.amplitude
    wave = settings(row) | {"surface.amplitude": amplitude, "surface.x_start": 3.0, "time.steps": 1}
    smooth = solve(POINT, row.points, {"lubricant.roelands_z": row.roelands_z}, fields=True)
    rough = solve(POINT, row.points, wave, fields=True)
    x, y = rough.field("X")[:, None], rough.field("Y")
    angle = 2.0 * np.pi / row.wavelength
    phase = angle * (x - 3.0 - FIG_2["velocity_ratio"] * rough["T"])
    roughness = amplitude * np.cos(phase) * np.cos(angle * y)
    change = rough.field("H") - smooth.field("H")
    inside = x**2 + y**2 < 0.9**2
    assert change[inside & (roughness > 0.8 * amplitude)].max() < 0.0
    assert change[inside & (roughness < -0.8 * amplitude)].min() > 0.0
    # After one step the roughness is still almost undeformed
    slope = (change * roughness)[inside].sum() / (roughness**2)[inside].sum()
    assert slope == pytest.approx(-1.0, abs=0.02)


@pytest.fixture(scope="module")
def tile(tmp_path_factory: pytest.TempPathFactory, solve) -> tuple[dict[str, object], float]:
    """Settings of a map of the waviness, in SI units; its amplitude in Hertz units."""
    amplitude, pixels = 8e-3, 32
    smooth = solve(None, 129)
    wave = np.cos(2.0 * np.pi * np.arange(pixels) / pixels)
    path: Path = tmp_path_factory.mktemp("tile") / "tile.npy"
    np.save(path, amplitude * smooth["film_scale_m"] * np.outer(wave, wave))
    length = 0.5 * smooth["hertz_radius_m"]
    return {
        "surface.kind": "map",
        "surface.file": f"'{path}'",
        "surface.length_x": length,
        "surface.length_y": length,
        "time.estimate_error": False,
    }, amplitude


def test_map_equals_waviness(solve, tile):
    settings, amplitude = tile
    wave = {
        "surface.kind": "harmonic",
        "surface.amplitude": amplitude,
        "surface.wavelength": 0.5,
        "time.estimate_error": False,
        "solver.symmetry": "full",
    }
    as_map, as_wave = solve(None, 129, settings), solve(None, 129, wave)
    assert as_map.converged
    # Same grid, same cycles: only the roughness differs, by the interpolation of the tile, which is
    # accurate to 1e-9 of the amplitude with 32 pixels per wave
    assert as_map["mu_ratio"] == pytest.approx(as_wave["mu_ratio"], rel=1e-6)
    assert as_map["amplitude_ratio"] == pytest.approx(as_wave["amplitude_ratio"], rel=1e-6)
    assert as_map["mu_ratio"] > 1.05


def test_maps_take_the_whole_domain(solve, tile):
    """A map is not symmetric in general: even a symmetric one is not folded."""
    steps = {"time.steps": 2}
    done = solve(None, 129, tile[0] | steps | {"solver.symmetry": "auto"})
    assert done["half_domain"] is False
