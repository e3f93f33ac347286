# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl app``: an interactive contact in the browser."""

import argparse
from functools import partial

from pyehl.case import Case
from pyehl.commands.arguments import add_case_arguments
from pyehl.errors import InputError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_case_arguments(parser, optional=True)
    parser.add_argument(
        "--port", type=int, default=0, metavar="N", help="port of 127.0.0.1 (default: a free one)"
    )
    parser.add_argument(
        "--no-browser", dest="browser", action="store_false", help="print only the address"
    )


def execute(args: argparse.Namespace) -> int:
    """Run ``pyehl app`` until it is interrupted; then 0, for bad input 2."""
    if not 0 <= args.port <= 65535:
        raise InputError(f"--port {args.port}: expected 0 ... 65535")
    case = Case(args.case, args.overrides) if args.case else Case.from_text("", args.overrides)
    try:
        from pyehl.app.server import serve  # noqa: PLC0415 (Bokeh is an extra)
    except ImportError as error:
        if (error.name or "").partition(".")[0] not in ("bokeh", "tornado"):
            raise
        raise InputError(
            f"pyehl app: it needs {error.name}, which is not installed\n"
            "expected: pip install 'pyehl[app]'"
        ) from error
    from pyehl.app.position import from_case  # noqa: PLC0415

    position, note = from_case(case)
    serve(position, note, port=args.port, browser=args.browser, say=partial(print, flush=True))
    return 0
