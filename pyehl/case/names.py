# SPDX-License-Identifier: BSD-3-Clause
"""Messages for unknown names of keys and groups."""

from collections.abc import Iterable

from pyehl.case.settings import GROUPS, KEYS, MACHINES

BODIES = (
    "E and nu of each body are keys of &bodies (modulus_1, poisson_1, modulus_2, poisson_2); "
    "contact.reduced_modulus is E' with 2/E' = sum of (1 - nu^2)/E"
)
EFFECTIVE = (
    "contact.reduced_modulus is E' with 2/E' = sum of (1 - nu^2)/E, twice the modulus E* of 1/E* = "
    "sum of (1 - nu^2)/E"
)
PRESSURE = (
    "a pressure is no input: the Hertz pressure follows from load, radius and reduced_modulus of "
    "&contact, and 'pyehl film' prints it"
)
SPEEDS = (
    "speeds are contact.mean_velocity = (u1 + u2)/2 and contact.slide_to_roll = (u1 - "
    "u2)/mean_velocity"
)
LINES = (
    "a line has contact.shape = 'line' and contact.load_per_length [N/m], a roller contact.shape = "
    "'roller', contact.load [N] and contact.length [m]"
)
SPIN = (
    "spin is not modelled: both bodies move along x, with contact.mean_velocity and "
    "contact.slide_to_roll"
)
STARVED = (
    "a starved inlet has inlet.position [m], where the oil begins, or inlet.film [m], "
    "the layer that arrives"
)
WEAR = "wear is not modelled: surfaces keep their heights"
HARDNESS = (
    "contact.hardness [Pa] limits the pressure of the solids, with lubricant.boundary_film; "
    "without it they stay elastic, and the assessment of a result names pressures above 4.2 GPa"
)
# Common names of quantities that have another key or are not modelled, and their group ('': any)
OTHER_NAMES: dict[tuple[str, str], str] = {
    (group, name): sentence
    for names, group, sentence in (
        (
            "e e1 e2 e_1 e_2 modulus elastic_modulus young youngs_modulus youngs_modulus_1 "
            "youngs_modulus_2 nu nu1 nu2 nu_1 nu_2 poisson poissons_ratio poisson_ratio",
            "",
            BODIES,
        ),
        ("e_star effective_modulus equivalent_modulus", "", EFFECTIVE),
        ("hertz_pressure max_pressure maximum_pressure pressure p_h p_max", "", PRESSURE),
        (
            "speed speed1 speed2 speed_1 speed_2 u1 u2 u_1 u_2 velocity velocity_1 velocity_2 "
            "entrainment_speed rolling_speed sliding_speed srr",
            "contact",
            SPEEDS,
        ),
        ("line_load load_per_length", "", LINES),
        ("spin spin_ratio spin_velocity", "", SPIN),
        ("starved starvation", "", STARVED),
        ("wear wear_rate wear_coefficient", "", WEAR),
        ("plasticity plastic hardness yield_stress yield_strength", "", HARDNESS),
    )
    for name in names.split()
}


def unknown_key(name: str, group: str) -> str:
    """Suggest what to write in place of an unknown key of a group."""
    lower = name.lower()
    sentence = OTHER_NAMES.get((group, lower)) or OTHER_NAMES.get(("", lower))
    if sentence:
        return sentence
    names = [key.key for key in GROUPS[group] if key.for_input]
    owner = next((key.group for key in KEYS.values() if key.key == lower), "")
    hint = f"; '{lower}' belongs to &{owner}" if owner else did_you_mean(name, names)
    return f"one of the keys {', '.join(names)}{hint}"


def unknown_group(name: str, prefix: str = "") -> str:
    """Suggest what to write in place of an unknown group."""
    sentence = OTHER_NAMES.get(("", name.lower()))
    if sentence:
        return sentence
    return f"one of the groups {groups(prefix)}{did_you_mean(name, GROUPS, prefix)}"


def groups(prefix: str) -> str:
    """List the groups of a contact, each with a prefix."""
    return ", ".join(prefix + group for group in GROUPS if group not in MACHINES)


def did_you_mean(name: str, names: Iterable[str], prefix: str = "") -> str:
    """Give the end of a message, '; did you mean ...?', or '' if no name is near."""
    near = nearest(name, names)
    return f"; did you mean '{prefix}{near}'?" if near else ""


def nearest(name: str, names: Iterable[str]) -> str:
    """Give the known word with the fewest edits from a name; '' if none is near.

    A beginning of a word counts as near: 'visc' for 'viscosity'.
    """
    name = name.lower().rstrip()
    best, answer = max(2, len(name) // 2) + 1, ""
    for known in names:
        starts = len(name) >= 3 and known.startswith(name)
        distance = 1 if starts else edits(name, known)
        if distance < best:
            best, answer = distance, known
    return answer


def edits(a: str, b: str) -> int:
    """Count insertions, deletions, substitutions and swaps of neighbours (Damerau, restricted)."""
    before: list[int] = []
    row = list(range(len(b) + 1))
    for i, x in enumerate(a, 1):
        last, before, row = before, row, [i]
        for j, y in enumerate(b, 1):
            cost = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (x != y))
            if last and j > 1 and x == b[j - 2] and a[i - 2] == y:
                cost = min(cost, last[j - 2] + 1)
            row.append(cost)
    return row[-1]
