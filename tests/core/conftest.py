# SPDX-License-Identifier: BSD-3-Clause
"""Case files that several tests use."""

from pathlib import Path

import pytest

SMOOTH = (
    "&contact moes_m = 100.0 moes_l = 5.0 /\n"
    "&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
)
FRACTAL = (
    "&contact load = 20.0 /\n&grid points = 65 /\n&surface kind = 'fractal' pixels = 32 "
    "length_x = 1e-4 length_y = 1e-4 rms_height = 2e-8 /\n"
    "&time steps = 3 estimate_error = .false. /\n"
)


@pytest.fixture
def smooth(tmp_path: Path) -> Path:
    path = tmp_path / "smooth.nml"
    path.write_text(SMOOTH)
    return path


@pytest.fixture
def fractal(tmp_path: Path) -> Path:
    path = tmp_path / "fractal.nml"
    path.write_text(FRACTAL)
    return path
