# SPDX-License-Identifier: BSD-3-Clause
"""Keys, defaults and ranges of the solver agree with the table of keys."""

import numpy as np

from pyehl.case.settings import KEYS, MACHINES
from pyehl.extension import cases


def test_keys_defaults_and_ranges_of_the_solver_are_those_of_the_table():
    room = np.empty(65536, np.int32)
    length = cases.defaults(room)
    assert length <= room.size
    reported = room[:length].astype(np.uint8).tobytes()
    solver = {
        name: (default, allowed)
        for name, default, allowed in (line.split("\t") for line in reported.decode().splitlines())
    }
    # the solver reports no choices for these: truth values, oils by name; lists have no default
    table = {
        key.name: (
            "" if key.kind == "numbers" else key.default,
            "" if key.kind in ("truth", "numbers") or key.name == "lubricant.name" else key.allowed,
        )
        for key in KEYS.values()
        if key.group not in MACHINES
    }
    assert solver == table
