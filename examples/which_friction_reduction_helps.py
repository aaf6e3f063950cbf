"""
Which friction reduction helps a worm gearset
=============================================

Oils, additives and coatings against vibration, in a worm gearset of low efficiency. The vibration
is once as it is quoted, and once as the friction between the teeth answers to an amplitude that a
transducer reaches; and what it takes counts too.
"""

import matplotlib.pyplot as plt
import numpy as np

from asperity.casefile import read_case
from asperity.gearset import Gearset
from asperity.rating import Operation
from asperity.rating.tables import TABLES
from asperity.results.figures import STYLE
from asperity.studies.methods import compare
from asperity.vibration import Vibration

case = read_case("gearset-2", TABLES)
gearset, operation = case.require(Gearset), case.require(Operation)

# %%
# All of them. A reduction acts on the base coefficient of friction of ISO/TR 14521. Diamonds are
# efficiencies that count the power of the vibration.

comparison = compare(gearset, operation)
figure = comparison.plot()
for note in comparison.notes:
    print(f"- {note}")

# %%
# How much vibration is worth it? Along the sliding it does nothing until its peak velocity exceeds
# the sliding velocity of 1.39 m/s, which takes 11 micrometres at 20 kHz. The less friction is left
# between the teeth, the more power the vibration needs: an amplitude that makes the drive lighter
# does not make it thriftier.

amplitudes = np.linspace(0.0, 60e-6, 61)
plt.rcParams.update(STYLE)
figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
efficiency, counted = {}, {}
for key, style in (("longitudinal", "-"), ("transverse", "--")):
    rows = [
        compare(
            gearset, operation, methods=[],
            vibration=Vibration(frequency="20 kHz", displacement_amplitude=amplitude, units="SI"),
        )[key]
        for amplitude in amplitudes
    ]  # fmt: skip
    efficiency[key] = np.array([row.efficiency for row in rows])
    counted[key] = np.array([row.efficiency_with_vibration for row in rows])
    axes.plot(1e6 * amplitudes, 100 * efficiency[key], style, color="C0", label=f"{key}, drive")
    axes.plot(
        1e6 * amplitudes, 100 * counted[key], style, color="C1", label=f"{key}, with its power"
    )
axes.set(xlabel="amplitude at 20 kHz (µm)", ylabel="efficiency of the teeth (%)", xlim=(0, 60))
axes.set_ylim(0, 100)
axes.legend(frameon=False)

best = max(row.max() for row in counted.values())
without = efficiency["transverse"][0]
print(f"with its power counted never above {best:.1%}; without vibration {without:.1%}")
