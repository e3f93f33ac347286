# SPDX-License-Identifier: BSD-3-Clause
"""Text files of instruments, spreadsheets and people: each line, cell and unit."""

from pathlib import Path

import numpy as np
import pytest
from scan_texts import GWYDDION, MISSING, NX, NY, SIZE, STEP, Z, check, lines, write

from pyehl.errors import InputError
from pyehl.surfaces import for_solver, read_scan

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


@pytest.mark.parametrize(
    "mark", ["-32768", "-9999", "32767", "1000001", "1e38", "-3.4e38", "99999"]
)
def test_marks_of_missing_points(tmp_path: Path, mark: str):
    """Numbers far from all heights, which programs write for a missing point."""
    note = check(write(tmp_path / "map.txt", [*GWYDDION, *lines("\t", mark)]), MISSING)
    assert "4 heights" in note
    assert "marks of missing points" in note


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
