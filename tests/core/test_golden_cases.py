# SPDX-License-Identifier: BSD-3-Clause
"""Cases resolve as with the Fortran reader of commit 2e4262cb (golden_cases.json).

For a resolved case the record has the lines that differ from the default case, or from the case
whose key was changed, with the origin of each value ('given', 'default' or 'derived'), and for a
refused one the message. For each key it has a valid case, and a refusal if there is one. Since then
messages list only keys that people give, a gap that does not open names the key that was given,
numbers are shown as people write them, and the keys ADDED are written too. &inlet starves a
contact, and the sides of a narrow or a wide one follow from its width.
"""

import json
from pathlib import Path

import pytest
from golden_cases import made, outcome
from test_malformed import FAULTS, MARK

RECORD = json.loads(Path(__file__).with_name("golden_cases.json").read_text())


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("golden")


def test_cases_resolve_as_recorded(folder: Path):
    cases = made(folder)
    for name, text, options, _ in FAULTS:
        cases[f"fault: {name}"] = (text.replace(MARK, ""), [f"--set {o}" for o in options])
    assert len(RECORD) > 400
    bases = {n: outcome(*case, folder) for n, case in cases.items() if n.startswith("base: ")}
    wrong = []
    for name, recorded in RECORD.items():
        result = outcome(*cases[name], folder)
        if isinstance(result, list):
            result = differences(result, bases[reference(name)])
        if result != recorded:
            wrong.append(f"{name}:\n{recorded}\n{result}")
    assert not wrong, "\n".join(wrong[:5])


def reference(name: str) -> str:
    """Name of the case with which the record of a case is compared."""
    base = f"base: {name.partition(': ')[0].removeprefix('written ')}"
    return base if "=" in name.partition(": ")[2] and base != "base: fault" else "base: defaults"


def differences(lines: list[str], others: list[str]) -> list[str]:
    """Lines that were added, and those removed after a minus sign."""
    added = [line for line in lines if line not in others]
    return added + [f"-{line}" for line in others if line not in lines]
