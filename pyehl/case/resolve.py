# SPDX-License-Identifier: BSD-3-Clause
"""From the text of a case to the resolved one."""

import os
from collections.abc import Iterable

from pyehl.case.complete import complete
from pyehl.case.file import read_text
from pyehl.case.reader import read
from pyehl.case.writer import case_text
from pyehl.given import Option, options_of, path_of, text_of


def resolve(
    text: str, origin: str, options: Option | Iterable[Option] = (), *, from_file: bool = False
) -> str:
    """Resolve a case: check it, and spell out every value of it as namelist text.

    The text of a file called `origin`, for messages and for names of maps, or `from_file` that
    file itself; `options` replace values. InputError with file, line and column, what was
    expected, and the nearest name.
    """
    origin = path_of(origin, "the name of a case")
    if from_file:
        text = read_text(origin, "the name of a case file")
    text_of(text, "the text of a case")
    draft = read(text, os.fspath(origin), options_of(options))
    complete(draft)
    return case_text(draft.settings, draft.given)
