# SPDX-License-Identifier: BSD-3-Clause
"""Films of starved inlets over those of flooded ones, by closed formulas."""

from pyehl.theory.film import FilmEstimate, outside

EXPONENTS = (2.0, 5.0)
"""Minimum and maximum exponent gamma of `layer_reduction` (Chevalier et al. 1998)."""
EXPONENT = 3.0
"""Exponent used, from converged solutions (docs/evidence/starvation)."""
# The formula was fitted at an ellipticity of 6
HAMROCK_DOWSON_RANGE = {"ellipticity": (6.0, 6.0)}


def position_reduction(position: float, film: float, constants: tuple[float, ...]) -> float:
    """Film over the flooded one for a meniscus m = `position` [a] ahead of the centre.

    `film` is the flooded one [a^2/R]. ((m - 1)/(m* - 1))^c with m* = 1 + a film^b, 1 for m >= m*
    (Hamrock & Dowson 1977, part IV, J. Lubr. Technol. 99, 15-23); `constants` are a, b and c.
    """
    factor, power, exponent = constants
    needed = factor * film**power
    return min(1.0, max(position - 1.0, 0.0) / needed) ** exponent


CENTRAL, MINIMUM = (3.06, 0.58, 0.29), (3.34, 0.56, 0.25)
"""Constants for the central and the minimum film."""


def layer_reduction(ratio: float, exponent: float = EXPONENT) -> float:
    """h_c over the flooded one for `ratio` r = h_oil/(rho(p_h) h_flooded), h_oil the inlet layer.

    r/(1 + r^gamma)^(1/gamma), gamma = `exponent`: Chevalier, Lubrecht, Cann, Colin & Dalmaz 1998,
    J. Tribol. 120, 126-133.
    """
    return float((1.0 + ratio**-exponent) ** (-1.0 / exponent))


def estimate(
    position: float,
    layer: float,
    flooded: tuple[float, float],
    scale: float,
    density: float,
    ellipticity: float,
) -> FilmEstimate | None:
    """Return the films [m] of a starved inlet, None of a flooded one.

    Either `position` [a] or `layer` [a^2/R] is given, the other is 0; `flooded` films h_c and h_min
    [m], NaN where not known; `scale` a^2/R [m]; `density` at the Hertz pressure over that at
    ambient pressure [-]; `ellipticity` of the contact [-].
    """
    h_c, h_min = flooded
    if position > 0.0:
        return FilmEstimate(
            name="starved: Hamrock-Dowson IV",
            source="J. Lubr. Technol. 99 (1977) 15, of the flooded films above",
            regime="",
            h_c=h_c * position_reduction(position, h_c / scale, CENTRAL),
            h_min=h_min * position_reduction(position, h_min / scale, MINIMUM),
            applies=True,
            bounds=HAMROCK_DOWSON_RANGE,
            outside=outside({"ellipticity": ellipticity}, HAMROCK_DOWSON_RANGE),
            note="of the flooded films above",
        )
    if layer > 0.0:
        ratio = layer * scale / (density * h_c)
        low, high = (layer_reduction(ratio, exponent) for exponent in EXPONENTS)
        return FilmEstimate(
            name="starved: Chevalier et al.",
            source="J. Tribol. 120 (1998) 126, of the flooded film above",
            regime="",
            h_c=h_c * layer_reduction(ratio),
            h_min=float("nan"),
            applies=True,
            bounds={},
            outside=(),
            note=f"with r = {ratio:.3g} and gamma = {EXPONENT:g}; {low:.3g} to {high:.3g} of the "
            "flooded film with gamma from 2 to 5",
        )
    return None


def line_estimate(layer: float, flooded: float) -> FilmEstimate:
    """Return the film [m] of a line: all the oil that arrives, up to the flooded film.

    `layer` [m] is the thickness of the oil at its density in the contact.
    """
    return FilmEstimate(
        name="starved: all oil that arrives",
        source="conservation of mass",
        regime="",
        h_c=min(layer, flooded),
        h_min=float("nan"),
        applies=True,
        bounds={},
        outside=(),
        note="nothing flows around a line: the layer over its density, or the flooded film",
    )
