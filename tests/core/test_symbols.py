# SPDX-License-Identifier: BSD-3-Clause
"""The table of symbols contains each mathematical symbol of all pages, once."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
TABLE = DOCS / "theory" / "symbols.md"
PAGES = [path for path in sorted(DOCS.rglob("*.md")) if path != TABLE]
# Numbers, operators and functions
PLAIN = {
    r"\pi",
    r"\infty",
    r"\partial",
    r"\nabla",
    "i",
    "j",
    r"\mathrm{d}",
    r"\mathrm{e}",
    r"\mathrm{asinh}",
    r"\mathrm{Re}",
}
# Commands whose argument, with them, is another symbol
MARKS = (r"\bar", r"\tilde", r"\hat", r"\dot", r"\mathbf", r"\boldsymbol", r"\mathcal", r"\mathrm")
LETTER = re.compile(
    r"[A-Za-z]|RR|rr|\\(?:alpha|beta|gamma|delta|varepsilon|zeta|eta|theta|vartheta|kappa|lambda|mu|nu|xi|pi|rho|varrho"
    r"|sigma|tau|phi|chi|psi|omega|Gamma|Delta|Theta|Lambda|Pi|Sigma|Phi|Psi|nabla|partial|infty|ell)"
)
# Here a prime makes another symbol; elsewhere it is a derivative or a variable of integration
PRIMED = {"E", "w", "n", "K_0"}


def formulas(text: str) -> list[str]:
    """Mathematics of a page, without code."""
    text = re.sub(r"```.*?```", "", text, flags=re.DOTALL)
    text = re.sub(r"`[^`\n]*`", "", text)
    blocks = re.findall(r"\$\$(.+?)\$\$", text, flags=re.DOTALL)
    return blocks + re.findall(r"\$([^$\n]+)\$", re.sub(r"\$\$.+?\$\$", "", text, flags=re.DOTALL))


def argument(tokens: list[str], at: int) -> tuple[list[str], int]:
    """The argument at a token, and the index after it."""
    if tokens[at] != "{":
        if tokens[at] in MARKS:
            inside, end = argument(tokens, at + 1)
            return [tokens[at], "{", *inside, "}"], end
        return [tokens[at]], at + 1
    depth, end = 1, at + 1
    while depth:
        depth += {"{": 1, "}": -1}.get(tokens[end], 0)
        end += 1
    return tokens[at + 1 : end - 1], end


def endings(subscript: list[str]) -> list[str]:
    """Endings that a subscript adds to a name: all indices are i, grid levels add none."""
    text = re.sub(r"\\(?:mathrm|mathbf|text|,)|[{}]", "", "".join(subscript))
    if re.fullmatch(r"2?h", text):
        return [""]
    if (
        re.fullmatch(
            r"[ijkl0-9+\-/,]|(?:[2ijk0-9+\-/,]|\\pm|l(?!l|t|z))*[ijk](?:[ijk0-9+\-/,l]|\\pm)*", text
        )
        and not text.isdigit()
    ):
        return ["_i"]
    return (
        [f"_{part}" for part in text.split(",")] if re.fullmatch(r"\w,\w", text) else [f"_{text}"]
    )


def scripts(tokens: list[str], at: int, name: str) -> tuple[set[str], set[str], int]:
    """A name with its primes and subscripts, the symbols of its exponent, the next index."""
    prime, star, subscripts, inner = False, "", [""], set()
    while at < len(tokens) and tokens[at] in ("_", "'", "^"):
        if tokens[at] == "'":
            prime, at = True, at + 1
            continue
        kind = tokens[at]
        inside, at = argument(tokens, at + 1)
        if kind == "_":
            subscripts = ["_h"] if name == "p" and inside == ["h"] else endings(inside)
        elif inside == ["*"]:
            star = "^*"
        elif name != "I" and inside not in (["k"], ["c"]) and inside[0] != r"\mathsf":
            inner |= symbols(inside) - {r"\mathrm{Newton}"}
    names = {name + subscript for subscript in subscripts}
    return (
        {(f"{whole}'" if prime and whole in PRIMED else whole) + star for whole in names},
        inner,
        at,
    )


def symbols(tokens: list[str]) -> set[str]:
    """Symbols of a formula, with marks and subscripts."""
    result: set[str] = set()
    at = 0
    while at < len(tokens):
        name = tokens[at]
        if name in (r"\text", r"\begin", r"\end"):
            at = argument(tokens, at + 1)[1]
            continue
        if name == r"\sum" and tokens[at + 1 : at + 2] == ["_"]:
            at = argument(tokens, at + 2)[1]
            continue
        if name in MARKS:
            inside, at = argument(tokens, at + 1)
            name = f"{name}{{{''.join(inside)}}}"
        elif LETTER.fullmatch(name):
            at += 1
        else:
            at += 1
            continue
        if name in (r"\Delta", r"\delta") and (
            tokens[at : at + 1] in (["P"], ["H"], ["K"], ["u"], [r"\bar"], [r"\mathbf"])
        ):
            inside, at = argument(tokens, at)
            name += " " + "".join(inside)
        whole, inner, at = scripts(tokens, at, name)
        result |= whole | inner
    return result - PLAIN


def of_formula(tex: str) -> set[str]:
    """Symbols of a formula in LaTeX."""
    return symbols(re.findall(r"\\[A-Za-z]+|\\.|RR|rr|\S", tex))


def table() -> list[tuple[str, list[Path]]]:
    """Symbols of the table, and the pages of their section; none: all pages."""
    rows: list[tuple[str, list[Path]]] = []
    pages: list[Path] = []
    for line in TABLE.read_text(encoding="utf-8").split("\n"):
        if line.startswith("## "):
            pages = [(TABLE.parent / name).resolve() for name in re.findall(r"\]\(([^)]+)\)", line)]
        if line.startswith("| $"):
            cell = line.split(" | ")[0]
            rows += [
                (name, pages)
                for tex in re.findall(r"\$([^$]+)\$", cell)
                for name in of_formula(tex)
            ]
    return rows


def test_symbols_are_unique():
    names = [name for name, _ in table()]
    assert len(names) > 250
    assert [name for name in set(names) if names.count(name) > 1] == []


def test_sections_name_pages():
    assert {page for _, pages in table() for page in pages} <= set(PAGES)


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.relative_to(DOCS).as_posix())
def test_symbols_of_a_page_are_in_the_table(page):
    known = {name for name, pages in table() if not pages or page in pages}
    missing = set()
    for tex in formulas(page.read_text(encoding="utf-8")):
        for name in of_formula(tex):
            # of one of two bodies, surfaces, nodes
            whole = re.sub(r"[_,][12i]$", "", name)
            if not {name, whole, f"{whole}_i"} & known:
                missing.add((name, tex))
    assert not missing


def test_every_symbol_of_the_table_is_used():
    used = {
        name
        for page in PAGES
        for tex in formulas(page.read_text(encoding="utf-8"))
        for name in of_formula(tex)
    }
    assert [
        name
        for name, pages in table()
        if pages and name not in used and not any(other.startswith(name) for other in used)
    ] == []


def test_the_parser_knows_marks_subscripts_and_operators():
    assert of_formula(r"\bar\lambda = \frac{12\,\eta_0\bar uR_x^2}{a^3 p_h}") == {
        r"\bar{\lambda}",
        r"\eta_0",
        r"\bar{u}",
        "R_x",
        "a",
        "p_h",
    }
    assert of_formula(r"\sum_k\omega_k K_{i+2k-1}") == {r"\omega_i", "K_i"}
    assert of_formula(r"\mathrm{e}^{-h_x^3k^4(X+1)/2}") == {"h_x", "k", "X"}
    assert of_formula(r"E'\,\mathrm{d}X' - \varepsilon_{x,y}") == {
        "E'",
        "X",
        r"\varepsilon_x",
        r"\varepsilon_y",
    }
