# SPDX-License-Identifier: BSD-3-Clause
"""Height maps in the subcommands and the program: prepared, refused, written, resumed."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from pyehl import Case, InputError, Solver, cli, surfaces

pytest.importorskip("SurfaceTopography")

LENGTH = 1e-4
CASE = (
    "&contact load = 20.0 /\n"
    "&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    "&time steps = 3 /\n"
    "&surface kind = 'map' file = '{}' {} /\n"
)


def heights(pixels: int = 32, seed: int = 1) -> np.ndarray:
    made = surfaces.fractal(pixels, LENGTH, LENGTH, rms_height=2e-8, hurst=0.8, seed=seed)
    return made.heights


@pytest.fixture
def scan(tmp_path: Path) -> Path:
    """A tilted scan of an instrument, with a hole and a spike."""
    from SurfaceTopography import Topography

    z = heights() + np.linspace(0.0, 1e-6, 32)[:, None]
    z[3, 4] = np.nan
    z[20, 10] += 2e-6
    topography = Topography(np.ma.masked_invalid(z), (LENGTH, LENGTH), unit="m")
    topography.to_x3p(str(tmp_path / "scan.x3p"))
    return tmp_path / "scan.x3p"


def write_case(path: Path, file: str, keys: str = "") -> str:
    path.write_text(CASE.format(file, keys))
    return str(path)


def run(case: str | Path, folder: Path, *options: str) -> int:
    """`pyehl run` in this process."""
    return cli.main(["run", str(case), "-o", str(folder), "-q", *options])


def test_run_of_a_scan(scan: Path, tmp_path: Path, capsys):
    """The plan, the summary and plan.txt report its preparation; the tile has its size."""
    case = write_case(tmp_path / "case.nml", "scan.x3p", "outliers = 50.0")
    assert cli.main(["check", case]) == 0
    plan = capsys.readouterr().out
    assert "outliers 50 (given), 1 points" in plan
    # three steps are too few for the mean friction
    assert run(case, tmp_path / "out") == 1
    made = json.loads((tmp_path / "out" / "summary.json").read_text())["surface_preparation"]
    assert [s["key"].partition(".")[2] for s in made["steps"]] == [
        "outliers", "fill", "detrend", "edges",
    ]  # fmt: skip
    assert made["tile_size_m"] == pytest.approx([2 * LENGTH, 2 * LENGTH], rel=1e-6)
    assert "outliers 50" in (tmp_path / "out" / "plan.txt").read_text()
    kept = Case(tmp_path / "out" / "case.nml").resolve()["surface"]
    assert kept["tile_x"] == pytest.approx(2 * LENGTH, rel=1e-6)
    assert kept["length_x"] == 0.0
    # the case of a result gives the same result
    assert run(tmp_path / "out" / "case.nml", tmp_path / "again") == 1
    assert np.array_equal(
        np.load(tmp_path / "out" / "P.npy"), np.load(tmp_path / "again" / "P.npy")
    )


def test_program_accepts_the_tile_of_pyehl_surface(scan: Path, tmp_path: Path, drive, capsys):
    case = write_case(tmp_path / "case.nml", "scan.x3p", "outliers = 50.0 track = 1e-5")
    refused = drive("ehl", case, "-o", "none")
    assert refused.returncode == 2
    assert "has to be prepared by pyehl" in refused.stderr
    assert "pyehl surface CASE.nml -o prepared.npy" in refused.stderr
    assert not (tmp_path / "none").exists()
    assert cli.main(["surface", case, "-o", str(tmp_path / "prepared.npy")]) == 0
    printed = capsys.readouterr().out
    assert "Sq " in printed
    assert imread(tmp_path / "prepared.npy.png").std() > 0.1
    assert drive("ehl", tmp_path / "prepared.npy.nml", "-o", "ehl").returncode == 1
    assert run(case, tmp_path / "pyehl") == 1
    for name in ("P.npy", "H.npy"):
        one, other = (np.load(tmp_path / d / name) for d in ("ehl", "pyehl"))
        assert np.array_equal(one, other)


@pytest.mark.parametrize(
    ("keys", "why"),
    [
        ("detrend = 'tilt'", "surface.detrend"),
        ("edges = 'mirror'", "surface.edges"),
        ("crop_x_max = 5e-5", "surface.crop"),
        ("outliers = 10.0", "surface.outliers"),
        ("align_lines = 'y'", "surface.align_lines"),
        ("profile = 'ridges'", "surface.profile"),
        ("rotate = 90.0", "surface.rotate"),
        ("sign = -1", "surface.sign"),
        ("track = 1e-5", "surface.track"),
        ("length_x = 0.0", "size of the map is not known"),
    ],
)
def test_program_refuses_what_it_cannot_prepare(tmp_path: Path, drive, keys: str, why: str):
    np.save(tmp_path / "map.npy", heights())
    size = "" if "length_x" in keys else f"length_x = {LENGTH}"
    case = write_case(tmp_path / "case.nml", "map.npy", f"{size} length_y = {LENGTH} {keys}")
    refused = drive("ehl", case, "-o", "none")
    assert refused.returncode == 2
    assert why in refused.stderr
    assert str(tmp_path / "map.npy") in refused.stderr


def test_program_refuses_exports(tmp_path: Path, drive):
    """Their lines are along x: read as an array they would be transposed."""
    text = "# Width: 100 µm\n# Height: 100 µm\n# Value units: m\n"
    with (tmp_path / "map.txt").open("w", encoding="utf-8") as stream:
        stream.write(text)
        np.savetxt(stream, heights())
    size = f"length_x = {LENGTH} length_y = {LENGTH}"
    refused = drive("ehl", write_case(tmp_path / "case.nml", "map.txt", size), "-o", "none")
    assert refused.returncode == 2
    assert "it is not a .npy array" in refused.stderr


@pytest.mark.parametrize(("numbers", "order"), [("f8", "C"), ("f4", "C"), ("f4", "F")])
def test_unprepared_arrays_have_the_same_bits(tmp_path: Path, drive, numbers: str, order):
    np.save(tmp_path / "map.npy", np.array(heights(), dtype=numbers, order=order))
    size = f"length_x = {LENGTH} length_y = {LENGTH}"
    case = write_case(tmp_path / "case.nml", "map.npy", size)
    assert drive("ehl", case, "-o", "ehl").returncode == run(case, tmp_path / "pyehl") == 1
    for name in ("P.npy", "H.npy"):
        assert (tmp_path / "ehl" / name).read_bytes() == (tmp_path / "pyehl" / name).read_bytes()
    # an unprepared map is reported, too
    summary = json.loads((tmp_path / "pyehl" / "summary.json").read_text())
    assert summary["surface_preparation"]["steps"] == []
    assert "taken as it is" in (tmp_path / "pyehl" / "plan.txt").read_text()
    # `sign` twice changes nothing: a prepared map gives the result of the same heights from a file
    np.save(tmp_path / "map.npy", -heights().astype(numbers))
    other = write_case(tmp_path / "other.nml", "map.npy", f"{size} sign = -1")
    assert run(other, tmp_path / "other") == 1
    one, same = (np.load(tmp_path / d / "P.npy") for d in ("pyehl", "other"))
    assert same == pytest.approx(one, abs=1e-12)


def test_run_with_a_prepared_map_is_resumed_to_the_same_bits(scan: Path, tmp_path: Path):
    """With its size, and without the file of the instrument."""
    case = write_case(tmp_path / "case.nml", "scan.x3p", "outliers = 50.0")
    longer = ("--set", "time.steps=5")
    assert run(case, tmp_path / "whole", *longer) == 1
    assert run(case, tmp_path / "part") == 1
    scan.rename(tmp_path / "moved.x3p")
    part = str(tmp_path / "part")
    whole = (tmp_path / "whole" / "P.npy").read_bytes()
    without = str(tmp_path / "without")
    assert cli.main(["run", "--resume", part, *longer, "-q", "-o", without]) == 1
    assert (tmp_path / "without" / "P.npy").read_bytes() == whole
    scan.with_name("moved.x3p").rename(scan)
    assert cli.main(["run", "--resume", part, *longer, "-q"]) == 1
    assert (tmp_path / "part" / "P.npy").read_bytes() == whole
    summary = json.loads((tmp_path / "part" / "summary.json").read_text())
    assert summary["surface_preparation"]["missing"] == 1


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ("channel = '9'", "there is no such channel"),
        ("crop_x_max = 1e-2", "surface.crop_x_max"),
        ("fill = 'none'", "surface.fill = 'none'"),
    ],
)
def test_unusable_maps_are_bad_input(scan: Path, tmp_path: Path, capsys, keys: str, message: str):
    case = write_case(tmp_path / "case.nml", "scan.x3p", keys)
    assert run(case, tmp_path / "none") == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "none").exists()
    with pytest.raises(InputError):
        Solver(Case(case))


def test_surface_of_a_bare_file(scan: Path, tmp_path: Path, capsys):
    assert cli.main(["surface", str(scan), "--set", "surface.detrend='curvature'"]) == 0
    printed = capsys.readouterr().out
    assert "0.1 x 0.1 mm by the file" in printed
    assert "detrend  curvature (given)" in printed
    for name in ("Sa", "Sq", "Ssk", "Sku", "Sz", "Sdq", "Str"):
        assert f"\n{name} " in printed
    assert {p.name for p in tmp_path.iterdir()} == {"scan.x3p"}


@pytest.mark.parametrize("kind", ["harmonic", "fractal"])
def test_surface_of_every_kind(tmp_path: Path, kind: str):
    (tmp_path / "case.nml").write_text(f"&surface kind = '{kind}' pixels = 32 /\n")
    out = tmp_path / "map.txt"
    assert cli.main(["surface", str(tmp_path / "case.nml"), "-o", str(out), "--no-plots"]) == 0
    assert surfaces.tile_of(surfaces.read_scan(out)).shape == (32, 32)
    assert not (tmp_path / "map.txt.png").exists()


def test_surface_refuses(tmp_path: Path, capsys):
    (tmp_path / "case.nml").write_text(
        "&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    )
    assert cli.main(["surface", str(tmp_path / "case.nml")]) == 2
    assert "surface.kind = 'smooth' is no tile of heights" in capsys.readouterr().err
    (tmp_path / "case.nml").write_text("&surface kind = 'fractal' /\n")
    assert cli.main(["surface", str(tmp_path / "case.nml"), "-o", "map.x3p"]) == 2
    assert ".npy, .txt, .nc" in capsys.readouterr().err


def test_progress_of_large_maps(tmp_path: Path, capsys, monkeypatch):
    np.save(tmp_path / "map.npy", heights())
    words = ["surface", str(tmp_path / "map.npy"), "--set", f"surface.length_x={LENGTH}"]
    words += ["--set", f"surface.length_y={LENGTH}", "--set", "surface.detrend='tilt'"]
    assert cli.main(words) == 0
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(sys.modules["pyehl.surfaces.prepare"], "LARGE", 1024)
    # in another way: a map that is prepared already is kept
    words[-1] = "surface.detrend='curvature'"
    assert cli.main(words) == 0
    assert "32 x 32 heights: detrend ..." in capsys.readouterr().err


def test_part_of_a_large_map(tmp_path: Path, monkeypatch):
    """What the grid does not resolve is predicted with a part; small maps are used whole."""
    np.save(tmp_path / "map.npy", heights())
    size = f"length_x = {LENGTH} length_y = {LENGTH} edges = 'mirror'"
    case = Case(write_case(tmp_path / "case.nml", "map.npy", size))
    assert surfaces.for_solver(case.resolve()).part is None
    # a function has the name of the module
    module = sys.modules["pyehl.surfaces.solver_surface"]
    monkeypatch.setattr(module, "LARGE_PIXELS", 4000)
    monkeypatch.setattr(module, "PART_PIXELS", 1024)
    part = surfaces.for_solver(case.resolve()).part
    with Solver(case) as solver:
        plan = solver.describe(predict=True)
    assert part is not None
    assert part.shape == (32, 32)
    assert part.pixel == pytest.approx((LENGTH / 32, LENGTH / 32))
    middle = heights()[8:24, 8:24]
    assert np.sort(np.unique(part.heights)) == pytest.approx(
        np.sort(middle.ravel() - middle.mean()), abs=1e-18
    )
    assert "map.npy, 16 x 16 pixels in its middle" in plan
