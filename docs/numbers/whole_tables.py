# SPDX-License-Identifier: BSD-3-Clause
"""Whole tables that the scripts of docs/evidence make."""

from __future__ import annotations

import json

from records import ROOT, Values, script

from pyehl.conclusion import conclude


def machines() -> Values:
    """Random machine contacts, their borders and sides, and modes on cells."""
    make, modes = script("machines/make.py"), script("machines/modes.py")
    cells, domains = script("machines/cells.py"), script("machines/domains.py")
    tables = (make.robustness, make.speed, *cells.TABLES, *domains.TABLES)
    return {table.__name__: "\n".join(table()) for table in tables} | {
        "lines": "\n".join(make.robustness(make.LINES)),
        "narrow": "\n".join(make.robustness(make.NARROW)),
        "narrow_times": "\n".join(make.speed(make.NARROW)),
        "modes": "\n".join(modes.lines()),
    }


def gear() -> Values:
    """A rough contact of two flanks: the last lines of its run, and its films."""
    record = json.loads((ROOT / "docs/howto/gear.json").read_text(encoding="utf-8"))
    pairs = [(1e9 * record[f"{n}_m"], 1e9 * record[f"{n}_error_m"]) for n in ("h_c", "h_min")]
    solved = " | ".join(f"{film:.0f} ± {error:.0f} nm" for film, error in pairs)
    unit = 1e9 * record["film_scale_m"]
    limits = [unit * record[f"{name}_extrapolated"] for name in ("H_c", "H_min")]
    extrapolated = " | ".join(f"{film:.1f} nm" for film in limits)
    smooth, rough = (f"{1e9 * record[f'h_min{n}_m']:.0f}" for n in ("", "_rough"))
    return locals() | {"output": f"```text\n{conclude(record)}\n```"}


def rollers() -> Values:
    """Profiles of a roller, and random rollers."""
    make = script("rollers/make.py")
    names = ("table", "random", "by_seed", "remedies")
    result = {name: "\n".join(getattr(make, name)()) for name in names}
    return result | {"dry": "\n".join(script("rollers/dry.py").table())}


def deflection() -> Values:
    """Errors of the multi-integration, for the pages of theory and evidence."""
    theory, evidence = script("deflection/make.py").tables()
    return {"theory": "\n".join(theory), "evidence": "\n".join(evidence)}


def campaigns() -> Values:
    """Random cases and faults."""
    return {name: "\n".join(script(f"{name}/make.py").lines()) for name in ("stress", "faults")}


def times() -> Values:
    """Seconds of steps, runs, smooth contacts and studies."""
    make = script("speed/make.py")
    names = ("steps", "whole", "smooth", "predictions", "ratios", "sweep", "skips")
    return {name: "\n".join(getattr(make, name)()) for name in names}


def shares() -> Values:
    """Load shares under grid refinement, and rough balls compared with dry contact."""
    make = script("contact/make.py")
    result = {name: "\n".join(make.lines(name)) for name in make.CONTACTS}
    return result | {"dry": "\n".join(script("contact/dry.py").lines())}


def inlet() -> Values:
    """Smooth bodies in contact: the stated errors cover at least 95 %."""
    make = script("inlet/make.py")
    rows = make.read()
    for name in make.QUANTITIES:
        known, good = (sum(part[k] for part in make.covered(rows, name).values()) for k in (0, 1))
        assert known > 40
        assert good >= 0.95 * known, name
    return {"lines": "\n".join(make.lines()), "good": make.by_two_grids(rows)}


def start() -> Values:
    """Runs that start from the prediction: the same means in fewer steps."""
    make = script("start/make.py")
    rows = make.rows_of(make.Path(make.__file__).with_name("problems.csv"))
    for row in rows:
        stop = row["error_stop"] + row["error_stop_front"]
        assert abs(row["mu_ratio"] - row["mu_ratio_front"]) <= stop
    return {"rows": [make.line_of(row)[2:-2] for row in rows]}


def mixed_curve() -> Values:
    """Friction from boundary to full-film lubrication."""
    return {"lines": "\n".join(script("mixed_curve/make.py").lines())}


def paper() -> Values:
    """The reproduction of the paper."""
    make = script("paper/make.py")
    judged = (row for row in make.read("table.csv") if row["verdict"] != "not judged")
    rows = [make.line(row) for row in judged if row["piece"] != "table 1"]
    return {"table": "\n".join([*make.HEAD, *rows]), "findings": "\n".join(make.findings())}


def films() -> Values:
    """Measured films of dimples."""
    make = script("films/make.py")
    profiles = (make.read_profiles(make.HERE / f"{n}.csv") for n in ("mourier", "profiles"))
    rows = [[str(cell) for cell in row] for row in make.table(*profiles)]
    return {name: "\n".join(make.lines(rows, name)) for name in ("measured", "simulated")}


def catalogue() -> Values:
    """Random bearings and gear pairs."""
    make = script("catalogue/make.py")
    errors = [float(row["h_c_error_max"]) for row in make.read() if row["h_c_error_max"]]
    return {"lines": "\n".join(make.lines()), "error": 100.0 * max(errors)}
