# SPDX-License-Identifier: BSD-3-Clause
"""
Friction against film thickness
===============================

At lower speeds the film is thinner and the roughness adds more friction: this is the full-film part
of a Stribeck curve. The command ``pyehl stribeck`` draws such curves with error bands, full
simulations and measured data, see :doc:`/howto/stribeck`.
"""

import matplotlib.pyplot as plt

import pyehl

tables = {
    law: pyehl.stribeck(
        "../../cases/table1.nml",
        {"contact.mean_velocity": "0.4:4:6log"},
        {"lubricant.shear_law": law, "grid.points": 129},
        jobs=1,
    )
    for law in ("newtonian", "eyring")
}
print(tables["newtonian"].status.values)

# %%
# If the film broke down the status would report it, and there would be no ratio. Eyring's law limits
# the effect of viscosity peaks on the shear stress, so that the ratio stays close to 1.

figure, ax = plt.subplots(figsize=(3.35, 2.4), layout="constrained")
for law, table in tables.items():
    label = f"{law.title()} shear stress"
    ax.semilogx(table.lambda_ratio_central, table.mu_ratio, "o-", label=label)
ax.set_xticks([2, 3, 4, 6, 8, 10, 14], ["2", "3", "4", "6", "8", "10", "14"])
ax.minorticks_off()
ax.axhline(1.0, color="grey", ls=":", lw=0.8)
ax.set_xlabel(r"$h_c/\sigma$, central film over rms height")
ax.set_ylabel(r"$\mu_r/\mu_s$, predicted")
ax.legend()
plt.show()
