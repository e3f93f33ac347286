# SPDX-License-Identifier: BSD-3-Clause
"""Arguments of ``pyehl bench``, for each of what it measures."""

import argparse
from collections.abc import Callable, Sequence
from typing import Any

from pyehl.bench import skips, smooth, step, stress_cases, sweep, workprec

GRIDS = (65, 129, 257, 513, 1025)
STEP_GRIDS = GRIDS[1:4]


def _numbers(text: str) -> list[int]:
    try:
        return [int(word) for word in text.split(",")]
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"'{text}' is not like 129,257") from error


def _add_list(
    parser: argparse.ArgumentParser, name: str, default: Sequence[Any], what: str, told: str = ""
) -> None:
    """Numbers or names with commas between."""
    numbers = not any(isinstance(word, str) for word in default)
    parser.add_argument(
        f"--{name}",
        type=_numbers if numbers else lambda text: text.split(","),
        default=list(default),
        metavar="N,N,..." if numbers else "NAME,NAME,...",
        help=f"{what} (default: {told or ','.join(map(str, default))})",
    )


def _add_points(parser: argparse.ArgumentParser, default: Sequence[int], told: str = "") -> None:
    _add_list(parser, "points", default, "nodes per side", told)


def _add_threads(parser: argparse.ArgumentParser, what: str = "threads") -> None:
    _add_list(parser, "threads", (1, 2), f"numbers of {what}")


def _add_scenes(parser: argparse.ArgumentParser, names: Sequence[str]) -> None:
    _add_list(parser, "scenes", names, f"of {', '.join(names)}", "all")
    parser.set_defaults(known={"scenes": names})


def _add_number(parser: argparse.ArgumentParser, name: str, default: float, what: str = "") -> None:
    told = f"{what} (default: {default:g})" if what else f"default: {default:g}"
    parser.add_argument(f"--{name}", type=type(default), default=default, help=told)


def _add_deflection(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, GRIDS)
    _add_threads(parser)


def _add_smooth(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, GRIDS)
    _add_threads(parser)
    engines = ("mlmi", "fft")
    _add_list(parser, "engines", engines, "of the deflection")
    parser.set_defaults(known={"engines": engines, "cases": smooth.CASES})
    _add_number(parser, "moes-m", 1000.0)
    _add_number(parser, "moes-l", 10.0)
    known = ", ".join(smooth.CASES)
    _add_list(parser, "cases", smooth.CASES[:1], f"of {known}, each in turn with the first")


def _add_step(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, STEP_GRIDS)
    _add_threads(parser)
    names = dict.fromkeys(scene.name for scene in step.CASES)
    parser.set_defaults(known={"cases": names})
    told = ", ".join(names)
    _add_list(parser, "cases", step.USUAL, f"of {told}; wave: of Fig. 2, fractal: of Table 1")
    parser.add_argument("--scheme", choices=("narrow", "paper"), default="narrow")
    _add_number(parser, "steps", step.STEPS, "timed steps")
    front = "X of the front of the roughness when the timed steps begin; that takes many steps on "
    _add_number(parser, "front", step.FILLED, f"{front}fine grids where the contact is to be full")
    parser.add_argument(
        "--error",
        action="store_true",
        help="whole runs too, for the error of mu_r/mu_s against the finest grid",
    )


def _add_sweep(parser: argparse.ArgumentParser) -> None:
    _add_threads(parser, "worker processes")
    _add_scenes(parser, [scene.name for scene in sweep.SCENES])


def _add_skips(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, (skips.LEAST,))
    _add_scenes(parser, list(skips.SCENES))


def _add_machines(parser: argparse.ArgumentParser) -> None:
    _add_number(parser, "seed", 1)
    _add_number(parser, "count", 60, "how many contacts, of four kinds in turn")
    parser.add_argument(
        "--fine", action="store_true", help="on twice the nodes too, to check the stated errors"
    )


def _add_stress(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, stress_cases.GRIDS)
    _add_number(parser, "cases", 500, "how many")
    _add_number(parser, "seed", 1)
    parser.add_argument(
        "--shear-law",
        choices=stress_cases.LAWS,
        default="newtonian",
        help="of all cases, each with a stress of its own (default: newtonian)",
    )
    parser.add_argument(
        "--boundary-film",
        action="store_true",
        help="all cases with one of a thickness of its own; needs a --shear-law",
    )
    _add_number(parser, "jobs", 2, "worker processes")


def _add_faults(parser: argparse.ArgumentParser) -> None:
    _add_number(parser, "seed", 1)
    _add_number(parser, "kills", 200)
    _add_number(parser, "inputs", 2000, "mutated ones")


def _add_workprec(parser: argparse.ArgumentParser) -> None:
    _add_points(parser, (), "those of each scene")
    _add_threads(parser)
    _add_scenes(parser, [scene.name for scene in workprec.SCENES])
    parser.add_argument("--full", action="store_true", help="the finest grids too, for reference")


DECLARE: dict[str, Callable[[argparse.ArgumentParser], None]] = {
    "deflection": _add_deflection,
    "smooth": _add_smooth,
    "step": _add_step,
    "sweep": _add_sweep,
    "skips": _add_skips,
    "machines": _add_machines,
    "stress": _add_stress,
    "faults": _add_faults,
    "workprec": _add_workprec,
}
"""Declares the arguments of what is measured."""
