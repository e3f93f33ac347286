# SPDX-License-Identifier: BSD-3-Clause
"""Check random bearings and gear pairs with dimensions as in catalogues and drawings.

Deep-groove, angular-contact, cylindrical and tapered roller bearings and gear pairs in turn. Seed
and number determine a machine. Every result is checked independently of `pyehl.machines`:
equilibrium of the ring, Hertz pressure of a line, film formulas written out here, physical ranges.
``--solve N`` also solves each contact of the first N machines and compares the central films.
"""

import argparse
import math
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pandas as pd
from common import add_number, columns, measure, parser, say, show

import pyehl
from pyehl.errors import InputError
from pyehl.machines.result import MachineResult
from pyehl.types import Row

BORES = (10, 12, 15, 17, 20, 25, 30, 35, 40, 45, 50, 60, 70, 80, 90, 100, 120, 150, 200)
"""Bores in catalogues [mm]."""
VISCOSITIES = (10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460)
"""ISO VG classes."""
FINISHES = ("ground", "honed", "superfinished", "polished")
REFUSED, CRASHED, WRONG, RIGHT = "refused", "crashed", "wrong", "right"
# E' of bearing steel [Pa] from Young's modulus and Poisson's ratio
STEEL = 2.06e11 / (1.0 - 0.3**2)
COLUMNS = columns("machine:s drawn:d right:d refused:d wrong:d crashed:d solved:d contacts:d")

Keys = dict[str, Any]


def _scale(rng: np.random.Generator, low: float, high: float) -> float:
    """Draw a number, log-uniformly."""
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def _rings(rng: np.random.Generator, low: float, high: float) -> tuple[float, float, float, float]:
    """Bore, outside and pitch diameter, and a diameter of elements between both rings [m]."""
    bore = 1e-3 * float(rng.choice(BORES))
    outside = round(bore * rng.uniform(1.5, 2.2) + 8e-3, 3)
    return bore, outside, 0.5 * (bore + outside), 0.5 * (outside - bore) * rng.uniform(low, high)


def _balls(rng: np.random.Generator) -> tuple[Keys, float]:
    """Draw a row of balls; returns it with its static load rating by ISO 76, f_0 = 14 [N]."""
    bore, outside, pitch, ball = _rings(rng, 0.5, 0.65)
    count = max(5, int(rng.uniform(0.55, 0.75) * math.pi / math.asin(ball / pitch)))
    keys = {
        "bore": bore,
        "outer_diameter": outside,
        "ball_diameter": round(ball, 6),
        "balls": count,
        "osculation_inner": rng.uniform(0.51, 0.525),
        "osculation_outer": rng.uniform(0.515, 0.53),
    }
    return keys, 14e6 * count * ball**2


def deep_groove(rng: np.random.Generator) -> tuple[str, Keys]:
    """Draw a deep-groove ball bearing under a radial or combined load."""
    keys, rating = _balls(rng)
    keys["clearance"] = _scale(rng, 3e-6, 3e-5)
    keys["radial_load"] = rating * _scale(rng, 0.01, 0.5)
    keys["axial_load"] = float(rng.choice([0.0, 0.3])) * keys["radial_load"]
    return "ball_bearing", keys


def angular_contact(rng: np.random.Generator) -> tuple[str, Keys]:
    """Draw an angular-contact ball bearing."""
    keys, rating = _balls(rng)
    keys["contact_angle"] = float(rng.choice([15.0, 25.0, 30.0, 40.0]))
    keys["radial_load"] = rating * _scale(rng, 0.01, 0.3)
    keys["axial_load"] = keys["radial_load"] * rng.uniform(0.5, 2.0)
    return "ball_bearing", keys


def _rollers(rng: np.random.Generator) -> tuple[Keys, float]:
    """Draw a row of rollers; returns it with its static load rating by ISO 76 at 0 deg [N]."""
    bore, outside, pitch, roller = _rings(rng, 0.42, 0.58)
    count = max(6, int(rng.uniform(0.7, 0.95) * math.pi / math.asin(roller / pitch)))
    length = roller * rng.uniform(1.0, 2.0)
    keys = {
        "bore": bore,
        "outer_diameter": outside,
        "roller_diameter": round(roller, 6),
        "roller_length": round(length, 6),
        "rollers": count,
    }
    return keys, 44e6 * (1.0 - roller / pitch) * count * length * roller


def cylindrical(rng: np.random.Generator) -> tuple[str, Keys]:
    """Draw a cylindrical roller bearing."""
    keys, rating = _rollers(rng)
    keys["clearance"] = _scale(rng, 1e-5, 8e-5)
    keys["radial_load"] = rating * _scale(rng, 0.01, 0.5)
    return "roller_bearing", keys


def tapered(rng: np.random.Generator) -> tuple[str, Keys]:
    """Draw a tapered roller bearing with at least the axial load that holds it together."""
    keys, rating = _rollers(rng)
    keys["contact_angle"] = rng.uniform(10.0, 28.0)
    keys["roller_angle"] = rng.uniform(1.0, 2.5)
    keys["radial_load"] = rating * _scale(rng, 0.01, 0.3)
    minimum = keys["radial_load"] * math.tan(math.radians(keys["contact_angle"]))
    keys["axial_load"] = minimum * rng.uniform(1.05, 3.0)
    return "roller_bearing", keys


def gears(rng: np.random.Generator) -> tuple[str, Keys]:
    """Draw spur gears; one pair in five has few teeth without profile shift: an undercut."""
    module = 1e-3 * float(rng.choice([1.0, 1.5, 2.0, 3.0, 4.0, 4.5, 6.0, 8.0]))
    few = rng.random() < 0.2
    teeth = int(rng.integers(10, 17)) if few else int(rng.integers(17, 40))
    other = int(teeth * rng.uniform(1.0, 4.0))
    width = module * rng.uniform(6.0, 14.0)
    keys = {
        "teeth_1": teeth,
        "teeth_2": other,
        "module": module,
        "profile_shift_1": 0.0 if few else rng.uniform(0.0, 0.4),
        "profile_shift_2": rng.uniform(0.0, 0.2),
        "face_width": width,
        "crowning_1": float(rng.choice([0.0, 0.0, 5e-6, 2e-5])),
        "load_sharing": str(rng.choice(["linear", "equal"])),
        "speed": _scale(rng, 100.0, 6000.0),
    }
    # tooth load over width and module, limited by strength
    keys["torque"] = _scale(rng, 5e6, 8e7) * width * module * 0.5 * module * teeth
    return "spur_gear", keys


MACHINES: dict[str, Callable[[np.random.Generator], tuple[str, Keys]]] = {
    "deep-groove ball": deep_groove,
    "angular-contact ball": angular_contact,
    "cylindrical roller": cylindrical,
    "tapered roller": tapered,
    "gear pair": gears,
}


def draw(seed: int, number: int) -> tuple[str, Keys]:
    """Draw a machine; returns its kind and its keys."""
    rng = np.random.default_rng((seed, number))
    kind = list(MACHINES)[number % len(MACHINES)]
    group, keys = MACHINES[kind](rng)
    if group != "spur_gear":
        # speed from n d_m, in the usual range of bearings
        pitch = 0.5 * (keys["bore"] + keys["outer_diameter"])
        keys["inner_speed"] = _scale(rng, 1e4, 5e5) * 1e-3 / pitch
    grade = float(rng.choice(VISCOSITIES))
    oil = {
        "lubricant.kinematic_viscosity_40": grade,
        # viscosity index of about 95
        "lubricant.kinematic_viscosity_100": 0.65 * grade**0.61,
        "lubricant.temperature": rng.uniform(30.0, 110.0),
        "lubricant.shear_law": str(rng.choice(["newtonian", "eyring", "eyring"])),
    }
    finish = {
        f"{name}.{key}": value
        for name in ("surface", "second_surface")
        for key, value in (("kind", "fractal"), ("finish", str(rng.choice(FINISHES))))
    }
    return kind, {f"{group}.{name}": value for name, value in keys.items()} | oil | finish


def answer(keys: Keys, run: str, **options: Any) -> MachineResult:  # noqa: ANN401 (keys of a case)
    """Run the function of the machine element."""
    command = pyehl.gear if "spur_gear.teeth_1" in keys else pyehl.bearing
    return command(..., keys, options, run=run, jobs=1)


def faults(keys: Keys, result: MachineResult) -> list[str]:
    """List the impossible values of a result."""
    table, s = result.table, result.summary
    wrong = [
        f"{name} not between {low:g} and {high:g}"
        for name, low, high in (
            ("hertz_pressure_Pa", 2e7, 6e9),
            ("h_c_m", 1e-10, 1e-4),
            ("mu", 0.0, 0.15),
            ("flash_temperature_K", 0.0, 400.0),
            ("slide_to_roll", -2.0, 2.0),
            ("half_width_m", 1e-6, 1e-2),
            ("sliding_power_W", 0.0, 1e6),
            ("rolling_power_W", 0.0, 1e6),
        )
        if name in table and not table[name].dropna().between(low, high).all()
    ]
    crossed = table["h_min_m"] > table["h_c_m"]
    if (crossed & ~table["note"].str.contains("minimum film above")).any():
        wrong.append("minimum film above the central one without a note")
    if result.kind == "bearing":
        wrong += _bearing_faults(keys, table, s)
    elif not (0.8 < s.get("efficiency", 0.99) < 1.0 or math.isnan(s["efficiency"])):
        wrong.append(f"efficiency {s['efficiency']:.4f}")
    return wrong + _line_faults(keys, table)


def _bearing_faults(keys: Keys, table: pd.DataFrame, s: Row) -> list[str]:
    """Check the equilibrium of the ring from the loads on the outer raceway."""
    outer = table[table["ring"] == "outer"]
    load, psi, angle = (
        outer["load_N"].to_numpy(),
        np.radians(outer["azimuth_deg"]),
        np.radians(outer["contact_angle_deg"]),
    )
    group = "ball_bearing" if "ball_bearing.bore" in keys else "roller_bearing"
    wanted = [keys.get(f"{group}.{name}_load", 0.0) for name in ("radial", "axial")]
    forces = [np.sum(load * np.cos(angle) * np.cos(psi)), np.sum(load * np.sin(angle))]
    wrong = [
        f"{name} force {force:.6g} N for {want:.6g} N"
        for name, force, want in zip(("radial", "axial"), forces, wanted, strict=True)
        if abs(force - want) > 1e-6 * load.sum()
    ]
    # Z F_max/F is Z with one loaded element and about 4 with many
    count = keys.get("ball_bearing.balls") or keys["roller_bearing.rollers"]
    if wanted[1] == 0.0 and not 3.9 <= s["load_max_Z_over_F"] <= count * (1.0 + 1e-9):
        wrong.append(f"largest load {s['load_max_Z_over_F']:.3f} F/Z")
    torque = s["torque_N_m"]
    # coefficient of friction of a bearing, at the pitch radius
    ratio = torque / (0.5 * s["pitch_diameter_m"] * math.hypot(*wanted))
    if math.isfinite(torque) and not 1e-5 < ratio < 0.5:
        wrong.append(f"torque is {ratio:.2g} of load times pitch radius")
    return wrong


def _line_faults(keys: Keys, table: pd.DataFrame) -> list[str]:
    """Check Hertz pressure and minimum film of lines (Dowson-Higginson, or Martin if rigid)."""
    lines = table[table["shape"] == "line"]
    if lines.empty:
        return []
    per_length = lines["load_N"] / lines["length_m"]
    pressure = np.sqrt(per_length * STEEL / (2.0 * math.pi * lines["radius_m"]))
    wrong = []
    if not np.allclose(pressure, lines["hertz_pressure_Pa"], rtol=1e-6):
        wrong.append("Hertz pressure of a line")
    oil = pyehl.Lubricant.from_settings(pyehl.Case(..., _nested(keys, "lubricant")).resolve())
    flow = oil.viscosity * lines["mean_velocity_m_per_s"] / (STEEL * lines["radius_m"])
    weight = per_length / (STEEL * lines["radius_m"])
    material = oil.pressure_viscosity * STEEL
    film = 2.65 * flow**0.7 * material**0.54 * weight**-0.13 * lines["radius_m"]
    elastic = lines["regime"] == "elastic-piezoviscous"
    # the film of the result includes shear heating of the inlet
    if not (lines["h_min_m"] / film)[elastic].between(0.3, 1.01).all():
        wrong.append("minimum film differs from Dowson and Higginson")
    # Martin 1916
    film = 4.9 * flow / weight * lines["radius_m"]
    if not (lines["h_min_m"] / film)[lines["regime"] == "rigid-isoviscous"].between(0.9, 2.0).all():
        wrong.append("minimum film differs from Martin")
    return wrong


def _nested(keys: Keys, group: str) -> dict[str, Keys]:
    return {group: {n.partition(".")[2]: v for n, v in keys.items() if n.startswith(f"{group}.")}}


def one(seed: int, number: int, solve: bool) -> Row:
    """Compute a machine by formulas; with `solve` also solve it."""
    kind, keys = draw(seed, number)
    row: Row = {"number": number, "machine": kind, "values": keys, "status": RIGHT, "faults": []}
    try:
        result = answer(keys, "film")
        row["faults"] = faults(keys, result)
        row |= {k: v for k, v in result.summary.items() if isinstance(v, float | int)}
        if row["faults"]:
            row["status"] = WRONG
        if solve and not row["faults"]:
            row |= _solved(keys, result)
    except InputError as error:
        row |= {"status": REFUSED, "faults": [str(error)]}
    except Exception as error:
        row |= {"status": CRASHED, "faults": [f"{type(error).__name__}: {error}"]}
    return row | {"wrong": row["status"] in (WRONG, CRASHED)}


def _solved(keys: Keys, formulas: MachineResult) -> Row:
    """Solve each contact, on the coarsest grid that has an error estimate."""
    table = answer(keys, "solve", **{"grid.points": 257}).table
    ratio = table["h_c_m"] / formulas.table["h_c_m"]
    return {
        "contacts": len(table),
        "converged": int((table["status"] == "converged").sum()),
        "statuses": dict(Counter(table["status"])),
        "film_ratio_min": float(ratio.min()),
        "film_ratio_max": float(ratio.max()),
        "h_c_error_max": float((table["h_c_error_m"] / table["h_c_m"]).max()),
    }


def campaign(count: int, seed: int, solve: int) -> list[Row]:
    """Return a row for each machine."""
    rows = []
    for number in range(count):
        row = one(seed, number, number < solve)
        rows.append(row)
        say(f"{number + 1} of {count}: {row['machine']}, {row['status']} {row['faults'] or ''}")
    return rows


def summary(rows: Sequence[Row]) -> list[Row]:
    """Count the rows by kind and in total."""
    result = []
    for name in (*MACHINES, "all"):
        mine = [row for row in rows if name in (row["machine"], "all")]
        states = Counter(row["status"] for row in mine)
        result.append(
            {"machine": name, "drawn": len(mine)}
            | {state: states[state] for state in (RIGHT, REFUSED, WRONG, CRASHED)}
            | {
                "solved": sum(row.get("converged", 0) for row in mine),
                "contacts": sum(row["contacts"] for row in mine if "converged" in row),
            }
        )
    return result


def work(args: argparse.Namespace) -> Row:
    """Draw, check and print."""
    rows = campaign(args.count, args.seed, args.solve)
    result = summary(rows)
    show(result, COLUMNS, "solved: contacts that converge on 257 nodes, of those solved")
    asked = {name: getattr(args, name) for name in ("seed", "count", "solve")}
    return asked | {"summary": result, "rows": rows}


def main(words: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__)
    add_number(made, "seed", 1)
    add_number(made, "count", 60, "how many machines", minimum=1)
    add_number(made, "solve", 0, "how many of them to solve")
    return measure(work, made, words)


if __name__ == "__main__":
    sys.exit(main())
