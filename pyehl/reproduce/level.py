# SPDX-License-Identifier: BSD-3-Clause
"""How much is computed: ``--quick`` or ``--full``."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Level:
    """How much of the paper is computed."""

    name: str  # of the level
    # Nodes per side of Fig. 2, the coarsest first; the last is compared with the paper
    wave_grids: tuple[int, ...]
    collapse_grid: int  # nodes per side of the waves of Figs 3 and 4
    film_grid: int  # nodes per side of the smooth contacts whose film amplitudes are a share of
    surface_grid: int  # nodes per side of the surfaces of Figs 6 and 7
    meshes: tuple[int, ...]  # nodes per side of Table 2
    surfaces: int  # number of surfaces of Fig. 7
    leaves_out: str  # what the level leaves out, in words


QUICK = Level(
    "quick",
    wave_grids=(257, 513),
    collapse_grid=257,
    film_grid=513,
    surface_grid=257,
    meshes=(129, 257),
    surfaces=4,
    leaves_out=(
        "the waves of Figs 3 and 4 are on 257 x 257 nodes in place of 513 x 513; Fig. 6 and Fig. 7 "
        "are on 257 x 257, Fig. 7 has 4 surfaces of 20; Table 2 ends at 257 x 257"
    ),
)
FULL = Level(
    "full",
    wave_grids=(257, 513),
    collapse_grid=513,
    film_grid=513,
    surface_grid=513,
    meshes=(257, 513, 1025),
    surfaces=20,
    leaves_out=(
        "nothing of the paper; what it does not give is left out: Fig. 7 beyond 513 x 513 nodes, "
        "and error estimates by runs on coarser grids, but for Fig. 2 and Table 2"
    ),
)
LEVELS = {level.name: level for level in (QUICK, FULL)}
