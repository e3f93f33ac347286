# SPDX-License-Identifier: BSD-3-Clause
"""Tables of docs/evidence/thinning/README.md beside the records of that folder."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from records import Read, Row, Said, largest, missing, of


def thinning_waves(read: Read) -> Iterator[str]:
    """By how much measured waves of oils that thin differ from the response, by run."""
    runs: dict[str, list[Row]] = {}
    for row in read("thinning/waves.csv"):
        if float(row["x"]) == 0.0:
            runs.setdefault(row["run"], []).append(row)
    every = []
    for name, rows in runs.items():
        t, predicted, alone, newtonian = (
            of(rows, f"{part}_re") + 1j * of(rows, f"{part}_im")
            for part in ("T", "predicted", "without_twin", "newtonian")
        )
        yield f"| {name} | {float(rows[0]['slide_to_roll']):g} |"
        off = np.abs(t - predicted)
        cells = (
            f"{np.abs(t - newtonian).max():.2f} | {np.sqrt(np.mean(off**2)):.4f} | {off.max():.3f}"
        )
        if np.isnan(newtonian).any():
            cells = " |  | "
        else:
            every.extend(off)
        yield f" | {cells} | {np.abs(t - alone).max():.3f} |"
    yield f"**All {len(every)} waves are within 0.03**"
    yield f"the rms deviation is {np.sqrt(np.mean(np.square(every))):.3f}"


def thinning_surfaces(read: Read) -> Iterator[str]:
    """The summaries of the surfaces of e, f and i."""
    found = {row["name"]: row for row in read("thinning/simulated.csv")}
    aims = {
        ("mu_ratio", "mu_ratio_model_error", "μ_r/μ_s"): 0.5,
        ("p_rise_rms_Pa", "p_rise_rms_error_Pa", "rms of the pressure"): 5,
        ("p_rise_max_Pa", "p_rise_max_error_Pa", "greatest rise"): None,
        ("h_min_rough_m", "h_min_rough_error_m", "least film"): 5,
        ("rms_deformed_m", "rms_deformed_error_m", "rms height, deformed"): None,
    }
    for table, letter in (("predicted", "e"), ("predicted", "f"), ("committed", "i")):
        said = [row for row in read(f"thinning/{table}.csv") if row["name"][0] == letter]
        runs = [found[row["name"]] for row in said]
        for (name, error, words), aim in aims.items():
            values = of(runs, name)
            if name == "h_min_rough_m":
                values += of(runs, "h_min_extrapolated_m") - of(runs, "h_min_m")
            off = of(said, name) - values
            covered = np.count_nonzero(np.abs(off) <= of(said, error))
            off *= 100.0 / values
            within = np.count_nonzero(np.abs(off) <= (aim or 0))
            good = f"{within} of {off.size} within {aim} %" if aim else ""
            yield (
                f"| {words} | {np.sqrt(np.mean(off**2)):.2f} % | {largest(off, 1)} % | {good} "
                f"| {covered} of {off.size} |"
            )


@pytest.mark.parametrize("said", [thinning_waves, thinning_surfaces])
def test_the_page_says_what_its_tables_have(root: Path, said: Said):
    assert missing(root, "docs/evidence/thinning/README.md", said) == []
