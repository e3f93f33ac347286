# SPDX-License-Identifier: BSD-3-Clause
"""Convergence and error estimates of random duties or, with --inlets, of random starved inlets.

Circles, ellipses, lines and rollers, smooth and rough, with shear laws and boundary films, whose
load, speed, radius and viscosity change in waves, steps and reversals. The error estimates of the
time steps are compared with runs of half the step at every instant, those of the results with
solutions on twice the nodes (except rollers). Grids have 65 nodes along X (lines 129), and two or
four times as many if the film becomes negative.
"""

import argparse
import resource
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from common import add_number, columns, measure, parser, say, show

import pyehl
from pyehl.case import Case
from pyehl.errors import InputError
from pyehl.theory.line_contact import scaling_contact
from pyehl.types import Array, Row

SHAPES = ("circle", "ellipse", "line", "roller")
KINDS = ("wave", "step", "reversal")
LAWS = ("newtonian", "eyring", "carreau")
QUANTITIES = ("load", "mean_velocity", "radius_x", "viscosity")
FILMS = ("h_c_m", "h_min_m", "p_max_Pa")
EXTREMES = (
    *("h_c_min_m", "h_c_max_m", "h_min_min_m", "h_min_max_m", "p_max_Pa", "mu_max"),
    *("power_max_W", "flash_max_K"),
)
TOLERANCE = 5e-5
"""Relative error from the convergence tolerance of a step."""
POINTS = {"circle": 65, "ellipse": 65, "line": 129, "roller": 65}
MAX_REFINEMENTS = 2
"""Maximum number of refinements of a grid on which the film becomes negative."""
REFUSED = "refused"
COLUMNS = columns(
    "contacts:s drawn:d converged:d refused:d median_seconds:.2f largest_seconds:.1f "
    "steps_covered:.3f worst_steps:.2f extremes:d extremes_covered:d worst_extreme:.2f"
)
MEANING = (
    "seconds: of the processor, one thread; steps covered: fraction of instants at which the\n"
    "stated error of h_c, h_min and p_max covers the difference to half the time step; extremes: "
    "compared with twice the nodes; worst: difference over error"
)
INLET_COLUMNS = columns(
    "contacts:s drawn:d converged:d refused:d median_seconds:.2f checked:d h_c_covered:d "
    "h_min_covered:d largest_imbalance:.1e"
)


def _scale(rng: np.random.Generator, low: float, high: float) -> float:
    """Draw a number, log-uniformly."""
    return float(f"{np.exp(rng.uniform(np.log(low), np.log(high))):.4g}")


def contact(rng: np.random.Generator, shape: str) -> dict[str, Any]:
    """Draw the steady case, with a load for a realistic Hertz pressure."""
    keys: dict[str, Any] = {"mean_velocity": _scale(rng, 0.2, 10.0)}
    keys["slide_to_roll"] = round(float(rng.uniform(0.0, 1.0)), 3)
    radius = _scale(rng, 4e-3, 0.02)
    if shape in ("circle", "line"):
        keys["radius"] = radius
    elif shape == "ellipse":
        keys |= {"radius_x": radius, "radius_y": float(f"{radius * _scale(rng, 0.4, 15.0):.4g}")}
    if shape in ("line", "roller"):
        keys["shape"] = shape
    if shape == "line":
        keys["load_per_length"] = _scale(rng, 2e4, 4e5)
    elif shape == "roller":
        length = _scale(rng, 2e-3, 8e-3)
        load = float(f"{_scale(rng, 3e4, 1e5) * length:.4g}")
        crown = _scale(rng, 0.1, 1.0)
        keys |= {"radius": radius, "length": length, "load": load}
        keys |= {"profile": "crown", "crown_radius": crown}
    else:
        across = keys.get("radius_y", radius)
        # Hertz pressure of about 0.4 to 1.3 GPa
        keys["load"] = float(f"{_scale(rng, 2e4, 7e5) * radius**0.8 * across**1.2:.4g}")
    values = {f"contact.{key}": value for key, value in keys.items()}
    values["lubricant.viscosity"] = _scale(rng, 0.01, 0.2)
    law = str(rng.choice(LAWS))
    values["lubricant.shear_law"] = law
    if law != "newtonian":
        values[f"lubricant.{law}_stress"] = _scale(rng, 3e6, 1e7)
    if law == "carreau":
        values["lubricant.carreau_exponent"] = round(float(rng.uniform(0.5, 0.9)), 3)
    return values | {"grid.points": POINTS[shape], "solver.threads": 1}


def duty(rng: np.random.Generator, shape: str) -> tuple[str, dict[str, Any]]:
    """Draw a case under a duty; returns the kind of the duty and the case."""
    values = contact(rng, shape)
    kind = str(rng.choice(KINDS))
    one = scaling_contact(Case.from_text("", values).resolve())
    length = _scale(rng, 2.0, 5.0)
    time = np.linspace(0.0, length, 17)
    reference = {
        "load": values.get("contact.load", values.get("contact.load_per_length")),
        "mean_velocity": values["contact.mean_velocity"],
        "radius_x": values.get("contact.radius_x", values.get("contact.radius")),
        "viscosity": values["lubricant.viscosity"],
    }
    names = [str(name) for name in rng.permutation(QUANTITIES)[: rng.integers(1, 3)]]
    if kind == "reversal":
        names = ["mean_velocity", *(name for name in names if name != "mean_velocity")]
    for name in names:
        size = rng.uniform(0.1, 0.5)
        if name == "mean_velocity" and kind == "reversal":
            ratio = np.interp(
                time / length, (0.0, 0.2, 0.2 + 0.6 * size + 0.2, 1.0), (1, 1, -1, -1)
            )
        elif kind == "step":
            ratio = np.interp(
                time / length, (0.0, 0.2, 0.2 + 0.6 * size, 1.0), (1, 1, 1 - size, 1 - size)
            )
        else:
            ratio = 1.0 + size * np.sin(2.0 * np.pi * time / length)
            ratio[-1] = ratio[0]
        values[f"duty.{name}"] = tuple(float(f"{v:.6g}") for v in reference[name] * ratio)
    values["duty.time"] = tuple(float(f"{v:.6g}") for v in time * one.time_scale)
    if kind == "wave":
        values["duty.interpolation"] = "cubic"
    if kind == "reversal":
        values |= {"grid.x_inlet": -3.0, "grid.x_outlet": 3.0}
    if shape != "roller" and rng.random() < 0.3:
        film = pyehl.film(Case.from_text("", _steady(values))).formulas[0]["h_c_m"]
        if rng.random() < 0.5:
            values |= {"surface.kind": "harmonic", "surface.wavelength": 1.0}
            relative = rng.uniform(0.05, 0.3)
            height = film / one.film_scale * relative
            # in a thick film an amplitude above a^2/R is given over the film
            name = "amplitude_over_film" if height > 1.0 else "amplitude"
            value = relative if height > 1.0 else height
            values[f"surface.{name}"] = float(f"{value:.3g}")
        else:
            values["lubricant.boundary_film"] = float(f"{film * rng.uniform(0.3, 1.0):.3g}")
            values["lubricant.boundary_friction"] = 0.1
    return kind, values


def _steady(values: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in values.items() if not key.startswith("duty.")}


def inlet(rng: np.random.Generator, shape: str) -> tuple[str, dict[str, Any]]:
    """Draw a case with a starved inlet; returns how it is starved, and the case."""
    values = contact(rng, shape)
    case = Case.from_text("", values)
    one, film = scaling_contact(case.resolve()), float(pyehl.film(case).formulas[0]["h_c_m"])
    if rng.random() < 0.4:
        position = float(rng.uniform(1.1, 2.5)) * one.hertz_radius
        return "position", values | {"inlet.position": float(f"{position:.4g}")}
    layer = film * _scale(rng, 0.1, 1.5) * (1.0 if shape == "line" else 1.5)
    values["inlet.film"] = float(f"{layer:.4g}")
    if rng.random() < 0.3:
        values |= {"inlet.passages": 3, "inlet.replenishment": round(float(rng.uniform(0, 1)), 2)}
    return "layer", values


def solve(values: Mapping[str, Any], **more: Any) -> tuple[xr.Dataset, float]:  # noqa: ANN401
    """Solve, converged or not; returns the result and the processor time [s]."""
    began = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    result = pyehl.solve(Case.from_text("", dict(values) | more), check=False)
    return result, resource.getrusage(resource.RUSAGE_SELF).ru_utime - began


def solve_on_enough(values: dict[str, Any]) -> tuple[xr.Dataset, float]:
    """Solve, on twice the nodes where the film becomes negative, as that message recommends.

    `values` then have these nodes, for the runs to compare with.
    """
    result, seconds = solve(values)
    for _ in range(MAX_REFINEMENTS):
        if result.attrs["status"] != "negative film":
            break
        values["grid.points"] = 2 * values["grid.points"] - 1
        result, more = solve(values)
        seconds += more
    return result, seconds


def finer(values: Mapping[str, Any], result: xr.Dataset) -> dict[str, int]:
    """Return the keys for twice the nodes."""
    keys = {"grid.points": 2 * values["grid.points"] - 1}
    if result.sizes["Y"] > 1 and values.get("contact.shape") != "line":
        keys["grid.points_y"] = 2 * result.sizes["Y"] - 1
    return keys


def step_errors(result: xr.Dataset, half: xr.Dataset) -> tuple[float, float]:
    """Fraction of instants covered by the stated errors; largest difference over largest error."""
    errors = [result[f"history_{name}_step_error"].values for name in ("c", "min", "p")]
    holds: list[Array] = []
    worst = 0.0
    for name, error in zip(FILMS, errors, strict=True):
        values = result[f"history_{name}"].values
        # at second order half the step has a quarter of the error
        other = np.interp(result.history_t_s, half.history_t_s, half[f"history_{name}"])
        difference = np.abs(other / values - 1.0) * 4.0 / 3.0
        holds.append(difference <= error + TOLERANCE)
        worst = max(worst, float(difference.max() / (error.max() + TOLERANCE)))
    return float(np.mean(holds)), worst


def shares_covered(result: xr.Dataset, half: xr.Dataset) -> dict[str, float]:
    """Fractions of instants at which the stated errors of friction and load share suffice."""
    covered = {}
    for name, error in (("mu", "mu_step_error"), ("load_share", "load_share_error")):
        if f"history_{name}" not in result or not np.isfinite(result[f"history_{name}"]).all():
            continue
        values, stated = (result[f"history_{n}"].values for n in (name, error))
        other = np.interp(result.history_t_s, half.history_t_s, half[f"history_{name}"])
        difference = np.abs(other - values) * 4.0 / 3.0
        tolerance = TOLERANCE * np.abs(values).max()
        covered[f"{name}_covered"] = float(np.mean(difference <= stated + tolerance))
    return covered


def extremes(result: xr.Dataset, fine: xr.Dataset) -> dict[str, float]:
    """Differences of the extremes from those on twice the nodes, over their stated errors."""
    ratios = {}
    for name in EXTREMES:
        stem, _, unit = name.rpartition("_")
        error = f"duty_{name}_error" if name == "mu_max" else f"duty_{stem}_error_{unit}"
        value, other, stated = (float(d[n]) for d, n in (
            (result, f"duty_{name}"), (fine, f"duty_{name}"), (result, error)))  # fmt: skip
        if np.isfinite(value) and np.isfinite(other) and stated > 0.0:
            ratios[name] = abs(value - other) / stated
    return ratios


def one_duty(values: dict[str, Any]) -> Row:
    """Solve a duty, also with half the step and on twice the nodes."""
    result, seconds = solve_on_enough(values)
    row: Row = {"status": result.attrs["status"], "seconds": seconds}
    row["message"] = result.attrs.get("message")
    row["steps"] = result.sizes.get("history")
    if row["status"] != "converged":
        return row
    half, _ = solve(values, **{"duty.time_step": 0.5})
    row["half_status"] = half.attrs["status"]
    if row["half_status"] == "converged":
        row["steps_covered"], row["worst_steps"] = step_errors(result, half)
        row |= shares_covered(result, half)
    if values.get("contact.shape") == "roller":
        # on twice the nodes a roller takes ten times as long as all other runs
        return row
    fine, _ = solve(values, **finer(values, result))
    row["fine_status"] = fine.attrs["status"]
    if row["fine_status"] == "converged":
        row["extremes"] = extremes(result, fine)
    return row


def one_inlet(values: dict[str, Any]) -> Row:
    """Solve a starved contact, also on twice the nodes."""
    result, seconds = solve_on_enough(values)
    row: Row = {"status": result.attrs["status"], "seconds": seconds}
    row["message"] = result.attrs.get("message")
    if row["status"] != "converged":
        return row
    row |= {name: float(result[name]) for name in ("H_c", "H_c_error", "H_min", "H_min_error")}
    row["oil_imbalance"] = float(result.get("oil_imbalance", np.nan))
    fine, _ = solve(values, **finer(values, result))
    row["fine_status"] = fine.attrs["status"]
    row |= {f"{name}_fine": float(fine[name]) for name in ("H_c", "H_min")}
    return row


def campaign(count: int, seed: int, *, inlets: bool) -> list[Row]:
    """Solve `count` cases of a seed; a row for each, the first rows independent of `count`."""
    rows: list[Row] = []
    for number in range(count):
        rng = np.random.default_rng((seed, number))
        # rollers have no &inlet
        shape = SHAPES[number % (3 if inlets else 4)]
        kind, values = (inlet if inlets else duty)(rng, shape)
        try:
            row = (one_inlet if inlets else one_duty)(values)
        except InputError as error:
            row = {"status": REFUSED, "message": str(error), "seconds": None}
        row = {"number": number, "shape": shape, "kind": kind, "values": values} | row
        rows.append(row)
        say(f"{number + 1} of {count}: {shape}, {kind}, {row['status']}")
    return rows


def _common(name: str, rows: Sequence[Row]) -> Row:
    seconds = [row["seconds"] for row in rows if row["seconds"]]
    states = Counter(row["status"] for row in rows)
    return {
        "contacts": name,
        "drawn": len(rows),
        "converged": states["converged"],
        "refused": states[REFUSED],
        "median_seconds": float(np.median(seconds)) if seconds else None,
        "largest_seconds": max(seconds, default=None),
    }


def duties_of(name: str, rows: Sequence[Row]) -> Row:
    """Summarise the rows of duties."""
    steps = [row["steps_covered"] for row in rows if "steps_covered" in row]
    ratios = [r for row in rows for r in row.get("extremes", {}).values()]
    return _common(name, rows) | {
        "steps_covered": float(np.mean(steps)) if steps else None,
        "worst_steps": max(
            (row["worst_steps"] for row in rows if "worst_steps" in row), default=None
        ),
        "extremes": len(ratios),
        "extremes_covered": sum(r <= 1.0 for r in ratios),
        "worst_extreme": max(ratios, default=None),
    }


def inlets_of(name: str, rows: Sequence[Row]) -> Row:
    """Summarise the rows of inlets."""
    # only rows with an error estimate
    checked = [
        row
        for row in rows
        if row.get("fine_status") == "converged" and np.isfinite(row["H_c_error"])
    ]

    def holds(what: str) -> int:
        return sum(abs(r[what] - r[f"{what}_fine"]) <= r[f"{what}_error"] for r in checked)

    oil = [abs(r["oil_imbalance"]) for r in checked if np.isfinite(r["oil_imbalance"])]
    return _common(name, rows) | {
        "checked": len(checked),
        "h_c_covered": holds("H_c"),
        "h_min_covered": holds("H_min"),
        "largest_imbalance": max(oil, default=None),
    }


def work(args: argparse.Namespace) -> Row:
    """Measure and print."""
    rows = campaign(args.count, args.seed, inlets=args.inlets)
    groups = {shape: [row for row in rows if row["shape"] == shape] for shape in SHAPES}
    groups["all"] = list(rows)
    count = inlets_of if args.inlets else duties_of
    result = [count(name, mine) for name, mine in groups.items() if mine]
    show(result, INLET_COLUMNS if args.inlets else COLUMNS, "" if args.inlets else MEANING)
    return {"seed": args.seed, "count": args.count, "summary": result, "rows": rows}


def main(words: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__)
    add_number(made, "seed", 1)
    add_number(made, "count", 40, "how many cases", minimum=1)
    made.add_argument("--inlets", action="store_true", help="inlets short of oil, not duties")
    return measure(work, made, words)


if __name__ == "__main__":
    sys.exit(main())
