# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl bench``: what is skipped, stress, faults, work and precision, on tiny campaigns."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from pyehl.bench import skips
from pyehl.cli import main


def test_skips_change_nothing(tmp_path: Path, capsys, monkeypatch):
    """Rows on small grids; the exit status says that nothing differs."""
    monkeypatch.setattr(skips, "LEAST", 65)
    point = ("contact.moes_m=100.0", "contact.moes_l=6.0", "surface.velocity_ratio=1.01")
    wave = (*point, "surface.kind=harmonic", "surface.amplitude_over_film=0.2")
    monkeypatch.setattr(skips, "WAVE", wave)
    words = ["bench", "skips", "--scenes", "wave,predict", "--points", "65"]
    assert main([*words, "-o", str(tmp_path / "skips.json")]) == 0
    assert "symmetric in Y" in capsys.readouterr().out
    rows = json.loads((tmp_path / "skips.json").read_text())["rows"]
    assert [row["quantity"] for row in rows] == ["mu_ratio"] * 3 + ["F", "mu_ratio"]
    for row in rows:
        assert row["difference"] <= row["allowed"] < 0.05
        assert row["seconds"] > 0.0
    # the kept contact and the one smooth solution give the same bits
    assert [row["difference"] for row in rows[3:]] == [0.0, 0.0]


def test_skips_that_change_something_are_told(monkeypatch, capsys):
    row = dict.fromkeys((name for name, _ in skips.COLUMNS), 0.0)
    row |= {"scene": "s", "skipped": "w", "quantity": "q", "same": False}
    monkeypatch.setattr(skips, "SCENES", {"predict": lambda points, repeats: [row]})
    assert main(["bench", "skips", "--scenes", "predict"]) == 1
    assert main(["bench", "skips", "--scenes", "perdict"]) == 2
    assert "perdict" in capsys.readouterr().err


@pytest.mark.parametrize("scene", ["smooth", pytest.param("sweep", marks=pytest.mark.slow)])
def test_skips_of_other_scenes(scene: str):
    rows = skips.skip_rows([scene], 257, repeats=1)
    assert len(rows) >= 2
    assert all(row["same"] for row in rows)
