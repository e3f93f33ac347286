# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl surface``: a rough surface in numbers, as a picture and as a file.

The surface is an instrument file, an array, or that of a case.
"""

import argparse
import hashlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pyehl import lengths
from pyehl.case import Case, exchanged, files_of
from pyehl.case.surfaces import without_fractal
from pyehl.commands.arguments import add_case_arguments
from pyehl.destination import check_files, made_by, mark, new_file
from pyehl.errors import FileError, InputError
from pyehl.given import key_of
from pyehl.surfaces import FEATURES, Topography, from_settings
from pyehl.surfaces.areal import AREAL_NAMES, areal_numbers
from pyehl.surfaces.from_case import profile_of
from pyehl.surfaces.prepare import SUFFIXES, write_map
from pyehl.surfaces.profile import fit
from pyehl.surfaces.profile_file import is_profile
from pyehl.surfaces.solver_surface import READY
from pyehl.theory.film import central_film
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint

MADE = f"! {mark('surface')}\n! A tile for the contact that it was made for\n"

# Keys of a tile on its track, with its spectrum already cut
READY_IN_PLACE = {
    **READY,
    "surface.track": 0.0,
    "surface.shortest_wavelength": 0.0,
    "surface.longest_wavelength": 0.0,
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_case_arguments(parser)
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="MAP",
        help=f"write the tile: {', '.join(SUFFIXES)}; a case for it, MAP.nml, and a picture, "
        "MAP.png, are written beside it",
    )
    parser.add_argument(
        "--second", action="store_true", help="the second surface of a case, not the first"
    )
    parser.add_argument(
        "--plots",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="draw the picture (default: yes)",
    )


def execute(args: argparse.Namespace) -> int:
    is_case = Path(args.case).suffix.lower() == ".nml"
    if is_case:
        case = Case(args.case, args.overrides)
        if args.second:
            case = exchanged(case)
    else:
        name = str(Path(args.case).absolute()).replace("'", "''")
        text = f"&surface kind = 'map' file = '{name}' /"
        case = Case.from_text(text, args.overrides, origin=args.case)
    settings = case.resolve()
    kind = settings["surface"]["kind"]
    if kind == "map":
        how = str(settings["surface"]["profile"])
        # a profile without a key that states which surface to make of it
        bare = how == "none" and not is_case and is_profile(settings["surface"]["file"])
        if bare or how != "none":
            print_spectrum(settings["surface"])
        if bare:
            return 0
    if kind in ("smooth", *FEATURES):
        group = "second_surface" if args.second else "surface"
        raise InputError(
            f"{args.case}: {group}.kind = '{kind}' is no tile of heights\n"
            f"expected: {group}.kind = 'harmonic', 'map', 'fractal'"
        )
    if args.output is not None and args.output.suffix not in SUFFIXES:
        raise InputError(
            f"pyehl surface: cannot write {args.output}\n"
            f"expected: a name with {', '.join(SUFFIXES)}"
        )
    if args.output is not None:
        _check(args.output, (args.case, *files_of(settings)), args.plots)
    operating = OperatingPoint.from_settings(settings)
    lubricant = Lubricant.from_settings(settings, str(settings["psd"]["viscosity_law"]))
    try:
        surface = from_settings(settings, operating, central_film(operating, lubricant))
    except (InputError, FileError) as error:
        named = "" if args.case in str(error) else f"{args.case}: "
        raise InputError(f"{named}{error}") from error
    print("\n".join([*_lines(surface), *numbers(surface)]))
    if args.output is not None:
        known = is_case or any(
            key_of(o).startswith(("contact.", "lubricant.")) for o in args.overrides
        )
        conditions = (
            operating.hertz_radius,
            *operating.equivalent_moes,
            str(settings["psd"]["wavelength_convention"]),
        )
        for path in _write(surface, case, args.output, conditions if known else None, args.plots):
            print(path)
    return 0


def print_spectrum(surface: Mapping[str, Any]) -> None:
    """Print the parameters of the spectrum of a profile."""
    ridges = surface["profile"] == "ridges"
    result = fit(profile_of(surface), str(surface["detrend"]), ridges=ridges)
    print("\n".join(result.report()))


def _lines(surface: Topography) -> list[str]:
    """Describe the surface, and how it was prepared."""
    if surface.preparation is None:
        lines = [f"surface    {surface.origin}"]
    else:
        lines = surface.preparation.record.report()
    nx, ny = surface.shape
    lines.append(f"tile       {nx} x {ny} pixels, {lengths.size(*surface.size)}")
    return lines


def numbers(surface: Topography) -> list[str]:
    """Lines with the parameters of ISO 25178-2; of a map, those before its edges were joined."""
    made = surface.preparation
    values = areal_numbers(
        made.prepared if made else surface.heights, made.pixel if made else surface.pixel
    )
    lines = []
    for name, (unit, meaning) in AREAL_NAMES.items():
        value = f"{values[name] * 1e9:.4g} nm" if unit == "m" else f"{values[name]:.4g}"
        lines.append(f"{name:10} {value:14} {meaning}")
    return lines


def _beside(path: Path) -> tuple[Path, Path]:
    """Names of the case and of the picture of a tile."""
    return path.with_name(f"{path.name}.nml"), path.with_name(f"{path.name}.png")


def _checksum_line(path: Path) -> str:
    """Checksum of a tile, as a line of its case."""
    with path.open("rb") as stream:
        digest = hashlib.file_digest(stream, "sha256").hexdigest()
    return f"! {path.name}: sha256 {digest}\n"


def _check(path: Path, inputs: Sequence[str], plots: bool) -> None:
    """Refuse to replace files other than those of an earlier tile of this name."""
    beside, picture = _beside(path)
    check_files([beside, picture] if plots else [beside], "surface", inputs)

    def known(tile: Path) -> bool:
        return beside.is_file() and made_by(beside, _checksum_line(tile))

    check_files([path], "surface", inputs, known=known)


def _write(
    surface: Topography,
    case: Case,
    path: Path,
    conditions: tuple[float, float, float, str] | None,
    plots: bool,
) -> list[Path]:
    """Write the tile, a case for it, and the picture; returns their names.

    `conditions` as in :func:`pyehl.plots.surface.before_and_after`.
    """
    beside, picture = _beside(path)
    written = [write_map(surface, path), beside]
    size = {"surface.length_x": surface.length_x, "surface.length_y": surface.length_y}
    name = str(path.absolute()).replace("'", "''")
    done = without_fractal("surface", case["surface"])
    text = case.with_options(READY_IN_PLACE, done, size, f"surface.file='{name}'").text
    # a relative name: the folder may be moved
    text = text.replace(f"'{name}'", "'" + path.name.replace("'", "''") + "'")
    with new_file(beside) as fresh:
        fresh.write_text(MADE + _checksum_line(path) + text, encoding="utf-8")
    if plots:
        from pyehl.plots.style import save  # noqa: PLC0415
        from pyehl.plots.surface import before_and_after  # noqa: PLC0415 (slow to import)

        figure = before_and_after(surface, conditions)
        written.append(save(figure, picture, command="surface"))
    return written
