# SPDX-License-Identifier: BSD-3-Clause
"""The default domain of an operating point, and its error."""

import csv
from pathlib import Path

import numpy as np
import pytest

from pyehl import Case, Solver, library

PAPER = {"x_inlet": -2.5, "x_outlet": 1.5, "y_extent": 2.0}


def case_of(moes_m: float, moes_l: float, points: int, **domain: float | str) -> Case:
    values = {"contact.moes_m": moes_m, "contact.moes_l": moes_l, "grid.points": points}
    return Case.from_text("", values | {f"grid.{key}": value for key, value in domain.items()})


def domain_of(case: Case) -> dict[str, float]:
    return {key: case.resolve()["grid"][key] for key in PAPER}


def solved(case: Case) -> dict:
    with Solver(case) as solver:
        assert solver.run(), solver.summary["status"]
        return solver.summary


@pytest.mark.parametrize(
    ("moes_m", "moes_l", "points"),
    [
        *((0.3, 5.0, 65), (1.0, 0.0, 65), (3.0, 10.0, 129), (12.0, 5.0, 129), (20.0, 10.0, 129)),
        *((20.0, 25.0, 129), (60.0, 0.0, 129), (150.0, 20.0, 129), (350.0, 12.0, 129)),
        *((450.0, 10.0, 129), (500.0, 10.0, 129), (1500.0, 15.0, 257)),
    ],
)
def test_stated_error_covers_a_domain_twice_as_large(moes_m: float, moes_l: float, points: int):
    """On the same mesh sizes, so that the grid error is the same."""
    case = case_of(moes_m, moes_l, points)
    doubled = {key: 2.0 * value for key, value in domain_of(case).items()}
    here, wide = solved(case), solved(case_of(moes_m, moes_l, 2 * points - 1, **doubled))
    for name in ("H_c", "H_min"):
        assert abs(here[name] - wide[name]) <= here[f"{name}_error"]
        parts = here[f"{name}_error_grid"] + here[f"{name}_error_domain"]
        assert here[f"{name}_error"] == pytest.approx(parts, rel=1e-12)
    assert abs(here["H_c"] - wide["H_c"]) <= here["H_c_error_domain"]
    if moes_m < 500.0:
        assert abs(here["H_c"] / wide["H_c"] - 1.0) <= 0.002


def test_domain_of_the_paper_from_m_500():
    for moes_m, moes_l in ((500.0, 0.0), (500.0, 25.0), (5000.0, 10.0)):
        assert domain_of(case_of(moes_m, moes_l, 65)) == PAPER
    # and below it grows as the film gets thicker
    inlets = [domain_of(case_of(m, 10.0, 65))["x_inlet"] for m in (0.1, 1, 5, 20, 80, 480)]
    assert inlets == sorted(inlets)
    assert inlets[-1] == PAPER["x_inlet"]
    # X = 0 is a node of the coarse grids
    for moes_m in (0.2, 5.0, 20.0, 80.0, 200.0, 450.0):
        result = domain_of(case_of(moes_m, 10.0, 65))
        width = result["x_outlet"] - result["x_inlet"]
        assert width == pytest.approx(2.0 * result["y_extent"])
        assert 32.0 * result["x_inlet"] / width == pytest.approx(
            round(32.0 * result["x_inlet"] / width)
        )


def test_a_key_overrides_only_its_own_border():
    usual = domain_of(case_of(100.0, 10.0, 65))
    assert domain_of(case_of(100.0, 10.0, 65, x_inlet=-3.0)) == usual | {"x_inlet": -3.0}


def test_a_domain_that_starves_the_film_is_reported():
    """At (20, 10), P = 0 on the paper's domain reduces the film by 6 %; plan and error say so."""
    starved = solved(case_of(20.0, 10.0, 257, **PAPER, border="zero"))
    flooded = solved(case_of(20.0, 10.0, 257))
    assert flooded["H_c_extrapolated"] == pytest.approx(0.4368, rel=3e-3)
    missing = flooded["H_c_extrapolated"] - starved["H_c_extrapolated"]
    assert missing > 0.05 * flooded["H_c_extrapolated"]
    assert missing < starved["H_c_error_domain"] < 2.0 * missing
    with Solver(case_of(20.0, 10.0, 257, **PAPER, border="zero")) as solver:
        assert "-2.5000 <= X <= 1.5000" in solver.describe()
        assert "at its border P = 0" in solver.describe()


@pytest.mark.parametrize(("moes_m", "moes_l"), [(2.0, 10.0), (20.0, 10.0), (1000.0, 25.0)])
def test_flooded_border_is_that_of_a_large_domain(moes_m: float, moes_l: float):
    """On one mesh: effect of a domain twice as large, over that of P = 0 at its border."""
    usual = domain_of(case_of(moes_m, moes_l, 65, border="flooded"))
    points = 257 if moes_m > 100.0 else 129
    doubled = {key: 2.0 * value for key, value in usual.items()}

    def film(points: int, border: str, domain: dict[str, float]) -> float:
        return solved(case_of(moes_m, moes_l, points, border=border, **domain))["H_c"]

    wide = film(2 * points - 1, "flooded", doubled)
    here, zero = film(points, "flooded", usual), film(points, "zero", usual)
    assert abs(here - wide) < 0.15 * (wide - zero)
    with Solver(case_of(moes_m, moes_l, points, border="flooded")) as solver:
        assert "at its border the pressure of a fully flooded contact" in solver.describe()


def test_pressure_spike_of_few_nodes_converges():
    """Full cycles move the spike to and fro; the run restarts with damped ones."""
    result = solved(case_of(200.0, 25.0, 257, **PAPER, border="zero"))
    assert result["restarts"] == 1
    usual = solved(case_of(200.0, 24.0, 257, **PAPER, border="zero"))
    assert usual["restarts"] == 0
    # H_c is proportional to L to the power 0.6
    assert result["H_c"] / usual["H_c"] == pytest.approx((25.0 / 24.0) ** 0.6, rel=2e-3)


def test_damping_on_the_finest_level_alone_converges():
    """Damped cycles fail on coarse levels here; damping on the finest level alone converges."""
    result = solved(case_of(600.0, 40.0, 129))
    assert result["restarts"] == 2


def test_evidence_is_what_this_build_gives(root: Path):
    """Three rows of docs/evidence/errors/smooth.csv, computed anew."""
    path = root / "docs" / "evidence" / "errors" / "smooth.csv"
    with path.open(encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row["points"] in ("65", "129", "65.0")]
    for row in (rows[0], rows[len(rows) // 2], rows[-1]):
        result = solved(
            case_of(float(row["moes_m"]), float(row["moes_l"]), int(float(row["points"])))
        )
        for name in ("H_c", "H_c_error", "H_min_error"):
            # other processors have other instructions, which round differently
            assert result[name] == pytest.approx(float(row[name]), rel=1e-6)


@pytest.mark.parametrize("moes_m", [0.3, 20.0, 200.0])
def test_film_follows_from_the_pressure_to_its_border(moes_m: float):
    """The border pressure of a flooded contact follows the film, and the film that pressure."""
    case = case_of(moes_m, 10.0, 65, border="flooded").with_options("solver.deflection=fft")
    with Solver(case) as solver:
        assert solver.run()
        pressure, film = solver.field("P"), solver.field("H")
        x, y = solver.axes()
    assert pressure[0].min() > 0.0
    deflection = library.deflection(pressure, x[1] - x[0], y[1] - y[0], "fft").values
    parabola = 0.5 * (x[:, None] ** 2 + y[None, :] ** 2)
    separation = film - parabola - deflection
    assert np.ptp(separation) < 1e-12 * abs(separation).max()
