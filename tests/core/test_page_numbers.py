# SPDX-License-Identifier: BSD-3-Clause
"""Numbers of the documents that `python docs/numbers` fills from their records."""

import runpy
from pathlib import Path
from typing import Any

import pytest


@pytest.fixture(scope="module")
def numbers(root: Path) -> dict[str, Any]:
    """The module of the command."""
    return runpy.run_path(str(root / "docs" / "numbers"))


def test_pages_have_the_numbers_of_their_records(numbers: dict[str, Any], capsys):
    assert numbers["main"](["--check"]) == 0, capsys.readouterr().out
    markers = [m for p in numbers["pages"]() for m in numbers["MARKER"].findall(p.read_text())]
    assert len(markers) > 250


def test_a_wrong_number_is_replaced(numbers: dict[str, Any]):
    text = (
        "covers <!--compared=len(rows):d-->7<!--/--> surfaces\n<!--inlet=lines-->\n|\n\n<!--/-->\n"
    )
    made = numbers["filled"](text)
    assert "-->63<!--/--> surfaces" in made
    assert "<!--inlet=lines-->\n| " in made
    assert numbers["filled"](made) == made
    stated = numbers["filled"](
        "over <!--guard=depth-->0<!--/--> of <!--coarsening=long_x:g--><!--/-->"
    )
    assert numbers["plain"](stated) == "over four of 1.6"
    with pytest.raises(KeyError, match="no function nobody"):
        numbers["filled"]("<!--nobody=x-->7<!--/-->")


def test_markers_are_comments_to_markdown(numbers: dict[str, Any]):
    """A comment that begins a line would make the whole line HTML; a bar would end a table cell."""
    for page in numbers["pages"]():
        for line in page.read_text(encoding="utf-8").splitlines():
            assert not line.startswith("<!--") or line.endswith("-->"), f"{page}: {line}"
            if line.startswith("|"):
                assert "|" not in "".join(e for _, e, _ in numbers["MARKER"].findall(line)), line
