# SPDX-License-Identifier: BSD-3-Clause
"""A progress bar of a solver, with the time left of a transient run."""

from __future__ import annotations

import time

from tqdm import tqdm

from pyehl.handle import Work
from pyehl.solver import Solver

__all__ = ["ProgressBar"]

STEADY = "{desc} [{elapsed}]"
TRANSIENT = "{percentage:3.0f}%|{bar:10}|{desc} [{elapsed}]"


class ProgressBar:
    """A line on stderr: the state of a solver; in a transient run a bar and the time left.

    Parameters
    ----------
    disable
        Show nothing.
    """

    def __init__(self, *, disable: bool = False) -> None:
        # without a total, tqdm would draw an empty line at once
        self._bar = tqdm(bar_format=STEADY, disable=disable, delay=1e-9)
        self._begin: tuple[float, float] | None = None

    @property
    def disabled(self) -> bool:
        """Whether nothing is shown."""
        return bool(self._bar.disable)

    def show(self, solver: Solver) -> None:
        """Show the state of a solver."""
        if self._bar.disable:
            return
        work, text = solver.work(), solver.progress()
        if work.earliest > 0.0:
            self._bar.bar_format = TRANSIENT
            self._bar.total, self._bar.n = work.earliest, work.done
            # in front of the state: a narrow terminal cuts the end of the line
            state = text.rpartition(", ")[0] if text.endswith(" s left") else text
            text = f" {self._left(work)} | {state}"
        self._bar.set_description_str(text)

    def _left(self, work: Work) -> str:
        """Tell the time left, by the steps since the first call."""
        now = time.monotonic()
        if self._begin is None:
            self._begin = (now, work.done)
        began, done = self._begin
        if work.done <= done:
            return "?"
        rate = (now - began) / (work.done - done)
        if work.earliest > work.done:
            return f"{tqdm.format_interval((work.earliest - work.done) * rate)} left"
        return f"at most {tqdm.format_interval((work.latest - work.done) * rate)} left"

    def close(self) -> None:
        """End the line."""
        self._bar.close()
