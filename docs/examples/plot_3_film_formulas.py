# SPDX-License-Identifier: BSD-3-Clause
"""
Film thickness against speed: formulas and solver
=================================================

A sweep runs one case with many values and returns one table. This one gives the central film
thickness in the contact of Table 1 of Zhang et al. 2019 from published formulas, and from the
solver at three speeds.
"""

import matplotlib.pyplot as plt

import pyehl
from pyehl.plots.style import label_decades, label_log_ticks

CASE = "../../cases/table1.nml"
formulas = pyehl.sweep(CASE, {"contact.mean_velocity": "0.1:3:25log"}, run="film", jobs=1)
solved = pyehl.sweep(
    CASE,
    {"contact.mean_velocity": [0.5, 1.2, 3.0]},
    {"surface.kind": "smooth", "grid.points": 257},
    jobs=1,
)
sorted(name for name in formulas.data_vars if name.startswith("h_c_m"))

# %%

figure, ax = plt.subplots(figsize=(4.2, 3.0), layout="constrained")
speed = formulas.mean_velocity
for name, label, style in (
    ("nijenbanning_venner_moes", "Nijenbanning, Venner & Moes", "-"),
    ("hamrock_dowson", "Hamrock & Dowson", "--"),
    ("chittenden_et_al", "Chittenden et al.", ":"),
):
    ax.loglog(speed, formulas[f"h_c_m_{name}"] * 1e6, style, label=label)
unit = solved.h_c_m / solved.H_c * 1e6
ax.errorbar(
    solved.mean_velocity,
    solved.H_c_extrapolated * unit,
    yerr=solved.H_c_error * unit,
    fmt="ko",
    capsize=3,
    label="solver, extrapolated",
)
ax.set_xlabel("mean velocity [m/s]")
ax.set_ylabel("$h_c$ [µm]")
label_log_ticks(ax.yaxis, 4)
label_decades(ax.xaxis)
ax.legend(loc="upper left")
plt.show()
