# SPDX-License-Identifier: BSD-3-Clause
"""The subcommands of ``pyehl``: each module declares its arguments, prints and draws.

Only `pyehl.cli` imports them. Each has ``add_arguments(parser)`` and ``execute(args)``,
which returns the exit status.
"""
