# SPDX-License-Identifier: BSD-3-Clause
"""Height maps from files: arrays, and files of instruments in several formats."""

import struct
import sys

import numpy as np
import pytest
import scipy.io

from pyehl import cli
from pyehl.errors import InputError, NoMemoryError
from pyehl.surfaces import Options, prepare, read_scan

pytest.importorskip("SurfaceTopography")
import h5py
from SurfaceTopography import Topography, UniformLineScan

SIZE = (3e-5, 2e-5)


def slope_map(nx=30, ny=20):
    """Heights with different slopes along x and y: 2 nm per pixel along x, 7 along y."""
    return 1e-9 * (2.0 * np.arange(nx)[:, None] + 7.0 * np.arange(ny)[None, :])


def scan_of(z, unit="m"):
    scale = {"m": 1.0, "µm": 1e6, "nm": 1e9}[unit]
    sizes = tuple(s * scale for s in SIZE)
    return Topography(np.ma.masked_invalid(z * scale), sizes, unit=unit)


def write_sdf(path, z):
    """Binary file of ISO 25178-71, as optical profilers write it."""
    nx, ny = z.shape
    header = struct.pack(
        "<8s10s12s12sHHddddBBB",
        b"bISO-1.0", b"nobody    ", b"010120260000", b"010120260000", nx, ny,
        SIZE[0] / nx, SIZE[1] / ny, 1.0, -1.0, 0, 7, 0,
    )  # fmt: skip
    path.write_bytes(header + np.ascontiguousarray(z.T).astype("<f8").tobytes())


WRITERS = {
    "x3p": lambda z, path: scan_of(z, "µm").to_x3p(str(path)),
    "gwy": lambda z, path: scan_of(z, "nm").to_gwy(str(path)),
    "nc": lambda z, path: scan_of(z, "µm").to_netcdf(str(path)),
    "txt": lambda z, path: scan_of(z, "µm").to_matrix(str(path)),
    "sdf": lambda z, path: write_sdf(path, z),
}


@pytest.mark.parametrize("suffix", WRITERS)
def test_instrument_files_bring_unit_size_and_axes(tmp_path, suffix):
    path = tmp_path / f"scan.{suffix}"
    z = slope_map()
    WRITERS[suffix](z, path)
    scan = read_scan(path)
    assert not scan.is_array
    assert scan.heights.shape == (30, 20)
    # gwy keeps the heights in single precision
    assert scan.heights - scan.heights[0, 0] == pytest.approx(z, abs=2e-14)
    assert (scan.length_x, scan.length_y) == pytest.approx(SIZE, rel=1e-6)
    assert scan.size_from == "the file"


# the library leaves a netCDF file open
@pytest.mark.filterwarnings("ignore::ResourceWarning")
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("suffix", ["x3p", "gwy", "nc", "txt", "sdf"])
def test_missing_points_of_instrument_files(tmp_path, suffix):
    path = tmp_path / f"scan.{suffix}"
    z = slope_map()
    z[3:5, 7] = np.nan
    WRITERS[suffix](z, path)
    missing = np.argwhere(~np.isfinite(read_scan(path).heights))
    assert missing.tolist() == [[3, 7], [4, 7]]


def test_size_of_the_case_replaces_that_of_the_file(tmp_path):
    WRITERS["x3p"](slope_map(), tmp_path / "scan.x3p")
    scan = read_scan(tmp_path / "scan.x3p", length_y=5e-5)
    assert (scan.length_x, scan.length_y) == pytest.approx((SIZE[0], 5e-5))
    assert scan.size_from == (
        "surface.length_y and the file (in place of 3e-05 x 2e-05 m of the file)"
    )


TWO_CHANNELS = """# Channel: Up
# Width: 10 µm
# Height: 20 µm
# Value units: nm
1 2 3 4
2 3 4 6
3 4 5 6
3 4 5 8

# Channel: Down
# Width: 10 µm
# Height: 20 µm
# Value units: nm
-1 2 3 4
2 3 4 6
3 4 5 6
3 4 5 9
"""


@pytest.mark.parametrize(("wanted", "last"), [("", 8.0), ("2", 9.0), ("Down", 9.0), ("Up", 8.0)])
def test_channel_by_name_or_number(tmp_path, wanted, last):
    path = tmp_path / "two.txt"
    path.write_text(TWO_CHANNELS, encoding="utf-8")
    scan = read_scan(path, channel=wanted)
    assert scan.heights[3, 3] == pytest.approx(last * 1e-9)
    # lines of an export are along x
    assert scan.heights[1, 0] == pytest.approx(2e-9)
    assert scan.channel == ("Down" if last == 9.0 else "Up")
    assert (scan.length_x, scan.length_y) == pytest.approx((1e-5, 2e-5))


def test_unknown_channel_lists_the_channels(tmp_path):
    path = tmp_path / "two.txt"
    path.write_text(TWO_CHANNELS, encoding="utf-8")
    with pytest.raises(ValueError, match=r"surface.channel = '3'(.|\n)*1 'Up', 2 'Down'"):
        read_scan(path, channel="3")
    np.save(tmp_path / "map.npy", slope_map())
    with pytest.raises(ValueError, match=r"surface\.channel.*one map alone"):
        read_scan(tmp_path / "map.npy", 1e-5, 1e-5, channel="1")


def test_array_axes(tmp_path):
    """One x per line of a text; the first index of .npy."""
    z = slope_map()
    np.save(tmp_path / "map.npy", z)
    np.savetxt(tmp_path / "map.txt", z)
    for name in ("map.npy", "map.txt"):
        scan = read_scan(tmp_path / name, *SIZE)
        assert scan.is_array
        assert scan.heights == pytest.approx(z, abs=1e-24)
        with pytest.raises(ValueError, match=r"surface\.length_x and surface\.length_y \[m\]"):
            read_scan(tmp_path / name)


@pytest.mark.parametrize(("unit", "factor"), [("mm", 1e3), ("um", 1e6), ("nm", 1e9)])
def test_heights_in_other_units(tmp_path, unit, factor):
    """For files that name no unit; a file of an instrument names one."""
    z = slope_map()
    np.savetxt(tmp_path / "map.txt", factor * z)
    np.save(tmp_path / "map.npy", factor * z)
    for name in ("map.txt", "map.npy"):
        scan = read_scan(tmp_path / name, *SIZE, height_unit=unit)
        assert scan.heights == pytest.approx(z, rel=1e-12, abs=1e-24)
        assert unit in scan.note
    WRITERS["x3p"](z, tmp_path / "scan.x3p")
    with pytest.raises(ValueError, match="the file names its unit itself"):
        read_scan(tmp_path / "scan.x3p", height_unit=unit)


@pytest.mark.parametrize("separator", [";", "; ", "\t"])
def test_decimal_commas(tmp_path, separator):
    z = 1e6 * slope_map()
    lines = (separator.join(f"{v:.9g}".replace(".", ",") for v in line) for line in z)
    (tmp_path / "map.csv").write_text("\n".join(lines) + "\n")
    scan = read_scan(tmp_path / "map.csv", *SIZE, height_unit="um")
    assert scan.heights == pytest.approx(1e-6 * z, rel=1e-8)
    (tmp_path / "bad.csv").write_text(separator.join(("1,0", "1,,0", "1", "2")) + "\n")
    with pytest.raises(ValueError, match=rf"bad\.csv:1:{4 + len(separator)}: .* is no number"):
        read_scan(tmp_path / "bad.csv", *SIZE)


@pytest.mark.parametrize("header", ["", "x,y,z", "x y z"])
def test_lists_of_points(tmp_path, header):
    """In any order, positions rounded, a point missing; size and heights in one unit."""
    z = slope_map()
    nx, ny = z.shape
    pixel = SIZE[0] / nx, SIZE[1] / ny
    points = [(3e-6 + i * pixel[0], j * pixel[1], z[i, j]) for i in range(nx) for j in range(ny)]
    np.random.default_rng(1).shuffle(points)
    gone = points.pop()
    options = {"fmt": "%.7g", "header": header, "comments": "", "delimiter": "," if header else " "}
    np.savetxt(tmp_path / "list.xyz.txt", 1e6 * np.array(points), **options)
    scan = read_scan(tmp_path / "list.xyz.txt", height_unit="um")
    assert (scan.length_x, scan.length_y) == pytest.approx(SIZE, rel=1e-5)
    missing = np.argwhere(np.isnan(scan.heights))
    assert missing.tolist() == [[round((gone[0] - 3e-6) / pixel[0]), round(gone[1] / pixel[1])]]
    assert np.nan_to_num(scan.heights - z) == pytest.approx(np.zeros_like(z), abs=1e-13)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ((0, 0, 1.3), "point 1 of the list .* is off the grid"),
        ((4, 1, np.nan), "point 5 of the list has no y"),
        (
            (5, slice(None), (0.0, 1.0, 9.0)),
            "number 1 along x, 2 along y is in the list .* 2 times",
        ),
        ((slice(None), 1, 7.0), "all points of the list of x, y and z have the same y"),
    ],
)
def test_lists_of_points_off_a_grid(tmp_path, change, message):
    points = np.array([(i, j, 0.1 * i * j) for i in range(5) for j in range(6)], dtype=float)
    points[change[:2]] = change[2]
    np.savetxt(tmp_path / "list.txt", points)
    with pytest.raises(ValueError, match=message):
        read_scan(tmp_path / "list.txt", height_unit="um")


def test_unreadable_instrument_file(tmp_path):
    (tmp_path / "scan.x3p").write_bytes(b"PK\x03\x04 and nothing else")
    with pytest.raises(ValueError, match=r"scan\.x3p: cannot be read as a height map"):
        read_scan(tmp_path / "scan.x3p")
    WRITERS["sdf"](slope_map(), tmp_path / "scan.sdf")
    whole = (tmp_path / "scan.sdf").read_bytes()
    (tmp_path / "scan.sdf").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(ValueError, match=r"scan\.sdf: cannot be read"):
        read_scan(tmp_path / "scan.sdf")


@pytest.mark.parametrize("data", [b"II*\0" + bytes(range(250)) * 2, b"\0\0\0" + b"1 2 3\n" * 30])
def test_readers_print_nothing(tmp_path, capfd, recwarn, data):
    """They neither log nor warn about a binary file with the name of a text file."""
    (tmp_path / "map.csv").write_bytes(data)
    with pytest.raises(InputError, match=r"map\.csv: .*map") as refused:
        read_scan(tmp_path / "map.csv")
    assert "list index" not in str(refused.value)
    assert not any(capfd.readouterr())
    assert not recwarn.list


def test_file_without_a_unit_is_refused(tmp_path):
    Topography(slope_map(), (1.0, 2.0)).to_netcdf(str(tmp_path / "scan.nc"))
    with pytest.raises(ValueError, match="names no unit"):
        read_scan(tmp_path / "scan.nc")


def test_missing_package_says_how_to_install_it(tmp_path, monkeypatch):
    (tmp_path / "scan.x3p").write_bytes(b"PK")
    monkeypatch.setitem(sys.modules, "SurfaceTopography.IO", None)
    with pytest.raises(ValueError, match=r"pip install 'pyehl\[surfaces\]'"):
        read_scan(tmp_path / "scan.x3p")


@pytest.mark.parametrize("name", ["map.npy", "map.txt", "map.x3p", "map"])
def test_map_larger_than_the_memory(tmp_path, name):
    """Sparse files, which take no space on the disk: their data are not read."""
    n = 400_000
    with (tmp_path / name).open("wb") as stream:
        if name == "map.npy":
            header = {"descr": "<f8", "fortran_order": False, "shape": (n, n)}
            np.lib.format.write_array_header_1_0(stream, header)
        else:
            stream.write(b"1 2 3 4\n")
        try:
            stream.truncate(stream.tell() + 8 * n * n)
        except OSError:
            pytest.skip("no files of this size here")
    with pytest.raises(NoMemoryError, match=rf"{name}: .* needs .* GB of memory, .* are free"):
        read_scan(tmp_path / name, *SIZE)


def test_lengths_in_other_units_are_noticed(tmp_path):
    np.save(tmp_path / "map.npy", slope_map())
    with pytest.raises(ValueError, match="is the length in m"):
        read_scan(tmp_path / "map.npy", 0.829, 0.829)
    places = np.indices((5, 4)).reshape(2, -1).T
    np.savetxt(tmp_path / "list.txt", np.column_stack([2.0 * places, places[:, 0]]))
    with pytest.raises(ValueError, match=r"steps of 2, .* give .*, or surface\.lateral_unit"):
        read_scan(tmp_path / "list.txt")
    assert read_scan(tmp_path / "list.txt", height_unit="um").length_x == pytest.approx(1e-5)


TABLE = "0,5;1,5;2,5;3,5;4,5\n1,0;2,0;3,0;4,0;5,0\n-1;0;1;2;3\n0;0;0;0;7,25\n"


@pytest.mark.parametrize(
    ("header", "size", "unit"),
    [
        ("Height map;;\nWidth (um);10\nHeight (um);8,5\nUnit;nm\n\n", (1e-5, 8.5e-6), 1e-9),
        (
            "Profile 3\nX size: 0.01 mm\nY size: 8.5 µm\nZ units: Å\n128;128\n",
            (1e-5, 8.5e-6),
            1e-10,
        ),
        ("Height;0,5\nunit;nm\n", (None, None), 1e-9),
        ("Width;10\nHeight (um);8,5\nmade by hand\n", (None, None), 1.0),
        ("Width (um);10\nWidth (um);12\nUnit;um\nUnit;nm\n", (None, None), 1.0),
    ],
)
def test_table_under_header_lines(tmp_path, header, size, unit):
    """From a spreadsheet: lines along x, decimal commas; size and unit stated in the header."""
    path = tmp_path / "table.csv"
    path.write_text(header + TABLE, encoding="utf-8")
    given = (2e-5, 3e-5) if size == (None, None) else (None, None)
    if unit == 1.0:
        with pytest.raises(ValueError, match=r"slope of (.|\n)*names no unit: .* taken in m"):
            read_scan(path, *given)
        unit, named = 1e-9, {"height_unit": "nm"}
    else:
        named = {}
        with pytest.raises(ValueError, match="names its unit itself"):
            read_scan(path, *given, height_unit="nm")
    scan = read_scan(path, *given, **named)
    assert scan.heights.shape == (5, 4)
    assert scan.heights[:, 0] == pytest.approx(unit * np.array([0.5, 1.5, 2.5, 3.5, 4.5]))
    assert scan.heights[4, 3] == pytest.approx(unit * 7.25)
    assert (scan.length_x, scan.length_y) == pytest.approx(given if size == (None, None) else size)
    assert not scan.is_array
    assert ("by surface.height_unit" in scan.note) == bool(named)
    if size == (None, None):
        with pytest.raises(ValueError, match=r"surface\.length_x and surface\.length_y"):
            read_scan(path)


@pytest.mark.parametrize("separator", ["\t", ",", ";", " "])
def test_table_with_decimal_points(tmp_path, separator):
    """SurfaceTopography reads some of them, without the unit that the header names."""
    header = "Height map\nWidth (um): 10\nHeight (um): 8\nUnit: nm\n\n"
    lines = "\n".join(separator.join(f"{10 * j + i}.5" for i in range(5)) for j in range(4))
    (tmp_path / "table.txt").write_text(f"{header}{lines}\n")
    scan = read_scan(tmp_path / "table.txt")
    assert scan.heights == pytest.approx(1e-9 * (np.add.outer(range(5), 10 * np.arange(4)) + 0.5))
    assert (scan.length_x, scan.length_y) == pytest.approx((1e-5, 8e-6))


def test_list_of_points_under_a_header(tmp_path):
    places = np.indices((5, 4)).reshape(2, -1).T
    rows = "\n".join(f"{2 * x};{2 * y};{x},5" for x, y in places)
    (tmp_path / "list.csv").write_text(f"x;y;z\nUnit;um\n{rows}\n")
    scan = read_scan(tmp_path / "list.csv")
    assert scan.heights == pytest.approx(1e-6 * (np.arange(5)[:, None] + 0.5) * np.ones(4))
    assert (scan.length_x, scan.length_y) == pytest.approx((1e-5, 8e-6))


def test_bytes_are_no_table(tmp_path):
    (tmp_path / "binary.dat").write_bytes(b"Height map\n\0\1\2\3\n1,5;2;3;4\n4;5;6;7,5\n")
    with pytest.raises(ValueError, match=r"binary\.dat: cannot be read as a height map"):
        read_scan(tmp_path / "binary.dat", *SIZE)


@pytest.mark.parametrize("text", ["Height map\n1;2;3\nend\n", "Height map\nnothing\n\n"])
def test_text_without_a_table(tmp_path, text):
    """The message names the first line without numbers, and a remedy."""
    (tmp_path / "words.csv").write_text(text)
    message = r"words\.csv:1: 'Height map' is not numbers(.|\n)*height_unit, surface\.length_x"
    with pytest.raises(ValueError, match=message):
        read_scan(tmp_path / "words.csv")


@pytest.mark.parametrize(
    ("name", "head", "array"),
    [
        ("plain.txt", "# heights in m\n", True),
        ("plain.dat", "", True),
        ("plain.sur", "", True),
        ("nan.txt", "\n  nan 1e-9 2e-9 1e-9\n", True),
        ("signs.txt", "# one x per line\n-1e-9 2e-9 1e-9 1e-9\n", True),
        ("gwyddion.txt", "# Channel: A\n# Width: 10 µm\n", False),
        ("german.txt", "# Kanal: Höhe\n# Breite: 10 µm\n", False),
        ("japanese.txt", "# 幅： 10 µm\n", False),
        ("units.txt", "# Channel: A\n# Value units: mm\n", False),
        ("stylus.txt", "Data Type,Scan\nStylus,Radius: 2 um\n", False),
    ],
)
def test_exports_are_no_arrays(tmp_path, name, head, array):
    """In the languages of Gwyddion, with a unit and no size, and any that begin with words."""
    rows = "1e-9 2e-9 3e-9 1e-9\n" * 4
    (tmp_path / name).write_text(head + rows, encoding="utf-8")
    assert read_scan(tmp_path / name, *SIZE).is_array is array


def test_text_export_in_another_language(tmp_path):
    z = slope_map()
    header = "# Kanal: Höhe\n# Breite: 30 µm\n# Höhe: 20 µm\n# Einheiten: mm\n"
    lines = "\n".join("\t".join(f"{1e3 * v:.9g}" for v in line) for line in z.T)
    (tmp_path / "scan.txt").write_text(header + lines + "\n", encoding="utf-8")
    scan = read_scan(tmp_path / "scan.txt")
    assert scan.heights == pytest.approx(z, abs=1e-16)
    assert (scan.length_x, scan.length_y) == pytest.approx(SIZE)


@pytest.mark.parametrize("suffix", ["mat", "h5"])
def test_files_without_size_and_unit(tmp_path, suffix):
    """Both lengths are required; the heights are then taken in m, which the record states."""
    z = slope_map()
    path = tmp_path / f"scan.{suffix}"
    if suffix == "mat":
        scipy.io.savemat(path, {"height": z})
    else:
        with h5py.File(path, "w") as file:
            file["height"] = z
    with pytest.raises(ValueError, match=r"not known: .*; give surface\.length_x and surface\.len"):
        read_scan(path)
    with pytest.raises(ValueError, match=r"not known: .*; give surface\.length_y \[m\]"):
        read_scan(path, SIZE[0], None)
    scan = read_scan(path, *SIZE)
    assert scan.heights == pytest.approx(z, abs=1e-24)
    assert (scan.length_x, scan.length_y) == SIZE
    record = prepare(scan, Options(detrend="centre")).record
    assert "taken in m" in record.summary["note"]
    assert any("taken in m" in line for line in record.report())


def test_profiles_are_refused(tmp_path):
    """A profile is no area, in any format."""
    z = slope_map()[:, 0]
    UniformLineScan(1e6 * z, 30.0, unit="µm").to_netcdf(str(tmp_path / "line.nc"))
    with pytest.raises(ValueError, match="a profile along a line; a contact needs the map"):
        read_scan(tmp_path / "line.nc", *SIZE)
    (tmp_path / "line.txt").write_text(
        "X;Y;valid\n[mm];[mm];[1/0]\n" + "".join(f"{n};{v};1\n" for n, v in enumerate(1e3 * z))
    )
    with pytest.raises(ValueError, match="a profile along a line; a contact needs the map"):
        read_scan(tmp_path / "line.txt", *SIZE)
    lists = {1: "a profile along one line", 2: "a profile of x and z"}
    for columns, what in lists.items():
        np.savetxt(tmp_path / "list.txt", np.repeat(z[:, None], columns, axis=1))
        with pytest.raises(ValueError, match=f"not 30 x {columns}; is it {what}"):
            read_scan(tmp_path / "list.txt")


def test_empty_file(tmp_path):
    (tmp_path / "scan.x3p").write_bytes(b"")
    with pytest.raises(ValueError, match=r"scan\.x3p: the file is empty"):
        read_scan(tmp_path / "scan.x3p")


def test_command_names_a_broken_map_once(tmp_path, capsys):
    path = tmp_path / "bad.csv"
    path.write_text("1,2,3,4\n1,2,3\n")
    assert cli.main(["surface", str(path)]) == 2
    assert capsys.readouterr().err.count(str(path)) == 1
