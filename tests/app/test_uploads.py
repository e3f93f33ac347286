# SPDX-License-Identifier: BSD-3-Clause
"""Uploaded height maps: read, refused, removed; no other file of the machine can be named."""

from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl.app import words
from pyehl.app.position import from_case
from pyehl.app.uploads import Uploads
from pyehl.case import Case
from pyehl.errors import InputError


def test_refused_uploads_show_the_message_of_the_reader(tmp_path):
    uploads = Uploads()
    heights = tmp_path / "ground.npy"
    np.save(heights, 1e-8 * np.random.default_rng(1).normal(size=(32, 32)))
    with pytest.raises(InputError) as refused:
        uploads.add("ground.npy", heights.read_bytes())
    with pytest.raises(pyehl.InputError) as theirs:
        pyehl.surfaces.read_scan(heights)
    assert str(refused.value) == str(theirs.value).replace(f"{tmp_path}/", "")
    size = {"length_x": 1e-4, "length_y": 1e-4}
    path = uploads.add("../../ground.npy", heights.read_bytes(), size)
    assert Path(path).name == "ground.npy"
    assert uploads.without_folders(f"in {path}") == "in ground.npy"
    with pytest.raises(InputError, match=r"bad\.npy"):
        uploads.add("bad.npy", b"\x93NUMPY nonsense", size)
    # a bad file does not replace the good one of the same name
    with pytest.raises(InputError, match=r"^ground\.npy"):
        uploads.add("ground.npy", b"\x93NUMPY nonsense", size)
    assert Path(path).read_bytes() == heights.read_bytes()
    assert sorted(uploads.files) == ["ground.npy"]
    assert [p.name for p in Path(path).parents[1].rglob("*.npy")] == ["ground.npy"]
    uploads.close()
    assert not Path(path).exists()


def test_upload_is_read_as_its_case_states(tmp_path):
    """Text in nanometres is read as the case states, not as metres."""
    uploads = Uploads()
    text = (
        "&surface kind = 'map' file = 'm.txt' length_x = 1e-4 length_y = 2e-4 height_unit = 'nm' /"
    )
    np.savetxt(tmp_path / "m.txt", np.random.default_rng(1).normal(size=(16, 16)))
    data = (tmp_path / "m.txt").read_bytes()
    stated = {"length_x": 1e-4, "length_y": 1e-4, "height_unit": "nm"}
    uploads.add("m.txt", data, stated)
    position, _ = from_case(
        Case.from_text(text.replace("m.txt", uploads.files["m.txt"])), uploads.files
    )
    assert position.map_message() == {"length_x": 1e-4, "length_y": 2e-4, "height_unit": "nm"}
    uploads.check(position.file, position.map_message())
    uploads.close()


def test_case_may_not_name_a_file_of_the_machine(tmp_path):
    np.save(tmp_path / "secret.npy", np.zeros((8, 8)))
    text = f"&surface kind = 'map' file = '{tmp_path}/secret.npy' length_x = 1e-4 length_y = 1e-4 /"
    with pytest.raises(InputError, match=r"'secret\.npy': expected an upload"):
        from_case(Case.from_text(text), {})
    position, _ = from_case(Case.from_text(text))
    assert str(tmp_path) not in position.text(65)
    assert str(tmp_path) not in words.python_lines(position, 65)
