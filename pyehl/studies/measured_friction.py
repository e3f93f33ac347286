# SPDX-License-Identifier: BSD-3-Clause
"""Measured friction for comparison with a Stribeck curve, and CSV tables of users."""

import csv
import math
import os
import re
from dataclasses import dataclass

import numpy as np

from pyehl.errors import InputError
from pyehl.given import text_file
from pyehl.theory.transition import Curve
from pyehl.types import Array


def csv_rows(name: str, text: str) -> tuple[str, list[str], list[tuple[int, dict[str, str]]]]:
    """Read CSV without empty lines and comments (``#``).

    Returns the beginning of a message about the line of names, the names, and the rows with the
    number of their line. InputError for a row with more or fewer cells than names.
    """
    lines = [
        (number, [cell.strip() for cell in next(csv.reader([line]))])
        for number, line in enumerate(text.splitlines(), 1)
        if line.strip(" ,;\t") and line[0] != "#"
    ]
    (first, head), *others = lines or [(1, [])]
    for number, cells in others:
        if len(cells) != len(head):
            raise InputError(
                f"{name}:{number}: error: {len(cells)} values for {len(head)} columns\nexpected: "
                "one value for each, with decimal points, not commas"
            )
    rows = [(number, dict(zip(head, cells, strict=True))) for number, cells in others]
    return f"{name}:{first}: error:", head, rows


def number_in(cell: str) -> float:
    """Give the number in a cell; NaN if it is not a finite number."""
    try:
        value = float(cell)
    except ValueError:
        return math.nan
    return value if math.isfinite(value) else math.nan


LIKE_ERRORS = re.compile(r"err|std|sigma|uncert|dev|\+-|±", re.IGNORECASE)
"""Names of columns that probably hold errors."""


@dataclass(frozen=True, slots=True)
class Measured:
    """Measured friction, or a film of a rig."""

    abscissa: str  # name of the column of the curve that it was measured over
    places: Array  # values of it, (n,)
    ordinate: str  # 'mu' or 'mu_ratio', of a rig also the name of a film
    # Values and their errors (n,); zeros if no errors are given [-]; films [m]
    friction: Array
    error: Array

    def outside(self, places: Array) -> int:
        """Count its places outside of a curve over `places` (NaN: not known)."""
        known = places[np.isfinite(places)]
        inside = (self.places >= known.min()) & (self.places <= known.max()) if known.size else []
        return self.places.size - int(np.count_nonzero(inside))

    def deviation(self, name: str, curve: Curve) -> Array:
        """Give a column of the curve over the measured friction, minus 1 (n,); NaN outside of it.

        Interpolated along the curve, between places with the column.
        """
        source, target = curve.column(self.abscissa), curve.column(name)
        return _along(self.places, source, target) / self.friction - 1.0

    def over(self, name: str, curve: Curve) -> Array:
        """Give the places in another column of a curve, (n,); NaN outside of the curve.

        Interpolated along the curve, in logarithms.
        """
        if name == self.abscissa:
            return self.places
        columns = curve.column(self.abscissa), curve.column(name)
        source, target = (np.log(np.where(v > 0.0, v, np.nan)) for v in columns)
        return np.asarray(np.exp(_along(np.log(self.places), source, target)))


def _along(at: Array, source: Array, target: Array) -> Array:
    """Interpolate one column of a curve over another; NaN outside of it."""
    known = np.isfinite(source) & np.isfinite(target)
    if np.count_nonzero(known) < 2:
        return np.full(at.shape, np.nan)
    order = np.argsort(source[known])
    x, y = source[known][order], target[known][order]
    return np.interp(at, x, y, left=np.nan, right=np.nan)


def read_measured(path: str | os.PathLike[str], key: str) -> Measured:
    """Read measured friction for a curve over `key`: CSV with a line of names.

    One column is `key`, ``hersey``, ``lambda_ratio`` or ``theta_2``; another ``mu`` or
    ``mu_ratio``; a third, which may be missing, ``error``. InputError with the file and the line,
    and what was expected.
    """
    name = os.fspath(path)
    where, head, lines = csv_rows(name, text_file(path))
    known = (key, "hersey", "lambda_ratio", "theta_2")
    abscissae = [word for word in head if word in known]
    ordinates = [word for word in head if word in ("mu", "mu_ratio")]
    if len(abscissae) != 1 or len(ordinates) != 1:
        other = next((sign for sign in ";\t" if len(head) == 1 and sign in head[0]), "")
        hint = f"; with commas between columns, not {other!r}" if other else ""
        raise InputError(
            f"{where} columns: {', '.join(head) or 'none'}\nexpected: one of "
            f"{', '.join(known)}; one of mu, mu_ratio; and error, which may be missing{hint}"
        )
    abscissa, ordinate = abscissae[0], ordinates[0]
    # errors under another name would be ignored, and with them the weights of a fit
    unused = [word for word in head if word not in (abscissa, ordinate, "error")]
    like = [word for word in unused if LIKE_ERRORS.search(word)]
    if like or head.count("error") > 1:
        raise InputError(
            f"{where} {f'the column {like[0]!r}' if like else 'two columns error'}\n"
            "expected: errors of the friction in one column 'error'"
        )
    wanted = [abscissa, ordinate, *(["error"] if "error" in head else [])]
    for number, row in lines:
        for word in wanted:
            if not number_in(row[word]) > 0.0:
                other = ", or no column 'error' where the errors are not known"
                raise InputError(
                    f"{name}:{number}: error: {word} = '{row[word]}'\nexpected: a number above 0"
                    f"{other if word == 'error' else ''}"
                )
    if not lines:
        raise InputError(f"{name}: error: there are no rows")
    table = np.array([[float(row[word]) for word in wanted] for _, row in lines])
    error = table[:, 2] if "error" in head else np.zeros(len(table))
    return Measured(abscissa, table[:, 0], ordinate, table[:, 1], error)
