# SPDX-License-Identifier: BSD-3-Clause
"""
How good is a film thickness?
=============================

Every result carries an estimate of its grid error, from the next coarser grid, and an extrapolated
value. Here both are compared with a finer grid.
"""

import matplotlib.pyplot as plt

import pyehl

grids = [65, 129, 257]
runs = [pyehl.solve("../../cases/quick.nml", {"grid.points": n}) for n in grids]
film = [float(ds.H_c) for ds in runs]
error = [float(ds.H_c_error_grid) for ds in runs]
better = [float(ds.H_c_extrapolated) for ds in runs]

# %%
# The error falls by four when the mesh size is halved: the discretisation is of second order.

figure, ax = plt.subplots(figsize=(3.35, 2.4), layout="constrained")
ax.errorbar(grids, film, yerr=error, fmt="o", capsize=4, label="$H_c$ with its estimated error")
ax.plot(grids, better, "s", mfc="none", label="extrapolated")
ax.set_xscale("log", base=2)
ax.set_xticks(grids, [f"{n} × {n}" for n in grids])
ax.minorticks_off()
ax.set_xlabel("nodes")
ax.set_ylabel("$H_c = h_c R/a^2$")
ax.legend()
plt.show()

# %%
# The estimate covers what the finer grid shows, and the extrapolated value is nearer to it.

assert abs(film[0] - film[1]) < error[0]
assert abs(better[1] - better[2]) < abs(film[1] - better[2])
