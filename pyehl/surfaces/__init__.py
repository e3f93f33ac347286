# SPDX-License-Identifier: BSD-3-Clause
"""Rough surfaces: generators, height maps, spectra, exact shifts.

A surface is a periodic tile of heights z [m], array (nx, ny), first index along x (the rolling
direction); peaks are positive and reduce the film. Pixel [i, j] lies at x = i length_x/nx,
y = j length_y/ny. Spectra are those of Jacobs, Junge & Pastewka 2017, in m^4.
"""

# ruff: noqa: F401 (names for the rest of the package)
from pyehl.surfaces.from_case import (
    GROUPS,
    finished,
    from_settings,
    harmonic_amplitude,
    moved,
    one_rough,
    rough_groups,
    tile_of,
    track_offsets,
    without_spikes,
)
from pyehl.surfaces.prepare import Preparation, prepare
from pyehl.surfaces.reading import Scan, read_scan
from pyehl.surfaces.solver_surface import (
    SolverSurface,
    Surface,
    as_map,
    for_solver,
    gather,
    given,
    in_memory,
    part_of,
    with_surface,
    write_beside,
)
from pyehl.surfaces.tile import (
    FEATURES,
    MAX_PIXELS,
    Topography,
    filtered,
    fractal,
    harmonic,
    interpolated,
    psd_2d,
    psd_isotropic,
    resampled,
    shifted,
    wavenumbers,
)
from pyehl.surfaces.working_map import Options, Record
