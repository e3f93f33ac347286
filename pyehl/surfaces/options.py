# SPDX-License-Identifier: BSD-3-Clause
"""What to do with a map, and what 'auto' means."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Self

from pyehl.case.surface_group import Surface as Keys
from pyehl.surfaces.reading import Scan


@dataclass(frozen=True, slots=True)
class Options:
    """What to do with a map; each attribute is a key of ``&surface``."""

    detrend: str = "auto"  # ``"none"``, ``"centre"``, ``"tilt"``, ``"curvature"`` or ``"auto"``
    fill: str = "harmonic"  # ``"harmonic"`` or ``"none"``, which refuses maps with missing points
    # Threshold, see :func:`pyehl.surfaces.defects.prominence`; 0: none are removed
    outliers: float = 0.0
    # ``"x"`` or ``"y"``: lines along it are put level with each other; ``"none"``
    align_lines: str = "none"
    edges: str = "auto"  # ``"mirror"``, ``"window"``, ``"periodic"`` or ``"auto"``
    # (x_min, x_max, y_min, y_max) [m], a maximum of 0 being the far edge
    crop: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    rotate: float = 0.0  # counter-clockwise [degrees]
    sign: int = 1  # 1, or -1 for a map whose valleys are positive

    @classmethod
    def from_settings(cls, surface: Mapping[str, Any]) -> Self:
        """Options of the group ``surface`` of a resolved case; absent keys have their defaults."""
        s = Keys.of(surface)
        crop = s.crop_x_min, s.crop_x_max, s.crop_y_min, s.crop_y_max
        return cls(s.detrend, s.fill, s.outliers, s.align_lines, s.edges, crop, s.rotate, s.sign)


NEUTRAL = Options()
"""With these an array passes through as it is, its mean removed."""


def defaults(options: Options, scan: Scan) -> tuple[Options, dict[str, str]]:
    """Options without 'auto', and the reason for each word.

    A file of an instrument is a map of a part: it lies at an angle that is the stage's and not
    the surface's, and its edges do not match. An array is taken at its word, as is a file that
    says that it is periodic: nothing is taken off, and it is repeated. A part of an array, or an
    array that was turned, is no longer periodic.
    """
    why = {"detrend": "given", "edges": "given"}
    tile = scan.is_array or scan.is_periodic
    what = "an array is taken at its word" if scan.is_array else "the file says it is periodic"
    if options.detrend == "auto":
        options = replace(options, detrend="none" if tile else "tilt")
        why["detrend"] = what if tile else "the tilt of a scan is that of the stage"
    if options.edges == "auto":
        quarter = abs(options.rotate / 90.0 - round(options.rotate / 90.0)) < 1e-9
        whole = not any(options.crop) and quarter
        options = replace(options, edges="periodic" if tile and whole else "mirror")
        why["edges"] = what if tile and whole else "opposite edges of a scan do not match"
        if tile and not whole:
            why["edges"] = "a part of a tile is not periodic"
    return options, why
