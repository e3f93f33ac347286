# SPDX-License-Identifier: BSD-3-Clause
"""The order of the Fortran layers, and operations that only some of them may use."""

import re
from pathlib import Path

import pytest

# A module uses only modules of its own layer or of layers to the left
LAYERS = [
    ["base"],
    ["physics", "grid"],
    ["contact"],
    ["surface", "deflection"],
    ["reynolds"],
    ["multigrid"],
    ["transient", "steady"],
    ["case"],
    ["plan"],
    ["solve"],
    ["run"],
    ["app", "bind", "test"],
]
RANK = {folder: rank for rank, folders in enumerate(LAYERS) for folder in folders}
# First line of a program, a module or a submodule
UNIT = r"^\s*(?:module|program|submodule\s*\(\w+\))\s+(\w+)\s*$"
# The numerical layers take plain arguments, not the types of a case
NUMERICS = (
    "physics",
    "contact",
    "grid",
    "surface",
    "deflection",
    "reynolds",
    "multigrid",
    "transient",
    "steady",
)


def modules(root: Path) -> dict[str, tuple[Path, set[str]]]:
    """File and used modules of every module and submodule."""
    result = {}
    for path in sorted((root / "fortran").rglob("*.f90*")):
        text = path.read_text()
        for name in re.findall(UNIT, text, re.M | re.I):
            used = set(re.findall(r"^\s*use\s+(\w+)", text, re.M | re.I))
            result[name] = (path, used)
    return result


def folder(path: Path) -> str:
    return path.parent.name


def test_layers_use_only_lower_layers(root: Path):
    result = modules(root)
    assert len(result) > 20
    wrong = [
        f"{name} uses {other}"
        for name, (path, used) in result.items()
        for other in used
        if other in result and RANK[folder(result[other][0])] > RANK[folder(path)]
    ]
    assert not wrong


def test_every_used_module_is_known(root: Path):
    result = modules(root)
    system = {"iso_c_binding", "iso_fortran_env", "ieee_arithmetic", "omp_lib"}
    unknown = {u for _, used in result.values() for u in used} - set(result) - system
    assert not unknown


def test_numerics_use_no_cases(root: Path):
    wrong = [
        f"{name} uses {other}"
        for name, (path, used) in modules(root).items()
        if folder(path) in NUMERICS
        for other in used
        if other.startswith("ehl_case")
    ]
    assert not wrong


# A pattern that identifies a stencil or a shape, and the only file of the library that may have it
OWNED = [
    ("reynolds/poiseuille.f90", r"/[\w%]*h[xy]\s*\*\*\s*2"),
    ("reynolds/poiseuille.f90", r"\be(?:ps|x)?\(i [+-] 1, j\) \+"),
    ("reynolds/poiseuille.f90", r"%product%?(?!bytes)\w*\(|%north_east\(i"),
    ("reynolds/wedge.f90", r"1\.5_dp, -2\.0_dp, 0\.5_dp"),
    ("reynolds/wedge.f90", r"1\.5_dp/\w*time_step"),
    ("reynolds/wedge.f90", r"c\(1\)\*\w+\(i - 1"),
    (
        "contact/contact.f90 contact/elliptical.f90 contact/line.f90 contact/roller.f90",
        r"pi/3\.0_dp|sqrt\(max\(0\.0_dp, 1\.0_dp - x|(?<!%)\bx\w*(?:\(i\))?\*\*2 \+ ",
    ),
    ("grid/grid.f90", r"merge\(.*, j - 1, j == 1\)"),
]


@pytest.mark.parametrize(("owner", "pattern"), OWNED)
def test_each_routine_has_one_module(root: Path, owner: str, pattern: str):
    """Discrete equations and the macroscopic contact are implemented in one module each."""
    library = root / "fortran"
    # symmetric operators, their transfers and products are no discretisation
    apart = {"app", "bind", "test"}
    general = {"nine_point.f90", "alcouffe.f90", "galerkin.f90"}
    result = {
        path.relative_to(library).as_posix()
        for path in library.rglob("*.f90")
        if folder(path) not in apart and path.name not in general
        for line in path.read_text().splitlines()
        if re.search(pattern, line.split("!")[0])
    }
    assert result == set(owner.split())


def test_module_has_the_name_of_its_file(root: Path):
    for name, (path, _) in modules(root).items():
        if folder(path) in ("app", "test"):
            continue
        stem = path.name.split(".")[0]
        assert name == (stem if stem.startswith("ehl_") else f"ehl_{stem}"), path


@pytest.mark.parametrize(
    "pattern", [r"^\s*stop\b", r"^\s*error\s+stop\b", r"^\s*print\b", r"write\s*\(\*"]
)
def test_library_neither_prints_nor_stops(root: Path, pattern: str):
    for path in sorted((root / "fortran").rglob("*.f90")):
        if folder(path) in ("app", "test"):
            continue
        assert not re.search(pattern, path.read_text(), re.M | re.I), path


def test_first_line_is_the_licence(root: Path):
    paths = [*(root / "fortran").rglob("*.f90"), *(root / "pyehl").rglob("*.py")]
    assert len(paths) > 30
    for path in paths:
        assert "SPDX-License-Identifier: BSD-3-Clause" in path.read_text().splitlines()[0], path
