# SPDX-License-Identifier: BSD-3-Clause
"""The predictions for a run, each made once and on demand."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from pyehl.case import Case
from pyehl.errors import EhlError, InternalError
from pyehl.handle import SolverHandle, results_of, start_fronts, take_prediction
from pyehl.surfaces import Topography

if TYPE_CHECKING:
    from pyehl.simulation.resolution import Resolution


class Predictions:
    """The initial pressure of a run, and the part of mu_r/mu_s that its grid does not resolve.

    The package of the prediction is loaded on demand.

    Parameters
    ----------
    case
        The case of the run.
    tiles
        Surfaces by group that replace those of the case; of a large surface only a part.
    whole
        Whether all `tiles` are whole surfaces, not parts.

    Attributes
    ----------
    why_none
        Why the contribution of waves that the grid omits is not predicted; '' if it is.
    """

    why_none = ""

    def __init__(self, case: Case, tiles: Mapping[str, Topography], *, whole: bool) -> None:
        self._case, self._tiles, self._whole = case, tiles, whole
        self._resolution: Resolution | str | None = None
        self._resolved = self._passed = False

    def begin(self, solver: SolverHandle) -> None:
        """Pass the predicted initial pressure to a solver, if it needs one."""
        if start_fronts(solver).size:
            from pyehl.simulation.initial_condition import transfer  # noqa: PLC0415

            transfer(solver, self._case.resolve(), self._tiles, whole=self._whole)

    def _resolution_once(self) -> Resolution | str | None:
        """Predict the part that the grid does not resolve, or give the reason for a failure."""
        if not self._resolved:
            from pyehl.simulation.resolution import resolution  # noqa: PLC0415

            try:
                self._resolution = resolution(self._case, self._tiles)
            except InternalError:
                raise
            except (EhlError, MemoryError) as error:
                why = str(error) or type(error).__name__
                self._resolution = why.replace(chr(10), " ")
            self._resolved = True
        return self._resolution

    def lines(self) -> list[str]:
        """Lines of the plan about the part that the grid does not resolve."""
        result = self._resolution_once()
        if isinstance(result, str):
            return [f"predicted   no mu_r/mu_s: {result}"]
        return result.report() if result else []

    def transfer(self, solver: SolverHandle) -> None:
        """Pass the prediction to a solver, if the error of its mu_ratio depends on it."""
        values = {} if self._passed else results_of(solver).values
        if values.get("mu_ratio") is None or not values["variance_unresolved"]:
            return
        result = self._resolution_once()
        if isinstance(result, str):
            # only the status: the plan prints the message
            why = result.partition(": ")[0]
            self.why_none = f"the contribution of the omitted waves is not predicted ({why})"
            take_prediction(solver, math.nan, math.nan)
        elif result is not None:
            take_prediction(solver, result.left_out, result.unresolved)
        self._passed = True
