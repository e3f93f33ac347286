# SPDX-License-Identifier: BSD-3-Clause
"""Commands named in documents, run or not: their scripts and options exist."""

from __future__ import annotations

import argparse
import importlib
import re
from pathlib import Path

import pytest
from document_text import DOCUMENTS

from pyehl.cli import SUBCOMMANDS, make_parser


def test_scripts_in_documents_are_there(root: Path):
    """Scripts after `python …`, from the root or from the folder of the page."""
    seen = 0
    for name in DOCUMENTS:
        text = (root / name).read_text()
        folders = "docs/evidence|benchmarks|examples"
        for script in re.findall(rf"python ((?:{folders})/[\w/]+\.py|make\.py)", text):
            places = root / script, (root / name).parent / script
            assert any(place.is_file() for place in places), f"{name}: {script}"
            seen += 1
    assert seen > 60


def options_of(parser: argparse.ArgumentParser) -> set[str]:
    """Options of a subcommand and of the subcommands below it."""
    result: set[str] = set()
    for action in parser._actions:
        result |= set(action.option_strings)
        if isinstance(action, argparse._SubParsersAction):
            result |= set().union(*map(options_of, action.choices.values()))
    return result


def test_options_in_documents_are_options(root: Path):
    """Of every `pyehl SUBCOMMAND …` in a text or in a block, run or not."""
    known = {name: options_of(make_parser(name)) for name in SUBCOMMANDS}
    seen = 0
    for name in DOCUMENTS:
        text = (root / name).read_text()
        for line in re.findall(r"(?:`|^)(pyehl [a-z][^`\n]*)", text, re.MULTILINE):
            subcommand = line.split()[1]
            for option in re.findall(r"(?<!\S)--[a-z][a-z-]*", line.partition("#")[0]):
                assert option in known[subcommand], f"{name}: {line}"
                seen += 1
    assert seen > 100


def test_options_of_scripts_are_options(root: Path, capsys: pytest.CaptureFixture[str]):
    """Of every `python benchmarks/…` and `python examples/…`."""
    known: dict[str, str] = {}
    seen = 0
    for name in DOCUMENTS:
        text = (root / name).read_text()
        pattern = r"python (?:benchmarks|examples/\w+)/(\w+)\.py([^`\n]*)"
        for script, words in re.findall(pattern, text):
            if script not in known:
                with pytest.raises(SystemExit, match="0"):
                    importlib.import_module(script).main(["--help"])
                known[script] = capsys.readouterr().out
            for option in re.findall(r"(?<!\S)--?[a-z][a-z-]*", words.partition("#")[0]):
                match = re.search(rf"(?<![\w-]){option}\b", known[script])
                assert match, f"{name}: {script} {option}"
                seen += 1
    assert seen > 30
