# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl info``: versions and machine, for bug reports."""

import argparse
import os
import platform
from importlib import metadata

LIBRARIES = "bokeh jinja2 loky numpy scipy matplotlib pandas tqdm xarray SurfaceTopography".split()


def _version(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return "not installed"


def lines() -> list[str]:
    """Versions, compiler, processor."""
    try:
        from pyehl import library  # noqa: PLC0415 (the rest must print even where this fails)

        compiled = f"{library.version()}, {library.build()}"
    except ImportError as error:
        compiled = f"missing: {error}"
    return [
        f"pyehl      {_version('pyehl')}",
        f"library    {compiled}",
        f"python     {platform.python_version()}",
        *(f"{name:10} {_version(name)}" for name in LIBRARIES),
        f"machine    {platform.machine()}, {os.cpu_count()} processors, {platform.platform()}",
    ]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """``pyehl info`` takes no arguments."""


def execute(args: argparse.Namespace) -> int:
    print("\n".join(lines()))
    return 0
