# SPDX-License-Identifier: BSD-3-Clause
"""Keys of a line contact that replace those of a point contact, and keys that it does not have."""

from pyehl.case.settings import Draft

SHAPE = "contact.shape = 'line'"
LINE_KEYS = ("load_per_length", "moes_m_line", "moes_l_line")
MOES_DIFFER = "M and L of a line are defined differently from those of a point"
STRIP = "the strip is one period of the surfaces wide, its cells are nearly square"
# Keys of a point contact, and what to give in their place
POINT_KEYS = {
    "contact.load": "contact.load_per_length [N/m]",
    "contact.moes_m": f"contact.moes_m_line: {MOES_DIFFER}",
    "contact.moes_l": f"contact.moes_l_line: {MOES_DIFFER}",
    "contact.radius_x": "contact.radius: a line is not curved across the motion",
    "contact.radius_y": "contact.radius alone: a line is not curved across the motion",
    "contact.radius_ratio": "contact.radius alone: a line is not curved across the motion",
    "contact.angle": "none: a line is perpendicular to the motion",
    "bodies.radius_y1": "radii along the motion alone: a line is not curved across it",
    "bodies.radius_y2": "radii along the motion alone: a line is not curved across it",
    "grid.y_extent": f"none: {STRIP}",
    "grid.points_y": f"none: {STRIP}",
}
TRANSVERSE = 1e6
"""Wavelength across the motion of a wave that does not vary in that direction [b]."""


def complete(draft: Draft) -> None:
    """Set the engine of the deflection, unless it is given."""
    if draft.settings.contact.is_line and not draft.is_given("solver", "deflection"):
        draft.settings.solver.deflection = "fft"


def check_keys(draft: Draft) -> None:
    """Refuse keys of a point with a line, keys of a line with a point, and unsupported options.

    `pyehl.case.roller.check_keys` refuses the keys that a roller does not have.
    """
    s = draft.settings
    if s.contact.is_roller:
        return
    if not s.contact.is_line:
        name = draft.first_given(f"contact.{key}" for key in LINE_KEYS)
        if name:
            point = name.removesuffix("_line").replace("_per_length", "")
            expected = f"{SHAPE}, or {point} of a point: {MOES_DIFFER}"
            draft.refuse(name, f"{name} in a point contact", expected)
        return
    for name, expected in POINT_KEYS.items():
        # a flat body has the radius 0
        flat = name.startswith("bodies.") and getattr(s.bodies, name[7:]) == 0.0
        if name in draft.given and not flat:
            draft.refuse(name, f"{name} with {SHAPE}", expected)
    if draft.is_given("solver", "deflection") and s.solver.deflection != "fft":
        what = f"solver.deflection = 'mlmi' with {SHAPE}"
        draft.refuse(
            "solver.deflection",
            what,
            "'fft': multi-integration is not available for a periodic strip",
        )
    if s.lubricant.thermal_friction == "always" and abs(s.contact.slide_to_roll) >= 2.0:
        what = (
            "lubricant.thermal_friction = 'always' with a wall at rest under an infinite line, "
            "whose temperature has no limit"
        )
        expected = "'auto' or 'never', or a slide_to_roll between -2 and 2"
        draft.refuse("lubricant.thermal_friction", what, expected)
