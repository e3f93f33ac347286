# SPDX-License-Identifier: BSD-3-Clause
"""The command ``pyehl``: one module of `pyehl.commands` for each subcommand."""

import argparse
import logging
import sys
from collections.abc import Callable, Sequence
from importlib import import_module

from pyehl.errors import (
    EXIT_FAILED,
    EXIT_INTERRUPTED,
    EXIT_OK,
    EXIT_USAGE,
    EhlError,
    FileError,
    InputError,
    did_you_mean,
)
from pyehl.streams import mute

# Subcommand, which is a module of `pyehl.commands`, and what it does
SUBCOMMANDS = {
    "run": "solve a case and write a result folder",
    "check": "print the resolved case and the plan of its solution",
    "predict": "predict the relative friction of a rough surface from its PSD",
    "stribeck": "friction against speed, film ratio and theta_2",
    "app": "an interactive contact in the browser",
    "sweep": "solve many cases and tabulate their results",
    "compare": "compare results with a table of references",
    "bearing": "film of every contact of a rolling bearing, and its torque",
    "gear": "film along the path of contact of a gear pair, and its loss",
    "stress": "stress below the surface under a result, smooth or rough",
    "response": "measure the response of the contact to small waves of roughness",
    "surface": "write the surface of a case as a height map",
    "film": "film formulas side by side for a case",
    "lubricants": "oils by name: constants, ranges, sources",
    "fit-lubricant": "a shear law or alpha fitted to a measured traction or film curve",
    "plot": "pictures of a result folder",
    "report": "write a result as one HTML page",
    "export": "a result folder as netCDF",
    "info": "versions, compiler, machine",
}


def make_parser(chosen: str) -> argparse.ArgumentParser:
    """Make the parser; only the chosen subcommand is imported, and has its arguments."""
    parser = argparse.ArgumentParser(
        prog="pyehl",
        description="Elastohydrodynamically lubricated contacts with smooth and rough "
        "surfaces: point and line contacts, rollers, bearings and gears.",
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="store_true", help="print the version")
    subparsers = parser.add_subparsers(dest="subcommand", metavar="SUBCOMMAND")
    for name, text in SUBCOMMANDS.items():
        sub = subparsers.add_parser(
            name, help=text, description=f"{text[0].upper()}{text[1:]}.", allow_abbrev=False
        )
        if name == chosen:
            module = import_module(f"pyehl.commands.{name.replace('-', '_')}")
            module.add_arguments(sub)
            sub.set_defaults(execute=module.execute)
    return parser


class _Terminal(logging.Handler):
    """Prints the log on standard error: long steps without a progress bar, and warnings."""

    def emit(self, record: logging.LogRecord) -> None:
        print(record.getMessage(), file=sys.stderr)


def _listen(*, quiet: bool) -> None:
    log = logging.getLogger("pyehl")
    log.setLevel(logging.WARNING if quiet else logging.INFO)
    if not any(isinstance(handler, _Terminal) for handler in log.handlers):
        log.addHandler(_Terminal())


def _execute(args: argparse.Namespace) -> int:
    if sys.stdout is None:
        # the next file opened would get its descriptor
        raise FileError("standard output: it is closed")
    try:
        status = int(args.execute(args))
        sys.stdout.flush()
    except BrokenPipeError:
        # the reader has closed the pipe, as `| head` does
        mute()
        return EXIT_FAILED
    except EhlError:
        raise
    except OSError as error:
        # of standard output, or of another file
        try:
            print(flush=True)
        except OSError:
            mute()
            raise FileError(f"standard output: cannot be written: {error.strerror}") from error
        raise
    return status


def main(argv: Sequence[str] | None = None) -> int:
    """Run one subcommand; 0 done, 1 not converged or failed, 2 bad input, 130 interrupted."""
    words = list(sys.argv[1:] if argv is None else argv)
    if words[:1] == ["help"]:
        words[0] = "--help"
    if words == ["--version"]:
        print(f"pyehl {import_module('pyehl').__version__}")
        return EXIT_OK
    chosen = words[0] if words else ""
    _listen(quiet=not {"-q", "--quiet"}.isdisjoint(words))

    def run() -> int:
        parser = make_parser(chosen)
        if chosen not in SUBCOMMANDS and not chosen.startswith("-"):
            if words:
                hint = did_you_mean(chosen, SUBCOMMANDS)
                print(f"pyehl: error: unknown subcommand '{chosen}'{hint}", file=sys.stderr)
            parser.print_help(sys.stderr if words else sys.stdout)
            return EXIT_USAGE
        return _execute(parser.parse_args(words))

    return status_of(run)


def status_of(run: Callable[[], int]) -> int:
    """Run a command and return its exit status; its error is printed on standard error."""
    try:
        return run()
    except InputError as error:
        print(error, file=sys.stderr)
        return EXIT_USAGE
    except EhlError as error:
        print(f"pyehl: error: {error}", file=sys.stderr)
        return EXIT_FAILED
    except KeyboardInterrupt as stop:
        print(f"interrupted; {stop if stop.args else 'no result is written'}", file=sys.stderr)
        return EXIT_INTERRUPTED
