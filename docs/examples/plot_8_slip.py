# SPDX-License-Identifier: BSD-3-Clause
"""
Friction depends on the slip
============================

In pure rolling (velocity ratio 1) the surface and the film wave generated in the inlet move
together. With slip they separate, and short waves, which the contact does not flatten, increase the
friction. The friction due to roughness therefore depends on the velocity ratio of the rough surface.
"""

import matplotlib.pyplot as plt

import pyehl

ratios = [0.8, 0.9, 0.95, 0.97, 0.985, 1.0, 1.015, 1.03, 1.05, 1.1, 1.2]
table = pyehl.sweep(
    "../../cases/table1.nml",
    {"surface.velocity_ratio": ratios, "surface.seed": [1, 2]},
    {"grid.points": 129},
    run="predict",
    jobs=1,
)
table.mu_ratio.dims

# %%

figure, ax = plt.subplots(figsize=(3.35, 2.4), layout="constrained")
for seed in table.seed.values:
    one = table.sel(seed=seed)
    ax.errorbar(
        one.velocity_ratio,
        one.mu_ratio,
        yerr=one.mu_ratio_model_error,
        fmt="o-",
        capsize=3,
        label=f"seed {seed}",
    )
ax.set_xlabel("velocity of the rough surface / mean velocity")
ax.set_ylabel(r"$\mu_r/\mu_s$, predicted")
ax.legend()
plt.show()
