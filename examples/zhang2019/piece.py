# SPDX-License-Identifier: BSD-3-Clause
"""Figures and tables of the paper: levels of effort, references, checks and results."""

import csv
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol, Self

from runs import Made, Runs

from pyehl.errors import InternalError
from pyehl.plots.style import Figure


@dataclass(frozen=True, slots=True)
class Level:
    """Level of effort: how much of the paper is computed."""

    name: str
    # Nodes per side of Fig. 2, the coarsest first; the last is compared with the paper
    wave_grids: tuple[int, ...]
    collapse_grid: int  # nodes per side of the waves of Figs 3 and 4
    film_grid: int  # nodes per side of the smooth contacts to whose film amplitudes are relative
    surface_grid: int  # nodes per side of the surfaces of Figs 6 and 7
    meshes: tuple[int, ...]  # nodes per side of Table 2
    surfaces: int  # number of surfaces of Fig. 7
    leaves_out: str  # what the level omits, in words


QUICK = Level(
    "quick",
    wave_grids=(257, 513),
    collapse_grid=257,
    film_grid=513,
    surface_grid=257,
    meshes=(129, 257),
    surfaces=4,
    leaves_out=(
        "the waves of Figs 3 and 4 are on 257 x 257 nodes in place of 513 x 513; Fig. 6 and Fig. 7 "
        "are on 257 x 257, Fig. 7 has 4 surfaces of 20; Table 2 ends at 257 x 257"
    ),
)
FULL = Level(
    "full",
    wave_grids=(257, 513),
    collapse_grid=513,
    film_grid=513,
    surface_grid=513,
    meshes=(257, 513, 1025),
    surfaces=20,
    leaves_out=(
        "nothing of the paper; beyond it, Fig. 7 on more than 513 x 513 nodes, and error estimates "
        "from coarser grids except for Fig. 2 and Table 2"
    ),
)
FILE = Path(__file__).with_name("zhang2019.csv")
LEVELS = {level.name: level for level in (QUICK, FULL)}


@dataclass(frozen=True, slots=True)
class Reference:
    """One number of the paper."""

    name: str
    # As printed
    value: float
    unit: str
    # Page, place on it, and how it was read: 'text', 'table', 'derived', 'digitised'
    page: str
    where: str
    how: str
    reading: float  # uncertainty of the reading, in the same unit
    # Allowed deviation, in the same unit; None: not compared
    tolerance: float | None
    why: str  # reason for the tolerance, or for none


References = Mapping[str, Reference]


def read_references() -> dict[str, Reference]:
    """Read the numbers of the paper."""
    text = FILE.read_text(encoding="utf-8")
    result = {}
    for row in csv.DictReader(x for x in text.splitlines() if not x.startswith("#")):
        try:
            values: dict[str, Any] = dict(row)
            for key in ("value", "reading", "tolerance"):
                values[key] = float(row[key]) if row[key] or key != "tolerance" else None
            result[row["name"]] = Reference(**values)
        except (KeyError, TypeError, ValueError) as error:
            raise InternalError(f"{FILE.name}: a row is not complete: {row} ({error})") from error
    return result


@dataclass(frozen=True, slots=True)
class Check:
    """Comparison of a computed number with one of the paper or of another program."""

    name: str  # the quantity, in words
    value: float  # ours; NaN without a result
    expected: float  # theirs
    tolerance: float | None  # allowed deviation; None: reported, not judged
    why: str  # reason for the tolerance, or for none
    source: str  # source of theirs
    # Title of the `Finding` that explains a deviation beyond the tolerance
    finding: str = ""

    @classmethod
    def of(cls, name: str, result: float, reference: Reference, *, finding: str = "") -> Self:
        """Compare with a number of the paper."""
        r = reference
        unit = "" if r.unit == "-" else f" [{r.unit}]"
        source = f"p. {r.page}, {r.where} ({r.how})"
        return cls(f"{name}{unit}", result, r.value, r.tolerance, r.why, source, finding)

    @property
    def deviation(self) -> float:
        """Ours minus theirs."""
        return self.value - self.expected

    @property
    def judged(self) -> bool:
        """Whether there is a tolerance."""
        return self.tolerance is not None

    @property
    def passed(self) -> bool:
        """Whether it is within its tolerance, or not judged."""
        if self.tolerance is None:
            return True
        # inputs must agree up to rounding
        return abs(self.deviation) <= self.tolerance + 1e-12 * abs(self.expected)

    @property
    def explained(self) -> bool:
        """Whether it is beyond its tolerance and a finding of the report explains it."""
        return not self.passed and bool(self.finding)

    @property
    def verdict(self) -> str:
        """'pass', 'FAIL', 'not judged', or why the paper is not reproduced."""
        if self.explained:
            return f"FAIL, not reproduced: {self.finding}"
        return ("pass" if self.passed else "FAIL") if self.judged else "not judged"

    def row(self) -> dict[str, str]:
        """Return its row in the table of the report."""
        share = f" ({100.0 * self.deviation / self.expected:+.2f} %)" if self.expected else ""
        known = math.isfinite(self.value)
        allowed = "-" if self.tolerance is None else f"{self.tolerance:.2g}"
        return {
            "number": self.name,
            "ours": f"{self.value:.6g}" if known else "no result",
            "theirs": f"{self.expected:.6g}",
            "where theirs is from": self.source,
            "deviation": f"{self.deviation:+.3g}{share}" if known else "-",
            "tolerance": f"{allowed}: {self.why}",
            "verdict": self.verdict,
        }

    def __str__(self) -> str:
        """Return the row in a line."""
        name, *cells = self.row().items()
        return f"{name[1]}: " + ", ".join(f"{head} {cell}" for head, cell in cells)


@dataclass(frozen=True, slots=True)
class Finding:
    """An explanation why the paper is not reproduced; `text` has numbers of the runs."""

    title: str
    text: str


@dataclass(frozen=True, slots=True)
class Result:
    """A reproduced piece of the paper; `reproduce` names it and writes its files."""

    checks: Sequence[Check] = ()  # comparisons with the paper
    # Column names and rows of the numbers of the picture; None where a run has failed
    table: tuple[Sequence[str], Sequence[Iterable[object]]] | None = None
    figure: Figure | None = None
    caption: str = ""
    notes: Sequence[str] = ()  # remarks of a sentence or two each
    findings: Sequence[Finding] = ()  # where the paper is not reproduced
    studies: Sequence[Made] = ()  # studies used
    alone: float = 0.0  # processor time outside of studies [s]
    paper_seconds: str = ""  # the time that the paper states, in words; '' for none
    # 'figure 2', its title, its folder, and its elapsed time [s]
    name: str = ""
    title: str = ""
    folder: Path = Path()
    wall: float = 0.0
    failed: str = ""  # the run without a result that prevents this piece; '' if none
    unjudged: str = ""  # why none of its numbers can be judged; '' if some can

    def file(self, suffix: str) -> Path:
        """Return the path of its '.csv' or '.png'."""
        return self.folder / f"{self.folder.name}{suffix}"

    @property
    def seconds(self) -> float:
        """Processor time [s]."""
        return self.alone + sum(made.seconds for made in self.studies)

    @property
    def passed(self) -> bool:
        """Whether each deviation beyond its tolerance is explained by a finding."""
        return not self.failed and all(check.passed or check.explained for check in self.checks)

    @property
    def verdict(self) -> str:
        """'pass', 'FAIL', 'not reproduced' (a finding explains it) or 'nothing to judge'."""
        if not self.passed:
            return "FAIL"
        if not any(check.judged for check in self.checks):
            return "nothing to judge"
        return "pass" if all(check.passed for check in self.checks) else "not reproduced"

    def line(self) -> str:
        """Return the summary of its checks in a line."""
        if self.failed:
            return f"FAIL: {self.failed}"
        judged = [check for check in self.checks if check.judged]
        if not judged:
            return f"{self.verdict}: {self.unjudged}" if self.unjudged else self.verdict
        failed = [check for check in judged if not check.passed]
        explained = sum(check.explained for check in failed)
        line = f"{len(judged) - len(failed)} of {len(judged)} numbers within their tolerance"
        others = len(self.checks) - len(judged)
        line += f", {explained} not reproduced, explained below" if explained else ""
        line += f", {others} not judged" if others else ""
        return f"{self.verdict}: {line}"


class Piece(Protocol):
    """A figure or table of the paper.

    `run` computes without the numbers of the paper; `show` draws and compares its results.
    """

    NAME: str
    TITLE: str

    def run(self, runs: Runs, level: Level) -> Any:  # noqa: ANN401 (each its own)
        """Run the studies and evaluate them."""

    def show(
        self,
        data: Any,  # noqa: ANN401
        references: References,
        level: Level,
    ) -> Result:
        """Draw, and compare with the paper."""
