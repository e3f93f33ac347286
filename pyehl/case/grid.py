# SPDX-License-Identifier: BSD-3-Clause
"""The grid of a case: border and domain derived from the contact, nodes that can be coarsened."""

from pyehl.case import duty, physics
from pyehl.case.key import short, to_text
from pyehl.case.settings import Draft

# Minimum distance of the sides of the domain from the centre, over that of the edge of the contact
BEYOND_CONTACT = 1.05
# Minimum and maximum intervals per side of the coarsest grid, as in fortran/grid/grid.f90
MIN_COARSEST, MAX_COARSEST = 16, 32
ENDS = ("x_inlet", "x_outlet", "y_extent")


def complete(draft: Draft) -> None:
    """Derive border, domain and nodes from the operating point, unless they are given."""
    g = draft.settings.grid
    find_points = not draft.is_given("grid", "points") and g.target_error <= 0.0
    ends = [getattr(g, end) if draft.is_given("grid", end) else None for end in ENDS]
    border = g.border if draft.is_given("grid", "border") else ""
    inlet = draft.settings.inlet
    if ends[0] is None and inlet.position_hertz > 0.0:
        ends[0] = -inlet.position_hertz
    # the flooded pressure at the border is not known under a duty, where it changes with time
    if draft.settings.duty.time or inlet.is_starved:
        border = border or "zero"
    result = physics.grid_defaults(
        draft.settings,
        border,
        ends,
        0 if find_points else g.points,
        g.points_y,
        duty.widening(draft.settings),
        duty.reverses(draft.settings),
    )
    g.border, g.x_inlet, g.x_outlet, g.y_extent, g.points, g.points_y = result


def check_extent(draft: Draft) -> None:
    """Refuse a domain that does not contain the contact."""
    g, angle = draft.settings.grid, draft.settings.contact.angle
    if g.border == "flooded" and angle != 0.0 and draft.settings.contact.radius_ratio != 1.0:
        what = f"grid.border = 'flooded' with contact.angle = {to_text(angle)}"
        expected = "'zero': the pressure far from a rotated contact is not known"
        draft.refuse("grid.border", what, expected)
    point = physics.point(draft.settings)
    # a line has no sides, and those of a roller are its ends
    reach_y = 0.0 if draft.settings.contact.is_cylinder else point.reach_y
    reaches = (point.reach_x, point.reach_x, reach_y)
    for end, value, reach in zip(ENDS, (-g.x_inlet, g.x_outlet, g.y_extent), reaches, strict=True):
        if value < BEYOND_CONTACT * reach:
            what = (
                f"grid.{end} is {short(value)} a from the centre, and the contact reaches to "
                f"{short(reach)} a"
            )
            draft.refuse(f"grid.{end}", what, f"at least {short(BEYOND_CONTACT * reach)} a")


def check_points(draft: Draft) -> None:
    """Refuse a number of nodes that cannot be coarsened to a coarsest grid."""
    points = draft.settings.grid.points
    if _coarsest(points, points):
        if not draft.settings.contact.is_line:
            _check_rows(draft)
        return
    below = above = points
    while below > 17 and not _coarsest(below, below):
        below -= 1
    while not _coarsest(above, above):
        above += 1
    why = "too few grids can be made by halving" if points % 2 else "an even number of points"
    expected = (
        f"an odd number with points - 1 halved down to an even number of {MAX_COARSEST} or less; "
        f"the nearest are {below} and {above}"
    )
    draft.refuse("grid.points", f"grid.points = {points}: {why}", expected)


def _check_rows(draft: Draft) -> None:
    nx, ny = draft.settings.grid.points, draft.settings.grid.points_y
    draft.check_range("grid.points_y", ny, "grid.y_extent", "domain and grid.points")
    step = 2 * ((nx - 1) // _coarsest(nx, nx))
    if (ny - 1) % step == 0 and _coarsest(nx, ny):
        return
    below = max(4 * step, ((ny - 1) // step) * step)
    what = f"grid.points_y = {ny} with {nx} nodes along X"
    expected = (
        f"points_y - 1 in multiples of {step}: the nearest are {below + 1} and {below + step + 1}"
    )
    draft.refuse("grid.points_y", what, expected)


def _coarsest(nx: int, ny: int) -> int:
    """Intervals along X of the coarsest grid after halving; 0 if there is none."""
    x, y = nx - 1, ny - 1
    while x % 4 == y % 4 == 0 and min(x, y) >= 2 * MIN_COARSEST:
        x, y = x // 2, y // 2
    return 0 if min(x, y) > MAX_COARSEST or x % 2 or y % 2 or min(nx, ny) < 3 else x
