"""
An elastic block
================

The sliding body as a block of steel: 12 by 9 mm of it stand on each of twelve faces, condensed once
to 20 contact nodes, then solved increment by increment with the friction law at every point of the
contact. Here a rigid drive pulls it, so that it slides from the first moment on.
"""

import matplotlib.pyplot as plt
import numpy as np

from asperity.block.problem import BlockProblem
from asperity.block.solution.march import solve_block
from asperity.block.tables import TABLES as CONTACT
from asperity.casefile import read_case
from asperity.results.figures import STYLE
from asperity.slider import TABLES, Model, solve

# %%
# A case that ships, with a light mesh, over 20 cycles. Without a stiffness the drive is rigid.

settings = [
    "block.elements=[4, 3, 3]",
    "block.element=hex8",
    "vibration.start=0 s",
    "solve.step=2 us",
    "solve.duration=5 ms",
]
case = read_case("block-longitudinal", {**TABLES, **CONTACT}, settings)
case = case.replace_values({"slider.drive_stiffness": None})
problem = BlockProblem.from_case(case)
block = solve_block(problem)
body = solve(Model.from_case(case))
print(block.ratio, body.ratio, block.iterations_mean, block.ledger.residual)

# %%
# Its friction is the sliding body's; only the block bounces a little on its contact.

plt.rcParams.update(STYLE)
figure, axes = plt.subplots(figsize=(7, 3.5), layout="constrained")
for name, result, dashes in (("sliding body", body, (1, 0)), ("elastic block", block, (4, 2))):
    history = result.history
    last = history.time > history.time[-1] - 0.5e-3
    time = 1e3 * (history.time[last] - history.time[-1] + 0.5e-3)
    axes.plot(time, history.friction[last, 0], dashes=dashes, label=name)
axes.set(xlabel="time (ms)", ylabel="friction (N)")
axes.legend(frameon=False)

# %%
# The drive pulls at half the block's height: it presses harder in front.

front = problem.surface.points[..., 0].ravel() > 0.0
pressure = block.point_pressure
print(pressure[front].mean() / pressure[~front].mean())
block.plot("block_pressure")

loads = problem.surface.weights.ravel() * pressure
assert np.isclose(loads.sum(), 55.0, rtol=1e-4)
