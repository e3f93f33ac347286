# SPDX-License-Identifier: BSD-3-Clause
"""The layer near the surface, where roughness decides over the stress."""

from __future__ import annotations

from pyehl.prediction.friction import RISE
from pyehl.subsurface.passage import INNER, Profile, Row, in_layer, largest, share_above

# Depth down to which the layer reaches, over that of the largest smooth shear
NEAR = 0.25
CHANGE_INNER, CHANGE_OUTER = RISE, 1.0
"""Error of a predicted change of the near-surface shear by the roughness, over that change: within
`INNER` that of the largest rise of pressure; outside, where the roughness moves the edge of the
contact and the linear response does not, all of it (docs/evidence/subsurface)."""

Scalar = tuple[str, float, str, str]


def near_surface(
    found: Profile, depth: float | None, above: float | None, *, predicted: bool
) -> list[Scalar]:
    """Largest shear in the layer, and the share of its volume above the one asked for.

    Parameters
    ----------
    found
        Stress over depth [p_h].
    depth
        Of the layer [a]; None: `NEAR` times the depth of the largest smooth shear.
    above
        Whether a share was asked for, the shear of which `Row.above` is the share.
    predicted
        Whether the rough contact is predicted: then with errors.

    Returns
    -------
    list
        Name, value in Hertz units, unit in SI, meaning.
    """
    depth = depth or NEAR * largest(found.smooth)[1]
    scalars: list[Scalar] = [
        ("near_surface_depth", depth, "m", "depth of the near-surface layer"),
    ]
    pairs = [(found.rows, "", ""), (found.smooth, "_smooth", " of the smooth contact")]
    for rows, end, of in pairs if found.rough else pairs[:1]:
        inner, outer = (in_layer(rows, name, depth) for name in ("inner", "outer"))
        meaning = f"largest principal shear in the near-surface layer{of}"
        scalars += [
            (f"near_surface_shear{end}", max(inner, outer), "Pa", meaning),
            (
                f"near_surface_shear_inner{end}",
                inner,
                "Pa",
                f"{meaning}, within {INNER:g} semi-axes of the centre",
            ),
        ]
        if above is not None:
            meaning = f"share of the layer where the shear exceeds {above:g} Pa at some time{of}"
            share = share_above(rows, depth)
            scalars.append((f"near_surface_share{end}", share, "1", meaning))
    if found.rough and predicted:
        names = "near_surface_shear_error", "near_surface_shear_inner_error"
        for name, error in zip(names, _errors(found, depth), strict=True):
            scalars.append((name, error, "Pa", "estimate of its error"))
    return scalars


def _errors(found: Profile, depth: float) -> tuple[float, float]:
    """Errors of the predicted shear in the layer [p_h]: of the largest one, and within `INNER`."""
    reached = {}
    for name, share in (("inner", CHANGE_INNER), ("outer", CHANGE_OUTER)):
        pairs = zip(found.rough, found.smooth, strict=True)
        peaks = [(r.depth, getattr(r, name).value, getattr(s, name).value) for r, s in pairs]
        rows = [Row(z) for z, *_ in peaks]
        for row, (_, rough, smooth) in zip(rows, peaks, strict=True):
            row.shear.value = rough + share * abs(rough - smooth)
        reached[name] = in_layer(rows, "shear", depth)
    inner, outer = (in_layer(found.rough, name, depth) for name in ("inner", "outer"))
    error = reached["inner"] - inner
    return max(max(reached.values()) - max(inner, outer), error), error
