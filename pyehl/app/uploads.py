# SPDX-License-Identifier: BSD-3-Clause
"""Files that were uploaded to one page: kept in a folder of their own, gone with the page.

The page knows their names alone. What a reader says of a file names it, not where it lies.
"""

from __future__ import annotations

import re
import tempfile
from pathlib import Path

from pyehl.errors import EhlError, InputError
from pyehl.surfaces.reading import read_scan

__all__ = ["LARGEST", "Uploads"]

LARGEST = 64 * 2**20
"""Bytes of the largest file that is taken."""


class Uploads:
    """Height maps by the names that they had."""

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="pyehl-app-")
        self.files: dict[str, str] = {}

    def add(self, name: str, data: bytes, length_x: float = 0.0, length_y: float = 0.0) -> str:
        """Keep a height map if it can be read, lengths [m] or 0; returns where.

        InputError with the words of the reader.
        """
        base = re.sub(r"[^\w.\- ]", "_", Path(name.replace("\\", "/")).name).lstrip(".")
        if not base:
            raise InputError("the map has no name: expected a file")
        if len(data) > LARGEST:
            raise InputError(f"{base}: {len(data)} bytes; a map of up to {LARGEST} was expected")
        path = Path(self._folder.name) / base
        path.write_bytes(data)
        try:
            self.check(str(path), length_x, length_y)
        except InputError:
            path.unlink()
            raise
        self.files[base] = str(path)
        return str(path)

    def check(self, path: str, length_x: float = 0.0, length_y: float = 0.0) -> None:
        """Read a map; InputError with the words of the reader."""
        try:
            read_scan(path, length_x=length_x or None, length_y=length_y or None)
        except (EhlError, OSError) as error:
            raise InputError(self.nameless(str(error))) from error

    def nameless(self, text: str) -> str:
        """Leave out where the files lie."""
        return text.replace(f"{self._folder.name}/", "").replace(self._folder.name, "the page")

    def close(self) -> None:
        """Remove all files."""
        self._folder.cleanup()
