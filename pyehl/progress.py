# SPDX-License-Identifier: BSD-3-Clause
"""A progress bar of a solver, with the time left of a transient run."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from pyehl.handle import Work
from pyehl.solver import Solver

if TYPE_CHECKING:
    from tqdm import tqdm

__all__ = ["ProgressBar"]

STEADY = "{desc} [{elapsed}]"
TRANSIENT = "{percentage:3.0f}%|{bar:10}|{desc} [{elapsed}]"


class ProgressBar:
    """A line on stderr: the state of a solver; in a transient run a bar and the time left."""

    def __init__(self, *, disable: bool = False) -> None:
        self._bar: tqdm | None = None
        if not disable:
            from tqdm import tqdm  # noqa: PLC0415 (most runs show no bar)

            # without a total, tqdm would draw an empty line at once
            self._bar = tqdm(bar_format=STEADY, delay=1e-9)
        self._begin: tuple[float, float] | None = None

    @property
    def disabled(self) -> bool:
        """Whether nothing is shown."""
        return self._bar is None

    def show(self, solver: Solver) -> None:
        """Show the state of a solver."""
        if self._bar is None:
            return
        work, text = solver.work(), solver.progress()
        if work.earliest > 0.0:
            self._bar.bar_format = TRANSIENT
            self._bar.total, self._bar.n = work.earliest, work.done
            # in front of the state: a narrow terminal cuts the end of the line
            state = text.rpartition(", ")[0] if text.endswith(" s left") else text
            text = f" {self._left(work, self._bar.format_interval)} | {state}"
        self._bar.set_description_str(text)

    def _left(self, work: Work, interval: Callable[[float], str]) -> str:
        """Tell the time left, by the steps since the first call."""
        now = time.monotonic()
        if self._begin is None:
            self._begin = (now, work.done)
        began, done = self._begin
        if work.done <= done:
            return "?"
        rate = (now - began) / (work.done - done)
        if work.earliest > work.done:
            return f"{interval((work.earliest - work.done) * rate)} left"
        return f"at most {interval((work.latest - work.done) * rate)} left"

    def close(self) -> None:
        """End the line."""
        if self._bar is not None:
            self._bar.close()
