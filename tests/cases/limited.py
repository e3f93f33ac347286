# SPDX-License-Identifier: BSD-3-Clause
"""Run ``pyehl`` with a limit of the system."""

import subprocess
import sys
from pathlib import Path

# A full disk is to be an error of a write, not a signal
LIMITED = (
    "import resource, signal, sys; from pyehl import cli; import pyehl.commands.run; "
    "signal.signal(signal.SIGXFSZ, signal.SIG_IGN); kind, size = map(int, sys.argv[1:3]); "
    "resource.setrlimit(kind, (size, size)); sys.exit(cli.main(sys.argv[3:]))"
)


def limited(folder: Path, kind: int, size: int, *words: str) -> subprocess.CompletedProcess[str]:
    """Run ``pyehl`` with a limit that is set after its imports: an editable package may build."""
    return subprocess.run(
        [sys.executable, "-P", "-c", LIMITED, str(kind), str(size), *words],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=900.0,
        check=False,
    )
