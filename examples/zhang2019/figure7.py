# SPDX-License-Identifier: BSD-3-Clause
"""Figure 7: mu_r/mu_s of random surfaces by simulation and by two predictions."""

from dataclasses import dataclass

import numpy as np
import pictures
from conditions import MODELS, SEED, predictions, resolved_waves, simulations
from piece import Check, Finding, Level, References, Result
from runs import Made, Runs, friction_of
from table1 import CASE

from pyehl.prediction.model import PAPER_STIFFNESS
from pyehl.types import Array

NAME = "figure 7"
TITLE = "Relative friction of random surfaces by simulation and by prediction"
# The slip study: velocity ratios, and a grid on which it takes a minute
VELOCITY_RATIOS = (1.0, 1.01)
SLIP_GRID = 257
SLIP = "Slip is missing in the paper's prediction"


@dataclass(frozen=True, slots=True)
class Surfaces:
    """mu_r/mu_s by seed (n,)."""

    simulated: Array  # by simulation
    predicted: dict[str, Array]  # by model, see `MODELS`
    # First seed at `VELOCITY_RATIOS`, by simulation and by our prediction; the paper's model has
    # no slip
    slip: tuple[Array, Array]
    slip_grid: int  # nodes per side of the slip study
    studies: list[Made]  # studies used


def run(runs: Runs, level: Level) -> Surfaces:
    """Simulate and predict the surfaces, the first one also in pure rolling."""
    rows, studies = simulations(runs, level)
    predicted = {model: predictions(runs, level, model) for model in MODELS}
    grid = min(SLIP_GRID, level.surface_grid)
    text = "&time estimate_error = .false. /\n&output fields = .false. /\n"
    text += f"&grid points = {grid} /\n"
    vary = {"surface.velocity_ratio": list(VELOCITY_RATIOS)}
    slip = [
        runs.study(f"slip-{grid}", CASE + text, vary),
        runs.study(
            f"slip-predictions-{grid}", CASE, vary, options=resolved_waves(grid), run="predict"
        ),
    ]
    return Surfaces(
        friction_of(rows),
        {model: friction_of(made.rows) for model, made in predicted.items()},
        (friction_of(slip[0].rows), friction_of(slip[1].rows)),
        grid,
        [*studies, *predicted.values(), *slip],
    )


def _deviations(predicted: Array, simulated: Array) -> tuple[float, float]:
    """Mean of the absolute and of the signed relative deviation."""
    d = predicted / simulated - 1.0
    d = d[np.isfinite(d)]
    return float(np.abs(d).mean()), float(d.mean())


def show(data: Surfaces, references: References, level: Level) -> Result:
    """Draw both predictions with the simulation, and compare the mean deviations."""
    seeds = np.arange(SEED, SEED + data.simulated.size)
    means = {model: _deviations(p, data.simulated) for model, p in data.predicted.items()}
    labels = {
        "response": f"our prediction: {100 * means['response'][0]:.1f} % off on average",
        "paper": f"the paper's model: {100 * means['paper'][0]:.1f} %",
    }
    shown = [(labels[model], data.predicted[model]) for model in labels]
    figure = pictures.by_seed(seeds, data.simulated, shown)
    names = ["seed", "simulated"]
    names += [f"{word}_{model}" for word in ("predicted", "deviation") for model in MODELS]
    rows = [
        (int(seeds[k]), data.simulated[k], *(data.predicted[m][k] for m in MODELS),
         *(data.predicted[m][k] / data.simulated[k] - 1.0 for m in MODELS))
        for k in range(seeds.size)
    ]  # fmt: skip
    claimed = references["fig7.deviation"]
    checks = [
        Check.of(
            "mean deviation of the paper's model from simulation", means["paper"][0], claimed,
            finding=SLIP,
        ),
        Check(
            "mean deviation of our prediction from simulation", means["response"][0], 0.0,
            claimed.value, "no more than the paper claims for its own", "our simulation",
        ),
    ]  # fmt: skip
    spread = float(np.nanmin(data.simulated)), float(np.nanmax(data.simulated))
    notes = [
        f"On {level.surface_grid} x {level.surface_grid} nodes; the predictions count the waves "
        "that this grid resolves, those longer than two mesh sizes.",
        f"Simulated mu_r/mu_s of {seeds.size} surfaces with the inputs of Table 1: mean "
        f"{np.nanmean(data.simulated):.3f}, {spread[0]:.3f} to {spread[1]:.3f}.",
        *(
            f"{words}: mean mu_r/mu_s {np.nanmean(data.predicted[m]):.3f}, mean deviation from "
            f"simulation {100 * means[m][1]:+.1f} %, of absolute values {100 * means[m][0]:.1f} %."
            for m, words in (
                ("response", "Our prediction"),
                ("paper", "The paper's model with Roelands' law and exact stiffness"),
                ("literal", "The paper's model with eq. 11 read literally and Barus' law"),
            )
        ),
    ]
    return Result(
        checks,
        (names, rows),
        figure,
        "By seed of the surface; the paper's surfaces are not published.",
        notes,
        _findings(data, means, spread, references),
        data.studies,
        paper_seconds=(
            f"{references['time.simulation'].value / 86400:g} days for a simulation, "
            f"{references['time.prediction'].value:g} s for each time step of a prediction"
        ),
    )


def _findings(
    data: Surfaces,
    means: dict[str, tuple[float, float]],
    spread: tuple[float, float],
    references: References,
) -> list[Finding]:
    (rolling, slipping), predicted = data.slip
    printed = references["table2.ehl.513"].value
    return [
        Finding(
            SLIP,
            f"On {data.slip_grid} x {data.slip_grid} nodes the surface of seed {SEED} has "
            f"mu_r/mu_s = {rolling:.3f} in pure rolling (U_rat = 1) and {slipping:.3f} at "
            f"U_rat = 1.01 by simulation, {predicted[0]:.3f} and {predicted[1]:.3f} by our "
            "prediction. The paper's model ignores slip and "
            f"gives {data.predicted['paper'][0]:.3f}. Over all surfaces its mean "
            f"deviation is {100 * means['paper'][1]:+.1f} %, that of our prediction "
            f"{100 * means['response'][1]:+.1f} %.",
        ),
        Finding(
            "The paper's surface is not published",
            f"mu_r/mu_s = {printed:g} (Table 2) is the value of one surface. Surfaces with the "
            f"same inputs and other seeds have {spread[0]:.3f} to {spread[1]:.3f} here: the inputs "
            "do not determine this value.",
        ),
        Finding(
            "Misprints and readings",
            f"Eq. 11 with its wavelength read as 2 pi/|q| is {100 * (PAPER_STIFFNESS - 1.0):.0f} % "
            "stiffer than the half-space, and the paper does not state the viscosity law of the "
            "prediction. For the same surfaces the paper's model gives a mean of "
            f"{np.nanmean(data.predicted['literal']):.3f} if read literally, with Barus' law of "
            f"the appendix, and of {np.nanmean(data.predicted['paper']):.3f} with the exact "
            "stiffness and Roelands' law of section 2.",
        ),
    ]
