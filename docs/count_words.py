# SPDX-License-Identifier: BSD-3-Clause
"""Count the words of the book: python docs/count_words.py, with --pages for each page.

Words of running prose that have a letter: of README.md, all of docs, cases/README.md and
fortran/README.md. Without code, tables, mathematics, addresses of links, and without the
bibliography. Pages that include another one count once.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
WITHOUT = ("docs/bibliography.md", "docs/gallery/", "docs/ford.md")
LIMIT = 41_000
"""Maximum number of words that the tests allow, names of code included; the aim is about 40 000."""


def pages() -> list[Path]:
    """List the pages of the book."""
    result = [ROOT / "README.md", ROOT / "cases" / "README.md", ROOT / "fortran" / "README.md"]
    result += sorted((ROOT / "docs").rglob("*.md"))
    return [path for path in result if not path.relative_to(ROOT).as_posix().startswith(WITHOUT)]


def prose(text: str, *, code_apart: bool = True) -> str:
    """Give the running prose of a Markdown page; a name of code counts as one word or none."""
    text = re.sub(r"^ *(`{3,}|~{3,}).*?^ *\1", "", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"^ *\|.*$", "", text, flags=re.MULTILINE)
    text = re.sub(r"<!--.*?-->|</?[a-z]+>", "", text, flags=re.DOTALL)
    text = re.sub(r"`[^`\n]*`", "" if code_apart else "code", text)
    text = re.sub(r"\$\$.+?\$\$|\$[^$]+\$", "", text, flags=re.DOTALL)
    return re.sub(r"\]\([^)]*\)", "]", text)


def words(text: str, *, code_apart: bool = True) -> int:
    """Count the words with a letter."""
    running = prose(text, code_apart=code_apart).split()
    return sum(any(sign.isalpha() for sign in word) for word in running)


def main() -> None:
    """Print the numbers of words."""
    texts = {path: path.read_text(encoding="utf-8") for path in pages()}
    counts = {path: words(text) for path, text in texts.items()}
    with_code = sum(words(text, code_apart=False) for text in texts.values())
    if "--pages" in sys.argv:
        for path, count in sorted(counts.items(), key=lambda item: item[1]):
            print(f"{count:6d}  {path.relative_to(ROOT)}")
    evidence = sum(count for path, count in counts.items() if "evidence" in path.parts)
    total = sum(counts.values())
    print(f"{total} words on {len(counts)} pages, {evidence} of them in the evidence")
    print(f"{with_code} with each name of code in a sentence as a word")


if __name__ == "__main__":
    main()
