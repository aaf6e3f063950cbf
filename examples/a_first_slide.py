"""
A first slide
=============

A body of 0.5 kg is pulled over a steel base through a spring. At 0.14 s the base begins to vibrate
along the direction of motion, six times as fast at its peak as the drive. How much force is left?
"""

import matplotlib.pyplot as plt

from asperity.friction import Friction
from asperity.results.figures import STYLE
from asperity.slider import Model, Slider, Solve, solve
from asperity.vibration import Vibration

# %%
# Body and drive, contact, vibration: quantities are text with a unit, or numbers in SI.

body = Slider(
    drive_velocity="0.5 mm/s",
    drive_stiffness="96068 N/m",
    mass="0.5 kg",
    normal_force="55 N",
)
contact = Friction(mu=0.1, max_deflection="68.75 nm")
shaking = Vibration(frequency="4 kHz", velocity_ratio=6.0, direction="0 deg", start="0.14 s")

result = solve(Model(body, contact, shaking, Solve(step="1 us", duration="1 s")))
ratio = result.ratio
print(f"{ratio:.4f} of the drive force without vibration, {result.static_drive_force:.2f} N")

# %%
# The force rises with the drive until the body breaks away, rings for a moment, and falls when the
# vibration begins: friction now pushes the body forward for almost half of every cycle.

plt.rcParams.update(STYLE)
figure, (whole, cycles) = plt.subplots(2, figsize=(7, 5.5), layout="constrained")
history = result.history
whole.plot(history.time, history.drive_force)
whole.axhline(result.static_drive_force, color="black", linestyle=":")
whole.set(xlabel="time (s)", ylabel="drive force (N)")
last = history.time > history.time[-1] - 3 / 4000
cycles.plot((history.time[last] - history.time[-1]) * 1e3, history.friction[last, 0])
cycles.set(xlabel="time before the end (ms)", ylabel="friction (N)")

# %%
# Nothing is for free: the actuator supplies more than the drive saves.

ledger = result.ledger
print(f"drive     {ledger.drive * 1e3:6.3f} mW")
print(f"vibration {ledger.vibration * 1e3:6.3f} mW")
print(f"friction  {ledger.friction * 1e3:6.3f} mW")
print(f"missing   {ledger.residual:.1e} of the drive's power")
