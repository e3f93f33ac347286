# SPDX-License-Identifier: BSD-3-Clause
"""Cases: keys with unit, range and default; reading, completion, and the resolved namelist."""

from pyehl.case.case import Case, exchanged, files_of, resolve, resolved_case
from pyehl.case.key import Key
from pyehl.case.settings import KEYS

__all__ = ["KEYS", "Case", "Key", "exchanged", "files_of", "resolve", "resolved_case"]
