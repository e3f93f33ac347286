# SPDX-License-Identifier: BSD-3-Clause
"""Shear-thinning oils: waves and rough surfaces."""

from __future__ import annotations

import numpy as np
from records import Row, Values, largest, of, read

ERRORS = {
    "mu_ratio": "mu_ratio_model_error",
    "p_rise_rms_Pa": "p_rise_rms_error_Pa",
    "p_rise_max_Pa": "p_rise_max_error_Pa",
    "h_min_rough_m": "h_min_rough_error_m",
    "rms_deformed_m": "rms_deformed_error_m",
}
AIMS = {"mu_ratio": 0.5, "p_rise_rms_Pa": 5, "h_min_rough_m": 5}
"""Target deviations [%]."""


def thinning_waves() -> Values:
    """Deviations of measured waves of shear-thinning oils from the response, by run."""
    runs: dict[str, list[Row]] = {}
    for row in read("thinning/waves.csv"):
        if float(row["x"]) == 0.0:
            runs.setdefault(row["run"], []).append(row)
    every = []
    lines = {}
    for name, rows in runs.items():
        t, predicted, alone, newtonian = (
            of(rows, f"{part}_re") + 1j * of(rows, f"{part}_im")
            for part in ("T", "predicted", "without_twin", "newtonian")
        )
        off = np.abs(t - predicted)
        cells = (
            f"{np.abs(t - newtonian).max():.2f} | {np.sqrt(np.mean(off**2)):.4f} | {off.max():.3f}"
        )
        if np.isnan(newtonian).any():
            cells = " |  | "
        else:
            every.extend(off)
        lines[name] = f"{cells} | {np.abs(t - alone).max():.3f}"
    return locals()


def thinning_surfaces() -> Values:
    """Summaries of the surfaces of i."""
    return {
        "lines": {("i", n): line for n, line in summaries("simulated", "i", "committed").items()}
    }


def deviations(table: str, names: str, prediction: str) -> Values:
    """Relative deviations of surfaces by the first letter of their names, and coverage."""
    said = {row["name"]: row for row in read(f"thinning/{prediction}.csv")}
    runs = [row for row in read(f"thinning/{table}.csv") if row["name"][0] in names]
    result = {}
    for name, error in ERRORS.items():
        values = of(runs, name)
        if name == "h_min_rough_m":
            values += of(runs, "h_min_extrapolated_m") - of(runs, "h_min_m")
        rows = [said[row["name"]] for row in runs]
        off = of(rows, name) - values
        result[name] = off / values, np.abs(off) <= of(rows, error)
    return result


def summaries(table: str, names: str, prediction: str) -> Values:
    """Lines of a table of deviations by quantity."""
    lines = {}
    for name, (off, covered) in deviations(table, names, prediction).items():
        aim = AIMS.get(name)
        within = np.count_nonzero(np.abs(off) <= 0.01 * aim) if aim else 0
        good = f"{within} of {off.size} within {aim:g} %" if aim else ""
        share = 100.0 * off
        lines[name] = (
            f"{np.sqrt(np.mean(share**2)):.2f} % | {largest(share, 1)} % | {good} "
            f"| {np.count_nonzero(covered)} of {off.size}"
        )
    return lines


def surfaces_before() -> Values:
    """Surfaces predicted before they were simulated, on both grids; all surfaces."""
    coarse, fine = (summaries(table, "gh", "committed") for table in ("simulated", "fine"))
    every = deviations("simulated", "efghi", "predicted")
    ratio, film = (every[name][0] for name in ("mu_ratio", "h_min_rough_m"))
    ratios, films = np.count_nonzero(abs(ratio) <= 0.005), np.count_nonzero(abs(film) <= 0.05)
    rms = [100.0 * np.sqrt(np.mean(off**2)) for off in (ratio, film)]
    most = 100.0 * abs(film).max()
    return locals()


def surface_rows() -> Values:
    """Predicted and simulated values of each surface; g, h and i as committed."""
    tables = {
        name: {row["name"]: row for row in read(f"thinning/{name}.csv")}
        for name in ("committed", "predicted")
    }
    units = {"p_rise_rms_Pa": 1e6, "p_rise_max_Pa": 1e6, "h_min_rough_m": 1e-9}
    lines = {}
    for run in read("thinning/simulated.csv"):
        name = run["name"]
        said = tables["committed" if name[0] in "ghi" else "predicted"][name]
        cells = [f"{float(said['mu_ratio']):.4f} / {float(run['mu_ratio']):.4f}"]
        for key, unit in units.items():
            value = float(run[key])
            if key == "h_min_rough_m":
                value += float(run["h_min_extrapolated_m"]) - float(run["h_min_m"])
            cells.append(f"{float(said[key]) / unit:.3g} / {value / unit:.3g}")
        lines[name] = " | ".join(cells)
    return locals()
