"""
How the friction law matters across the drive
=============================================

In one dimension the three relaxation laws of the asperities are the same. Under transverse
vibration the asperity's direction turns, and they part by tens of percent. Which one is right is a
question to an experiment: this is where to look.
"""

import matplotlib.pyplot as plt
import numpy as np

from asperity.friction import Friction
from asperity.results.figures import STYLE
from asperity.slider import Model, Slider, Solve, solve_many
from asperity.slider.closed_forms import transverse_ratio
from asperity.vibration import Vibration

# %%
# ``split`` takes the body's slip and the base's one after the other, ``unsplit`` relaxes by the
# slip along the asperity, ``vector`` by the speed of the slip in any direction.

body = Slider(
    drive_velocity="0.5 mm/s", drive_stiffness="96068 N/m", mass="2 kg", normal_force="50.8 N"
)
velocity_ratios = np.linspace(0.25, 12.0, 48)


def ratios(law, direction):
    contact = Friction(mu=0.1, max_deflection="75.49 nm", law=law, transfer=0.71)
    models = [
        Model(
            body,
            contact,
            Vibration(frequency="3 kHz", velocity_ratio=k, direction=direction, units="SI"),
            Solve(method="periodic"),
        )
        for k in velocity_ratios
    ]
    return np.array([result.ratio for result in solve_many(models)])


across = {law: ratios(law, "90 deg") for law in ("split", "unsplit", "vector")}

# %%
# Rigid friction knows no asperities and no law; it lies between them at first and above them later.

plt.rcParams.update(STYLE)
figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
for (law, row), style in zip(across.items(), ("-", "--", "-."), strict=True):
    axes.plot(velocity_ratios, row, style, label=law)
rigid = transverse_ratio(0.71 * velocity_ratios)
axes.plot(velocity_ratios, rigid, ":", color="black", label="rigid friction")
axes.set(xlabel="velocity ratio k", ylabel="drive force over µ F_N", xlim=(0, 12), ylim=(0, 1.05))
axes.legend(frameon=False)

# %%
# Along the drive the laws agree.

along = [ratios(law, "0 deg") for law in across]
spread_along = np.ptp(along, axis=0).max()
spread_across = np.ptp(list(across.values()), axis=0).max()
print(f"largest difference along {spread_along:.1e}, across {spread_across:.2f}")
