"""Data that the constants of fortran/contact/domain.f90 were fitted to.

    python docs/evidence/errors/fit.py make     # flooded.csv, zero.csv, ratios.csv; three minutes
    python docs/evidence/errors/fit.py show     # coverage of the estimate

Smooth contacts on domains of many sizes with one mesh size, so that differences are due to the
domain and not to the grid; and rough contacts on two domains.
"""

from __future__ import annotations

import csv
import itertools
import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np
from make import HERE, Row, domain_of, numbers, run

MATERIALS = (0.0, 2.5, 5.0, 10.0, 15.0, 20.0, 25.0)
# Loads, and domains: inlet, outlet and half width, the flooded contact first, in a; with a flooded
# border and a thick film, in 0.3 of the default half width.
FLOODED = (
    (
        *(0.1, 0.3, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 20.0, 40.0, 70.0, 120.0, 200.0, 350.0),
        *(500.0, 1000.0),
    ),
    (
        *((10.0, 6.0, 8.0), (2.5, 1.5, 2.0), (3.125, 1.875, 2.5), (3.75, 2.25, 3.0)),
        *((5.0, 3.0, 4.0), (2.5, 5.5, 4.0)),
    ),
)
ZERO = (
    (8.0, 12.0, 20.0, 40.0, 70.0, 120.0, 200.0, 350.0, 500.0, 1000.0, 2000.0),
    (
        *((14.5, 1.5, 8.0), (2.5, 1.5, 2.0), (3.5, 1.5, 2.5), (4.5, 1.5, 3.0), (6.5, 1.5, 4.0)),
        *((8.5, 1.5, 5.0), (2.5, 5.5, 4.0), (3.5, 4.5, 4.0), (4.5, 3.5, 4.0)),
    ),
)
BORDERS = {"flooded": FLOODED, "zero": ZERO}
# Amplitude [a^2/R], wavelength [a]
WAVE_NAMES = ("moes_m", "moes_l", "amplitude", "wavelength", "velocity_ratio")
WAVES = (
    *((100.0, 10.0, 0.03, 0.5, 1.01), (100.0, 10.0, 0.03, 1.0, 1.0), (100.0, 10.0, 0.05, 0.5, 1.3)),
    *((200.0, 10.0, 0.02, 0.5, 1.01), (200.0, 20.0, 0.04, 0.5, 0.9), (50.0, 5.0, 0.05, 0.7, 1.01)),
    *((20.0, 10.0, 0.15, 0.7, 1.0), (500.0, 10.0, 0.015, 0.5, 1.01)),
    (1000.0, 10.0, 0.0097, 0.5, 1.01),
)


def options_of(point: tuple[float, float], border: str, mesh: float, domain: Row) -> Row:
    """Options of a contact on a square domain."""
    return {
        "contact.moes_m": point[0],
        "contact.moes_l": point[1],
        "grid.border": border,
        "grid.points": round(2.0 * domain["y_extent"] / mesh) + 1,
    } | {f"grid.{key}": value for key, value in domain.items()}


def domain_rows(what: tuple[str, tuple[float, float]]) -> list[Row]:
    """Solve a contact on all domains; H_c and H_min are empty without a solution."""
    border, point = what
    unit = 1.0
    if border == "flooded":
        contact = {"contact.moes_m": point[0], "contact.moes_l": point[1]}
        unit = max(1.0, 0.3 * domain_of(contact | {"grid.border": border})["y_extent"])
    mesh = unit / (16 if point[0] < 60.0 else 32)
    rows = []
    for inlet, outlet, side in BORDERS[border][1]:
        domain = {"x_inlet": -inlet * unit, "x_outlet": outlet * unit, "y_extent": side * unit}
        result = run(options_of(point, border, mesh, domain) | {"solver.accuracy": 0.02})
        row = {"moes_m": point[0], "moes_l": point[1]} | domain
        for name in ("H_c", "H_min"):
            row |= {name: result[name], f"{name}_error_domain": result[f"{name}_error_domain"]}
        rows.append(row)
    return rows


def ratio_rows(wave: tuple[float, ...]) -> list[Row]:
    """Run a wave on domains of 4 a and 8 a, P = 0 at the border."""
    rows = []
    for width in (4.0, 8.0):
        domain = {"x_inlet": 1.5 - width, "x_outlet": 1.5, "y_extent": 0.5 * width}
        options = options_of(wave[:2], "zero", 1 / 32, domain) | {
            "surface.kind": "harmonic",
            "surface.amplitude": wave[2],
            "surface.wavelength": wave[3],
            "surface.velocity_ratio": wave[4],
            "time.estimate_error": False,
            "solver.accuracy": 0.02,
        }
        result = run(options)
        row = dict(zip(WAVE_NAMES, wave, strict=True))
        row |= {"width": width} | {k: result[k] for k in ("H_c", "mu_ratio")}
        rows.append(row | {"mu_ratio_error_domain": result["mu_ratio_error_domain"]})
    return rows


def shares_covered(border: str, name: str) -> np.ndarray:
    """Change of a film by a domain over its estimate.

    Only if one of them is above 0.03 % of H_c or 0.1 % of H_min, which jumps from node to node.
    """
    least = 3e-4 if name == "H_c" else 1e-3
    rows, each = numbers(border), len(BORDERS[border][1])
    shares = []
    for first in range(0, len(rows), each):
        flooded, *others = rows[first : first + each]
        for row in others:
            if row[name] is None or flooded[name] is None:
                continue
            # the reference has a domain error as well
            said = row[f"{name}_error_domain"] - flooded[f"{name}_error_domain"]
            change = abs(flooded[name] - row[name])
            if max(change, said) > least * flooded[name]:
                shares.append(change / said)
    return np.array(shares)


def ratio_shares() -> np.ndarray:
    """Change of mu_r/mu_s by the domain of 4 a, over the error that the run states."""
    rows = numbers("ratios")
    pairs = zip(rows[::2], rows[1::2], strict=True)
    return np.array(
        [abs(a["mu_ratio"] - b["mu_ratio"]) / a["mu_ratio_error_domain"] for a, b in pairs]
    )


def show() -> None:
    """Print the coverage of the estimates."""
    for border, name in itertools.product(BORDERS, ("H_c", "H_min")):
        result = shares_covered(border, name)
        print(
            f"{border}, {name}: {result.size} changes, {np.mean(result <= 1.0):.1%} covered, "
            f"median {np.median(result):.2f} of the estimate, at most {result.max():.2f}"
        )
    print("mu_ratio:", *np.round(ratio_shares(), 2))


def main() -> None:
    """Make the tables with two workers, and print the coverage."""
    if sys.argv[1] == "make":
        todo = [
            (
                border,
                domain_rows,
                [(border, (m, ell)) for m in loads for ell in MATERIALS],
            )
            for border, (loads, _) in BORDERS.items()
        ]
        for name, make, what in [*todo, ("ratios", ratio_rows, list(WAVES))]:
            with ProcessPoolExecutor(2) as pool:
                rows = [row for rows in pool.map(make, what) for row in rows]
            with (HERE / f"{name}.csv").open("w", newline="", encoding="utf-8") as stream:
                writer = csv.DictWriter(stream, rows[0], lineterminator="\n")
                writer.writeheader()
                writer.writerows(rows)
    show()


if __name__ == "__main__":
    main()
