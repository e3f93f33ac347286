# SPDX-License-Identifier: BSD-3-Clause
"""Constants of the Fortran sources that the theory pages state."""

from __future__ import annotations

import re

from records import ROOT, Values

WORDS = "none one two three four five six seven eight nine ten".split()
ORDINALS = "zeroth first second third fourth fifth sixth seventh eighth ninth tenth".split()


def constants(file: str, names: str) -> Values:
    """Constants of a source by name: a number, or the list in [...] or merge(...)."""
    text = (ROOT / "fortran" / file).read_text(encoding="utf-8")
    result = {}
    for name in names.split():
        value = re.search(rf"\b{name}(?:\(\w+\))? = (\S*\[.*?\]|merge\(.*|[\d.]+)", text)
        assert value, f"{file}: no constant {name}"
        numbers = [float(n) for n in re.findall(r"(?<![\w.])\d+(?:\.\d+)?", value[1])]
        result[name] = numbers if value[1].endswith(("]", ")")) else numbers[0]
    return result


def coarsening() -> Values:
    """When grids are coarsened in one direction only, and the limits."""
    result = constants("multigrid/hierarchy.f90", "long_y max_unknowns")
    result |= constants("grid/grid.f90", "long_x")
    return result | constants("case/case_grid.f90", "few_rows")


def cells() -> Values:
    """Shapes of cells, and the sharp pressure spike."""
    names = "min_ratio largest_ratio largest_smooth high_spike blunt_spike"
    return constants("multigrid/workspace.f90", "long") | constants("case/case_grid.f90", names)


def guard() -> Values:
    """When failing cycles are rejected, damped or accelerated."""
    result = constants("multigrid/cycle.f90", "damped_log_change damped_sweep damped_correction")
    lines = [
        "| degree | limit on changes of ln ε, relative | factor on changes in a sweep | factor on "
        "coarse-grid corrections |",
        "|---|---|---|---|",
    ]
    for degree, (limit, sweep, correction) in enumerate(zip(*result.values(), strict=True), 1):
        change = "–" if limit == 1.0 else f"1/{limit:g}"
        lines.append(f"| {degree} | {change} | {sweep:g} | {correction:g} |")
    result |= constants("solve/smooth_contact.f90", "max_residual")
    names = "undamped_after patience stalled stalls_after max_growth"
    result |= constants("solve/cycle_guard.f90", names)
    result |= constants("multigrid/anderson.f90", "depth")
    result |= {name: WORDS[int(result[name])] for name in ("undamped_after", "patience", "depth")}
    return result | {"lines": "\n".join(lines), "stalls": ORDINALS[int(result["stalls_after"])]}
