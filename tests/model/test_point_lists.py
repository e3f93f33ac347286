# SPDX-License-Identifier: BSD-3-Clause
"""Lists of points and their columns, and positions along the axes of a table."""

from pathlib import Path

import numpy as np
import pytest
from scan_texts import GWYDDION, NX, NY, SIZE, STEP, check, lines, points, write

from pyehl.errors import InputError
from pyehl.surfaces import read_scan


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
        with pytest.raises(InputError, match=r"the first column increases .* not in equal steps"):
            read_scan(write(tmp_path / "table.csv", rows), 3e-5, 2e-5, height_unit="um")


def test_places_with_too_few_digits_are_no_heights(tmp_path: Path):
    """Steps of 2.44e-6 m with seven decimals are equal only to 2 %."""
    rng = np.random.default_rng(106)
    places = [f"{2.44e-6 * k:.7f}" for k in range(12)]
    rows = [";".join(["m", *places[:9]])]
    rows += [";".join([y, *(f"{z:.7f}" for z in rng.normal(0, 0.02, 9))]) for y in places]
    path = tmp_path / "map.txt"
    path.write_text("\n".join(rows))
    with pytest.raises(InputError, match="the first column increases or decreases like an axis"):
        read_scan(path, 1e-5, 1e-5, height_unit="um")


def test_units_of_positions_and_heights_are_required(tmp_path: Path):
    """One unit for all three would make a map of 3 mm from one of 3 um."""
    rng = np.random.default_rng(70)
    rows = [
        f"{4.97e-4 * i} {4.97e-4 * j} {rng.normal(0, 1e-7)}" for j in range(9) for i in range(7)
    ]
    path = tmp_path / "points.txt"
    path.write_text("\n".join(rows))
    with pytest.raises(InputError, match=r"steps of 0\.000497, and the file does not name"):
        read_scan(path)
    assert read_scan(path, lateral_unit="mm").length_x == pytest.approx(7 * 4.97e-7)
