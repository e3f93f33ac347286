# SPDX-License-Identifier: BSD-3-Clause
"""Oils that thin: waves and rough surfaces."""

from __future__ import annotations

import numpy as np
from records import Row, Values, largest, of, read


def thinning_waves() -> Values:
    """By how much measured waves of oils that thin differ from the response, by run."""
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
    """The summaries of the surfaces of e, f and i."""
    found = {row["name"]: row for row in read("thinning/simulated.csv")}
    aims = {
        ("mu_ratio", "mu_ratio_model_error"): 0.5,
        ("p_rise_rms_Pa", "p_rise_rms_error_Pa"): 5,
        ("p_rise_max_Pa", "p_rise_max_error_Pa"): None,
        ("h_min_rough_m", "h_min_rough_error_m"): 5,
        ("rms_deformed_m", "rms_deformed_error_m"): None,
    }
    lines = {}
    for table, letter in (("predicted", "e"), ("predicted", "f"), ("committed", "i")):
        said = [row for row in read(f"thinning/{table}.csv") if row["name"][0] == letter]
        runs = [found[row["name"]] for row in said]
        for (name, error), aim in aims.items():
            values = of(runs, name)
            if name == "h_min_rough_m":
                values += of(runs, "h_min_extrapolated_m") - of(runs, "h_min_m")
            off = of(said, name) - values
            covered = np.count_nonzero(np.abs(off) <= of(said, error))
            off *= 100.0 / values
            within = np.count_nonzero(np.abs(off) <= (aim or 0))
            good = f"{within} of {off.size} within {aim} %" if aim else ""
            lines[letter, name] = (
                f"{np.sqrt(np.mean(off**2)):.2f} % | {largest(off, 1)} % | {good} "
                f"| {covered} of {off.size}"
            )
    return locals()
