# SPDX-License-Identifier: BSD-3-Clause
"""Make table.csv and stress.png from a campaign, with the results of the second solver.

python benchmarks/stress.py --cases 100 --seed 1 -o stress
PYTHONPATH=tests/cases python docs/evidence/stress/make.py stress/stress.json
python docs/evidence/stress/make.py show       prints the table of docs/robustness.md

The second solver solves up to 20 converged smooth contacts and waves on 65 x 65 nodes, and tries
up to 80 failed ones.
"""

from __future__ import annotations

import csv
import json
import sys
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyehl.case import Case

if TYPE_CHECKING:
    from second_solver import SecondSolver

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "benchmarks"))
from figures import draw_outcomes

HERE = Path(__file__).resolve().parent
COLUMNS = (
    *("family", "moes_m", "moes_l", "points", "outcome"),
    *("steps", "difference", "allowed", "second"),
)

Row = dict[str, Any]

POINTS = 65
"""Nodes per side on which the second solver takes seconds."""
MAX_STEPS = 120
"""Maximum number of steps of its runs."""
FAILED = ("cycle limit", "negative film", "diverged")
NO_SOLUTION, SAME, DIFFERS, UNSOLVED, SOLVABLE = (
    "no solution",
    "same",
    "differs",
    "not solved either",
    "has a solution",
)
ALL_STEPS = "ended at its number of steps"
FAMILIES = {
    "smooth": "smooth contacts",
    "wave": "waves",
    "rest": "waves at rest",
    "fractal": "fractal surfaces",
    "feature": "single features",
    "": "all",
}
LATER = 5
"""Steps by which film breakdown may be later than in the run: it is sensitive to rounding."""
AGREE = 1e-2
"""Allowed relative difference of the maximum mu_r/mu_s of a period, due to algebraic errors."""


def check(rows: list[Row], sample: int) -> None:
    """Set `second` of up to `sample` converged rows, and of four times as many failed ones."""
    for wanted, count in ((("converged",), sample), (FAILED, 4 * sample)):
        chosen = [row for row in rows if row["outcome"] in wanted and _can(row)][:count]
        for number, row in enumerate(chosen, 1):
            print(f"second solver: {number} of {len(chosen)} ({' or '.join(wanted)})")
            row["second"] = solve_again(row)


def _can(row: Row) -> bool:
    """Whether the second solver can solve the case."""
    if row["values"].get("grid.points") != POINTS or row["family"] not in ("smooth", "wave"):
        return False
    if row["moes_l"] == 0.0:
        return False
    return (row["steps"] or 0) <= MAX_STEPS


def solve_again(row: Row) -> str:
    """Solve a case by Newton's method.

    Returns
    -------
    str
        For a converged case: 'same' or 'differs'. For a failed one: 'no solution' if the
        solution of the equations has a negative film at that step (if the run had one, within
        `LATER` steps), 'has a solution', or 'not solved either'.
    """
    # a module of the tests, not needed to show stored results
    from second_solver import NotSolvedError, SecondSolver, Wave  # noqa: PLC0415

    values = row["values"]
    narrow = values.get("time.scheme", "narrow") == "narrow"
    grid = Case.from_text("", [f"{key}={value}" for key, value in values.items()]).resolve()["grid"]
    borders = grid["x_inlet"], grid["x_outlet"]
    flooded = grid["border"] == "flooded"
    solver = SecondSolver(
        row["moes_m"], row["moes_l"], POINTS, narrow=narrow, borders=borders, flooded=flooded
    )
    steps = row["steps"]
    good = row["outcome"] == "converged"
    try:
        if steps is None:
            return _smooth(solver, row, good=good)
        wave = Wave(
            row["amplitude"],
            values["surface.wavelength_x"],
            values["surface.wavelength_y"],
            values["surface.velocity_ratio"],
        )
        if not good:
            ahead = LATER if row["outcome"] == "negative film" else 1
            films = (film.min() for _, film in islice(solver.steps(wave), steps + ahead))
            return NO_SOLUTION if any(minimum <= 0.0 for minimum in films) else SOLVABLE
        result = list(islice(solver.steps(wave), steps))
    except (NotSolvedError, np.linalg.LinAlgError, ValueError):
        return UNSOLVED
    last = [ratio for ratio, _ in result][max(0, steps - int(row["T_mean"] / solver.h) - 1) :]
    return SAME if abs(max(last) / row["mu_ratio_max"] - 1.0) < AGREE else DIFFERS


def _smooth(solver: SecondSolver, row: Row, *, good: bool) -> str:
    _, _, film = solver.smooth()
    if not good:
        return NO_SOLUTION if film.min() <= 0.0 else SOLVABLE
    centre = int(np.argmin(np.hypot(solver.x, solver.y)))
    return SAME if abs(film[centre] / row["H_c"] - 1.0) < AGREE else DIFFERS


def read() -> list[dict[str, str]]:
    """Read table.csv."""
    with (HERE / "table.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def wrong(row: dict[str, str]) -> bool:
    """Whether a result differs from its check by more than the allowed difference."""
    return bool(row["difference"]) and float(row["difference"]) > float(row["allowed"])


def lines() -> list[str]:
    """Make the table of docs/robustness.md."""
    result = [
        "| problems | cases | converged | all steps done | no solution | other status | checked "
        "| wrong |",
        "|---|---|---|---|---|---|---|---|",
    ]
    rows = read()
    for family, name in FAMILIES.items():
        mine = [row for row in rows if family in ("", row["family"])]
        ends = [row["outcome"] for row in mine]
        counts = [
            len(mine),
            ends.count("converged"),
            ends.count(ALL_STEPS),
            sum(row["second"] == NO_SOLUTION for row in mine),
        ]
        counts.append(counts[0] - sum(counts[1:]))
        counts += [sum(bool(row["difference"]) for row in mine), sum(map(wrong, mine))]
        result.append(f"| {name} | " + " | ".join(str(n or "") for n in counts[:-1]))
        result[-1] += f" | {counts[-1]} |"
    return result


def main(file: str) -> None:
    """Write the table and the figure."""
    if file == "show":
        print("\n".join(lines()))
        draw()
        return
    rows = json.loads(Path(file).read_text())["rows"]
    check(rows, 20)
    with (HERE / "table.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row in rows:
            values = row | {"points": row["values"]["grid.points"]}
            cells = (values.get(name) for name in COLUMNS)
            writer.writerow(f"{v:.2g}" if isinstance(v, float) and v < 1.0 else v for v in cells)
    draw()


def draw() -> None:
    """Draw the stored table."""
    with (HERE / "table.csv").open(newline="", encoding="utf-8") as stream:
        rows = [
            row
            | {name: float(row[name]) for name in ("moes_m", "moes_l")}
            | {"values": {"grid.points": int(row["points"])}}
            for row in csv.DictReader(stream)
        ]
    draw_outcomes(rows, HERE / "stress.png")


if __name__ == "__main__":
    main(sys.argv[1])
