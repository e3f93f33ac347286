# SPDX-License-Identifier: BSD-3-Clause
"""Compare predictions of contacts with a boundary film with solutions of the same contacts.

Seed and number determine a contact. For each one, the smooth contact of its prediction is compared
with a solution on the same grid, a prediction with vanishing roughness with the same solution, and,
for the first ones (``--simulate``), the prediction with a simulation of the rough contact. The
numbers of every summary must be consistent (`contradictions`).
"""

import argparse
import math
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from common import add_number, columns, measure, parser, say, show

import pyehl
from pyehl.contact.smooth import INLET, RESOLVED
from pyehl.errors import EhlError, InputError
from pyehl.solver import Solver
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Row

GRIDS = (65, 129)
"""Nodes along X of the simulations."""
LENGTH = 4.0
"""Length of the domain along X [a]."""
NODES = 8
"""Nodes per shortest wavelength."""
SAME = 1e-9
"""Largest relative difference of two values of one quantity."""
ENDED = 1e-3
"""Largest relative difference of solutions whose cycles ended at different residuals."""
MIN_M, MAX_M = 100.0, 1000.0
"""Range of M, within that of the response for most contacts."""
POINTS_ERROR = 0.02
"""Error of friction and load share from sums over the points of a prediction, which are not the
nodes of a solution."""
NO_HEIGHT = 1e-13
"""Rms height [m] of a surface whose prediction is that of the smooth contact."""
FILMS = ("h_c_m", "h_min_m", "p_max_Pa")
SHARE = "contact_load_share"

COLUMNS = columns(
    "kind:s contacts:d compared:d touching:d no_number:d failed:d wrong:d largest_ratio:.2f"
)
MEANING = (
    "compared: both have a load share; touching: it is not 0; no number: the prediction has none, "
    "and says why;\nfailed: no prediction or no solution; wrong: a difference above the stated "
    "errors, or numbers that contradict each other;\nlargest ratio: of a difference of load shares "
    "to the allowed one"
)
"""Meaning of the columns."""


@dataclass(frozen=True, slots=True)
class Contact:
    """A contact with the keys of its case; those of its surface are separate."""

    number: int
    points: int  # nodes along X of the simulation
    over: float  # boundary film over the central film by formula, both at the Hertz pressure
    keys: Mapping[str, Any]
    surface: Mapping[str, Any]


def draw(count: int, seed: int, grids: Sequence[int] = GRIDS) -> list[Contact]:
    """Draw contacts; the first ones do not depend on `count`."""
    return [_one(k, np.random.default_rng((seed, k)), grids) for k in range(count)]


def _scale(rng: np.random.Generator, low: float, high: float) -> float:
    return float(f"{math.exp(rng.uniform(math.log(low), math.log(high))):.4g}")


def _one(number: int, rng: np.random.Generator, grids: Sequence[int]) -> Contact:
    """Draw until the case is valid, the grid resolves the inlet, and M is within its range."""
    points = int(grids[number % len(grids)])
    while True:
        law = str(rng.choice(("eyring", "eyring", "carreau", "limiting")))
        keys: dict[str, Any] = {
            "contact.load": _scale(rng, 5.0, 200.0),
            "contact.mean_velocity": _scale(rng, 0.05, 2.0),
            "contact.radius": _scale(rng, 0.005, 0.02),
            "contact.slide_to_roll": float(rng.choice((0.0, 0.02, 0.1, 0.3, 0.6))),
            "lubricant.viscosity": _scale(rng, 0.01, 0.1),
            "lubricant.pressure_viscosity": round(rng.uniform(1e-8, 2.4e-8), 10),
            "lubricant.shear_law": law,
            "lubricant.boundary_film": 1e-9,
            "lubricant.boundary_friction": float(rng.choice((0.0, 0.05, 0.1, 0.1, 0.15))),
            "lubricant.thermal_friction": str(rng.choice(("auto", "never"))),
            "lubricant.temperature_viscosity": 0.03,
            "grid.points": points,
            "grid.x_inlet": -2.5,
            "grid.x_outlet": LENGTH - 2.5,
            "grid.y_extent": 0.5 * LENGTH,
        }
        if rng.random() < 0.3:
            radius, wide = keys.pop("contact.radius"), _scale(rng, 0.7, 4.0)
            keys |= {"contact.radius_x": radius, "contact.radius_y": float(f"{radius * wide:.4g}")}
        if law == "carreau":
            keys |= {"lubricant.carreau_stress": 5e6, "lubricant.carreau_exponent": 0.6}
        over, rough = rng.uniform(0.1, 1.05), rng.uniform(0.05, 0.8)
        try:
            settings = pyehl.Case.from_text("", keys).resolve()
        except InputError:
            continue
        point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
        film = central_film(point, oil)
        missed = INLET * (LENGTH / (points - 1)) ** 2 * (film / point.film_scale) ** (-4.0 / 3.0)
        if missed > RESOLVED or not MIN_M < point.equivalent_moes[0] < MAX_M:
            continue
        a = point.hertz_radius
        keys["lubricant.boundary_film"] = float(
            f"{over * film * float(oil.density_ratio(point.hertz_pressure)):.4g}"
        )
        surface = {
            "surface.kind": "fractal",
            "surface.rms_height": float(f"{rough * film:.4g}"),
            "surface.hurst": round(rng.uniform(0.5, 1.0), 3),
            "surface.seed": number + 1,
            "surface.length_x": float(f"{a:.5g}"),
            "surface.length_y": float(f"{a:.5g}"),
            "surface.pixels": 128,
            "surface.shortest_wavelength": float(f"{NODES * LENGTH / (points - 1) * a:.5g}"),
        }
        return Contact(number, points, over, keys, surface)


def _known(values: Iterable[Any]) -> list[float]:
    """Return the numbers, or an empty list if one of them is missing."""
    result = list(values)
    return [] if None in result else result


def contradictions(result: Mapping[str, Any]) -> list[str]:
    """Return descriptions of the contradictions between the numbers of a summary."""
    wrong = []

    def product(mu: str, smooth: str) -> None:
        values = _known(result.get(name) for name in (mu, smooth, "mu_ratio"))
        if values and not math.isclose(values[0], values[1] * values[2], rel_tol=SAME):
            wrong.append(f"{mu} = {smooth} mu_ratio")

    product("mu", "mu_smooth")
    product("mu_isothermal", "mu_smooth_isothermal")
    share, error = result.get(SHARE), result.get(f"{SHARE}_error")
    note = result.get(f"{SHARE}_error_note") or ""
    numbers = [result.get(n) for n in ("mu", "mu_ratio", *FILMS, "h_min_rough_m")]
    if any(isinstance(v, float) and not math.isfinite(v) for v in result.values()):
        wrong.append("not a number")
    if any(v is not None and v < 0.0 for v in [*numbers, error]):
        wrong.append("less than 0")
    if share is None and (result.get("mu") is not None or error is not None):
        wrong.append("friction without a load share")
    if share is None and not note:
        wrong.append("no load share and no reason")
    if share is not None and not 0.0 <= share <= 1.0:
        wrong.append("load share")
    if result.get("mu") is None and not result.get("mu_note"):
        wrong.append("no friction and no reason")
    assessment = str(result.get("assessment") or "")
    if share and ("full film" in assessment) and share > 0.01:
        wrong.append("assessment")
    return wrong


def work(args: argparse.Namespace) -> dict[str, object]:
    """Compare and print; returns the contents of the JSON file."""
    rows = []
    for contact in draw(args.contacts, args.seed, args.points):
        say(f"contact {contact.number + 1} of {args.contacts}")
        rows += compare(contact, simulate=contact.number < args.simulate)
    show(summary(rows), COLUMNS, MEANING)
    return {"contacts": args.contacts, "seed": args.seed, "summary": summary(rows), "rows": rows}


def compare(contact: Contact, *, simulate: bool) -> list[Row]:
    """Return the rows of a contact: smooth, with vanishing roughness, and rough."""
    head: Row = {"contact": contact.number, "over": contact.over, "points": contact.points}
    head["values"] = {**contact.keys, **contact.surface}
    rough = predicted({**contact.keys, **contact.surface})
    none = predicted({**contact.keys, **contact.surface, "surface.rms_height": NO_HEIGHT})
    source = str(rough.get("h_c_source", ""))
    words = source.split()
    nodes = int(words[2]) if source.startswith("solved on") else contact.points
    smooth = solved({**contact.keys, "grid.points": nodes})
    rows = [
        head | {"kind": "smooth"} | of_smooth(rough, smooth),
        head | {"kind": "vanishing"} | of_pair(none, smooth),
    ]
    if simulate:
        rows.append(head | {"kind": "rough"} | of_pair(rough, solved(head["values"])))
    return rows


def predicted(keys: Mapping[str, Any]) -> dict[str, Any]:
    """Return the summary of a prediction."""
    try:
        return pyehl.predict(pyehl.Case.from_text("", keys), tracks=1).summary
    except EhlError as error:
        return {"status": "failed", "message": str(error)}


def solved(keys: Mapping[str, Any]) -> dict[str, Any]:
    """Return the summary of a solution."""
    with Solver(pyehl.Case.from_text("", keys)) as solver:
        solver.run()
        return dict(solver.summary)


KEPT = (
    *("status", SHARE, f"{SHARE}_error", f"{SHARE}_error_note", "mu", "mu_smooth", "mu_ratio"),
    *("mu_isothermal", "mu_smooth_isothermal", "mu_note", *FILMS, "h_c_error_m", "h_min_error_m"),
    *("mu_ratio_model_error", "mu_ratio_error", "mu_ratio_error_note", "moes_m", "moes_l"),
    *("h_c_source", "outside_range", "message", "wall_seconds", "assessment"),
)


def _both(one: Mapping[str, Any], other: Mapping[str, Any]) -> Row:
    row: Row = {f"predicted_{name}": one.get(name) for name in KEPT}
    row |= {f"solved_{name}": other.get(name) for name in KEPT}
    broken = [f"prediction: {word}" for word in contradictions(one) if one["status"] != "failed"]
    if other["status"] == "converged":
        broken += [f"solution: {word}" for word in contradictions(other)]
    return row | {"broken": broken, "difference": None, "allowed": None, "wrong": bool(broken)}


def of_smooth(result: Mapping[str, Any], smooth: Mapping[str, Any]) -> Row:
    """Compare films and pressure of the smooth contact of a prediction with those of a solution."""
    row = _both(result, smooth)
    if result["status"] == "failed" or smooth["status"] != "converged":
        return row
    for name in FILMS:
        value, other = result.get(name), _film(smooth, name)
        if value is None:
            if smooth.get(SHARE) is not None and result.get("h_c_source", "").startswith("solved"):
                row["broken"].append(f"{name}: none")
        elif abs(value / other - 1.0) > max(ENDED, _stated(result, smooth, name)):
            row["broken"].append(f"{name}: {value / other:.6f} of the solution")
    row["wrong"] = bool(row["broken"])
    return row


def _stated(result: Mapping[str, Any], smooth: Mapping[str, Any], name: str) -> float:
    """Largest relative error of a film that either result states; 0 if neither does."""
    error = name.removesuffix("_m") + "_error_m"
    return max((one.get(error) or 0.0) / one[name] for one in (result, smooth))


def _film(smooth: Mapping[str, Any], name: str) -> float:
    """Return a film of a solution as a prediction reports it: extrapolated if possible."""
    if name == "p_max_Pa":
        return float(smooth[name])
    of = {"h_c_m": "H_c", "h_min_m": "H_min"}[name]
    limit = smooth.get(f"{of}_extrapolated")
    return float(smooth[name] if limit is None else limit * smooth["film_scale_m"])


def of_pair(result: Mapping[str, Any], other: Mapping[str, Any]) -> Row:
    """Compare load share and friction of a prediction with those of a solution."""
    row = _both(result, other)
    if result["status"] == "failed" or other["status"] != "converged":
        return row
    if shares := _known(one.get(SHARE) for one in (result, other)):
        row["difference"] = abs(shares[0] - shares[1])
        if stated := _known(one.get(f"{SHARE}_error") for one in (result, other)):
            row["allowed"] = sum(stated) + POINTS_ERROR * max(shares)
            if row["difference"] > row["allowed"] + 1e-3:
                row["broken"].append("load share")
    if (both := _known(one.get("mu") for one in (result, other))) and row["allowed"] is not None:
        mu, friction = both
        error = (result.get("mu_ratio_model_error") or math.inf) * (mu / result["mu_ratio"])
        row["mu_difference"] = abs(mu - friction)
        row["mu_allowed"] = error + POINTS_ERROR * max(mu, friction)
        row["mu_allowed"] += (other.get("mu_ratio_error") or 0.0) * friction
    row["wrong"] = bool(row["broken"])
    return row


def summary(rows: Sequence[Row]) -> list[Row]:
    """Count outcomes by kind."""
    table: list[Row] = []
    for kind in ("smooth", "vanishing", "rough"):
        mine = [row for row in rows if row["kind"] == kind]
        if not mine:
            continue
        ratios = [r["difference"] / max(r["allowed"], 1e-3) for r in mine if r["allowed"]]
        shares = [(r[f"predicted_{SHARE}"], r[f"solved_{SHARE}"]) for r in mine]
        table.append(
            {
                "kind": kind,
                "contacts": len(mine),
                "compared": sum(None not in pair for pair in shares),
                "touching": sum(None not in pair and max(pair) > 0.0 for pair in shares),
                "no_number": sum(pair[0] is None for pair in shares),
                "failed": sum(
                    r["predicted_status"] == "failed" or r["solved_status"] != "converged"
                    for r in mine
                ),
                "wrong": sum(bool(r["wrong"]) for r in mine),
                "largest_ratio": max(ratios, default=0.0),
            }
        )
    return table


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__, points=GRIDS)
    add_number(made, "contacts", 100, "how many", minimum=1)
    add_number(made, "seed", 1)
    add_number(made, "simulate", 40, "of how many the rough contact is simulated", minimum=0)
    return measure(work, made, arguments)


if __name__ == "__main__":
    sys.exit(main())
