# SPDX-License-Identifier: BSD-3-Clause
"""The documents: every command and example in them works, and they name every module.

Commands are the lines of blocks marked ``sh``. They are run unchanged, in the order of the
document, in a folder that contains only ``cases/``. Not run are those that install something or run
the tests themselves: of the two commands of the README the part before ``&&`` and ``pytest``, and
those in EXEMPT. The files and options that these name must exist. Output in a document of SHOWN is
compared with the printed output.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from document_text import DOCUMENTS, NUMBER, ROOT, blocks, commands, fences, is_shown, lines_of

import pyehl
from pyehl import Case
from pyehl.case import KEYS
from pyehl.prediction import friction
from pyehl.theory import transition

# Those of `docs/` take half a minute each
EXECUTED = [
    pytest.param(name, marks=pytest.mark.long) if name.startswith("docs/") else name
    for name in DOCUMENTS
]
# Their text blocks show the output of the commands in the block above; a console block has both
SHOWN = (
    "docs/tutorial.md",
    *(f"docs/howto/{name}.md" for name in ("compare", "lubricants", "measured-surface")),
)
INSTALL = "bash install"
# First words of commands that are not run here, and where they are run
EXEMPT = {
    "bash install": "whoever pastes it; .ci/run in a fresh environment",
    "bash .ci/run": "runs this test",
    "bash .ci/wheel": ".ci/run",
    ".venv/bin/pytest": "runs this test",
    "pytest": "runs this test",
    "pip install": "needs the network",
    "dask": "studies/test_cluster.py",
    "meson": ".ci/run",
    "sphinx-build": ".ci/run",
    "ford": ".ci/run",
    "pyehl app": "app/test_page.py; it ends when the user ends it",
}
Command = Callable[..., subprocess.CompletedProcess[str]]
# Options of meson, which meson.options does not list
MESON_OPTIONS = {"buildtype"}


def parts(command: str) -> list[str]:
    return [part.strip() for part in command.split("&&")]


def is_exempt(part: str) -> bool:
    return any(part == first or part.startswith(f"{first} ") for first in EXEMPT)


@pytest.fixture
def folder(root: Path, tmp_path: Path) -> Path:
    """A folder with the case files, those of the rig, and a profile [µm] with positions in mm."""
    shutil.copytree(root / "cases", tmp_path / "cases")
    shutil.copytree(root / "docs/evidence/rig", tmp_path / "docs/evidence/rig")
    z = np.cumsum(np.random.default_rng(1).normal(size=2000)) * 0.01
    rows = (f"{0.0005 * k:.4f};{v - z.mean():.4f}" for k, v in enumerate(z))
    (tmp_path / "profile.prf").write_text("X [mm];Z [um]\n" + "\n".join(rows) + "\n")
    return tmp_path


def execute(
    part: str,
    folder: Path,
    drivers: dict[str, list[str]],
    statuses: tuple[int, ...] = (0,),
    command: Command | None = None,
) -> str:
    """Run a command by `command` in this process; returns its output, paths from the folder."""
    words = shlex.split(part.removeprefix(".venv/bin/"))
    if command is not None and words[0] == "pyehl":
        done = command(folder, *words[1:])
        assert done.returncode in statuses, f"{part}\n{done.stdout}{done.stderr}"
        return done.stdout.replace(f"{folder}/", "")
    programs = {"ehl": drivers["ehl"], "pyehl": drivers["pyehl"][:-1]}
    if words[0] == "python":
        programs["python"] = [sys.executable, str(ROOT / words.pop(1))]
    assert words[0] in programs, f"{part}: neither a program of this package nor exempt"
    done = subprocess.run(
        [*programs[words[0]], *words[1:]],
        cwd=folder,
        env={k: v for k, v in os.environ.items() if k != "OMP_NUM_THREADS"},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode in statuses, f"{part}\n{done.stdout}{done.stderr}"
    return done.stdout.replace(f"{folder}/", "")


def assert_shown(shown: str, printed: str) -> None:
    """Every line of a block is in the output."""
    for line in shown.splitlines():
        if line != "...":
            assert any(is_shown(line, other) for other in printed.splitlines()), (
                f"{line}\nis not in\n{printed}"
            )


@pytest.mark.parametrize("name", [name for name in EXECUTED if name != "README.md"])
def test_commands_in_documents_work(
    root: Path, folder: Path, drivers: dict[str, list[str]], command: Command, name: str
):
    assert commands(root / name) or name.startswith(("docs/", "benchmarks/", "CONTRIBUTING"))
    printed = ""
    compared = 0
    for language, block in fences(root / name):
        if language == "sh":
            whole = lines_of(block)
            todo = [part for line in whole for part in parts(line) if not is_exempt(part)]
            printed = "".join(execute(part, folder, drivers, command=command) for part in todo)
        elif language == "console" and name in SHOWN:
            line, _, shown = block.removeprefix("$ ").partition("\n")
            # a status without a result is shown, too
            assert_shown(shown, execute(line, folder, drivers, (0, 1), command))
        elif language == "text" and name in SHOWN:
            assert_shown(block, printed)
            compared += 1
    assert compared or name not in SHOWN
    for block in blocks(root / name, "python"):
        run_python(block, folder)


def run_python(block: str, folder: Path) -> str:
    """Run a Python block of a document after its commands; returns its output."""
    done = subprocess.run(
        [sys.executable, "-P", "-c", block],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, f"{block}\n{done.stderr}"
    return done.stdout


def test_commands_in_documents_name_existing_files(root: Path):
    options = set(re.findall(r"^option\('(\w+)'", (root / "meson.options").read_text(), re.M))
    seen = 0
    for name in DOCUMENTS:
        for part in (p for command in commands(root / name) for p in parts(command)):
            if not is_exempt(part):
                continue
            seen += 1
            for word in shlex.split(part)[1:]:
                if match := re.fullmatch(r"-D(\w+)=\S+", word):
                    assert match[1] in options | MESON_OPTIONS, part
                elif re.match(r"(tests|cases|\.ci|fortran)/|install$", word):
                    assert (root / word).exists(), part
    assert seen > 5


def test_two_commands_of_the_readme(root: Path):
    """They are one line each, need only the clone, and .ci/run takes the second from the README."""
    lines = [c for c in commands(root / "README.md") if c.startswith(INSTALL)]
    assert len(lines) == 2
    main, tests = lines
    assert all(part.startswith(".venv/bin/pyehl ") for part in parts(main)[1:])
    assert parts(tests) == [INSTALL, ".venv/bin/pytest -n auto"]
    assert (root / "install").is_file()


@pytest.mark.long
def test_readme_prints_what_is_printed(root: Path, folder: Path, drivers: dict[str, list[str]]):
    """The lines below a command and below Python, number by number; residuals may differ."""
    printed, compared = "", 0
    for language, block in fences(root / "README.md"):
        if language == "sh":
            lines = lines_of(block)
            todo = [part for line in lines for part in parts(line) if not is_exempt(part)]
            printed = "".join(execute(part, folder, drivers) for part in todo) or printed
        elif language == "python":
            printed = run_python(block, folder)
        elif language == "text":
            assert_shown(block, printed)
            compared += len(re.findall(NUMBER, block))
    assert compared > 60


@pytest.mark.parametrize(
    ("shown", "printed", "same"),
    [
        ("H_c 0.0798 +- 0.0027", "H_c 0.0799 +- 0.0027", True),
        ("H_c 0.0798 +- 0.0027", "H_c 0.0800 +- 0.0027", False),
        ("H_c 0.0798", "H_c 0.0798 +- 0.0027", False),
        ("H_c 0.0798 ...", "H_c 0.0798 +- 0.0027", True),
        ("9 x 9 ... residual 1E-05  end", "9 x 9  a  residual 3E-05  end", True),
        ("5 pixels, 0.02 %", "4 pixels, 0.02 %", False),
        ("smooth.csv:15: a", "smooth.csv:16: a", False),
    ],
)
def test_a_line_is_shown_if_its_words_and_numbers_agree(shown: str, printed: str, same: bool):
    assert is_shown(shown, printed) == same


@pytest.mark.parametrize("name", DOCUMENTS)
def test_case_texts_are_cases(root: Path, name: str):
    for text in blocks(root / name, "fortran"):
        Case.from_text(text)


@pytest.mark.parametrize("name", DOCUMENTS)
def test_links_lead_somewhere(root: Path, name: str):
    path = root / name
    for target in re.findall(r"\]\(([^)]+)\)", path.read_text()):
        if not target.startswith("http"):
            assert (path.parent / target.partition("#")[0]).exists(), target


@pytest.mark.parametrize("name", DOCUMENTS)
def test_keys_in_documents_are_keys(root: Path, name: str):
    known = set(KEYS)
    groups = {name.partition(".")[0] for name in known}
    words = re.findall(r"`(?:--set )?(\w+\.\w+)(?: ?=[^`]*)?`", (root / name).read_text())
    assert not {w for w in words if w.partition(".")[0] in groups} - known - FILES


# Files whose names look like keys
FILES = {
    *("ball_bearing.nml", "lubricant.nml", "case.nml", "duty.nml", "duty.csv"),
    *("surface.py", "case.py", "solver.py"),
}


def mapped(root: Path) -> list[str]:
    """Modules of the map in fortran/README.md, in order."""
    text = (root / "fortran" / "README.md").read_text()
    rows = re.findall(r"^\| `(\w+)/` \| [^|]* \| ([^|]*) \|$", text, re.M)
    return [f"{folder}/{name}.f90" for folder, names in rows for name in names.split("`")[1::2]]


def test_every_module_is_in_a_map(root: Path):
    listed = mapped(root)
    sources = {
        f"{path.parent.name}/{path.name}"
        for path in (root / "fortran").glob("*/*.f90")
        if path.parent.name != "test"
    }
    assert set(listed) == sources
    design = (root / "docs" / "design.md").read_text()
    package = root / "pyehl"
    modules = {
        path.relative_to(package).as_posix()
        for path in package.rglob("*.py")
        if path.name != "__init__.py"
    }
    assert not {m for m in modules if f"`{m}`" not in design}
    tests = (root / "tests" / "README.md").read_text()
    files = {p.relative_to(root / "tests").as_posix() for p in (root / "tests").glob("*/test_*.py")}
    assert set(re.findall(r"`(\w+/test_\w+\.py)`", tests)) == files


def test_every_public_name_is_in_the_reference(root: Path):
    text = (root / "docs" / "reference" / "api.md").read_text()
    assert set(re.findall(r"^\.\. auto\w+:: pyehl\.(\w+)$", text, re.M)) == set(pyehl.__all__)


def test_every_subcommand_is_in_the_reference(root: Path):
    text = (root / "docs" / "reference" / "commands.md").read_text()
    modules = {path.stem for path in (root / "pyehl" / "commands").glob("[a-z]*.py")}
    listed = {n.replace("-", "_") for n in re.findall(r"^\| `pyehl ([\w-]+)", text, re.M)}
    assert listed == modules - {"arguments", "machine", "watching"}


@pytest.mark.long
def test_friction_of_both_oils(root: Path):
    """Friction of Table 1 with an Eyring stress, and the ratio for a Newtonian oil."""
    text = (root / "docs/theory/prediction-compared.md").read_text(encoding="utf-8")
    case = root / "cases/table1.nml"
    newtonian = pyehl.predict(case).summary
    ratio, error = newtonian["mu_ratio"], newtonian["mu_ratio_model_error"]
    mean, scatter = newtonian["mu_ratio_tracks"], newtonian["mu_ratio_tracks_spread"]
    assert f"is {mean:.3f} ± {scatter:.3f} times that of smooth surfaces (mean and scatter" in text
    assert f"on the track of the case it is {ratio:.3f} ± {error:.3f} times (error of the" in text
    summary = pyehl.predict(case, {"lubricant.shear_law": "eyring"}).summary
    assert f"coefficient of friction is {summary['mu']:.4f}" in text
    assert f"the roughness adds {100.0 * (summary['mu_ratio'] - 1.0):.1f} % to it" in text


def test_every_status_has_a_line(root: Path):
    """Statuses of runs, predictions and points of a curve, each in the table of its kind."""
    text = (root / "docs/reference/statuses.md").read_text(encoding="utf-8")
    source = (root / "fortran/base/outcome.f90").read_text(encoding="utf-8")
    names = re.findall(r'"([^"]+)"', source[source.index("outcome_names(0:8)") :])
    runs = {name.strip() for name in names} - {"running"}
    points = set(transition.STATUSES)
    predictions = set(friction.STATUSES)
    kinds = (("Runs", runs), ("Points of a curve", points), ("Predictions", predictions))
    for head, expected in kinds:
        part = text.split(f"## {head}\n")[1].split("\n## ")[0]
        assert set(re.findall(r"^\| `([^`]+)` \|", part, re.MULTILINE)) == expected


def test_module_map_has_the_order_of_the_build(root: Path):
    """meson.build lists the modules so that each uses only earlier ones; so does the map."""
    built = re.findall(r"'(\w+/\w+\.f90)'", (root / "fortran" / "meson.build").read_text())
    listed = mapped(root)
    folders = [list(dict.fromkeys(n.partition("/")[0] for n in names)) for names in (built, listed)]
    assert folders[1] == [*folders[0], "bind"]


def test_modules_of_the_equation_table_have_its_routines(root: Path):
    """Routines that fortran/README.md names exist in the files given."""
    text = (root / "fortran" / "README.md").read_text()
    result = re.findall(r"((?:`\w+`(?:, )?)+) in `([\w/]+\.f90)`", text)
    assert len(result) >= 4
    for names, path in result:
        source = (root / "fortran" / path).read_text()
        for name in re.findall(r"`(\w+)`", names):
            assert re.search(rf"(subroutine|function|procedure) {name}\b", source), (name, path)


def test_theory_names_routines_that_are_there(root: Path):
    """Routines that a page of the theory names exist in the files given."""
    named = [
        (page.name, name, path)
        for page in sorted((root / "docs/theory").glob("*.md"))
        for names, path in re.findall(
            r"((?:`\w+`(?:, )?)+) in `(fortran/[\w/]+\.f90)`", page.read_text(encoding="utf-8")
        )
        for name in re.findall(r"`(\w+)`", names)
    ]
    assert {"full_multigrid", "time_step", "solve_stationary"} <= {name for _, name, _ in named}
    for page, name, path in named:
        source = (root / path).read_text(encoding="utf-8")
        assert re.search(rf"(subroutine|function|procedure) {name}\b", source), (page, name, path)


def test_theory_names_files_that_are_there(root: Path):
    """Every chapter names the files in which its equations are computed, and they exist."""
    folders = ("fortran", "pyehl", "tests", "docs")
    files = {path.name for folder in folders for path in (root / folder).rglob("*.*")}
    chapters = [p for p in (root / "docs/theory").glob("*.md") if "toctree" not in p.read_text()]
    for page in chapters:
        named = re.findall(r"`([\w/]+\.(?:f90|py))`", page.read_text(encoding="utf-8"))
        assert named or page.stem == "stress", page.name
        for name in named:
            places = [root / folder / name for folder in ("", "fortran", "pyehl")]
            known = any(place.is_file() for place in places)
            assert known or ("/" not in name and name in files), (page.name, name)


def test_a_v_cycle_is_in_few_files(root: Path):
    """From the program to the kernel, each file is used or created by the one before it."""
    text = (root / "fortran/README.md").read_text(encoding="utf-8")
    part = text.split("## From `ehl` to a V cycle\n")[1].split("\n## ")[0]
    to_cycle, cycle = (
        re.findall(r"^\| `([\w/]+\.f90)` \| (.*) \|$", table, re.MULTILINE)
        for table in part.split("The cycle of a round contact")
    )
    assert to_cycle
    assert len(cycle) <= 15
    sources = [p.read_text(encoding="utf-8") for p in (root / "fortran").glob("*/*.f90")]
    uses = {
        module[1]: set(re.findall(r"^   use (\w+)", source, re.MULTILINE))
        for source in sources
        if (module := re.search(r"^(?:module|program) (\w+)", source, re.MULTILINE))
    }
    used = {"ehl"}
    for path, routines in to_cycle + cycle:
        source = (root / "fortran" / path).read_text(encoding="utf-8")
        module = re.search(r"^(?:module|program) (\w+)", source, re.MULTILINE)
        assert module is not None
        assert module[1] in used, path
        used |= uses[module[1]]
        used |= {m for name in used if name.endswith("_factory") for m in uses[name]}
        for name in re.findall(r"`(\w+)`", routines):
            assert re.search(rf"(subroutine|function|type.*::) {name}\b", source), (path, name)


def test_citation_names_the_version_and_the_paper(root: Path):
    text = (root / "CITATION.cff").read_text()
    version = re.search(r"^  version: '(.+)'", (root / "meson.build").read_text(), re.M)
    assert version is not None
    assert f"version: {version[1]}" in text
    assert "10.1016/j.triboint.2019.01.028" in text
    assert f"## [{version[1]}]" in (root / "CHANGELOG.md").read_text()


def test_the_book_is_not_longer_than_it_says(script):
    count = script("docs/count_words.py")
    texts = [path.read_text(encoding="utf-8") for path in count.pages()]
    assert len(texts) > 100
    assert 30_000 < sum(count.words(text, code_apart=False) for text in texts) < count.LIMIT
    page = "# A *title*\n\nTwo `names`, [a link](x/y.md) and $a+b$: 3 %.\n\n| no | row |\n"
    assert count.words(page + "```sh\nno code\n```\n<!--n=a-->one<!--/-->") == 7


@pytest.mark.long
def test_a_page_too_wide_for_a_phone_is_found(script, tmp_path):
    phone = script("docs/check_phone.py")
    head = '<!doctype html><meta name="viewport" content="width=device-width">'
    (tmp_path / "good.html").write_text(f"{head}<article><p>words</p></article>")
    wide = '<table style="width: 900px"><tr><td>cut</td></tr></table>'
    (tmp_path / "wide.html").write_text(f"{head}<article>{wide}</article>")
    hidden = f'<div style="overflow: hidden">{wide}</div>'
    (tmp_path / "hidden.html").write_text(f"{head}<article>{hidden}</article>")
    own = f'<div style="overflow: auto">{wide}</div>'
    (tmp_path / "scrolls.html").write_text(f"{head}<article>{own}</article>")
    (tmp_path / "search.html").write_text(head)
    result = " ".join(phone.faults(tmp_path, None, timeout=1.0))
    assert "wide.html: 9" in result
    assert "hidden.html: cut" in result
    assert "good.html" not in result
    assert "scrolls.html" not in result
    assert "search: nothing" in result
