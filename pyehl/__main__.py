# SPDX-License-Identifier: BSD-3-Clause
"""``python -m pyehl`` is the command ``pyehl``."""

import sys

from pyehl.cli import main

sys.exit(main())
