# SPDX-License-Identifier: BSD-3-Clause
"""Cases: keys with unit, range and default; reading, completion, and the resolved namelist."""

from pyehl.case.case import Case, files_of, trusted

__all__ = ["Case", "files_of", "trusted"]
