# SPDX-License-Identifier: BSD-3-Clause
"""Whole text files that a case is made of."""

import os

from pyehl.errors import InputError

LARGEST = 1_000_000
"""Bytes of the largest file; anything longer is not one."""
BYTE_ORDER_MARK = "\ufeff"


def read_text(path: str, expected: str) -> str:
    """Give the text of a file, without the mark that editors put before UTF-8.

    InputError with what was expected if it cannot be read. What is no UTF-8 becomes surrogates.
    """
    try:
        text = _text(path)
    except OSError as error:
        text = f"cannot open: {error.strerror}"
    except _Refused as refused:
        text = str(refused)
    else:
        return text.removeprefix(BYTE_ORDER_MARK)
    raise InputError(f"{path}: error: {text}\nexpected: {expected}")


class _Refused(Exception):  # noqa: N818
    """Why a file is not read."""


def _text(path: str) -> str:
    if not os.path.exists(path):
        raise _Refused("there is no such file")
    if os.path.isdir(path):
        raise _Refused("this is a folder, not a file")
    if not os.path.isfile(path):
        raise _Refused("this is a device or a pipe, not a file")
    with open(path, "rb") as file:
        data = file.read(LARGEST + 1)
    if len(data) > LARGEST:
        raise _Refused(f"not a file of at most {LARGEST} bytes")
    return data.decode(errors="surrogateescape")
