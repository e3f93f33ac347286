"""What the constants of fortran/contact/domain.f90 were fitted to.

    python docs/evidence/errors/fit.py make     # domains.csv and ratios.csv, a minute
    python docs/evidence/errors/fit.py show     # how the estimate covers them

Smooth contacts on domains of many sizes, all on meshes of one size, so that the grid error is the
same and differences are due to the domain; and rough ones on two domains.
"""

from __future__ import annotations

import csv
import itertools
import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np
from make import HERE, Row, numbers, run

LOADS = (8.0, 12.0, 20.0, 40.0, 70.0, 120.0, 200.0, 350.0, 500.0, 1000.0, 2000.0)
MATERIALS = (0.0, 2.5, 5.0, 10.0, 15.0, 20.0, 25.0)
# Width and inlet [a]; the first is the flooded contact
DOMAINS = (
    *((16.0, 14.5), (4.0, 2.5), (5.0, 3.5), (6.0, 4.5), (8.0, 6.5), (10.0, 8.5)),
    *((8.0, 2.5), (8.0, 3.5), (8.0, 4.5)),
)
# Amplitude [a^2/R], wavelength [a]
WAVE_NAMES = ("moes_m", "moes_l", "amplitude", "wavelength", "velocity_ratio")
WAVES = (
    *((100.0, 10.0, 0.03, 0.5, 1.01), (100.0, 10.0, 0.03, 1.0, 1.0), (100.0, 10.0, 0.05, 0.5, 1.3)),
    *((200.0, 10.0, 0.02, 0.5, 1.01), (200.0, 20.0, 0.04, 0.5, 0.9), (50.0, 5.0, 0.05, 0.7, 1.01)),
    *((20.0, 10.0, 0.15, 0.7, 1.0), (500.0, 10.0, 0.015, 0.5, 1.01)),
    (1000.0, 10.0, 0.0097, 0.5, 1.01),
)


def options_of(moes_m: float, moes_l: float, mesh: float, width: float, inlet: float) -> Row:
    """Options of a contact on a square domain."""
    domain = {"x_inlet": -inlet, "x_outlet": width - inlet, "y_extent": 0.5 * width}
    return {
        "contact.moes_m": moes_m,
        "contact.moes_l": moes_l,
        "grid.points": round(width / mesh) + 1,
    } | {f"grid.{key}": value for key, value in domain.items()}


def domain_rows(point: tuple[float, float]) -> list[Row]:
    """Solve a contact on all domains; H_c and H_min empty where there is no solution."""
    rows = []
    for width, inlet in DOMAINS:
        mesh = 1 / 16 if point[0] < 60.0 else 1 / 32
        options = options_of(*point, mesh, width, inlet) | {"solver.accuracy": 0.05}
        found = run(options)
        row = {"moes_m": point[0], "moes_l": point[1], "width": width, "x_inlet": -inlet}
        for name in ("H_c", "H_min"):
            row |= {name: found[name], f"{name}_error_domain": found[f"{name}_error_domain"]}
        rows.append(row)
    return rows


def ratio_rows(wave: tuple[float, ...]) -> list[Row]:
    """Run a wave on domains of 4 a and 8 a."""
    rows = []
    for width in (4.0, 8.0):
        options = options_of(*wave[:2], 1 / 32, width, width - 1.5) | {
            "surface.kind": "harmonic",
            "surface.amplitude": wave[2],
            "surface.wavelength": wave[3],
            "surface.velocity_ratio": wave[4],
            "time.estimate_error": False,
            "solver.accuracy": 0.02,
        }
        found = run(options)
        row = dict(zip(WAVE_NAMES, wave, strict=True))
        row |= {"width": width} | {k: found[k] for k in ("H_c", "mu_ratio")}
        rows.append(row | {"mu_ratio_error_domain": found["mu_ratio_error_domain"]})
    return rows


def shares_covered(name: str) -> np.ndarray:
    """Change of a film by a domain over what the estimate says, where one is above 0.03 %."""
    rows = numbers("domains")
    shares = []
    for first in range(0, len(rows), len(DOMAINS)):
        flooded, *others = rows[first : first + len(DOMAINS)]
        for row in others:
            if row[name] is None or flooded[name] is None:
                continue
            # the flooded contact has a domain, too
            said = row[f"{name}_error_domain"] - flooded[f"{name}_error_domain"]
            change = flooded[name] - row[name]
            if max(abs(change), said) > 3e-4 * flooded[name]:
                shares.append(change / said)
    return np.array(shares)


def ratio_shares() -> np.ndarray:
    """Change of mu_r/mu_s by the domain of 4 a, over what that run says of it."""
    rows = numbers("ratios")
    pairs = zip(rows[::2], rows[1::2], strict=True)
    return np.array(
        [abs(a["mu_ratio"] - b["mu_ratio"]) / a["mu_ratio_error_domain"] for a, b in pairs]
    )


def show() -> None:
    """Print how the estimates cover the tables."""
    for name in ("H_c", "H_min"):
        found = shares_covered(name)
        print(
            f"{name}: {found.size} changes, {np.mean(found <= 1.0):.1%} covered, "
            f"median {np.median(found):.2f} of the estimate, at most {found.max():.2f}"
        )
    print("mu_ratio:", *np.round(ratio_shares(), 2))


def main() -> None:
    """Make the tables with two workers, or print what they say."""
    if sys.argv[1] == "make":
        todo = (
            ("domains", domain_rows, list(itertools.product(LOADS, MATERIALS))),
            ("ratios", ratio_rows, list(WAVES)),
        )
        for name, make, what in todo:
            with ProcessPoolExecutor(2) as pool:
                rows = [row for rows in pool.map(make, what) for row in rows]
            with (HERE / f"{name}.csv").open("w", newline="", encoding="utf-8") as stream:
                writer = csv.DictWriter(stream, rows[0], lineterminator="\n")
                writer.writeheader()
                writer.writerows(rows)
    show()


if __name__ == "__main__":
    main()
