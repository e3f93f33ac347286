# SPDX-License-Identifier: BSD-3-Clause
"""What predictions leave out, for ``pyehl bench skips``: smooth contacts, starts of Python."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from pyehl.bench.comparison import Row, Values, compare, nothing
from pyehl.case import Case
from pyehl.prediction import smooth as smooth_contact
from pyehl.prediction.of_case import predict

__all__ = ["prediction_scene", "sweep_scene"]

FRACTAL = "surface.kind=fractal"


def _predict(*options: str, keep: bool = True) -> Values:
    if not keep:
        smooth_contact.forget()
    return predict(Case.from_text("", [FRACTAL, *options]).resolve()).summary


def prediction_scene(points: int, repeats: int) -> list[Row]:
    """Prediction of a fractal surface, nothing simulated."""
    _predict()
    return [
        compare(
            "prediction only",
            "the smooth contact of another surface",
            "mu_ratio",
            lambda: _predict("surface.seed=2"),
            lambda: _predict("surface.seed=2", keep=False),
            nothing,
            repeats,
        )
    ]


def sweep_scene(points: int, repeats: int) -> list[Row]:
    """Sweep of predictions over surfaces."""
    cases = 20
    seeds = [f"surface.seed={k + 1}" for k in range(cases)]

    def together() -> Values:
        smooth_contact.forget()
        return {"mu_ratio": [_predict(seed)["mu_ratio"] for seed in seeds]}

    def alone() -> Values:
        return {"mu_ratio": [_predict(seed, keep=False)["mu_ratio"] for seed in seeds]}

    return [
        compare(
            f"sweep of {cases}",
            f"{cases - 1} smooth contacts",
            "mu_ratio",
            together,
            alone,
            nothing,
            repeats,
        ),
        _starts_row(seeds, together),
    ]


def _starts_row(seeds: Sequence[str], together: Callable[[], Values]) -> Row:
    """One process for all cases, or one for each."""

    def apart() -> Values:
        found = []
        with tempfile.TemporaryDirectory(prefix="pyehl-") as place:
            case = Path(place) / "case.nml"
            case.write_text("&surface kind = 'fractal' /\n", encoding="utf-8")
            for k, seed in enumerate(seeds):
                folder = Path(place) / str(k)
                words = ["predict", str(case), "--set", seed, "-o", str(folder), "--no-plots"]
                subprocess.run(
                    [sys.executable, "-P", "-m", "pyehl", *words], check=True, capture_output=True
                )
                text = (folder / "summary.json").read_text(encoding="utf-8")
                found.append(json.loads(text)["mu_ratio"])
        return {"mu_ratio": found}

    return compare(
        f"sweep of {len(seeds)}",
        f"{len(seeds) - 1} starts of Python, and the above",
        "mu_ratio",
        together,
        apart,
        nothing,
        1,
    )
