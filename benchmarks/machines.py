# SPDX-License-Identifier: BSD-3-Clause
"""Convergence, cost and error estimates of smooth machine contacts at default settings.

Seed and number determine a contact. The time is the processor time of the solution in this process,
on one thread: it excludes the start of Python and depends little on the load of the computer.
"""

import argparse
import resource
import statistics
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from common import add_number, columns, measure, parser, say, show
from scipy.special import elliprd

from pyehl.case import Case
from pyehl.errors import InputError
from pyehl.solver import Solver
from pyehl.theory.ellipse import ellipse
from pyehl.theory.line_contact import LineContact
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Row

MODULUS = 2.26e11
"""E' of steel on steel [Pa]."""
WIDEST = 240.0
"""Largest R_y/R_x, for kappa = 30."""
WIDE = 4.0
"""Contacts with a larger kappa count as wide."""
LAWS = ("newtonian", "eyring", "carreau")
SETTINGS: dict[str, Any] = {"solver.threads": 1}
"""All other settings are the defaults."""
QUANTITIES = ("H_c", "H_min")
REFUSED = "refused"
"""Status of a contact whose case is not valid."""
KEPT = (
    *("status", "message", "moes_m", "moes_l", "points", "points_y", "cycles", "total_cycles"),
    *("restarts", "H_c", "H_c_error", "H_c_error_grid", "H_min", "H_min_error"),
    *("H_min_error_grid", "film_scale_m"),
)

COLUMNS = columns(
    "contacts:s drawn:d converged:d median_seconds:.2f largest_seconds:.1f median_ratio:.1f "
    "largest_ratio:.1f restarts:d checked:d h_c_covered:d h_min_covered:d"
)
MEANING = (
    "seconds: of the processor, one thread, all grids of a solution; ratio: to the median of the "
    "ball on disc;\nchecked: solved on twice the nodes too (--fine); covered: the error against "
    "those, extrapolated, is at most the stated one"
)
"""Meaning of the columns."""


@dataclass(frozen=True, slots=True)
class Contact:
    """A contact of a machine, and the keys of its case."""

    kind: str
    ellipticity: float | None  # semi-axis across the motion over that along it; None: a line
    pressure: float  # maximum Hertz pressure [Pa]
    values: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class _Shape:
    """Radii [m], and ranges of Hertz pressure [Pa], mean velocity [m/s], slide-to-roll ratio."""

    radius_x: float
    radius_y: float
    pressure: tuple[float, float]
    velocity: tuple[float, float]
    slide: float


def _scale(rng: np.random.Generator, low: float, high: float) -> float:
    """Draw a number, log-uniformly."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def _bearing(rng: np.random.Generator) -> _Shape:
    """Draw a ball of 3 to 40 mm on an inner ring with an osculation of 0.51 to 0.53."""
    ball = _scale(rng, 3e-3, 0.04)
    ring = 0.5 * ball * (rng.uniform(4.0, 8.0) - 1.0)
    groove = ball * rng.uniform(0.51, 0.53)
    across = 1.0 / (2.0 / ball - 1.0 / groove)
    return _Shape(1.0 / (2.0 / ball + 1.0 / ring), across, (0.8e9, 3e9), (0.3, 20.0), 0.1)


def _gear(rng: np.random.Generator) -> _Shape:
    """Draw a flank with a crowning radius of 8 to 200 times its radius."""
    along = _scale(rng, 3e-3, 0.03)
    return _Shape(along, along * _scale(rng, 8.0, 200.0), (0.5e9, 1.8e9), (0.5, 20.0), 0.8)


def _ball(rng: np.random.Generator) -> _Shape:
    """Draw a ball on disc of a tribometer."""
    radius = _scale(rng, 4e-3, 0.0127)
    return _Shape(radius, radius, (0.4e9, 1.3e9), (0.02, 4.0), 1.0)


def _roller(rng: np.random.Generator) -> _Shape:
    """Draw a roller of R_x = 2 to 20 mm with a crown radius of 0.1 to 3 m."""
    along = _scale(rng, 2e-3, 0.02)
    across = min(_scale(rng, 0.1, 3.0), WIDEST * along)
    return _Shape(along, across, (0.6e9, 2.5e9), (0.3, 15.0), 0.1)


def _along(rng: np.random.Generator) -> _Shape:
    """Draw a roller that moves along its axis: R_y of 2 to 20 mm, R_x of 2 to 110 times that."""
    across = _scale(rng, 2e-3, 0.02)
    return _Shape(across * _scale(rng, 2.0, 110.0), across, (0.4e9, 1.8e9), (0.1, 15.0), 0.5)


DISC = "ball on disc"
KINDS: dict[str, Callable[[np.random.Generator], _Shape]] = {
    "ball bearing": _bearing,
    "gear": _gear,
    DISC: _ball,
    "crowned roller": _roller,
}
"""Kinds of contacts, drawn in turn."""
NARROW: dict[str, Callable[[np.random.Generator], _Shape]] = {
    "roller along its axis": _along,
    DISC: _ball,
}
"""Kinds of narrow contacts, kappa from 0.05 to 0.65, drawn in turn with balls on discs."""


def draw(count: int, seed: int) -> list[Contact]:
    """Draw contacts; the first ones do not depend on `count`."""
    return _in_turn(KINDS, count, seed)


def draw_narrow(count: int, seed: int) -> list[Contact]:
    """Draw contacts that move along their longer axis, in turn with balls on discs, as `draw`."""
    return _in_turn(NARROW, count, seed)


def _in_turn(
    kinds: Mapping[str, Callable[[np.random.Generator], _Shape]], count: int, seed: int
) -> list[Contact]:
    names = list(kinds)
    rngs = (np.random.default_rng((seed, k)) for k in range(count))
    return [
        _one(names[k % len(names)], kinds[names[k % len(names)]](rng), rng)
        for k, rng in enumerate(rngs)
    ]


def _one(kind: str, shape: _Shape, rng: np.random.Generator) -> Contact:
    keys = {
        "contact.radius_x": shape.radius_x,
        "contact.radius_y": shape.radius_y,
        "contact.mean_velocity": _scale(rng, *shape.velocity),
        "contact.slide_to_roll": rng.uniform(0.0, shape.slide),
        "lubricant.viscosity": _scale(rng, 0.004, 0.3),
        "lubricant.pressure_viscosity": rng.uniform(1.3e-8, 2.4e-8),
    }
    law = str(rng.choice(LAWS))
    stress, exponent = _scale(rng, 1e6, 1e7), rng.uniform(0.4, 0.9)
    if law != "newtonian":
        keys[f"lubricant.{law}_stress"] = stress
    if law == "carreau":
        keys["lubricant.carreau_exponent"] = exponent
    keys = {key: float(f"{value:.4g}") for key, value in keys.items()}
    pressure = rng.uniform(*shape.pressure)
    unloaded = _point(keys, 1.0)
    # the Hertz pressure is proportional to the cube root of the load
    load = float(f"{(pressure / unloaded.hertz_pressure) ** 3:.4g}")
    values: dict[str, Any] = {"contact.reduced_modulus": MODULUS, "contact.load": load, **keys}
    values["lubricant.shear_law"] = law
    return Contact(kind, unloaded.ellipse.ellipticity, _point(keys, load).hertz_pressure, values)


def draw_lines(count: int, seed: int) -> list[Contact]:
    """Draw line contacts, in turn in SI units and by M and L, as `draw`."""
    kinds = ("line, SI units", "line, M and L")
    return [_line(kinds[k % 2], np.random.default_rng((seed, k))) for k in range(count)]


def _line(kind: str, rng: np.random.Generator) -> Contact:
    oil = {
        "viscosity": _scale(rng, 0.004, 0.3),
        "pressure_viscosity": rng.uniform(1.3e-8, 2.4e-8),
    }
    keys = {"contact.slide_to_roll": rng.uniform(0.0, 1.0)}
    keys |= {f"lubricant.{name}": value for name, value in oil.items()}
    words: dict[str, Any] = {"contact.shape": "line"}
    words["lubricant.viscosity_law"] = str(rng.choice(("roelands", "barus")))
    words["grid.border"] = str(rng.choice(("flooded", "zero"), p=(0.8, 0.2)))
    if kind.endswith("units"):
        si = {
            "load_per_length": _scale(rng, 2e4, 1.5e6),
            "radius": _scale(rng, 2e-3, 0.03),
            "mean_velocity": _scale(rng, 0.05, 20.0),
        }
        keys |= {f"contact.{name}": value for name, value in si.items()}
        words["contact.reduced_modulus"] = MODULUS
        values: dict[str, Any] = {"reduced_modulus": MODULUS, "si": True, **si, **oil}
        line = LineContact(**values)
        law = words["lubricant.shear_law"] = str(rng.choice(LAWS))
        if law != "newtonian":
            keys[f"lubricant.{law}_stress"] = _scale(rng, 1e6, 1e7)
        if law == "carreau":
            keys["lubricant.carreau_exponent"] = rng.uniform(0.4, 0.9)
    else:
        moes = _scale(rng, 0.3, 1000.0), rng.uniform(0.0, 25.0)
        keys |= {"contact.moes_m_line": moes[0], "contact.moes_l_line": moes[1]}
        line = LineContact.from_moes(*moes, **oil)
    rounded = {key: float(f"{value:.4g}") for key, value in keys.items()}
    return Contact(kind, None, line.hertz_pressure, rounded | words)


def draw_numbers(count: int, seed: int) -> list[Contact]:
    """Draw ellipses by kappa, and by M and L of the circular contact with the same equations."""
    return [_ellipse(np.random.default_rng((seed, k))) for k in range(count)]


def _ellipse(rng: np.random.Generator) -> Contact:
    kappa, moes_m, moes_l = (
        _scale(rng, 0.2, 10.0),
        _scale(rng, 20.0, 5000.0),
        rng.uniform(0.0, 25.0),
    )
    shape = ellipse(radius_ratio(kappa))
    keys = {
        "contact.radius_ratio": shape.radius_ratio,
        "contact.moes_m": moes_m * kappa * shape.kernel_ratio**0.25,
        "contact.moes_l": moes_l / shape.kernel_ratio**0.75,
    }
    words = {"lubricant.viscosity_law": str(rng.choice(("roelands", "barus")))}
    rounded = {key: float(f"{value:.5g}") for key, value in keys.items()}
    ratio, *moes = rounded.values()
    point = OperatingPoint.from_moes(*moes, radius_ratio=ratio)
    return Contact("ellipse, M and L", kappa, point.hertz_pressure, rounded | words)


def radius_ratio(kappa: float) -> float:
    """R_x/R_y of an ellipticity."""
    return float(elliprd(0.0, 1.0, kappa**2) / elliprd(0.0, kappa**2, 1.0))


def _point(keys: Mapping[str, float], load: float) -> OperatingPoint:
    return OperatingPoint(
        load=load,
        mean_velocity=keys["contact.mean_velocity"],
        radius=keys["contact.radius_x"],
        reduced_modulus=MODULUS,
        viscosity=keys["lubricant.viscosity"],
        pressure_viscosity=keys["lubricant.pressure_viscosity"],
        radius_ratio=keys["contact.radius_x"] / keys["contact.radius_y"],
    )


DRAWS = {"ellipse": draw, "narrow": draw_narrow, "line": draw_lines, "numbers": draw_numbers}
"""Draws by the option ``--shape``."""


def campaign(count: int, seed: int, *, fine: bool = False, shape: str = "ellipse") -> list[Row]:
    """Solve `count` contacts of a seed, of one of `DRAWS`; returns a row for each.

    With `fine` each converged one is also solved on twice the nodes: `H_c_fine` and `H_min_fine`
    are the values extrapolated from there.
    """
    rows: list[Row] = []
    for number, contact in enumerate(DRAWS[shape](count, seed)):
        row = _solved(contact, {})
        row |= {"seed": seed, "number": number, "kind": contact.kind, "values": contact.values}
        row |= {"ellipticity": contact.ellipticity, "hertz_pressure_Pa": contact.pressure}
        row |= dict.fromkeys(["fine_status", *(f"{name}_fine" for name in QUANTITIES)])
        if fine and row["status"] == "converged":
            finer = _solved(contact, _finer(row))
            row["fine_status"] = finer["status"]
            if finer["status"] == "converged":
                row |= {f"{name}_fine": finer[f"{name}_extrapolated"] for name in QUANTITIES}
        say(
            f"{number + 1} of {count}: {contact.kind}, "
            + (f"kappa {contact.ellipticity:.1f}, " if contact.ellipticity else "")
            + f"{row['status']}"
            + (f", {row['seconds']:.2f} s" if row["seconds"] else "")
        )
        rows.append(row)
    return rows


def _finer(row: Row) -> dict[str, int]:
    """Return the keys of a grid with twice the nodes along each axis."""
    keys = {"grid.points": 2 * row["points"] - 1}
    if row["points_y"] is not None:
        keys["grid.points_y"] = 2 * row["points_y"] - 1
    return keys


def _solved(contact: Contact, more: Mapping[str, Any]) -> Row:
    try:
        result = timed(dict(contact.values) | SETTINGS | dict(more))
    except InputError as error:
        # M is beyond the range of a case
        result = {"status": REFUSED, "message": str(error), "seconds": None}
    names = ("seconds", *KEPT, *(f"{name}_extrapolated" for name in QUANTITIES))
    return {name: result.get(name) for name in names}


def timed(keys: Mapping[str, Any]) -> Row:
    """Solve a case; returns its summary with the processor time `seconds`."""
    case = Case.from_text("", keys)
    began = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    with Solver(case) as solver:
        solver.run()
        seconds = resource.getrusage(resource.RUSAGE_SELF).ru_utime - began
        return {**solver.summary, "seconds": seconds}


def covered(row: Row, name: str, error: str) -> bool | None:
    """Whether an error of a row covers the difference from the finer grid; None: not checked."""
    value, finer, stated = row[name], row[f"{name}_fine"], row[f"{name}_{error}"]
    if None in (value, finer, stated):
        return None
    return bool(abs(value - finer) <= stated)


def summary(rows: Sequence[Row]) -> list[Row]:
    """Summarise counts and times by kind, of the wide contacts, and of all."""
    discs = [row["seconds"] for row in rows if row["kind"] == DISC and row["seconds"]]
    unit = statistics.median(discs) if discs else None
    kinds = dict.fromkeys([*KINDS, *(row["kind"] for row in rows)])
    groups = {kind: [row for row in rows if row["kind"] == kind] for kind in kinds}
    groups[f"kappa > {WIDE:g}"] = [row for row in rows if (row["ellipticity"] or 0.0) > WIDE]
    groups["all"] = list(rows)
    return [_counted(name, mine, unit) for name, mine in groups.items() if mine]


def _counted(name: str, rows: Sequence[Row], unit: float | None) -> Row:
    seconds = [row["seconds"] for row in rows if row["seconds"]]
    middle, largest = (statistics.median(seconds), max(seconds)) if seconds else (None, None)
    holds = {what: [covered(row, what, "error") for row in rows] for what in QUANTITIES}
    checked = any(row["fine_status"] for row in rows)
    return {
        "contacts": name,
        "drawn": len(rows),
        "converged": sum(row["status"] == "converged" for row in rows),
        "median_seconds": middle,
        "largest_seconds": largest,
        "median_ratio": middle / unit if unit and middle else None,
        "largest_ratio": largest / unit if unit and largest else None,
        "restarts": sum(row["restarts"] or 0 for row in rows),
        "checked": sum(each is not None for each in holds["H_c"]) if checked else None,
        "h_c_covered": holds["H_c"].count(True) if checked else None,
        "h_min_covered": holds["H_min"].count(True) if checked else None,
    }


def work(args: argparse.Namespace) -> Row:
    """Measure and print."""
    rows = campaign(args.count, args.seed, fine=args.fine, shape=args.shape)
    result = summary(rows)
    show(result, COLUMNS, MEANING)
    asked = {name: getattr(args, name) for name in ("seed", "count", "fine", "shape")}
    return asked | {"summary": result, "rows": rows}


def main(words: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__)
    add_number(made, "seed", 1)
    add_number(made, "count", 60, "how many contacts, of all kinds in turn", minimum=1)
    made.add_argument(
        "--shape",
        choices=DRAWS,
        default="ellipse",
        help="ellipse (of machines), narrow, line, or numbers",
    )
    made.add_argument(
        "--fine", action="store_true", help="on twice the nodes too, to check the stated errors"
    )
    return measure(work, made, words)


if __name__ == "__main__":
    sys.exit(main())
