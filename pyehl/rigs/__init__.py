# SPDX-License-Identifier: BSD-3-Clause
"""Files of rigs that measure film thickness and friction, and comparison with results."""
