# SPDX-License-Identifier: BSD-3-Clause
"""Types of arrays."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Single = NDArray[np.float32]
Indices = NDArray[np.int_]
