# SPDX-License-Identifier: BSD-3-Clause
"""What the prediction contributes to a run: its start, and the waves that its grid omits."""
