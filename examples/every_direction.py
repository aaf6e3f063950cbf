"""
Vibration in every direction
============================

A body on a base that is shaken in 49 directions of the plane at four velocity ratios: 196 periodic
states, solved in one call. Along the drive (0 and 180 degrees) nothing is gained until the
vibration is faster than the drive; then it is the best direction.
"""

import matplotlib.pyplot as plt
import numpy as np

from asperity.casefile import read_case
from asperity.results.figures import STYLE
from asperity.slider import TABLES, Model, solve_many
from asperity.slider.closed_forms import directed_ratio

# %%
# A case that ships, changed for every point. ``replace_values`` takes numbers in SI, so angles
# are in radians.

case = read_case("table-4.4", TABLES, ["solve.method=periodic"])
velocity_ratios = (1.0, 2.0, 6.0, 20.0)
degrees = np.arange(0.0, 361.0, 7.5)
models = [
    Model.from_case(
        case.replace_values({"vibration.velocity_ratio": k, "vibration.direction": np.radians(d)})
    )
    for k in velocity_ratios
    for d in degrees
]
ratios = np.array([result.ratio for result in solve_many(models)])
ratios = ratios.reshape(len(velocity_ratios), len(degrees))

# %%
# Thin lines are the closed form of rigid friction on a rigid drive, with all of the vibration
# transferred. What the model adds: asperities that yield before they slip, a body that follows the
# base, and a contact that takes part in 71 % of the motion across.

plt.rcParams.update(STYLE)
figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
for row, k in zip(ratios, velocity_ratios, strict=True):
    (line,) = axes.plot(degrees, row, marker="o", markersize=3, label=f"k = {k:g}")
    axes.plot(
        degrees, directed_ratio(k, np.radians(degrees)), color=line.get_color(), linewidth=0.6
    )
axes.set(xlabel="direction of vibration (deg)", ylabel="drive force over µ F_N", ylim=(0, None))
axes.set_xticks(np.arange(0, 361, 45))
axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)

best = degrees[ratios.round(6).argmin(axis=1)]
print(dict(zip(velocity_ratios, best.tolist(), strict=True)))
