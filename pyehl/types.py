# SPDX-License-Identifier: BSD-3-Clause
"""Types of arrays, of cases as groups of values, and of the rows of tables."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Single = NDArray[np.float32]
Indices = NDArray[np.int_]
Mask = NDArray[np.bool_]
Settings = Mapping[str, Mapping[str, Any]]
Row = dict[str, Any]
Values = Mapping[str, Any]
