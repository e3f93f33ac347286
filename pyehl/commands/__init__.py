# SPDX-License-Identifier: BSD-3-Clause
"""The subcommands of ``pyehl``: each module declares its arguments, prints and draws.

In the package only `pyehl.cli` imports them. Each has ``add_arguments(parser)`` and
``execute(args)``, which returns the exit status; `arguments`, `machine` and `watching` have what
several of them share.
"""
