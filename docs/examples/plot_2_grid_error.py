# SPDX-License-Identifier: BSD-3-Clause
"""
How accurate is a film thickness?
=================================

Every result has an estimate of its grid error and an extrapolated value, both from coarser grids.
Here they are compared with a finer grid.
"""

import matplotlib.pyplot as plt

import pyehl

grids = [65, 129, 257]
runs = [pyehl.solve("../../cases/quick.nml", {"grid.points": n}) for n in grids]
film = [float(ds.H_c) for ds in runs]
error = [float(ds.H_c_error_grid) for ds in runs]
better = [float(ds.H_c_extrapolated) for ds in runs]

# %%
# Half the mesh size reduces the error by a factor of four: the discretisation is of second order.

figure, ax = plt.subplots(figsize=(3.35, 2.4), layout="constrained")
ax.errorbar(grids, film, yerr=error, fmt="o", capsize=4, label="$H_c$ with its estimated error")
ax.plot(grids, better, "s", mfc="none", label="extrapolated")
ax.set_xscale("log", base=2)
ax.set_xticks(grids, [f"{n} × {n}" for n in grids])
ax.minorticks_off()
ax.margins(x=0.15)
ax.set_xlabel("nodes")
ax.set_ylabel("$H_c = h_c R/a^2$")
ax.legend()
plt.show()

# %%
# The estimate covers the difference from the finer grid, to which the extrapolated value is closer.

assert abs(film[0] - film[1]) < error[0]
assert abs(better[1] - better[2]) < abs(film[1] - better[2])
