# SPDX-License-Identifier: BSD-3-Clause
"""Compare measured waves with the response: writes ``waves.csv``, and prints deviations.

    python docs/evidence/thinning/compare.py [FOLDER]

FOLDER has the runs of ``waves.py``; without it the measured waves are those of ``waves.csv``.

T is predicted with pressure and film of the smooth contact on 257 x 257 nodes, so that the grid
error of the smooth contact does not enter the comparison. Nor does that of the wave in the inlet:
the inlet transfer, for a grid without error, is multiplied by its ratio to the measured one of the
Newtonian twin of a run. ``waves.csv`` has T with and without this factor.
"""

from __future__ import annotations

import csv
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from waves import PLAN, POINTS, TILE, Run, case_of, twin

from pyehl.case import Case
from pyehl.solver import Solver
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_transfer
from pyehl.theory.transport import Zone, transport, zone_on

Array, Complex = NDArray[np.float64], NDArray[np.complex128]
Measured = tuple[Array, Array, Complex]
HERE = Path(__file__).parent
# Length of the domain [a]
SIDE = 4.0
STATIONS = np.array([-0.5, 0.0, 0.5])
COLUMNS = (
    "run moes_m moes_l slide_to_roll kx ky x T_re T_im predicted_re predicted_im "
    "without_twin_re without_twin_im newtonian_re newtonian_im"
).split()


def of_runs(folder: Path) -> dict[str, Measured]:
    """Waves of the runs in a folder, by their names."""
    result = {}
    for path in sorted(folder.glob("*.npz")):
        stored = np.load(path)
        kx, ky = (2.0 * np.pi / TILE * stored[name] for name in ("along", "across"))
        place = [int(np.argmin(np.abs(stored["x"] - x))) for x in STATIONS]
        result[path.stem] = kx, ky, stored["response"][:, place]
    return result


def of_table() -> dict[str, Measured]:
    """Waves of ``waves.csv``, by the names of their runs."""
    with (HERE / "waves.csv").open(newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    result = {}
    for name in PLAN:
        here = [row for row in rows if row["run"] == name]
        kx, ky = (np.array([float(row[k]) for row in here[:: STATIONS.size]]) for k in ("kx", "ky"))
        for column, end in (("T", ""), ("newtonian", "-newtonian")):
            if end and PLAN[name].points != POINTS:
                continue
            parts = [float(row[f"{column}_re"]) + 1j * float(row[f"{column}_im"]) for row in here]
            result[f"{name}{end}"] = kx, ky, np.array(parts).reshape(-1, STATIONS.size)
    return result


class Waves:
    """Measured waves of a run, and their prediction by the response."""

    def __init__(self, run: Run, measured: Measured) -> None:
        self.kx, self.ky, self.measured = measured
        self.ratio, self.points = run.velocity_ratio, run.points
        settings = case_of(run).resolve()
        self.operating = OperatingPoint.from_settings(settings)
        self.zone = zone(settings, self.operating, run.points)
        self.film = float(np.interp(0.0, self.zone.x, self.zone.film))

    def predicted(self, of_grid: Complex | float = 1.0, newtonian: Zone | None = None) -> Complex:
        """T at the STATIONS (m, 3).

        `of_grid`: factor of the grid on the inlet transfer; `newtonian`: the smooth contact of the
        twin.
        """
        o, spacing = self.operating, SIDE / (self.points - 1)
        waves = self.kx, self.ky
        here = replace(self.zone, newtonian=newtonian)
        moes = o.moes_m, o.moes_l
        inlet = inlet_transfer(here, *waves, moes, self.ratio, spacing=spacing) * of_grid
        result = []
        for x, (driven, free) in zip(
            STATIONS, transport(here, *waves, self.ratio, STATIONS, spacing), strict=True
        ):
            result.append(driven + free * inlet * np.exp(1j * self.kx * (self.ratio - 1) * (x + 1)))
        return np.stack(result, axis=-1)

    def of_grid(self) -> Complex:
        """Factor of the grid on the inlet transfer, from Newtonian waves."""
        none, whole = self.predicted(of_grid=0.0)[:, 0], self.predicted()[:, 0]
        return np.asarray((self.measured[:, 0] - none) / (whole - none))


def zone(settings: dict[str, dict[str, Any]], operating: OperatingPoint, points: int) -> Zone:
    """Centre line of the smooth contact on the grid of the runs."""
    grid = {"points": points, "x_inlet": -2.5, "x_outlet": 1.5, "y_extent": 2.0}
    case = Case(contact=settings["contact"], lubricant=settings["lubricant"], grid=grid)
    with Solver(case) as solver:
        solver.run()
        if solver.summary["status"] != "converged":
            raise SystemExit("the smooth contact did not converge")
        (x, y), pressure, film = solver.axes(), solver.field("P"), solver.field("H")
    middle = int(np.argmin(np.abs(y)))
    line = np.maximum(pressure[:, middle], 0.0), film[:, middle]
    return zone_on(x, *line, operating, Lubricant.from_settings(settings))


def predicted(waves: Waves, newtonian: Waves) -> tuple[Complex, Complex]:
    """T at the STATIONS, with and without the factor of the grid from the twin (m, 3)."""
    plain = waves.predicted(newtonian=newtonian.zone)
    if np.isnan(newtonian.measured).all():
        return plain, plain
    return waves.predicted(newtonian.of_grid(), newtonian.zone), plain


def main(arguments: list[str]) -> None:
    """Write the table and print the deviations of each run."""
    measured = of_runs(Path(arguments[0])) if arguments else of_table()
    rows: list[list[str]] = []
    worst = []
    for name, run in PLAN.items():
        waves = Waves(run, measured[name])
        # a run on a finer grid has no twin: NaN for its waves
        nothing = waves.kx, waves.ky, np.full_like(waves.measured, np.nan)
        newtonian = Waves(twin(run), measured.get(f"{name}-newtonian", nothing))
        film = waves.film / newtonian.film
        t, plain = predicted(waves, newtonian)
        o = waves.operating
        for j in range(waves.kx.size):
            for i, x in enumerate(STATIONS):
                values = waves.measured[j, i], t[j, i], plain[j, i], newtonian.measured[j, i]
                rows.append(
                    [
                        name,
                        f"{o.moes_m:.1f}",
                        f"{o.moes_l:.2f}",
                        f"{2.0 * abs(run.velocity_ratio - 1.0):g}",
                        f"{waves.kx[j]:.6g}",
                        f"{waves.ky[j]:.6g}",
                        f"{x:g}",
                        *(f"{v:.5f}" for c in values for v in (c.real, c.imag)),
                    ]
                )
        off, without = np.abs(t - waves.measured), np.abs(plain - waves.measured)
        changed = np.abs(newtonian.measured - waves.measured)
        worst.append(off[:, 1])
        print(
            f"{name:24s} film {film:.3f} of the Newtonian; off at X = -0.5, 0, 0.5: rms "
            f"{np.sqrt(np.mean(off**2, axis=0)).round(4)} largest {off.max(axis=0).round(4)}; "
            f"without twin {without[:, 1].max():.3f}; the law changes T by "
            f"{changed[:, 1].max():.2f}",
            flush=True,
        )
    whole = np.concatenate(worst)
    fraction = np.count_nonzero(whole <= 0.03) / whole.size
    print(
        f"{whole.size} waves at X = 0: rms {np.sqrt(np.mean(whole**2)):.4f}, largest "
        f"{whole.max():.4f}, {fraction:.1%} within 0.03"
    )
    with (HERE / "waves.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows)


if __name__ == "__main__":
    main(sys.argv[1:])
