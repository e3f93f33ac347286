# SPDX-License-Identifier: BSD-3-Clause
"""Unusual valid files of instruments, and wrong headers: the reason is reported."""

import io
import re
import struct
import threading
import zipfile
from pathlib import Path

import numpy as np
import pytest

from pyehl.errors import InputError
from pyehl.surfaces import Topography as Tile
from pyehl.surfaces import in_memory, read_scan

pytest.importorskip("SurfaceTopography")
from SurfaceTopography import Topography

NX, NY, STEP = 12, 9, 1.5e-6
SIZE = (NX * STEP, NY * STEP)
Z = 5e-8 * np.random.default_rng(1).normal(size=(NX, NY))
GAPPY = np.where(np.random.default_rng(2).uniform(size=Z.shape) < 0.08, np.nan, Z)


def same(path: Path, expected: np.ndarray = Z, atol: float = 1e-15, **keys: object) -> str:
    """The file has these heights and its size; returns the note."""
    scan = read_scan(path, **keys)
    assert scan.heights.shape == expected.shape
    np.testing.assert_allclose(scan.heights, expected, rtol=1e-6, atol=atol)
    assert (scan.length_x, scan.length_y) == pytest.approx(SIZE, rel=1e-6)
    return scan.note


def x3p_members(z: np.ndarray) -> dict[str, bytes]:
    """Members of an archive of heights, as SurfaceTopography writes it."""
    stream = io.BytesIO()
    Topography(np.ma.masked_invalid(z), SIZE, unit="m").to_x3p(stream)
    with zipfile.ZipFile(stream) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def pack(path: Path, members: dict[str, bytes]) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    return path


def edited(members: dict[str, bytes], pattern: str, new: str) -> dict[str, bytes]:
    text, count = re.subn(pattern, new, members["main.xml"].decode(), flags=re.DOTALL)
    assert count
    return {**members, "main.xml": text.encode()}


@pytest.mark.parametrize("revision", ["ISO5436 – 2000", "ISO5436-2000", "ISO5436 — 2000 "])
def test_x3p_with_another_dash(tmp_path: Path, revision: str):
    members = edited(x3p_members(GAPPY), "ISO5436 - 2000", revision)
    same(pack(tmp_path / "scan.x3p", members), GAPPY)


@pytest.mark.parametrize("folder", ["scan/", "a/b/"])
def test_x3p_in_a_folder(tmp_path: Path, folder: str):
    members = {folder + name: data for name, data in x3p_members(GAPPY).items()}
    same(pack(tmp_path / "scan.x3p", {folder: b"", **members}), GAPPY)


def test_x3p_with_paths_of_windows(tmp_path: Path):
    members = edited(x3p_members(Z), "bindata/data.bin", r"bindata\\data.bin")
    same(pack(tmp_path / "scan.x3p", members))


@pytest.mark.parametrize("form", ["{}", "{};{};{}"])
def test_x3p_with_heights_in_the_xml(tmp_path: Path, form: str):
    """Each point as z, or x;y;z; a missing point as an empty entry."""
    data = "".join(
        "<Datum/>"
        if np.isnan(GAPPY[i, j])
        else f"<Datum>{form.format(*[repr(float(GAPPY[i, j]))] if form == '{}' else (i, j, repr(float(GAPPY[i, j]))))}</Datum>"  # noqa: E501
        for j in range(NY)
        for i in range(NX)
    )
    members = edited(x3p_members(Z), "<DataLink>.*</DataLink>", f"<DataList>{data}</DataList>")
    del members["bindata/data.bin"]
    same(pack(tmp_path / "scan.x3p", members), GAPPY)
    short = edited(members, "<Datum/>", "")
    with pytest.raises(InputError, match=r"heights in the XML, but its matrix has 108 points"):
        read_scan(pack(tmp_path / "scan.x3p", short))


@pytest.mark.parametrize(
    ("pattern", "new", "reason"),
    [
        ("ISO5436 - 2000", "ISO5436 - 1999", "Revision should be"),
        (">SUR<", ">PRF<", "FeatureType should be"),
        ("<SizeX>12", "<SizeX>100000", r"(100000 x 9 points|expected|bytes)"),
        (r"<SizeX>12</SizeX>\s*<SizeY>9", "<SizeX>100000</SizeX><SizeY>100000",
         r"states 100000 x 100000 points, but there are \d+ bytes in it"),
    ],
)  # fmt: skip
def test_the_reason_of_a_reader(tmp_path: Path, pattern: str, new: str, reason: str):
    """It is reported: a known format is not called unknown."""
    path = pack(tmp_path / "scan.x3p", edited(x3p_members(Z), pattern, new))
    with pytest.raises(InputError, match=reason) as refused:
        read_scan(path)
    assert "of no format" not in str(refused.value)


def write_tmd(path: Path, comment: bytes) -> Path:
    header = b"Binary TrueMap Data File v2.0\r\n\0" + comment
    header += struct.pack("<IIffff", NX, NY, 1e3 * SIZE[0], 1e3 * SIZE[1], 0.0, 0.0)
    path.write_bytes(header + (1e3 * GAPPY).T.astype("<f4").tobytes())
    return path


@pytest.mark.parametrize(
    "comment",
    [b"Created by TrueMap v6\r\n\0", b"\0", b"GelSight, a longer comment than usual\0", b""],
)
def test_comments_of_tmd(tmp_path: Path, comment: bytes):
    same(write_tmd(tmp_path / "scan.tmd", comment), GAPPY, 1e-14)


def test_missing_points_of_nms(tmp_path: Path):
    """The largest two-byte number is no height."""
    low, high = -0.2, 0.2
    raw = np.rint((1e6 * Z - low) / (high - low) * (2**16 - 2))
    raw[np.isnan(GAPPY)] = 2**16 - 1
    data = bytearray(3468)
    struct.pack_into("<dd", data, 16, low, high)
    struct.pack_into("<IIdd", data, 1368, NX, NY, 1e3 * STEP, 1e3 * STEP)
    (tmp_path / "scan.nms").write_bytes(bytes(data) + raw.T.astype("<u2").tobytes())
    same(tmp_path / "scan.nms", GAPPY, 1e-11)
    # without the suffix its format is unknown
    (tmp_path / "scan.bin").write_bytes(bytes(data) + raw.T.astype("<u2").tobytes())
    with pytest.raises(InputError, match="of no format"):
        read_scan(tmp_path / "scan.bin")


def write_gwy(path: Path, *units: str) -> Path:
    """Gwyddion file of one channel, with or without the units of its sizes and heights."""

    def item(name: str, kind: str, data: bytes) -> bytes:
        return name.encode() + b"\0" + kind.encode() + data

    def gwy_object(name: str, items: bytes) -> bytes:
        return name.encode() + b"\0" + struct.pack("<I", len(items)) + items

    field = item("xres", "i", struct.pack("<i", NX)) + item("yres", "i", struct.pack("<i", NY))
    field += item("xreal", "d", struct.pack("<d", SIZE[0]))
    field += item("yreal", "d", struct.pack("<d", SIZE[1]))
    for name, unit in zip(("si_unit_xy", "si_unit_z"), units, strict=False):
        field += item(
            name, "o", gwy_object("GwySIUnit", item("unitstr", "s", unit.encode() + b"\0"))
        )
    field += item("data", "D", struct.pack("<I", Z.size) + Z.T.astype("<f8").tobytes())
    items = item("/0/data", "o", gwy_object("GwyDataField", field))
    items += item("/0/data/title", "s", b"Topography\0")
    path.write_bytes(b"GWYP" + gwy_object("GwyContainer", items))
    return path


def test_gwyddion_without_units(tmp_path: Path):
    """The unit is requested, and the file is not called damaged."""
    assert same(write_gwy(tmp_path / "scan.gwy", "m", "m")) == ""
    for units in ((), ("", "")):
        path = write_gwy(tmp_path / "scan.gwy", *units)
        with pytest.raises(InputError, match=r"no unit of its size .* give .*lateral_unit"):
            read_scan(path)
        assert "names no unit" in same(path, lateral_unit="m")
        same(path, length_x=SIZE[0], length_y=SIZE[1])
    with pytest.raises(InputError, match="no such map of heights"):
        read_scan(write_gwy(tmp_path / "scan.gwy", "m", "V"), lateral_unit="m")
    path.write_bytes(path.read_bytes()[:200])
    with pytest.raises(InputError, match="as Gwyddion: "):
        read_scan(path)


SDF = """aISO-1.0
ManufacID = nobody
CreateDate = 040120100853
ModDate = 050320101353
NumPoints = {nx}
NumProfiles = {ny}
Xscale = {step}
Yscale = 1.5E-6
Zscale = 1.0E-6
Zresolution = 1.0E-9
Compression = 0
DataType = 7
CheckType = 0
*
{rows}
*
"""


@pytest.mark.parametrize("suffix", ["sdf", "txt", "dat"])
def test_texts_of_a_known_format(tmp_path: Path, suffix: str):
    """SDF is recognised by its content; errors in its header are refused."""
    rows = "\n".join(" ".join("BAD" if np.isnan(v) else f"{1e6 * v:.12f}" for v in GAPPY[:, j])
                     for j in range(NY))  # fmt: skip
    path = tmp_path / f"scan.{suffix}"
    path.write_text(SDF.format(nx=NX, ny=NY, step="1.5E-6", rows=rows))
    same(path, GAPPY)
    path.write_text(SDF.format(nx=65536, ny=65537, step="1.5E-6", rows=rows))
    with pytest.raises(InputError, match="as ISO 25178-71 SDF: End of stream after reading 10"):
        read_scan(path)
    path.write_text(SDF.format(nx=NX, ny=NY, step="0", rows=rows))
    with pytest.raises(InputError, match="its header gives length_x = 0: it is damaged"):
        read_scan(path)


def test_archive_named_npy(tmp_path: Path):
    np.savez(tmp_path / "scan.npz", heights=Z)
    (tmp_path / "scan.npz").rename(tmp_path / "scan.npy")
    with pytest.raises(InputError, match=r"it is a \.npz archive of arrays, named \.npy"):
        read_scan(tmp_path / "scan.npy", *SIZE)


KINDS = [(Z + 1j, "complex numbers"), (Z > 0.0, "truth values"), (Z.astype("U9"), "text"),
         (np.zeros(Z.shape, "M8[s]"), "dates"), (np.zeros(Z.shape, "m8[s]"), "spans of time"),
         (np.zeros(Z.shape, [("z", "f8")]), "records")]  # fmt: skip


@pytest.mark.parametrize(("array", "kind"), KINDS)
def test_arrays_without_real_numbers(tmp_path: Path, array: np.ndarray, kind: str):
    np.save(tmp_path / "scan.npy", array)
    with pytest.raises(InputError, match=f"heights must be real numbers, not {kind}"):
        read_scan(tmp_path / "scan.npy", *SIZE)


@pytest.mark.parametrize(("dtype", "mark"), [("i2", -32768), ("u2", 65535), ("f4", -9999.0),
                                             ("f8", np.inf), ("i4", 2147483647)])  # fmt: skip
def test_marks_of_missing_points_in_arrays(tmp_path: Path, dtype: str, mark: float):
    """Numbers that mark missing points; in an array with an offset the same are heights."""
    raw = np.rint(1e9 * Z).astype(float) + (300.0 if dtype == "u2" else 0.0)
    raw[np.isnan(GAPPY)] = mark
    np.save(tmp_path / "scan.npy", raw.astype(dtype))
    scan = read_scan(tmp_path / "scan.npy", *SIZE, height_unit="nm")
    assert np.array_equal(np.isnan(scan.heights), np.isnan(GAPPY))
    assert "missing points" in scan.note
    np.save(tmp_path / "scan.npy", (np.rint(1e9 * Z) + 32750.0).astype("u2"))
    scan = read_scan(tmp_path / "scan.npy", *SIZE, height_unit="nm")
    assert np.isfinite(scan.heights).all()


def test_readers_change_nothing_of_the_process(tmp_path: Path, capfd):
    """Output of another thread while files are read goes to the right stream."""
    (tmp_path / "scan.tif").write_bytes(b"II*\0" + bytes(range(250)) * 2)
    done = threading.Event()

    def read() -> None:
        for _ in range(40):
            with pytest.raises(InputError):
                read_scan(tmp_path / "scan.tif")
        done.set()

    thread = threading.Thread(target=read)
    thread.start()
    count = 0
    while not done.is_set():
        print("line")
        count += 1
    thread.join()
    reported = capfd.readouterr()
    assert reported.out.count("line\n") == count
    assert reported.err == ""


GROUP = {"kind": "map", "length_x": SIZE[0], "length_y": SIZE[1]}


def test_missing_points_of_masked_arrays():
    """Masked values are no heights: the points are interpolated, as missing ones of a file are."""
    mask = np.isnan(GAPPY)
    spiky = np.ma.masked_array(np.where(mask, 1e-3, Z), mask)
    tile = in_memory(spiky, GROUP)
    assert np.abs(tile.heights).max() < 4 * Z.std()
    assert f"{mask.sum()} missing points interpolated" in tile.origin
    other = in_memory(GAPPY, GROUP)
    assert other.heights == pytest.approx(tile.heights, abs=1e-20)
    # the other points, less their mean, are unchanged
    shift = Z[~mask] - tile.heights[~mask]
    assert shift == pytest.approx(shift.mean(), abs=1e-18)
    for group in (GROUP | {"fill": "none"}, {"kind": "smooth"}):
        with pytest.raises(InputError, match=r"heights are missing \(nan or masked\)"):
            in_memory(spiky, group)
    half = np.ma.masked_array(Z, np.arange(Z.size).reshape(Z.shape) % 2 == 0)
    with pytest.raises(InputError, match=r"54 of 108 heights are missing \(50\.0 %\)"):
        in_memory(half, GROUP)


@pytest.mark.parametrize(("array", "kind"), KINDS)
def test_arrays_in_memory_without_real_numbers(array: np.ndarray, kind: str):
    for call in (lambda: in_memory(array, GROUP), lambda: Tile(array, SIZE)):
        with pytest.raises(InputError, match=f"heights must be real numbers, not {kind}"):
            call()
    assert in_memory(Z.astype("f4"), GROUP).shape == Z.shape
    assert in_memory(Z.tolist(), GROUP).shape == Z.shape
    for members in (Z.astype(object), Z.astype("f2").astype(object)):
        assert in_memory(members, GROUP).shape == Z.shape
    with pytest.raises(InputError, match="a matrix of numbers"):
        in_memory(np.where(Z > 0, Z, None), GROUP)


def test_array_without_heights(tmp_path: Path) -> None:
    np.save(tmp_path / "empty.npy", np.zeros((0, 4)))
    with pytest.raises(InputError, match=r"must be a matrix \(nx, ny\), not of shape \(0, 4\)"):
        read_scan(tmp_path / "empty.npy")
