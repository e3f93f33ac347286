# SPDX-License-Identifier: BSD-3-Clause
"""Stress test: where the solver converges, and whether converged results are right.

Cases drawn from a seed run as a study of ``pyehl sweep``. All that end with a result are solved
again to a twentieth of the algebraic error. For cases with a boundary film the fields are checked,
too, and the load share on a finer grid.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from common import add_number, columns, header, parser, say, show, verdict
from figures import draw_outcomes
from stress_cases import FAMILIES, GRIDS, LAWS, StressCase, draw, study_of
from stress_checks import ENDED, broken, judge, judge_share

from pyehl.cli import status_of
from pyehl.commands.arguments import add_force
from pyehl.destination import Destination, write_json
from pyehl.errors import InputError
from pyehl.studies.plan import Plan, plan
from pyehl.studies.sweep import CASES, perform
from pyehl.types import Row

STRICT = {"solver.accuracy": 0.005, "solver.max_cycles": 200}
"""Settings of the stricter run."""
MAX_AMPLITUDE = 1.0
"""Maximum surface.amplitude that a case may have [a^2/R]."""
KEPT = (
    *("status", "points", "restarts", "steps", "cycles_per_step", "cycles", "rough_cycles"),
    *("amplitude", "H_c", "H_c_error_grid", "H_min", "mu_ratio", "mu_ratio_error", "last_mu_ratio"),
    *("mu_ratio_min", "mu_ratio_max", "T_mean", "coarsening_changed_at", "seconds", "message"),
    *("points_suggested", "contact_load_share", "contact_load_share_error", "mass_defect"),
)

COLUMNS = columns(
    "family:s cases:d converged:d ended:d failed:d checked:d wrong:d cycles:.1f most_cycles:.1f"
)
MEANING = (
    "ended: all required steps converged; checked: solved once more to a twentieth of the "
    "algebraic error;\nwrong: differs by more than the error it states; cycles: of a step, or all"
)
"""Meaning of the columns."""


def campaign(
    cases: int,
    seed: int,
    folder: Path,
    *,
    jobs: int = 1,
    grids: Sequence[int] = (65, 129, 257),
    law: str = "newtonian",
    layer: bool = False,
) -> list[Row]:
    """Run and check `cases` cases of a seed; returns a row for each.

    `law` is their shear law; with `layer` each has a boundary film. A row has the case, its
    summary, `outcome`, `difference` and `allowed`; with a layer also the conditions that its fields
    violate (`broken`) and the load shares of the other runs. The folder has the journals of the
    runs, so that an interrupted campaign is resumed. Each grid has half as many cases as the one
    before. KeyboardInterrupt if it is interrupted.
    """
    rows: list[Row] = []
    drawn = draw(cases, seed, grids, law, layer=layer)
    for family in FAMILIES:
        mine = [case for case in drawn if case.family == family]
        if not mine:
            continue
        say(f"{family}: {len(mine)} cases")
        result = _run(family, mine, folder / family, jobs, fields=layer)
        chosen = [row for row in result if row["outcome"] in ("converged", ENDED)]
        known = [row for row in chosen if row["contact_load_share_error"] is not None]
        for name, how, some in (
            ("strict", "to a stricter end", chosen),
            ("finer", "on a finer grid", known),
        ):
            if some:
                say(f"{family}: {len(some)} once more, {how}")
            for end, high in (("", False), ("-high", True)):
                part = [row for row in some if _is_high(row) == high]
                if part:
                    place = folder / f"{family}-{name}{end}"
                    _check(family, part, place, jobs, finer=name == "finer")
        rows += result
    return rows


def folders() -> list[str]:
    """Return the names of the folders of the runs."""
    ends = ("", "-strict", "-strict-high", "-finer", "-finer-high")
    return [f"{family}{end}" for family in FAMILIES for end in ends]


def _run(
    family: str, cases: Sequence[StressCase], folder: Path, jobs: int, *, fields: bool
) -> list[Row]:
    keep = folder / CASES if fields else None
    todo = plan(study_of(family, cases, fields=fields), keep)
    rows = []
    for task, case, reported in zip(todo.tasks, cases, _solved(todo, folder, jobs), strict=True):
        row: Row = {"family": family, "moes_m": case.moes_m, "moes_l": case.moes_l}
        row |= {"values": dict(case.values)} | {name: reported.get(name) for name in KEPT}
        row["outcome"] = _outcome(row)
        row |= {"difference": None, "allowed": None, "strict_status": None, "wrong": False}
        if fields and row["outcome"] in ("converged", ENDED):
            row["broken"] = broken(Path(task.folder))
            row["wrong"] = row["broken"] != ""
        rows.append(row)
    return rows


def _solved(todo: Plan, folder: Path, jobs: int) -> list[Row]:
    """Return the rows of all cases; KeyboardInterrupt if the study was interrupted."""
    outcome = perform(todo, folder, jobs=jobs)
    if outcome.interrupted:
        raise KeyboardInterrupt
    return [outcome.rows[number] for number in range(len(todo.points))]


def _outcome(row: Mapping[str, Any]) -> str:
    asked = row["values"].get("time.steps") or 0
    if row["status"] == "not settled" and asked and row["steps"] == asked:
        return ENDED
    return str(row["status"])


def _is_high(row: Mapping[str, Any]) -> bool:
    """Whether an amplitude exceeds the range of surface.amplitude and must be given over H_c."""
    return row["amplitude"] is not None and row["amplitude"] > MAX_AMPLITUDE


def _check(
    family: str, rows: Sequence[Row], folder: Path, jobs: int, *, finer: bool = False
) -> None:
    """Solve cases with a result again, to a stricter tolerance or on a finer grid."""
    cases = [StressCase(family, r["moes_m"], r["moes_l"], r["points"], r["values"]) for r in rows]
    strict: list[dict[str, Any]] = []
    for row in rows:
        more: dict[str, Any] = dict(STRICT)
        if row["amplitude"] is not None and not _is_high(row):
            # relative to the film the amplitude would change
            more |= {"surface.amplitude_over_film": None, "surface.amplitude": row["amplitude"]}
        if finer:
            more |= {"grid.points": 2 * row["values"]["grid.points"] - 1, "time.steps": 0}
            more |= {"time.estimate_error": False, **dict.fromkeys(STRICT)}
        elif row["steps"] is not None:
            more["time.steps"] = row["steps"]
        strict.append(more)
    todo = plan(study_of(family, cases, strict))
    for row, reported in zip(rows, _solved(todo, folder, jobs), strict=True):
        if not finer:
            judge(row, reported)
        name = "share_finer" if finer else "share_strict"
        judge_share(row, name, reported)


def summary(rows: Sequence[Row]) -> list[Row]:
    """Count outcomes by family."""
    table = []
    for family in [*FAMILIES, "all"]:
        mine = [row for row in rows if family in ("all", row["family"])]
        if not mine:
            continue
        counts = Counter(row["outcome"] for row in mine)
        good = counts["converged"] + counts[ENDED]
        cycles = [row["cycles_per_step"] or row["cycles"] or 0.0 for row in mine]
        table.append(
            {
                "family": family,
                "cases": len(mine),
                "converged": counts["converged"],
                "ended": counts[ENDED],
                "failed": len(mine) - good,
                "checked": sum(row["difference"] is not None for row in mine),
                "wrong": sum(bool(row["wrong"]) for row in mine),
                "cycles": sum(cycles) / len(cycles),
                "most_cycles": max(cycles),
            }
        )
    return table


def work(args: argparse.Namespace) -> int:
    """Run the campaign, print and draw; returns the exit status."""
    if args.boundary_film and args.shear_law == "newtonian":
        raise InputError("--boundary-film needs a --shear-law that thins")
    names = ("stress.json", "stress.png", *folders())
    Destination(args.output, "bench stress", names, force=args.force).claim({})
    try:
        rows = campaign(
            args.cases,
            args.seed,
            args.output,
            jobs=args.jobs,
            grids=args.points,
            law=args.shear_law,
            layer=args.boundary_film,
        )
    except KeyboardInterrupt as stop:
        raise KeyboardInterrupt(f"the same command resumes it in {args.output}") from stop
    asked = ("cases", "seed", "points", "shear_law", "boundary_film")
    answer = header(work) | {name: getattr(args, name) for name in asked}
    answer |= {"summary": summary(rows), "rows": rows}
    write_json(args.output / "stress.json", answer, allow_nan=True)
    draw_outcomes(rows, args.output / "stress.png")
    show(summary(rows), COLUMNS, MEANING)
    return verdict(rows)


def main(words: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__, points=GRIDS)
    add_number(made, "cases", 500, "how many", minimum=1)
    add_number(made, "seed", 1)
    made.add_argument(
        "--shear-law",
        choices=LAWS,
        default="newtonian",
        help="of all cases, each with another stress (default: newtonian)",
    )
    made.add_argument(
        "--boundary-film",
        action="store_true",
        help="all cases with a boundary film, each of another thickness; needs a --shear-law",
    )
    add_number(made, "jobs", 2, "worker processes", minimum=1)
    add_force(made)
    made.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="DIR",
        required=True,
        help="folder of results; an interrupted campaign is resumed in it",
    )
    args = made.parse_args(words)
    return status_of(lambda: work(args))


if __name__ == "__main__":
    sys.exit(main())
