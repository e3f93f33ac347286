# SPDX-License-Identifier: BSD-3-Clause
"""A page as PDF, printed by an installed browser."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from pyehl.destination import mark, new_file
from pyehl.errors import EhlError, InputError

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
OPTIONS = (
    "--headless --disable-gpu --disable-quic --no-first-run --disable-background-networking "
    "--disable-component-update --disable-sync --no-pdf-header-footer"
).split()
TIMEOUT = 120.0
"""Maximum time of a print [s]."""


def browser() -> str:
    """Find an installed browser that prints; InputError if there is none."""
    result = next(filter(None, map(shutil.which, BROWSERS)), None)
    if result is None:
        expected = f"expected: one of {', '.join(BROWSERS)}"
        raise InputError(f"--pdf: no browser is installed that prints pages\n{expected}")
    return result


def write_pdf(page: Path, path: Path) -> Path:
    """Print a page, whole or not at all; returns the path.

    InputError if no browser is installed; EhlError if it does not print; FileError if the file
    cannot be written.
    """
    program = browser()
    with tempfile.TemporaryDirectory(prefix="pyehl-") as profile, new_file(path) as partial:
        # as root, chromium runs only without its sandbox
        root = ["--no-sandbox"] if os.geteuid() == 0 else []
        words = [*OPTIONS, *root, f"--user-data-dir={profile}"]
        words.append(f"--print-to-pdf={partial.resolve()}")
        try:
            done = subprocess.run(
                [program, *words, page.resolve().as_uri()],
                capture_output=True,
                timeout=TIMEOUT,
                check=False,
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            raise EhlError(f"{path}: {program} did not print: {error}") from error
        if done.returncode != 0 or not partial.is_file():
            message = done.stderr.decode(errors="replace").strip().splitlines()[-1:]
            raise EhlError(f"{path}: {program} did not print: {' '.join(message)}")
        # a comment after the end marks the file as one of pyehl
        with partial.open("ab") as stream:
            stream.write(f"%{mark('report')}\n".encode())
    return path
