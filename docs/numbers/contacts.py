# SPDX-License-Identifier: BSD-3-Clause
"""Contact at a boundary film, dry contact, and films as thin as the roughness."""

from __future__ import annotations

import numpy as np
from records import Values, of, read, script

from pyehl.prediction.response import FILM_ENDS


def load_shares() -> Values:
    """Load shares on ever finer grids: changes, orders, friction."""
    make = script("contact/make.py")
    rows = make.read()
    share = {
        make.key_of(r): float(r["contact_load_share"]) for r in rows if r["contact_load_share"]
    }
    friction = {make.key_of(row): float(row["mu"] or "nan") for row in rows}
    known = covered = 0
    for row in rows:
        name, film, points = make.key_of(row)
        finer = share.get((name, film, 2 * points - 1), 0.0)
        if row["contact_load_share_error_grid"] and finer:
            known += 1
            change = abs(finer - float(row["contact_load_share"]))
            covered += change <= float(row["contact_load_share_error_grid"])
    change = share["fractal", 8e-8, 129] - share["fractal", 8e-8, 257]
    words = {"light": "waves, Eyring 5 MPa", "thin": "waves, Eyring 1 MPa"}
    words |= {"carreau": "waves, Carreau", "fractal": "fractal tile"}
    orders, finest = {}, {}
    for (name, film, points), fine in share.items():
        head = f"{words.get(name)}; {1e9 * film:.0f} nm"
        if points == 513 and (name, film, 129) in share:
            coarse, middle = (share[name, film, n] for n in (129, 257))
            falls = f"{(coarse - middle) / (middle - fine):.1f}"
            orders[head] = f"{falls} | {100.0 * (middle - fine) / middle:.0f} %"
        if points == 1025:
            coarse, middle = (share[name, film, n] for n in (257, 513))
            cells = [f"{middle:.4f}", f"{fine:.4f}", f"{100.0 * (fine / middle - 1.0):.1f} %"]
            cells += [f"{abs((coarse - middle) / (middle - fine)):.1f}"]
            cells += [f"{friction[name, film, n]:.4f}" for n in (513, 1025)]
            finest[head] = " | ".join(cells).replace("| -", "| −")
    return locals()


def dry_contact() -> Values:
    """Rough balls compared with dry contact."""
    dry = script("contact/dry.py")
    solved = [row for row in dry.read() if row["status"] == "converged"]
    worst = np.ceil(1e3 * max(row["rms"] for row in solved)) / 10.0
    peak = np.ceil(1e3 * max(abs(row["P_max_off"]) for row in solved)) / 10.0
    # surfaces with the boundary film and speed of the text
    same = [row for row in solved if row["surface"] not in list(dry.SURFACES)[-3:]]
    good, known, missing = [], [], []
    for points in dry.GRIDS:
        off = {row["surface"]: dry.area_off(row) for row in same if row["points"] == points}
        good.append(sum(abs(o) < 0.03 for o in off.values()))
        known.append(len(off))
        missing.append(-100.0 * min(off.values()))
    tiles = sum(abs(o) < 0.03 for surface, o in off.items() if surface.startswith("tile"))
    slow = [row["mass_defect"] for row in same if row["points"] == 129]
    return locals()


def predicted_shares() -> Values:
    """Load shares predicted before the simulation, and those known during development."""
    every = read("partial/table.csv")
    before = {row["name"]: row for row in read("partial/predicted.csv")}
    for row in every:
        was = float(before[row["name"]]["contact_load_share"])
        assert abs(float(row["contact_load_share_predicted"]) - was) <= 5e-5
    ends = {row["name"]: row["status"] for row in read("partial/simulated.csv")}
    assert {name for name, end in ends.items() if end != "converged"} == {"d9"}
    blind, seen = ([r for r in every if r["name"][0] == letter] for letter in "dc")
    share, area = ("contact_load_share", "contact_area_share")
    off = np.abs(of(blind, f"{share}_predicted") - of(blind, share))
    areas = np.abs(of(blind, f"{area}_predicted") - of(blind, area)).max()
    assert np.all(off <= of(blind, "stated_error"))
    oils = [r for r in blind if 0.05 < float(r[share]) < 0.3 and r["name"] != "d5"]
    friction = 100.0 * (of(oils, "mu_predicted") / of(oils, "mu") - 1.0).mean()
    now = np.abs(of(seen, f"{share}_now") - of(seen, share))
    assert seen[int(now.argmax())]["name"] == "c11"
    covered = np.sum(now <= of(seen, "stated_error"))
    return locals()


def thin_film() -> Values:
    """Rough balls whose films are as thin as the roughness: predicted and simulated."""
    make = script("thin_film/make.py")
    known = {(r["seed"], r["speed"], r["flow"]): r for r in make.read("predicted.csv")}
    runs = {(r["seed"], r["speed"], r["flow"], r["points"]): r for r in make.read("simulated.csv")}
    ratios, films = [], []
    for seed in "12":
        said, fine = known[seed, "6", "consistent"], runs[seed, "6", "consistent", "513"]
        ratio, error = (make.number(said, k) for k in ("mu_ratio", "mu_ratio_model_error"))
        there = make.number(fine, "mu_ratio")
        assert abs(ratio - there) <= error
        ratios.append(f"{ratio:.4f} ± {error:.4f} against {there:.4f}")
        film = (make.number(said, k) for k in ("h_min_rough_m", "h_min_rough_error_m"))
        films.append([*(1e9 * v for v in film), 1e9 * make.number(fine, "h_min_rough_m")])
        assert (said["status"], fine["status"]) == ("predicted", "converged")
        assert known[seed, "3", "consistent"]["status"] == "film breakdown"
        assert runs[seed, "3", "consistent", "513"]["status"] == "diverged"
    (one, error, there), (two, wide, fine) = films
    # the error of surface 2 covers its film, that of surface 1 does not
    assert 0.0 < two - fine <= wide
    assert one - there > error
    held, lost = (
        sorted(make.number(known[k, speed, "consistent"], "loss") for k in "12") for speed in "63"
    )
    assert held[1] < FILM_ENDS < lost[0]
    newtonian = make.number(known["1", "6", "newtonian"], "mu_ratio")
    simulated = make.number(runs["1", "6", "newtonian", "257"], "mu_ratio")
    tables = ["\n".join(make.lines()), "\n".join(make.film_lines())]
    return locals()
