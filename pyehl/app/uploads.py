# SPDX-License-Identifier: BSD-3-Clause
"""Files uploaded to one page, in a temporary folder that is removed with the page.

The page and its error messages show the names of the files, not their folder.
"""

import re
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pyehl.errors import EhlError, InputError
from pyehl.surfaces.reading import read_scan

MAX_BYTES = 64 * 2**20
"""Maximum size of a file [bytes]."""
# Subfolders of new files, and of files that could be read
PLACES = ("new", "maps")


class Uploads:
    """Height maps by their original names."""

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="pyehl-app-")
        for place in PLACES:
            (Path(self._folder.name) / place).mkdir()
        self.files: dict[str, str] = {}

    def add(self, name: str, data: bytes, given: Mapping[str, Any] | None = None) -> str:
        """Store a readable height map, which may replace one of the same name; returns its path.

        `given` are the keys of the case, as in `check`. InputError with the message of the reader;
        an earlier map of this name then stays.
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
        """Read a map; InputError with the message of the reader.

        `given` may have the keys of the case ``length_x``, ``length_y`` [m] or 0, ``channel``,
        ``height_unit`` and ``lateral_unit``.
        """
        known = {name: value for name, value in given.items() if value}
        try:
            read_scan(path, **known)
        except (EhlError, OSError) as error:
            raise InputError(self.without_folders(str(error))) from error

    def without_folders(self, text: str) -> str:
        """Remove the folders of the files from a text."""
        for place in PLACES:
            text = text.replace(f"{self._folder.name}/{place}/", "")
        return text.replace(self._folder.name, "the page")

    def close(self) -> None:
        """Remove all files."""
        self._folder.cleanup()
