# SPDX-License-Identifier: BSD-3-Clause
"""Files that were uploaded to one page: kept in a folder of their own, gone with the page.

The page knows their names alone. What a reader reports of a file names it, not where it lies.
"""

import re
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pyehl.errors import EhlError, InputError
from pyehl.surfaces.reading import read_scan

MAX_BYTES = 64 * 2**20
"""Bytes of the largest file that is taken."""
# What is read for the first time, and what could be read
PLACES = ("new", "maps")


class Uploads:
    """Height maps by the names that they had."""

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="pyehl-app-")
        for place in PLACES:
            (Path(self._folder.name) / place).mkdir()
        self.files: dict[str, str] = {}

    def add(self, name: str, data: bytes, given: Mapping[str, Any] | None = None) -> str:
        """Keep a height map if it can be read; returns where. A map of the same name is replaced.

        `given` is what a case states of it, as `check` takes it. InputError with the words of the
        reader; what was there of this name is kept then.
        """
        base = re.sub(r"[^\w.\- ]", "_", Path(name.replace("\\", "/")).name).lstrip(".")
        if not base:
            raise InputError("the map has no name: expected a file")
        if len(data) > MAX_BYTES:
            raise InputError(f"{base}: {len(data)} bytes; a map of up to {MAX_BYTES} was expected")
        fresh, path = (Path(self._folder.name) / place / base for place in PLACES)
        fresh.write_bytes(data)
        try:
            self.check(str(fresh), given or {})
            fresh.replace(path)
        finally:
            fresh.unlink(missing_ok=True)
        self.files[base] = str(path)
        return str(path)

    def check(self, path: str, given: Mapping[str, Any]) -> None:
        """Read a map; InputError with the words of the reader.

        `given` has what a case states of it: ``length_x``, ``length_y`` [m] or 0, ``channel``,
        ``height_unit``, ``lateral_unit``, each of them or none.
        """
        known = {name: value for name, value in given.items() if value}
        try:
            read_scan(path, **known)
        except (EhlError, OSError) as error:
            raise InputError(self.nameless(str(error))) from error

    def nameless(self, text: str) -> str:
        """Leave out where the files lie."""
        for place in PLACES:
            text = text.replace(f"{self._folder.name}/{place}/", "")
        return text.replace(self._folder.name, "the page")

    def close(self) -> None:
        """Remove all files."""
        self._folder.cleanup()
