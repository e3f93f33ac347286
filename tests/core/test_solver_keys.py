# SPDX-License-Identifier: BSD-3-Clause
"""Keys, defaults and ranges of the solver are those of the table of keys."""

from pyehl.case.settings import KEYS, MACHINES
from pyehl.extension import cases
from pyehl.library import whole


def test_keys_defaults_and_ranges_of_the_solver_are_those_of_the_table():
    (told,) = whole(lambda room: (cases.defaults(room),), 0)
    solver = {
        name: (default, allowed)
        for name, default, allowed in (line.split("\t") for line in told.decode().splitlines())
    }
    # what the solver does not choose between: truth values, oils by name; lists have no default
    table = {
        key.name: (
            "" if key.kind == "numbers" else key.default,
            "" if key.kind in ("truth", "numbers") or key.name == "lubricant.name" else key.allowed,
        )
        for key in KEYS.values()
        if key.group not in MACHINES
    }
    assert solver == table
