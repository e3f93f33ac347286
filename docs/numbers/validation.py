# SPDX-License-Identifier: BSD-3-Clause
"""Results compared with other programs and film formulas."""

from __future__ import annotations

from records import Row, Values, of, read

LIMITS = {"circle": 0.45, "ellipse": 0.3, "thinning": 0.9, "waviness": 0.1}
"""Maximum deviation from the other program that the page may show, by group [%]."""
LOW, HIGH = (20.0, 100.0), (200.0, 2000.0)


def others() -> Values:
    """Values of the other programs and of pyehl, and deviations, in the order of the table."""
    lines = []
    smooth: dict[str, list[float]] = {"H_c": [], "H_min": []}
    for row in read("validation/table.csv"):
        share = 100.0 * (float(row["ours"]) / float(row["theirs"]) - 1.0)
        assert abs(share) <= LIMITS[row["group"]]
        if row["group"] in ("circle", "ellipse"):
            smooth[row["quantity"]].append(abs(share))
        text = f"{share:+.2f} %".replace("-", "−")
        text = text[1:] if text[1:] == "0.00 %" else text
        lines.append(f"{float(row['theirs']):.5g} | {float(row['ours']):.5g} | {text}")
    central, least = (f"{max(smooth[name]):.2f}" for name in ("H_c", "H_min"))
    return locals()


def second_solver() -> Values:
    """Films of ellipses by the second solver, by pyehl on the same cells, and by the C program."""
    rows = read("validation/second.csv")
    ours = max(abs(100.0 * (float(r["ours"]) / float(r["second"]) - 1.0)) for r in rows)
    off = {
        (r["moes_m"], r["kappa"], r["quantity"]): 100.0 * (float(r["second"]) / float(r["c"]) - 1.0)
        for r in rows
        if r["c"]
    }
    against = {q: share for (_, kappa, q), share in off.items() if kappa == "1.5"}
    others = max(abs(share) for (_, kappa, _), share in off.items() if kappa != "1.5")
    assert ours < 0.01
    assert len(off) == 10
    return locals()


def line_meshes() -> Values:
    """Extrapolated minimum film of a line: from two meshes by order 2, or from three."""
    films: dict[str, dict[int, float]] = {"pyehl": {}, "newton": {}}
    for row in read("validation/line.csv"):
        films[row["solver"]][int(row["intervals"])] = float(row["H_min"])

    def limits(solver: str, finest: int) -> tuple[float, float]:
        coarse, half, fine = (films[solver][finest // part] for part in (4, 2, 1))
        ratio = (half - coarse) / (fine - half)
        return fine + (fine - half) / 3.0, fine + (fine - half) / (ratio - 1.0)

    ours, newton = limits("pyehl", 4096), limits("newton", 2048)
    coarse = limits("newton", 440)[1]
    low = 100.0 * (1.0 - coarse / ours[1])
    assert max(*ours, *newton) < 1.002 * min(*ours, *newton)
    return locals()


def film_formulas() -> Values:
    """Ratios of films by formula to those of pyehl: ranges, and the maximum deviations."""
    every = read("validation/formulas.csv")

    def ratios(name: str, quantity: str, bounds: tuple[float, float]) -> list[float]:
        def here(row: Row) -> bool:
            inside = bounds[0] <= float(row["moes_m"]) <= bounds[1]
            return row["formula"].startswith(name) and row["quantity"] == quantity and inside

        return list(of(filter(here, every), "ratio"))

    def span(name: str, quantity: str, bounds: tuple[float, float]) -> str:
        result = ratios(name, quantity, bounds)
        return f"{min(result):.3f} | {max(result):.3f}"

    heavy, light = (500.0, 1e9), (0.0, 499.0)
    moes = max(abs(100.0 * (r - 1.0)) for r in ratios("Nijenbanning", "H_c", heavy))
    low = 100.0 * (1.0 - min(ratios("Nijenbanning", "H_c", light)))
    high = [
        100.0 * (max(ratios(name, "H_c", (0.0, 1e9))) - 1.0) for name in ("Hamrock", "Chittenden")
    ]
    # more than twice too thick
    assert 2.0 < max(ratios("Hamrock", "H_min", heavy)) < 2.3
    return locals()
