# SPDX-License-Identifier: BSD-3-Clause
"""The record of ``python examples/zhang2019/reproduce.py``: python make.py FOLDER.

Runs the tier ``--quick`` and, of ``--full``, Fig. 6 and Table 2 up to 513 nodes per side (half an
hour on one processor), writes table.csv, findings.csv and pictures beside this file, and prints the
tables of docs/validation.md and README.md. A second run with the same folder continues the first;
without a folder the script prints the stored tables.
"""

from __future__ import annotations

import csv
import re
import shutil
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "examples/zhang2019"))
from driver import PIECES, reproduce
from piece import FULL, QUICK, Level, Result

HERE = Path(__file__).resolve().parent
# Without 1025 nodes per side, which take longer than all the rest
RUNS: tuple[tuple[Level, Sequence[str]], ...] = (
    (QUICK, tuple(PIECES)),
    (replace(FULL, meshes=(257, 513)), ("figure 6", "table 2")),
)
PICTURES = ("figure 2", "figure 4", "figure 7")
COLUMNS = "tier piece quantity grid paper pyehl deviation tolerance verdict reason source".split()

HEAD = (
    "| part | quantity | grid | paper | source | pyehl | deviation | tolerance | verdict |",
    "|---|---|---|---|---|---|---|---|---|",
)


def grid_of(name: str, piece: str, level: Level) -> str:
    """Nodes per side of the grid of a number; '' for none."""
    if match := re.search(r"(\d+) x \1 nodes", name):
        return match[1]
    if piece == "figure 2":
        return str(level.wave_grids[-1])
    if piece == "table 2":
        return str(level.meshes[-1])
    if piece in ("figure 3", "figure 4"):
        return str(level.collapse_grid)
    return str(level.surface_grid) if piece in ("figure 6", "figure 7") else ""


def rows_of(level: Level, result: Result) -> Iterator[tuple[str, ...]]:
    """Rows of table.csv of a piece."""
    for check in result.checks:
        rounding = abs(check.deviation) < 1e-9 * abs(check.expected)
        yield (
            level.name,
            result.name,
            check.name,
            grid_of(check.name, result.name, level),
            f"{check.expected:.6g}",
            f"{check.value:.6g}",
            "0" if rounding else f"{check.deviation:+.3g}",
            "" if check.tolerance is None else f"{check.tolerance:.2g}",
            "not reproduced" if check.explained else check.verdict,
            check.finding if check.explained else check.why,
            check.source,
        )


def write(name: str, head: Iterable[str], rows: Iterable[Iterable[str]]) -> None:
    """Write a table beside this file."""
    with (HERE / name).open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(head)
        writer.writerows(rows)


def read(name: str) -> list[dict[str, str]]:
    """Rows of a table beside this file."""
    with (HERE / name).open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def make(folder: Path) -> None:
    """Run, and write the record."""
    rows: list[tuple[str, ...]] = []
    findings: list[tuple[str, ...]] = []
    for level, names in RUNS:
        for result in reproduce(names, level, folder / level.name, jobs=1):
            # results on meshes of both tiers appear once
            known = {row[1:] for row in rows}
            rows += (row for row in rows_of(level, result) if row[1:] not in known)
            findings += [(level.name, result.name, f.title, f.text) for f in result.findings]
            if level is QUICK and result.name in PICTURES:
                shutil.copyfile(result.file(".png"), HERE / result.file(".png").name)
    rows.sort(key=lambda row: list(PIECES).index(row[1]))
    write("table.csv", COLUMNS, rows)
    write("findings.csv", ("tier", "piece", "title", "text"), findings)


def line(row: Mapping[str, str]) -> str:
    """Give the row of docs/validation.md."""
    names = "piece quantity grid paper source pyehl deviation tolerance verdict".split()
    cells = [row[name] for name in names]
    cells[1] = re.sub(r",? ?\d+ x \d+ nodes(?=,|$),? ?", ", ", cells[1]).strip(", ")
    return "| " + " | ".join(cells) + " |"


def finding(row: Mapping[str, str]) -> str:
    """Give the item of README.md."""
    return f"- **{row['title']}** ({row['piece']}, `--{row['tier']}`). {row['text']}"


def findings() -> list[str]:
    """Give the list of README.md; a finding of both tiers appears once, from the finer grids."""
    return list(map(finding, {row["title"]: row for row in read("findings.csv")}.values()))


def main(arguments: Sequence[str]) -> None:
    """Run if a folder is given; print the stored tables."""
    if arguments:
        make(Path(arguments[0]).resolve())
    text = [*HEAD, *(line(row) for row in read("table.csv") if row["piece"] != "table 1")]
    text += ["", *findings()]
    sys.stdout.write("\n".join(text) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:])
