# SPDX-License-Identifier: BSD-3-Clause
"""Very thick films: the stated error is that of grid and border."""

import pytest

import pyehl
from pyehl.conclusion import conclude


# H_c in the limit of fine grids, from 257 and 513 nodes
@pytest.mark.parametrize(("moes_m", "limit"), [(0.05, 79793.0), (0.3, 671.25), (1.0, 27.093)])
@pytest.mark.parametrize("points", [33, 65, 129])
def test_error_covers_and_is_not_too_large(moes_m: float, limit: float, points: int):
    settings = {"contact.moes_m": moes_m, "contact.moes_l": 0.0, "grid.points": points}
    with pyehl.Solver(pyehl.Case.from_text("", settings)) as solver:
        assert solver.run()
        result = solver.summary
        lines = conclude(result).lines
    miss = abs(result["H_c"] - limit)
    # the domain has an error, for the film on an endless one
    assert miss <= result["H_c_error_grid"] * 1.05
    assert result["H_c_error_grid"] <= 3.0 * miss
    assert result["H_c_error"] <= 0.1 * limit
    # three grids and a value with few digits
    assert (result["P_max_error"] is not None) == (points == 129)
    shown = lines["p_max"].split()[0]
    assert float(shown) == pytest.approx(result["P_max"], rel=0.005)
