# SPDX-License-Identifier: BSD-3-Clause
"""Names of the results in the table of a study: which there are, and what they cost."""

from collections.abc import Sequence

from pyehl import schema
from pyehl.errors import InputError, did_you_mean
from pyehl.theory.film import estimates
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

LAST = ("status", "seconds", "message")
"""Columns that every table has, behind all others."""
TRACKS = ("tracks", "mu_ratio_tracks", "mu_ratio_tracks_spread")
"""Results of a prediction that are made only where they are asked for."""

KINDS = {"solve": "solution", "predict": "prediction", "film": "film"}
NOT_IN_A_TABLE = frozenset(
    "bands film_breakdown formulas pixels schema_version second_pixels second_surface_preparation "
    "surface_preparation wall_seconds".split()
)
"""Quantities that are no number, truth value or word, that all cases share, or are `seconds`."""


def film_columns(name: str) -> tuple[str, str]:
    """Columns of the central and the minimum film by a formula with this name."""
    short = "".join(c if c.isalnum() else "_" for c in name.lower()).strip("_")
    return f"h_c_m_{short}", f"h_min_m_{short}"


def known(run: str) -> list[str]:
    """Names of all results that a table may have where `run` is done with each case."""
    kind = KINDS[run]
    names = [q.name for q in schema.QUANTITIES if kind in q.kinds]
    if run == "film":
        names.append("h_c_m")
        for formula in estimates(OperatingPoint(), Lubricant()):
            names += film_columns(formula.name)
    return [*(name for name in names if name not in NOT_IN_A_TABLE), *LAST]


def checked(outputs: Sequence[str], run: str, origin: str = "") -> tuple[str, ...]:
    """Give the names asked for, each once.

    InputError for one that no table has, with the nearest; `origin` says where it stands.
    """
    names = known(run)
    for name in outputs:
        if name not in names:
            hint = did_you_mean(name, names) or f": {', '.join(names)}"
            raise InputError(
                f"{origin}outputs: unknown result '{name}'\nexpected: names of the summary of "
                f"run = '{run}'{hint}"
            )
    return tuple(dict.fromkeys(outputs))
