# SPDX-License-Identifier: BSD-3-Clause
"""No command changes files that it did not write."""

import json
import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import reproduce
import smooth
import stress

import pyehl
from pyehl import cli
from pyehl.case import files_of
from pyehl.measured_response import measurement

SMOOTH = (
    "&contact moes_m = 100.0 moes_l = 5.0 /\n"
    "&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
)
SI = "&contact load = 20.0 /\n&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
ROUGH = "&grid points = 65 /\n&surface kind = 'fractal' pixels = 32 /\n"
WAVE = SMOOTH + "&surface kind = 'harmonic' amplitude = 0.001 /\n&time steps = 2 /\n"
MANY = "contact.moes_m=100,200"
QUIET = ["--jobs", "1", "-q"]

# Commands that write a folder: the case of each, and its arguments without -o
FOLDERS = {
    "run": (SMOOTH, ["run", "case.nml", "-q"]),
    "ehl": (SMOOTH, ["case.nml", "-q"]),
    "predict": (ROUGH, ["predict", "case.nml", "--no-plots"]),
    "sweep": (SMOOTH, ["sweep", "case.nml", "--run", "film", "--vary", MANY, *QUIET]),
    "stribeck": (SI, ["stribeck", "case.nml", "--speed", "1,2", *QUIET]),
    "response": (SMOOTH, ["response", "case.nml"]),
    "reproduce": (SMOOTH, ["reproduce", "--table", "1", *QUIET]),
    "stress": (SMOOTH, ["stress", "--cases", "1"]),
}  # fmt: skip
# Of `benchmarks/` and `examples/`
SCRIPTS = {"reproduce": reproduce, "stress": stress, "smooth": smooth}
REPLACING = ("run", "ehl", "predict")
Call = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def call(
    ehl: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Call:
    """Run a command of `FOLDERS` on its case, ``call("run", "-o", "out")``, or another one."""
    monkeypatch.chdir(tmp_path)

    def run(name: str, *words: str, case: str = "case.nml") -> subprocess.CompletedProcess[str]:
        text, own = FOLDERS.get(name, ("", [name]))
        own = [case if word == "case.nml" else word for word in own]
        if text and not Path(case).exists():
            Path(case).write_text(text)
        if name == "ehl":
            command = [ehl, *own, *words]
            return subprocess.run(command, capture_output=True, text=True, check=False)
        capsys.readouterr()
        if own[0] in SCRIPTS:
            status = SCRIPTS[own[0]].main([*own[1:], *words])
        else:
            status = cli.main([*own, *words])
        return subprocess.CompletedProcess(name, status, *capsys.readouterr())

    return run


def tree(folder: Path) -> dict[str, object]:
    """Everything below a folder: files with their bytes, links with their targets."""
    result: dict[str, object] = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_symlink():
            result[name] = path.readlink()
        else:
            result[name] = path.read_bytes() if path.is_file() else None
    return result


def foreign(folder: Path) -> None:
    """Put a file and a folder of a user into a folder."""
    (folder / "sub").mkdir(parents=True)
    (folder / "sub").chmod(0o700)
    (folder / "sub" / "a.txt").write_text("mine")
    (folder / "notes.txt").write_text("mine")


def refused(done: subprocess.CompletedProcess[str], *parts: str) -> None:
    assert done.returncode == 2, done
    for part in (*parts, "expected: "):
        assert part in done.stderr
    for raw in ("Traceback", "Errno", ".partial", ".nml."):
        assert raw not in done.stderr


def whole(folder: Path) -> dict[str, object]:
    """Read the summary; all files that it lists exist."""
    summary = json.loads((folder / "summary.json").read_text())
    names = {path.name for path in folder.iterdir()}
    assert set(summary["files"]) <= names
    return summary


@pytest.mark.parametrize("name", FOLDERS)
def test_foreign_files(call: Call, tmp_path: Path, name: str):
    foreign(tmp_path / "out")
    Path("case.nml").write_text(FOLDERS[name][0])
    before = tree(tmp_path)
    refused(call(name, "-o", "out"), "out", "'notes.txt'", "--force")
    assert tree(tmp_path) == before


@pytest.mark.parametrize("name", FOLDERS)
def test_result_of_another_command(call: Call, tmp_path: Path, name: str):
    other = "predict" if name in ("run", "ehl") else "run"
    assert call(other, "-o", "out").returncode == 0
    Path("case.nml").write_text(FOLDERS[name][0])
    before = tree(tmp_path)
    for words in ([], ["--force"]):
        refused(call(name, "-o", "out", *words), "out", f"holds a result of pyehl {other}")
        assert tree(tmp_path) == before


@pytest.mark.parametrize("name", FOLDERS)
def test_a_foreign_file_with_a_name_of_the_result(call: Call, tmp_path: Path, name: str):
    needed = {
        "sweep": "results.csv",
        "stribeck": "stribeck.png",
        "reproduce": "report.html",
        "response": "case.nml",
        "stress": "stress.json",
    }.get(name, "case.nml")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / needed).write_text("mine")
    Path("case.nml").write_text(FOLDERS[name][0])
    before = tree(tmp_path)
    for words in ([], ["--force"]):
        refused(call(name, "-o", "out", *words), f"'{needed}'")
        assert tree(tmp_path) == before


@pytest.mark.parametrize("name", FOLDERS)
def test_folder_of_the_input(call: Call, tmp_path: Path, name: str):
    Path("case.nml").write_text(FOLDERS[name][0])
    before = tree(tmp_path)
    refused(call(name, "-o", "."), "'case.nml'")
    assert tree(tmp_path) == before


@pytest.mark.parametrize("name", REPLACING)
def test_forced_into_the_folder_of_the_input(call: Call, tmp_path: Path, name: str):
    """Files with other names are kept; the working directory is filled, not replaced."""
    foreign(tmp_path)
    (tmp_path / "my.nml").write_text(FOLDERS[name][0])
    inode = tmp_path.stat().st_ino
    assert call(name, "-o", ".", "--force", case="my.nml").returncode == 0
    whole(tmp_path)
    assert (tmp_path / "my.nml").read_text() == FOLDERS[name][0]
    assert (tmp_path / "notes.txt").read_text() == (tmp_path / "sub/a.txt").read_text() == "mine"
    assert tmp_path.stat().st_ino == inode
    before = tree(tmp_path)
    refused(call(name, "-o", ".", "--force", case="my.nml"), "working directory")
    assert tree(tmp_path) == before


@pytest.mark.parametrize("name", REPLACING)
def test_earlier_result_with_foreign_files(call: Call, tmp_path: Path, name: str):
    out = tmp_path / "out"
    assert call(name, "-o", "out").returncode == 0
    names = set(tree(out))
    foreign(out)
    os.symlink("notes.txt", out / "link")
    before = tree(tmp_path)
    refused(call(name, "-o", "out"), "'link'", "--force")
    assert tree(tmp_path) == before
    places = {n: (out / n).lstat().st_ino for n in ("notes.txt", "sub", "link")}
    old = (out / "summary.json").stat().st_ino
    assert call(name, "-o", "out", "--force").returncode == 0
    assert set(tree(out)) == names | {"notes.txt", "sub", "sub/a.txt", "link"}
    assert {n: (out / n).lstat().st_ino for n in places} == places
    assert (out / "sub").stat().st_mode & 0o777 == 0o700
    assert (out / "summary.json").stat().st_ino != old
    whole(out)
    assert {path.name for path in tmp_path.iterdir()} == {"case.nml", "out"}


@pytest.mark.parametrize("name", ["run", "ehl"])
def test_foreign_files_with_names_of_results(call: Call, tmp_path: Path, name: str):
    out = tmp_path / "out"
    assert call(name, "-o", "out", "--set", "output.fields=.false.").returncode == 0
    (out / "film.png").write_text("mine")
    (out / "H.npy").write_text("mine")
    refused(call(name, "-o", "out", "--force"), "'H.npy'")
    (out / "H.npy").rename(out / "mine.npy")
    refused(call(name, "-o", "out"), "'film.png'")
    assert call(name, "-o", "out", "--force").returncode == 0
    assert (out / "film.png").read_text() == (out / "mine.npy").read_text() == "mine"
    whole(out)


@pytest.mark.parametrize("name", ["run", "ehl"])
def test_own_case_as_input(call: Call, tmp_path: Path, name: str):
    assert call(name, "-o", "out").returncode == 0
    Path("case.nml").unlink()
    Path("case.nml").symlink_to("out/case.nml")
    before = tree(tmp_path)
    refused(call(name, "-o", "out"), "'case.nml'", "read by this command")
    assert tree(tmp_path) == before


@pytest.mark.parametrize("name", ["run", "ehl", "predict", "sweep", "stribeck"])
def test_links_are_kept(call: Call, tmp_path: Path, name: str):
    (tmp_path / "real").mkdir()
    Path("out").symlink_to("real")
    for _ in range(2):
        assert call(name, "-o", "out").returncode == 0
        assert Path("out").readlink() == Path("real")
        assert any((tmp_path / "real").iterdir())
    assert {path.name for path in tmp_path.iterdir()} == {"case.nml", "out", "real"}
    if name in REPLACING:
        Path("gone").symlink_to("nothing")
        refused(call(name, "-o", "gone"), "a link to nothing")


COARSE = ("--dpi", "40")
# Single files: arguments of the command, and its output
FILES = {
    "export": (["export", "out", "-o", "a.nc"], ["a.nc"]),
    "export of the folder": (["export", "out"], ["out/results.nc"]),
    "plot": (["plot", "out", "-o", ".", *COARSE], ["centre_lines.png", "film.png"]),
    "plot of the folder": (["plot", "out", *COARSE], ["out/centre_lines.png", "out/film.png"]),
    **{
        f"plot as {end}": (
            ["plot", "out", "--format", end, *COARSE],
            [f"out/centre_lines.{end}", f"out/film.{end}"],
        )
        for end in ("pdf", "svg")
    },
    "movie": (["plot", "moving", "--movie"], ["moving/movie.gif"]),
    **{
        f"surface as {end}": (
            ["surface", "rough.nml", "-o", f"a{end}"],
            [f"a{end}{more}" for more in ("", ".nml", ".png")],
        )
        for end in (".npy", ".txt", ".nc")
    },
    "smooth": (["smooth", "--points", "17", "--threads", "1", "-o", "a.json"], ["a.json"]),
}  # fmt: skip


# long tests; another file of the same kind is always tested
LONG = ("plot of the folder", "plot as pdf", "plot as svg", "surface as .txt", "surface as .nc")


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Inputs of commands that write single files."""
    folder = tmp_path_factory.mktemp("results")
    pyehl.solve(pyehl.Case.from_text(SMOOTH), output=folder / "out")
    moving = pyehl.Case.from_text(WAVE, ["output.frame_interval=1e-6"])
    pyehl.solve(moving, output=folder / "moving", check=False)
    shutil.rmtree(folder / "moving.checkpoint")
    (folder / "rough.nml").write_text(ROUGH)
    return folder


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.long] if n in LONG else []) for n in FILES]
)
def test_single_files(
    call: Call, results: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
):
    monkeypatch.setattr(smooth, "smooth_rows", lambda *_: [])
    monkeypatch.setattr(smooth, "exponents", lambda _: {})
    monkeypatch.setattr("pyehl.plots.movie.DPI", 40)
    shutil.copytree(results, tmp_path, dirs_exist_ok=True)
    words, files = FILES[name]
    # a foreign file in place of each: nothing is written, not even the other files
    for file in files:
        (tmp_path / file).write_text("made by pyehl, I think")
        before = tree(tmp_path)
        refused(call(*words), Path(file).name, "did not write")
        assert tree(tmp_path) == before
        (tmp_path / file).unlink()
    assert call(*words).returncode == 0
    assert all((tmp_path / file).is_file() for file in files)
    # files of this command are replaced, through a link too
    link, target = tmp_path / files[0], tmp_path / "elsewhere"
    link.rename(target)
    link.symlink_to(target)
    inode = target.stat().st_ino
    assert call(*words).returncode == 0
    assert link.is_symlink()
    assert target.stat().st_ino != inode
    assert not [p for p in tmp_path.rglob("*") if "partial" in p.name]


@pytest.mark.parametrize("suffix", [".npy", ".txt"])
def test_surface_does_not_overwrite_its_input(call: Call, tmp_path: Path, suffix: str):
    heights = np.random.default_rng(1).normal(scale=1e-8, size=(32, 32))
    scan = f"scan{suffix}"
    np.save(scan, heights) if suffix == ".npy" else np.savetxt(scan, heights)
    size = ["--set", "surface.length_x=1e-4", "--set", "surface.length_y=1e-4"]
    Path("case.nml").write_text(
        f"&surface kind = 'map' file = '{scan}' length_x = 1e-4 length_y = 1e-4 /\n"
    )
    Path("link.npy").symlink_to(scan)
    before = tree(tmp_path)
    for words in ([scan, *size], ["case.nml"]):
        for target in (scan, "link.npy"):
            refused(call("surface", *words, "-o", target), target, "reads it")
            assert tree(tmp_path) == before


def test_table_among_the_results_is_kept(call: Call, tmp_path: Path):
    Path("first.nml").write_text(SI)
    assert call("run", "-o", "out", case="first.nml").returncode == 0
    table = "pressure_Pa,temperature_degC,viscosity_Pa_s\n0,40,0.04\n1e9,40,1e7\n"
    Path("out/history.csv").write_text(table)
    Path("case.nml").write_text(SI + "&lubricant table = 'out/history.csv' temperature = 40 /\n")
    before = tree(tmp_path)
    refused(call("run", "-o", "out"), "history.csv")
    assert tree(tmp_path) == before


@pytest.mark.parametrize("end", ["", "_2"])
def test_profile_among_the_results_is_kept(call: Call, tmp_path: Path, end: str):
    roller = "&contact shape = 'roller' length = 0.01 load = 2000.0 radius = 0.005 "
    grid = "/\n&grid points = 65 /\n"
    Path("first.nml").write_text(f"{roller} profile = 'crown' crown_radius = 1.0 {grid}")
    assert call("run", "-o", "out", case="first.nml").returncode == 0
    Path("out/history.csv").write_text("-0.006, 1e-5\n0.0, 0.0\n0.006, 1e-5\n")
    table = f"profile{end} = 'file' profile_file{end} = 'out/history.csv'"
    Path("case.nml").write_text(f"{roller} {table} {grid}")
    before = tree(tmp_path)
    refused(call("run", "-o", "out"), "history.csv")
    assert tree(tmp_path) == before
    # a resolved case has the values of its table
    case = pyehl.Case("case.nml")
    Path("out/history.csv").unlink()
    assert files_of(case.resolve()) == []


def test_changed_map_is_foreign(call: Call, tmp_path: Path):
    """The case beside a map has its checksum."""
    Path("rough.nml").write_text(ROUGH)
    words = ["surface", "rough.nml", "-o", "a.npy", "--no-plots"]
    assert call(*words).returncode == 0
    np.save("a.npy", np.zeros((32, 32)))
    refused(call(*words), "a.npy", "did not write")
    assert not np.load("a.npy").any()


def test_pictures_and_exports_go_with_the_result(call: Call, tmp_path: Path):
    for driver in ("run", "ehl"):
        assert call(driver, "-o", "out").returncode == 0
        assert call("plot", "out", *COARSE).returncode == 0
        assert call("plot", "out", "--format", "svg").returncode == 0
        assert call("export", "out").returncode == 0
        assert call(driver, "-o", "out").returncode == 0
        assert set(tree(tmp_path / "out")) == set(whole(tmp_path / "out")["files"])


def test_response_with_foreign_case(call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Beside a folder of the command without a summary."""
    tiny = (measurement.Tier("long", 2.0, 65, 2.0, 0.5),)
    for module in (
        "measured_response.measurement",
        "measured_response.folder",
        "commands.response",
    ):
        monkeypatch.setattr(f"pyehl.{module}.TIERS", tiny)
    assert call("response", "-o", "out").returncode == 0
    out = tmp_path / "out"
    tier = (out / "tier_long.npz").stat().st_ino
    assert call("response", "-o", "out").returncode == 0
    assert (out / "tier_long.npz").stat().st_ino == tier
    whole(out)
    for name in ("summary.json", "response.csv", "response.nc", "response.png"):
        (out / name).unlink()
    (out / "case.nml").write_text("mine")
    before = tree(tmp_path)
    for words in ([], ["--force"]):
        refused(call("response", "-o", "out", *words), "'case.nml'")
        assert tree(tmp_path) == before


def test_output_in_python(tmp_path: Path):
    case = pyehl.Case.from_text(SMOOTH)
    foreign(tmp_path / "out")
    before = tree(tmp_path)
    with pytest.raises(pyehl.InputError, match=r"'notes\.txt'"):
        pyehl.solve(case, output=tmp_path / "out")
    with pytest.raises(pyehl.InputError, match=r"'notes\.txt'"):
        pyehl.sweep(case, {"contact.moes_m": [100.0]}, run="film", output=tmp_path / "out", jobs=1)
    with pyehl.Solver(case) as solver, pytest.raises(pyehl.InputError, match=r"'notes\.txt'"):
        solver.write(tmp_path / "out")
    assert tree(tmp_path) == before
    pyehl.solve(case, output=tmp_path / "out", force=True)
    whole(tmp_path / "out")
    pyehl.sweep(
        case, {"contact.moes_m": [100.0]}, run="film", jobs=1, force=True,
        output=tmp_path / "study",
    )  # fmt: skip
    assert {n: tree(tmp_path)[n] for n in before} == before


@pytest.mark.parametrize("name", ["run", "ehl"])
@pytest.mark.parametrize("place", ["out.checkpoint", "out.checkpoint.previous"])
def test_foreign_states(call: Call, tmp_path: Path, name: str, place: str):
    Path("case.nml").write_text(WAVE)
    if place.endswith("previous"):
        assert call(name, "-o", "out").returncode == 1
    (tmp_path / place).mkdir()
    (tmp_path / place / "case.nml").write_text("mine")
    before = tree(tmp_path)
    refused(call(name, "-o", "out"), place, "'case.nml'")
    assert tree(tmp_path) == before


def test_both_drivers_give_the_same_messages(call: Call, tmp_path: Path):
    assert call("run", "-o", "out").returncode == 0
    (tmp_path / "file").write_text("mine")
    foreign(tmp_path / "out")
    for words in (["out"], ["file"], ["file/deep"], ["/"], [".", "--force"]):
        reported = [call(name, "-o", *words) for name in ("run", "ehl")]
        assert reported[0].stderr == reported[1].stderr
        assert reported[0].returncode == reported[1].returncode == 2
