"""
How a worm wheel bears on its worm
==================================

The wheel of a worm gearset is cut by a hob. Were the hob the worm itself, both would touch along
whole lines, and the least misalignment would push the contact to an edge. So the hob is made
larger, and tilted to bring the contact back to the middle. Here is a hob 12 % larger, first without
a tilt and then with one of 2 degrees, and what is left when the shafts are not quite square.
"""

import matplotlib.pyplot as plt
import numpy as np

from asperity.casefile import read_case
from asperity.flanks.study.flank import prepare, study
from asperity.flanks.tables import TABLES as FLANKS
from asperity.rating.tables import TABLES as RATING
from asperity.results.figures import STYLE

TABLES = {**RATING, **FLANKS}


def found(*settings):
    case = read_case("gearset-3b", TABLES, ["mount.backlash=0.05 mm", *settings])
    return study(prepare(case, density="coarse"))


# %%
# Where a marking compound of 6 micrometres is squeezed out. Without a tilt that is near the edge of
# the face.

straight, tilted = found("hob.tilt=0 deg"), found()
plt.rcParams.update(STYLE)
figure, panels = plt.subplots(1, 2, figsize=(8, 3.2), sharey=True, layout="constrained")
centres = []
for axes, title, each in zip(panels, ("no tilt", "2° of tilt"), (straight, tilted), strict=True):
    flank = each.analysis.flanks[1]
    face, radius = flank.grid.z, flank.grid.radius
    axes.contourf(face, radius, 0.0 * face, levels=[-1.0, 1.0], colors=["#EEEEEE"])
    thickness = np.maximum(1e3 * flank.pattern.gap, 0.0)
    gap = axes.contourf(face, radius, thickness, levels=np.linspace(0.0, 6.0, 7))
    axes.set(title=title, xlabel="distance from mid-face (mm)")
    centres.append(flank.pattern.centre[0])
panels[0].set_ylabel("distance from the wheel's axis (mm)")
figure.colorbar(gap, ax=panels, label="gap (µm)")
print(f"centre of the pattern {centres[0]:.1f} mm from mid-face, with the tilt {centres[1]:.1f} mm")

# %%
# With both flanks involute and of one base pitch, the transmission stays even however the worm
# stands; a straight-sided worm (ZA) pays for a shaft angle that is 0.1 degrees wrong.

figure, axes = plt.subplots(figsize=(7, 3.2), layout="constrained")
errors, shown = {}, {}
for kind in ("ZI", "ZA"):
    wrong = found(f"gearset.flank={kind}", "mount.shaft_angle_error=0.1 deg")
    mesh = wrong.analysis.flanks[1].transmission
    errors[kind] = mesh.peak_to_peak
    even = errors[kind] < mesh.resolution("peak_to_peak")
    shown[kind] = "none" if even else f"{1e6 * errors[kind]:.3g} µrad"
    axes.plot(np.degrees(mesh.wheel_angle), 1e6 * (mesh.error - mesh.mean), label=kind)
axes.set(xlabel="angle of the wheel (°)", ylabel="transmission error (µrad)")
axes.legend(frameon=False)
print(shown)

# %%
# What a vibration would do there. A worm that vibrates along its axis moves mostly along the normal
# of the flanks, and would open the contact rather than slide in it; a wheel that vibrates along its
# axis moves along the sliding. The play bounds the first.

vibration = tilted.to_json()["vibration"]
for direction, parts in vibration.items():
    print(f"{direction:12s}", {part: round(value, 2) for part, value in parts.items()})
room = tilted.analysis.play.amplitude
print(f"the worm can vibrate along its axis with {1e3 * room:.0f} µm at most")
