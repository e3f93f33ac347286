# SPDX-License-Identifier: BSD-3-Clause
"""The command ``pyehl``: one verb, one module, imported when it is called for."""

from __future__ import annotations

import argparse
import difflib
import sys
from collections.abc import Sequence
from importlib import import_module

from pyehl.errors import EhlError, InputError

__all__ = ["main"]

EXIT_FAILED = 1
EXIT_USAGE = 2
EXIT_INTERRUPTED = 130

# Verb, module with add_arguments(parser) and execute(args), what it does
VERBS = {
    "run": ("pyehl.run", "solve a case and write a result folder"),
    "check": ("pyehl.case", "print a case resolved, and how it would be solved"),
    "predict": ("pyehl.predict", "predict the relative friction of a rough surface from its PSD"),
    "surface": ("pyehl.surface", "write the surface of a case as a height map"),
    "film": ("pyehl.film", "film formulas side by side for a case"),
    "plot": ("pyehl.plot", "pictures of a result folder"),
    "export": ("pyehl.export", "a result folder as netCDF"),
    "bench": ("pyehl.bench", "time and error of the parts, side by side"),
    "info": ("pyehl.info", "versions, compiler, machine"),
}


def _usage() -> str:
    lines = ["usage: pyehl VERB ...   (pyehl VERB --help says more)", ""]
    lines += [f"  {verb:8} {text}" for verb, (_, text) in VERBS.items()]
    return "\n".join(lines)


def main(argv: Sequence[str] | None = None) -> int:
    """Run one verb; 0 done, 1 not converged or failed, 2 bad input, 130 interrupted."""
    words = list(sys.argv[1:] if argv is None else argv)
    if not words or words[0] in ("-h", "--help", "help"):
        print(_usage())
        return 0 if words else EXIT_USAGE
    verb, rest = words[0], words[1:]
    if verb == "--version":
        verb = "info"
    if verb not in VERBS:
        near = difflib.get_close_matches(verb, VERBS, n=1)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        print(f"pyehl: error: unknown verb '{verb}'{hint}\n{_usage()}", file=sys.stderr)
        return EXIT_USAGE
    module = import_module(VERBS[verb][0])
    parser = argparse.ArgumentParser(
        prog=f"pyehl {verb}",
        description=f"{VERBS[verb][1][0].upper()}{VERBS[verb][1][1:]}.",
        allow_abbrev=False,
    )
    module.add_arguments(parser)
    args = parser.parse_args(rest)
    try:
        return int(module.execute(args))
    except InputError as error:
        print(error, file=sys.stderr)
        return EXIT_USAGE
    except EhlError as error:
        print(f"pyehl: error: {error}", file=sys.stderr)
        return EXIT_FAILED
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED
