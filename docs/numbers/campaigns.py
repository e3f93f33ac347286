# SPDX-License-Identifier: BSD-3-Clause
"""Outcomes of random cases and of random machine contacts."""

from __future__ import annotations

from collections import Counter
from importlib import import_module

from records import Row, Values, read, script

NAMES = {"eyring": "Eyring", "carreau": "Carreau", "newtonian": "Newtonian"}
GOOD = ("converged", "ended at its number of steps")
FAILED = ("negative film", "diverged", "cycle limit")


def machine_ends() -> Values:
    """Random machine contacts that did not converge, missed errors, large errors."""
    make = script("machines/make.py")
    covered, rows = import_module("machines").covered, make.read()
    failed = [row for row in rows if row["status"] != "converged"]
    ends_of = ", ".join(
        f"a {one['kind']} at {one['hertz_pressure_Pa'] / 1e9:.1f} GPa (κ = "
        f"{one['ellipticity']:.1f}, {NAMES[one['law']]}, seed {one['seed']}, number "
        f"{one['number']}, `{one['status']}`)"
        for one in failed
    )
    result = {"H_c": "h_c", "H_min": "h_min"}
    known = [
        (row, name) for row in rows for name in result if covered(row, name, "error") is not None
    ]
    missed = [(row, name) for row, name in known if not covered(row, name, "error")]
    lines = ["| contact | κ | M, L | film | true error | stated error |", "|" + "---|" * 6]
    for row, name in missed:
        wrong = 100.0 * abs(row[f"{name}_fine"] / row[name] - 1.0)
        stated = 100.0 * row[f"{name}_error"] / row[name]
        head = (
            f"{row['kind']} | {row['ellipticity']:.1f} | {row['moes_m']:.0f}, {row['moes_l']:.1f}"
        )
        lines.append(f"| {head} | {result[name]} | {wrong:.1f} % | {stated:.1f} % |")
    missed_table = "\n".join(lines)
    (disc,) = (row for row in make.summary(rows) if row["contacts"] == "ball on disc")
    long = [row for row in rows if (row["seconds"] or 0.0) > 10.0]
    wide = [row for row in rows if row["ellipticity"] > 4.0]
    ends = [sum((row["status"] == "converged") is yes for row in wide) for yes in (True, False)]
    span = [f(row["ellipticity"] for row in wide) for f in (min, max)]
    good = [row for row in rows if row["status"] == "converged"]
    large = [row for row in good if row["H_c_error"] > 0.05 * row["H_c"]]
    twice = [row for row in good if covered(row, "H_c", "error") is not None]
    both = [row for row in twice if row in large]
    assert all(covered(row, "H_c", "error") for row in both)
    return locals()


def machine_lines() -> Values:
    """Random line contacts: those without a result, and true errors over stated ones."""
    make = script("machines/make.py")
    rows = make.read(make.LINES)
    failed = [row for row in rows if row["status"] != "converged"]
    assert {row["law"] for row in failed} == {"eyring"}
    known = [row for row in rows if row["fine_status"] == "converged"]
    over = {
        name: [abs(row[name] - row[f"{name}_fine"]) / row[f"{name}_error"] for row in known]
        for name in ("H_c", "H_min")
    }
    h_c, h_min = (
        {most: sum(ratio <= most for ratio in ratios) for most in (1.0, 1.1, 1.5, 2.0)}
        for ratios in over.values()
    )
    largest = {name: max(ratios) for name, ratios in over.items()}
    seconds = max(row["seconds"] for row in rows)
    return locals()


def borders() -> Values:
    """Changes of films by sides and cells, and coverage of the domain error."""
    make = script("machines/make.py")
    for row in make.read("sides.csv"):
        for end in ("_further", "_square"):
            assert abs(row[f"H_c{end}"] / row["H_c"] - 1.0) < 2e-4
            assert abs(row[f"H_min{end}"] / row["H_min"] - 1.0) < 1.4e-3
    good = known = 0
    limit: Values = {}
    for row in make.read("border.csv"):
        if row["x_inlet"] != -4.5:
            continue
        if row["border"] == "flooded":
            limit = row
            continue
        for name in ("H_c", "H_min"):
            known += 1
            # with a margin for algebraic errors
            allowed = row[f"{name}_error_domain"] + 2e-5 * limit[name]
            good += abs(row[name] - limit[name]) <= allowed
    return locals()


def random_cases() -> Values:
    """Random cases with a Newtonian oil."""
    rows = read("stress/table.csv")
    checked = [row for row in rows if row["difference"]]
    largest = max(float(row["difference"]) / float(row["allowed"]) for row in checked)
    films = [row for row in rows if row["outcome"] == "negative film"]
    coarse = [
        r for r in films if 0.16 * float(r["moes_m"]) * (4.0 / (int(r["points"]) - 1)) ** 2 > 0.6
    ]
    ended = Counter(row["outcome"] for row in rows)
    assert ended["not settled"] == 0
    return locals()


def laws() -> Values:
    """The same problems with and without a shear law."""
    rows = read("stress/laws.csv")
    every = {law: [row for row in rows if row["law"] == law] for law in NAMES}
    assert sum(map(len, every.values())) == len(rows)
    # with a law in SI units
    problems = [
        [(r["family"], r["moes_m"], max(1.0, float(r["moes_l"])), r["points"]) for r in each]
        for each in every.values()
    ]
    assert problems[0] == problems[1] == problems[2]
    assert sum(float(row["moes_l"]) < 1.0 for row in every["newtonian"]) == 2
    lines = {}
    for law, mine in every.items():
        counts = Counter(row["outcome"] for row in mine)
        numbers = [len(mine), *(counts[name] for name in (*GOOD, *FAILED))]
        assert sum(numbers[1:]) == len(mine)
        numbers.append(sum(row["difference"] != "" for row in mine))
        numbers.append(sum(row["wrong"] == "True" for row in mine))
        lines[NAMES[law]] = " | ".join(map(str, numbers))
    failed = {
        law: {k for k, row in enumerate(mine) if row["outcome"] in FAILED}
        for law, mine in every.items()
    }
    newtonian = failed.pop("newtonian")
    more = [
        Counter(every[law][k]["outcome"] for k in those - newtonian)
        for law, those in failed.items()
    ]
    assert all(newtonian < those for those in failed.values())
    assert more[0] == more[1]
    return locals()


def boundary_films() -> Values:
    """Random cases with a boundary film, in the order of the table."""
    rows = read("stress/contacts.csv")
    counts = Counter(row["outcome"] for row in rows)
    fields = [row for row in rows if row["broken"]]
    numbers = [len(rows), *(counts[name] for name in (*GOOD, "diverged", "cycle limit"))]
    assert sum(numbers[1:]) == len(rows)
    numbers += [len(fields), sum(row["broken"] != "none" for row in fields)]
    for name in ("share_strict", "share_finer"):
        known = [row for row in rows if row["contact_load_share"] and row[name]]
        numbers += [len(known), sum(off(row, name) for row in known)]
    assert not any(row["wrong"] == "True" for row in rows)
    line = " | ".join(map(str, numbers))
    return locals()


def off(row: Row, name: str) -> bool:
    """Whether a load share differs from that of another run by more than its error."""
    stated = row["contact_load_share_error"]
    allowed = max(float(stated), 1e-3) if stated else 0.03
    return abs(float(row["contact_load_share"]) - float(row[name])) > allowed


def random_contacts_at_a_film() -> Values:
    """Predictions of contacts with a boundary film compared with solutions."""
    rows = read("partial/campaign.csv")
    heads = {
        "smooth": "smooth contact under the prediction: film, pressure",
        "vanishing": "prediction without roughness: load share",
        "rough": "prediction of the rough contact: load share",
    }
    lines = "| | contacts | compared | in contact | no value | outside the stated errors |\n"
    lines += "|---|---|---|---|---|---|"
    heat = "solution: mu = mu_smooth mu_ratio"
    for kind, head in heads.items():
        mine = [row for row in rows if row["kind"] == kind]
        share = [(r["predicted_contact_load_share"], r["solved_contact_load_share"]) for r in mine]
        if kind == "smooth":
            share = [(mine_solved, mine_solved) for _, mine_solved in share]
        known = [pair for pair in share if all(pair)]
        touching = sum(max(map(float, pair)) > 0.0 for pair in known)
        wrong = sum(row["broken"] not in ("", heat) for row in mine)
        lines += f"\n| {head} | {len(mine)} | {len(known)} | {touching} "
        lines += f"| {len(mine) - len(known)} | {wrong} |"
    heated = sum(row["broken"] == heat for row in rows)
    without = [row for row in rows if row["kind"] == "rough" and not row["allowed"]]
    friction = [row for row in rows if row["mu_allowed"] not in ("", "inf")]
    missed = sum(float(row["mu_difference"]) > float(row["mu_allowed"]) for row in friction)
    return locals()
