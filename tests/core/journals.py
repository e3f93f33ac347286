# SPDX-License-Identifier: BSD-3-Clause
"""Rows of the journal of a study, also while another process writes it."""

import json
import shutil
import sqlite3
import tempfile
from contextlib import closing, suppress
from pathlib import Path

from pyehl.studies.journal import FILES, NAME


def rows_in(folder: Path) -> dict[int, dict[str, object]]:
    """Rows by number, in the order of the numbers; none if there is no journal yet."""
    with tempfile.TemporaryDirectory() as place:
        # as a kill at this instant would leave it
        for name in FILES:
            # a file that the writer removes at this instant is missing
            with suppress(FileNotFoundError):
                shutil.copyfile(folder / name, Path(place) / name)
        if not (Path(place) / NAME).is_file():
            return {}
        try:
            with closing(sqlite3.connect(Path(place) / NAME)) as base:
                return {n: json.loads(row) for n, row in base.execute("SELECT * FROM rows")}
        except sqlite3.DatabaseError:
            # copied while the database was created
            return {}
