# SPDX-License-Identifier: BSD-3-Clause
"""Text files of instruments, spreadsheets and people: each line, cell and unit."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
import scipy.ndimage

from pyehl.errors import InputError
from pyehl.surfaces import for_solver, read_scan

NX, NY, STEP = 20, 14, 1.5
SIZE = (NX * STEP * 1e-6, NY * STEP * 1e-6)
MISSING = ((5, 3), (0, 7), (19, 7), (19, 13))


def smooth() -> np.ndarray:
    """Heights [um], rms 50 nm: no line is straight."""
    z = scipy.ndimage.gaussian_filter(np.random.default_rng(1).normal(size=(NX, NY)), 1.5)
    return np.round(0.05 * z / z.std(), 5)


Z = smooth()


def lines(
    separator: str = "\t", word: str | None = None, *, decimal: str = ".", quoted: bool = False
) -> list[str]:
    """Lines along x; a word replaces some points."""
    done = []
    for j in range(NY):
        cells = [f"{v:.5f}".replace(".", decimal) for v in Z[:, j]]
        if word is not None:
            cells = [word if (i, j) in MISSING else cell for i, cell in enumerate(cells)]
        done.append(separator.join(f'"{cell}"' if quoted else cell for cell in cells))
    return done


def write(path: Path, text: Sequence[str], encoding: str = "utf-8", end: str = "\n") -> Path:
    path.write_bytes((end.join(text) + end).encode(encoding))
    return path


def check(path: Path, missing: Sequence[tuple[int, int]] = (), **keys: object) -> str:
    """Shape, size and heights of the file are those of `Z`; returns the note."""
    scan = read_scan(path, **keys)
    assert scan.heights.shape == (NX, NY)
    assert (scan.length_x, scan.length_y) == pytest.approx(SIZE, rel=1e-9)
    assert [tuple(place) for place in np.argwhere(np.isnan(scan.heights))] == sorted(missing)
    there = np.isfinite(scan.heights)
    assert scan.heights[there] == pytest.approx(1e-6 * Z[there], abs=1e-14)
    return scan.note


GWYDDION = ["# Channel: Z", "# Width: 30 µm", "# Height: 21 µm", "# Value units: µm"]
WORDS = ["***", "*", "---", "-", "?", "void", "No Data", "no data", "N/A", "#N/A", "####", "BAD",
         "xxx", "1.#QNAN", "NULL", "not measured", "Ungültig", "None", "+++", "OVER"]  # fmt: skip


@pytest.mark.parametrize("word", WORDS)
def test_a_word_in_place_of_a_height(tmp_path: Path, word: str):
    """The point is missing, but no line of the map."""
    for name, separator in (("tab.txt", "\t"), ("semicolon.csv", ";"), ("blank.txt", " ")):
        path = write(tmp_path / name, [*GWYDDION, *lines(separator, word)], end="\r\n")
        note = check(path, MISSING)
        assert "missing points in the file" in note or separator == " "


@pytest.mark.parametrize("word", ["NaN", "nan", "inf", "-inf", ""])
def test_words_for_missing_points(tmp_path: Path, word: str):
    check(write(tmp_path / "map.txt", [*GWYDDION, *lines("\t", word)]), MISSING)


def test_a_line_of_missing_points(tmp_path: Path):
    """As the first one, and within; a line of separators counts, too."""
    row = "\t".join(["***"] * NX)
    for at, text in ((0, row), (5, row), (5, "\t" * (NX - 1))):
        table = lines()
        table[at] = text
        path = write(tmp_path / "map.txt", [*GWYDDION, *table])
        check(path, [(i, at) for i in range(NX)])


def test_an_unknown_word_in_a_table_is_refused(tmp_path: Path):
    """With its line and column; so is a heading within the table."""
    path = write(tmp_path / "map.txt", [*GWYDDION, *lines("\t", "three")])
    with pytest.raises(InputError, match=r"map\.txt:8:\d+: 'three' is no number"):
        read_scan(path)
    table = lines()
    table.insert(5, "measured again")
    with pytest.raises(InputError, match=r"map\.txt:10:1: 'measured again' is no number"):
        read_scan(write(tmp_path / "map.txt", [*GWYDDION, *table]))
    note = check(write(tmp_path / "map.txt", [*GWYDDION, *lines(), "end of file"]))
    assert "1 lines after the heights are no numbers and were not read: 'end of file'" in note


@pytest.mark.parametrize(
    "encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1"]
)
def test_encodings(tmp_path: Path, encoding: str):
    for end in ("\n", "\r\n", "\r"):
        check(write(tmp_path / "map.txt", [*GWYDDION, *lines()], encoding, end))


@pytest.mark.parametrize("mark", ["utf-8", "utf-8-sig", "utf-16"])
def test_a_byte_order_mark_does_not_swap_the_axes(tmp_path: Path, mark: str):
    """An array has one x per line, with and without it, and keeps all of its lines."""
    path = write(tmp_path / "map.csv", lines(","), mark, "\r\n")
    scan = read_scan(path, *SIZE[::-1], height_unit="um")
    assert scan.is_array
    assert scan.heights == pytest.approx(1e-6 * Z.T, abs=1e-15)


def test_empty_cells_move_no_columns(tmp_path: Path):
    """One per line, and as many as in the other lines; at the end of lines that are closed."""
    header = ["Width (um);30", "Height (um);21", "Unit;um"]
    table = [line.split(";") for line in lines(";")]
    missing = [(i, j) for j in range(NY) for i in (j,)]
    for i, j in missing:
        table[j][i] = ""
    rows = [";".join(row) for row in table]
    check(write(tmp_path / "map.csv", [*header, *rows]), missing)
    check(write(tmp_path / "map.csv", [*header, *(row + ";" for row in rows)]), missing)
    check(write(tmp_path / "map.csv", [*header, *lines(";", "", decimal=",")]), MISSING)
    rows[3] = rows[3].rpartition(";")[0]
    with pytest.raises(InputError, match=r"map\.csv:7:\d+: 19 heights, but 20 in the lines above"):
        read_scan(write(tmp_path / "map.csv", [*header, *rows]))


KEYENCE = ['"Measured date","2024-01-01 10:00:00"', '"Model","VK-X3000 Series"',
           '"Data type","ImageDataCsv"', '"XY Calibration","1500.000","nm"', '"Horizontal","20"',
           '"Vertical","14"', '"Minimum value","-0.140"', '"Maximum value","0.181"', '"Unit","um"',
           '"Reference data name",""', "", '"Height"']  # fmt: skip


def test_exports_of_keyence(tmp_path: Path):
    check(write(tmp_path / "k.csv", [*KEYENCE, *lines(",", quoted=True)], "utf-16", "\r\n"))
    check(write(tmp_path / "k.csv", [*KEYENCE, *lines(",", "", quoted=True)]), MISSING)
    check(write(tmp_path / "k.csv", [*KEYENCE, *lines(",", decimal=",", quoted=True)]))
    german = [line.replace('","', '";"').replace(".000", ",000") for line in KEYENCE]
    check(write(tmp_path / "k.csv", [*german, *lines(";", decimal=",", quoted=True)]))
    names = {"XY Calibration": "XYキャリブレーション", "Horizontal": "横", "Vertical": "縦",
             "Unit": "単位", '"Height"': '"高さ"'}  # fmt: skip
    japanese = "\n".join(KEYENCE)
    for word, other in names.items():
        japanese = japanese.replace(word, other)
    check(write(tmp_path / "k.csv", [*japanese.split("\n"), *lines(",", quoted=True)]))


def test_a_header_that_says_another_number_of_lines(tmp_path: Path):
    wrong = [line.replace('"14"', '"15"') for line in KEYENCE]
    path = write(tmp_path / "k.csv", [*wrong, *lines(",", quoted=True)])
    with pytest.raises(InputError, match=r"20 heights in a line and 14 lines, but .* 20 x 15"):
        read_scan(path)


@pytest.mark.parametrize(
    "header",
    [
        ["X Pixels,20", "Y Pixels,14", "X Pitch,1.5,um", "Y Pitch,1.5,um", "Z Unit,um"],
        ["Pixel size: 1.5 um", "Unit: um"],
        ["Pixel Size (um): 1.5", "Height unit: um"],
        ["dx = 1.5 µm", "dy = 1.5 µm", "z unit = µm"],
        ["Lateral resolution\t1.5 µm/px", "z in µm"],
        ["Width=0.030 mm", "Height=0.021 mm", "Units=um"],
        ["X Length [mm]: 0.030", "Y Length [mm]: 0.021", "Z-Unit: um"],
        ["# X range: 30 um", "# Y range: 21 um", "# heights in um"],
        ["pixel_size_um: 1.5", "unit: um"],
        ["X-Pixel size,1500,nm", "Y-Pixel size,1500,nm", "Data unit,um"],
        ["Spacing X;0,0015;mm", "Spacing Y;0,0015;mm", "Unit Z;microns"],
        ["Scan size X 30 um", "Scan size Y 21 um", "Z unit um"],
        ["Columns: 20", "Rows: 14", "x_pitch = 1.5e-6 m", "y_pitch = 1.5e-6 m", "z_unit = um"],
        ["Width: 20", "Height: 14", "Unit: um", "Pixel pitch: 1.5 um"],
        ["Width: 30", "Height: 21", "XY unit: um", "Values: um"],
    ],
)
def test_units_and_sizes_of_a_header(tmp_path: Path, header: list[str]):
    for separator in (";", "\t"):
        check(write(tmp_path / "map.csv", ["My map", *header, *lines(separator)]))
        closed = [line + separator for line in lines(separator)]
        check(write(tmp_path / "map.csv", ["My map", *header, *closed]))


@pytest.mark.parametrize(
    "header",
    [
        ["Image Size X [um],30.000", "Image Size Y [um],21.000", "Height [um]"],
        [
            "Width: 20",
            "Height: 14",
            "PixelSizeXMeter: 1.5e-6",
            "PixelSizeYMeter: 1.5e-6",
            "z in um",
        ],
        ["NX\t20", "NY\t14", "DX\t1.5\tµm", "DY\t1.5\tµm", "Z\tµm"],
        ["[Header]", "Pixel size X: 1.5 µm", "Pixel size Y: 1.5 µm", "Z units: µm", "[Data]"],
        ["# x-length = 30", "# y-length = 21", "# x-unit = um", "# y-unit = um", "# z-unit = um"],
    ],
)
def test_further_headers(tmp_path: Path, header: list[str]):
    """Lines that begin with a separator, Fortran numbers, marks named in the header."""
    check(write(tmp_path / "map.dat", [*header, *("\t" + line for line in lines())]))
    fortran = [line.replace("\t", "D+00\t") + "D+00" for line in lines()]
    check(write(tmp_path / "map.dat", [*header, *fortran]))
    marked = [*header, "NODATA_value: -7.5", *lines("\t", "-7.5")]
    assert "4 heights of -7.5 are missing by the header" in check(
        write(tmp_path / "map.dat", marked), MISSING
    )


def test_numbers_of_points_alone(tmp_path: Path):
    """Above the table they state the direction of the lines, or that some are missing."""
    size = {"length_x": SIZE[0], "length_y": SIZE[1], "height_unit": "um"}
    check(write(tmp_path / "map.txt", ["20 14", *lines(" ")]), **size)
    turned = [" ".join(f"{v:.5f}" for v in row) for row in Z]
    note = check(write(tmp_path / "map.txt", ["20 14", *turned]), **size)
    assert "one x per line" in note
    with pytest.raises(InputError, match=r"20 heights in a line and 13 lines, but .* 20 x 14"):
        read_scan(write(tmp_path / "map.txt", ["20 14", *lines(" ")[1:]]), **size)


def test_axes_and_lists_of_arrays(tmp_path: Path):
    """From `.npy` files as from text; the solver alone does not read them."""
    x, y = STEP * np.arange(NX), STEP * np.arange(NY)
    table = np.block([[np.zeros((1, 1)), y[None, :]], [x[:, None], Z]])
    listed = np.array([(x[i], y[j], Z[i, j]) for i in range(NX) for j in range(NY)])
    for array in (table, listed):
        np.save(tmp_path / "map.npy", array)
        check(tmp_path / "map.npy", height_unit="um")
    # in metres and with its size, the solver reads an array
    np.save(tmp_path / "map.npy", 1e-6 * table)
    group = {"kind": "map", "file": str(tmp_path / "map.npy"), "length_x": SIZE[0],
             "length_y": SIZE[1]}  # fmt: skip
    made = for_solver({"surface": group})
    assert made.heights is not None
    assert made.heights.shape == (NX, NY)
    np.save(tmp_path / "map.npy", 1e-6 * Z)
    assert for_solver({"surface": group}).heights is None


def test_unused_header_lines_are_reported(tmp_path: Path):
    """A factor that is not applied, and a unit that is not a length."""
    header = ["Pixel size: 1.5 um", "Unit: um"]
    note = check(write(tmp_path / "map.csv", [*header, "Z scale: 0.1", *lines(";")]))
    assert "a line 'scale z' of 0.1 that was not applied" in note
    with pytest.raises(InputError, match="not in a unit of length"):
        read_scan(write(tmp_path / "map.csv", ["Pixel size: 1.5 um", "Unit: V", *lines(";")]))


def points(scale: float = 1.0, form: str = "{:.6g};{:.6g};{:.5f}") -> list[str]:
    """List of x, y and z, positions in other units."""
    return [
        form.format(scale * STEP * i, scale * STEP * j, Z[i, j])
        for j in range(NY)
        for i in range(NX)
    ]


@pytest.mark.parametrize(
    "header",
    [
        ["X [mm];Y [mm];Z [µm]"],
        ["# x (mm) y (mm) z (um)"],
        ["x/mm;y/mm;z/um"],
        ["x;y;z", "mm;mm;µm"],
        ["X_mm;Y_mm;Z_um"],
        ["XY unit: mm", "Z unit: um"],
    ],
)
def test_columns_with_units_of_their_own(tmp_path: Path, header: list[str]):
    check(write(tmp_path / "list.csv", [*header, *points(1e-3)]))


def test_positions_in_another_unit_than_the_heights(tmp_path: Path):
    """If the header does not name it, it is required: 0.03 mm are not 0.03 um."""
    path = write(tmp_path / "list.csv", points(1e-3))
    with pytest.raises(InputError, match=r"steps of 0.0015, .* surface\.lateral_unit"):
        read_scan(path, height_unit="um")
    note = check(path, height_unit="um", lateral_unit="mm")
    assert "x and y in mm by surface.lateral_unit" in note
    check(path, length_x=SIZE[0], length_y=SIZE[1], height_unit="um")
    assert "x and y in um" in check(write(tmp_path / "um.csv", points()), height_unit="um")
    # steps of 0.1 um, heights of 50 nm: steeper than any surface
    path = write(tmp_path / "steep.csv", points(0.1 / STEP))
    with pytest.raises(InputError, match="slope of"):
        read_scan(path, height_unit="mm", lateral_unit="um")


def test_numbers_of_pixels_are_no_lengths(tmp_path: Path):
    path = write(tmp_path / "list.csv", points(1.0 / STEP))
    with pytest.raises(
        InputError, match=r"whole numbers, as those of pixels; give surface\.length_x"
    ):
        read_scan(path, height_unit="um")
    check(path, length_x=SIZE[0], length_y=SIZE[1], height_unit="um")
    assert read_scan(path, height_unit="um", lateral_unit="um").length_x == pytest.approx(2e-5)
    check(write(tmp_path / "list.csv", ["Pixel size: 1.5 um", *path.read_text().split("\n")]),
          height_unit="um")  # fmt: skip


def test_further_columns_of_a_list(tmp_path: Path):
    """An index before, a quality after: no heights."""
    path = write(tmp_path / "list.csv", ["n;x;y;z", *(f"{n};{p}" for n, p in enumerate(points()))])
    assert "the first column numbers the lines" in check(path, height_unit="um")
    path = write(tmp_path / "list.csv", [f"{p};{n % 7 / 9}" for n, p in enumerate(points())])
    assert "the first three of 4 columns are x, y and z" in check(path, height_unit="um")


def with_axes(corner: str | None, down: bool = False) -> list[str]:
    """Table under a line of x, after a column of y."""
    x = [f"{STEP * i:.3f}" for i in range(NX)]
    y = [f"{STEP * j:.3f}" for j in range(NY)]
    table = [";".join([place, line]) for place, line in zip(y, lines(";"), strict=True)]
    head = ";".join(([] if corner is None else [corner]) + x)
    return [head, *(table[::-1] if down else table)]


@pytest.mark.parametrize("corner", ["", "0", "y\\x", "nan", "µm", None])
def test_axes_are_not_taken_as_heights(tmp_path: Path, corner: str | None):
    for down in (False, True):
        path = write(tmp_path / "table.csv", with_axes(corner, down))
        note = check(path, height_unit="um")
        assert "positions, not heights: the first line and column" in note
        with pytest.raises(InputError, match=r"steps of 1\.5, .* surface\.lateral_unit"):
            read_scan(path)


def test_one_axis(tmp_path: Path):
    table = with_axes("")
    path = write(tmp_path / "rows.csv", table[1:])
    with pytest.raises(InputError, match=r"give surface\.length_x \[m\]"):
        read_scan(path, height_unit="um")
    assert "first column" in check(path, length_x=SIZE[0], height_unit="um")
    path = write(tmp_path / "columns.csv", [table[0][1:], *lines(";")])
    assert "first line" in check(path, length_y=SIZE[1], height_unit="um")


def test_tables_of_pandas(tmp_path: Path):
    """With the index, the names of columns, both; they are indices without lengths."""
    size = {"length_x": SIZE[0], "length_y": SIZE[1]}
    index = [f"{j},{line}" for j, line in enumerate(lines(","))]
    numbers = ",".join(map(str, range(NX)))
    names = ",".join(f"c{i}" for i in range(NX))
    for text in (["," + numbers, *index], index, [numbers, *lines(",")], ["," + names, *index]):
        path = write(tmp_path / "frame.csv", text)
        assert "numbers of pixels, not heights" in check(path, height_unit="um", **size)
        with pytest.raises(InputError, match=r"numbers of pixels, .* give surface\.length_x"):
            read_scan(path, height_unit="um")


@pytest.mark.parametrize(
    "mark", ["-32768", "-9999", "32767", "1000001", "1e38", "-3.4e38", "99999"]
)
def test_marks_of_missing_points(tmp_path: Path, mark: str):
    """Numbers far from all heights, which programs write for a missing point."""
    note = check(write(tmp_path / "map.txt", [*GWYDDION, *lines("\t", mark)]), MISSING)
    assert "4 heights" in note
    assert "marks of missing points" in note


def test_a_height_that_occurs_too_often(tmp_path: Path):
    """It may be a mark; it is kept and reported."""
    z = np.random.default_rng(2).normal(size=(40, 30))
    marked = np.where(np.random.default_rng(3).uniform(size=z.shape) < 0.02, 0.0, z)
    np.save(tmp_path / "map.npy", 1e-8 * marked)
    scan = read_scan(tmp_path / "map.npy", 1e-4, 1e-4)
    count = int((marked == 0.0).sum())
    assert f"{count} heights are exactly 0, far more often than any other value" in scan.note
    assert np.isfinite(scan.heights).all()
    np.save(tmp_path / "map.npy", 1e-8 * np.minimum(z, 1.5))
    count = int((z >= 1.5).sum())
    note = read_scan(tmp_path / "map.npy", 1e-4, 1e-4).note
    assert f"{count} heights are exactly 1.5e-08, the largest one" in note
    np.save(tmp_path / "map.npy", 1e-8 * z)
    assert read_scan(tmp_path / "map.npy", 1e-4, 1e-4).note == ""


def test_steep_steps_are_reported(tmp_path: Path):
    z = 1e-8 * np.random.default_rng(2).normal(size=(40, 30))
    z[4, 5] = 1e-4
    np.save(tmp_path / "map.npy", z)
    note = read_scan(tmp_path / "map.npy", 4e-5, 3e-5).note
    assert "0.17 % of the steps from point to point are steeper than 45 degrees" in note


ZYGO = ['Zygo XYZ Data File - Format 1', '1 8 3 5 "Thu Jan 01 10:00:00 2024"', "0 0 0 0 0 0",
        "3 2 20 14", '""', '""', '""', "0 0.5 5.7e-07 0 1 0 1.5e-06 1704103200",
        '48 32 0 0 0 0 ""', "0 0 0 0 0 0 0 0 0 0", "1 1 20 2 0 0 0 0 0", '0 ""', "1 0"]  # fmt: skip


@pytest.mark.parametrize("suffix", ["xyz", "txt", "asc", "dat"])
def test_zygo_lists(tmp_path: Path, suffix: str):
    """Positions are numbers of pixels from the corner in line 4, whose size is in line 8."""
    listed = [
        f"{i + 3} {j + 2} " + ("No Data" if (i, j) in MISSING else f"{Z[i, j]:.6f}")
        for j in range(NY)
        for i in range(NX)
    ]
    path = write(tmp_path / f"map.{suffix}", [*ZYGO, "#", *listed, "#"], end="\r\n")
    check(path, MISSING)
    with pytest.raises(InputError, match="279 points, but line 4 states 20 x 14"):
        read_scan(write(tmp_path / f"map.{suffix}", [*ZYGO, "#", *listed[1:], "#"]))
    bare = [line.replace("1.5e-06", "0") for line in ZYGO]
    with pytest.raises(InputError, match="line 8 of the file gives no size of a pixel"):
        read_scan(write(tmp_path / f"map.{suffix}", [*bare, "#", *listed, "#"]))


@pytest.mark.parametrize("number", [1, 2])
def test_zygo_phases(tmp_path: Path, number: int):
    """Phase counts in ten columns, after intensities or without them; 32768 counts per wave."""
    count = 0.5 * 5.7e-07 / 32768
    phases = np.rint(1e-6 * Z / count).astype(int)
    for place in MISSING:
        phases[place] = 2147483640
    words = [str(v) for v in phases.T.ravel()]
    block = [" ".join(words[k : k + 10]) + " " for k in range(0, len(words), 10)]
    for shape in ("0 0 0 0 0 0", "0 0 5 2 1 255"):
        header = [f"Zygo ASCII Data File - Format {number}", *ZYGO[1:2], shape, *ZYGO[3:], '" "']
        intensities = [] if shape.startswith("0 0 0") else ["1 2 3 4 5 6 7 8 9 10"]
        path = write(tmp_path / "map.asc", [*header, "#", *intensities, "#", *block, "#"])
        scan = read_scan(path)
        assert (scan.length_x, scan.length_y) == pytest.approx(SIZE)
        missing = np.argwhere(np.isnan(scan.heights))
        assert [tuple(place) for place in missing] == sorted(MISSING)
        assert np.nanmax(np.abs(scan.heights - 1e-6 * Z)) <= 0.51 * count
    with pytest.raises(InputError, match=r"blocks of \[270\] numbers, but .* say \[280\]"):
        read_scan(write(tmp_path / "map.asc", [*header[:2], ZYGO[2], *header[3:], "#", *block[1:]]))


def test_spip_and_wyko_keep_their_lines(tmp_path: Path):
    """Formats that SurfaceTopography knows, with words in place of points, are counted here."""
    spip = ["# File Format = ASCII", "# x-pixels = 20", "# y-pixels = 14", "# x-length = 30000",
            "# y-length = 21000", "# Bit2nm = 1000"]  # fmt: skip
    check(write(tmp_path / "map.asc", [*spip, *lines("\t", "void")]), MISSING)
    wyko = ["Wyko ASCII Data File Format 0 1 1", "X Size 14", "Y Size 20",
            "Pixel_size 7 4 0.0015"]  # fmt: skip
    values = [[v if v == "***" else f"{1e3 * float(v):.2f}" for v in line.split("\t")]
              for line in lines("\t", "***")]  # fmt: skip
    path = write(tmp_path / "map.asc", [*wyko, "RAW_DATA 3 280", *map("\t".join, values)])
    check(path, MISSING)


def test_profiles_are_reported_as_profiles(tmp_path: Path):
    z = [f"{v:.4f}" for v in Z[:, 0]]
    mahr = ["1 2", "SAMPLE 0.000000e+00 PRF", "CX M 2.000000e+03 MM 1.0e+00 D", "EOR", *z]
    columns = [f"{0.0005 * n:.4f};{v}".replace(".", ",") for n, v in enumerate(z)]
    for name, text in {
        "line.prf": mahr,
        "line.pro": z,
        "line.csv": ["Profil;R", "X [mm];Z [µm]", *columns],
        "line.txt": ["Profile curve", "2000\t0.5\tµm", *(f"{n}\t{v}" for n, v in enumerate(z))],
    }.items():
        with pytest.raises(InputError, match=r"a profile along (a|one) line"):
            read_scan(write(tmp_path / name, text, "latin-1", "\r\n"))


def test_missing_lines_are_reported(tmp_path: Path):
    """If a header has only lengths, and in a list; an axis with an extra step is refused."""
    scan = read_scan(write(tmp_path / "map.txt", [*GWYDDION, *lines()[:-2]]))
    assert "pixels of 1.5e-06 x 1.75e-06 m by the lengths of the header" in scan.note
    note = check(write(tmp_path / "list.csv", points()[:-3]),
                 [(i, NY - 1) for i in (17, 18, 19)], height_unit="um")  # fmt: skip
    assert "a list of 277 points of the 280 of its grid" in note
    table = with_axes("")
    for rows in (
        [*table[:5], *table[4:]],
        [*table[:5], *table[6:]],
        [*table[:5], table[6], table[5], *table[7:]],
    ):
        with pytest.raises(InputError, match=r"the first column grows .* not in equal steps"):
            read_scan(write(tmp_path / "table.csv", rows), 3e-5, 2e-5, height_unit="um")


def test_places_with_too_few_digits_are_no_heights(tmp_path: Path):
    """Steps of 2.44e-6 m with seven decimals are equal only to 2 %."""
    rng = np.random.default_rng(106)
    places = [f"{2.44e-6 * k:.7f}" for k in range(12)]
    lines = [";".join(["m", *places[:9]])]
    lines += [";".join([y, *(f"{z:.7f}" for z in rng.normal(0, 0.02, 9))]) for y in places]
    path = tmp_path / "map.txt"
    path.write_text("\n".join(lines))
    with pytest.raises(InputError, match="the first column grows as an axis does"):
        read_scan(path, 1e-5, 1e-5, height_unit="um")


def test_units_of_positions_and_heights_are_required(tmp_path: Path):
    """One unit for all three would make a map of 3 mm from one of 3 um."""
    rng = np.random.default_rng(70)
    lines = [
        f"{4.97e-4 * i} {4.97e-4 * j} {rng.normal(0, 1e-7)}" for j in range(9) for i in range(7)
    ]
    path = tmp_path / "points.txt"
    path.write_text("\n".join(lines))
    with pytest.raises(InputError, match=r"steps of 0\.000497, and the file does not name"):
        read_scan(path)
    assert read_scan(path, lateral_unit="mm").length_x == pytest.approx(7 * 4.97e-7)
