# SPDX-License-Identifier: BSD-3-Clause
"""The order of the Python modules, and operations that only some of them may use."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest

# A module imports only from its own layer or from layers to the left. Imports inside functions and
# those only for typing count too.
LAYERS = [
    ["errors", "display", "number_text", "schema", "types", "lengths", "blas"],
    ["processor", "namelist", "given"],
    ["extension"],
    ["library", "destination", "assessment", "conclusion", "reasons", "plan_text"],
    ["case", "theory", "arrays", "rigs"],
    ["surfaces"],
    ["handle"],
    ["results"],
    ["plots"],
    ["contact"],
    ["prediction", "netcdf"],
    ["simulation"],
    ["solver", "progress", "streams"],
    ["run"],
    ["api"],
    ["studies", "subsurface"],
    ["machines"],
    ["measured_response"],
    ["reports"],
    ["app"],
    ["commands"],
    ["cli"],
    ["__init__", "__main__"],
]
RANK = {name: rank for rank, names in enumerate(LAYERS) for name in names}


@cache
def modules(root: Path) -> dict[str, tuple[Path, ast.Module]]:
    """File and syntax tree of every module, by its name within the package."""
    result = {}
    for path in sorted((root / "pyehl").rglob("*.py")):
        parts = path.relative_to(root / "pyehl").with_suffix("").parts
        if len(parts) > 1 and parts[-1] == "__init__":
            parts = parts[:-1]
        result[".".join(parts)] = (path, ast.parse(path.read_text()))
    return result


def executed(tree: ast.Module) -> ast.Module:
    """A module without the imports for types alone."""

    def for_types(node: ast.stmt) -> bool:
        return isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"

    return ast.Module([node for node in tree.body if not for_types(node)], [])


def imported(tree: ast.Module, known: set[str]) -> set[str]:
    """Modules of this package that a module imports."""
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "no relative imports"
            for alias in node.names:
                name = f"{node.module}.{alias.name}"
                inner = name.removeprefix("pyehl.")
                names.add(name if inner in known else str(node.module))
    return {n.removeprefix("pyehl.") for n in names if n.startswith("pyehl.")} & known


@pytest.fixture(scope="module")
def graph(root: Path) -> dict[str, set[str]]:
    result = modules(root)
    return {name: imported(tree, set(result)) for name, (_, tree) in result.items()}


def top(name: str) -> str:
    return name.partition(".")[0]


def test_layers_use_only_lower_layers(graph: dict[str, set[str]]):
    assert len(graph) > 30
    assert {top(name) for name in graph} == set(RANK)
    wrong = [
        f"{name} imports {other}"
        for name, others in graph.items()
        for other in others
        if RANK[top(other)] > RANK[top(name)]
    ]
    assert not wrong


def test_no_circular_import(root: Path):
    """The modules can be ordered so that each loads only earlier ones."""
    result = modules(root)
    # `from pyehl.surfaces import x` inside the folder would run its __init__ first
    left = {n: imported(executed(tree), set(result)) - {n} for n, (_, tree) in result.items()}
    while left:
        free = {name for name, others in left.items() if not others & set(left)}
        assert free, f"an import cycle among {sorted(left)}"
        left = {name: others for name, others in left.items() if name not in free}


# A file without such a word uses nothing private: it need not be parsed
PRIVATE = re.compile(r"\b_[^\W_]|\._\b|\bimport\b.*\b_\b")
# of notebooks and of argparse
PUBLIC = {"_repr_html_", "_actions", "_SubParsersAction"}


@pytest.mark.parametrize("folder", ["benchmarks", "examples/zhang2019", "tests"])
def test_scripts_use_only_public_names(root: Path, folder: str):
    for path in (root / folder).rglob("*.py"):
        text = path.read_text()
        if not PRIVATE.search(text):
            continue
        tree = ast.parse(text)
        taken = [a.name for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) for a in n.names]
        taken += [
            node.attr
            for node in ast.walk(tree)
            if isinstance(node, ast.Attribute)
            and not (isinstance(node.value, ast.Name) and node.value.id in ("self", "cls"))
        ]
        private = [
            word
            for word in set(taken) - PUBLIC
            if word.startswith("_") and not word.startswith("__")
        ]
        assert not private, f"{path} uses {private}"


# Modules that subcommands share
SHARED = ("commands.arguments", "commands.machine", "commands.watching")


def test_no_module_imports_a_command(graph: dict[str, set[str]]):
    """Commands share only their arguments; `cli` names them by text."""
    wrong = [
        f"{name} imports {other}"
        for name, others in graph.items()
        for other in others
        if other.startswith("commands.") and not (name.startswith("commands.") and other in SHARED)
    ]
    assert not wrong


@pytest.mark.parametrize(
    ("what", "where"),
    [
        ("pyehl._core", {"extension"}),
        ("argparse", {"commands", "cli"}),
        # the prediction names one of its types
        ("matplotlib", {"plots", "prediction"}),
    ],
)
def test_imports_of_each_layer(root: Path, what: str, where: set[str]):
    users = set()
    for name, (_, tree) in modules(root).items():
        for node in ast.walk(tree):
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                names = [str(node.module), *(f"{node.module}.{a.name}" for a in node.names)]
            if any(other == what or other.startswith(f"{what}.") for other in names):
                users.add(top(name))
    assert users
    assert users <= where


def test_every_module_is_installed(root: Path):
    package = root / "pyehl"
    listed = re.findall(r"'([\w/]+\.(?:py|csv))'", (package / "meson.build").read_text())
    assert sorted(listed) == sorted(
        path.relative_to(package).as_posix()
        for end in ("py", "csv")
        for path in package.rglob(f"*.{end}")
    )
