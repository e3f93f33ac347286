# SPDX-License-Identifier: BSD-3-Clause
"""
Watching the solver
===================

A solver is an iterator: it yields after each multigrid cycle of a steady contact, or after each
time step of a transient run. The loop may read fields and results, and may end early.
"""

import matplotlib.pyplot as plt

import pyehl

residuals = {}
with pyehl.Solver("../../cases/quick.nml", "solver.accuracy=1e-3") as solver:
    for step in solver:
        residuals.setdefault(solver.summary["points"], []).append(step.summary["residual"])
    print(step)

# %%
# The grids are solved from coarse to fine (full multigrid); each cycle reduces the residual by a
# factor of about ten.

figure, ax = plt.subplots(figsize=(3.35, 2.4), layout="constrained")
first = 1
for points, values in residuals.items():
    ax.semilogy(range(first, first + len(values)), values, "o-", label=f"{points} × {points}")
    first += len(values)
ax.set_xlabel("cycle")
ax.set_ylabel("residual (rms)")
ax.legend(title="nodes")
plt.show()
