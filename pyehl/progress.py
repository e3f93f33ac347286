# SPDX-License-Identifier: BSD-3-Clause
"""A progress bar of a solver, with the time left of a transient run."""

from pyehl.solver import Solver

STEADY = "{desc} [{elapsed}]"
TRANSIENT = "{percentage:3.0f}%|{bar:10}|{desc} [{elapsed}]"


class ProgressBar:
    """A line on stderr: the state of a solver; in a transient run a bar and the time left."""

    def __init__(self) -> None:
        from tqdm import tqdm  # noqa: PLC0415 (most runs show no bar)

        # without the delay, tqdm would draw an empty line at once
        self._bar = tqdm(bar_format=STEADY, delay=1e-9)

    def show(self, solver: Solver) -> None:
        """Show the state of a solver; when it is done the line ends."""
        work, text = solver.work, solver.progress
        if work.earliest > 0.0:
            self._bar.bar_format = TRANSIENT
            self._bar.total, self._bar.n = work.earliest, work.done
            state, _, left = text.rpartition(", ")
            # in front of the state: a narrow terminal cuts the end of the line
            text = f" {left} | {state}" if left.endswith(" s left") else f" {text}"
        self._bar.set_description_str(text)
        if solver.done:
            self._bar.close()
