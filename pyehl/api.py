# SPDX-License-Identifier: BSD-3-Clause
"""What people type: solve and predict in one call."""

from __future__ import annotations

import os

from pyehl.case import Case, Option
from pyehl.errors import FileError, InputError
from pyehl.prediction import of_case
from pyehl.prediction.of_case import Prediction

__all__ = ["predict"]


def predict(case: Case | str | os.PathLike[str], *options: Option) -> Prediction:
    """Predict the relative friction of a rough contact from the spectrum of its surface.

    Parameters
    ----------
    case
        A case, or the path of a case file.
    *options
        Texts ``group.key=value`` that replace values.

    Returns
    -------
    Prediction
        With ``mu_ratio`` (mu_r/mu_s [-]), ``summary``, ``data`` and ``plot()``.

    Raises
    ------
    InputError
        If the case is not acceptable, or has no rough surface.
    FileError
        If a height map cannot be read.

    Examples
    --------
    >>> import pyehl
    >>> p = pyehl.predict("cases/table1.nml", "surface.seed=3")
    >>> p
    Prediction(mu_ratio=1.117, 'predicted')
    """
    case = Case.of(case, *options)
    try:
        return of_case.predict(case.resolve(), case.text)
    except OSError as error:
        raise FileError(str(error)) from error
    except ValueError as error:
        raise InputError(str(error)) from error
