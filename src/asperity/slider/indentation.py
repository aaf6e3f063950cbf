"""How deep a contact is pressed: the motion normal to the plane alone, from rest.

It asks nothing of what happens in the plane, and so is known before the springs of a contact are
laid out to the depth they need.
"""

from asperity.compiled import kernel
from asperity.normal import elastic_force
from asperity.slider.pressed import node_load
from asperity.vibration import displacement_at


@kernel
def greatest_penetration(q, wave, cycles_per_step, steps):
    """Return the greatest penetration of a march of `asperity.slider.pressed.march_pressed`."""
    d = q.reference
    if q.mobility == 0.0:
        d += q.base * displacement_at(wave, 0.0)
    deepest = d
    rise = 0.0
    here = displacement_at(wave, 0.0)
    there = displacement_at(wave, cycles_per_step)
    for n in range(steps):
        height = q.base * (there - here)
        here = there
        there = displacement_at(wave, (n + 2) * cycles_per_step)
        d += height - rise
        deepest = max(deepest, d)
        rate = 0.5 * (height + q.base * (there - here)) - rise
        load = node_load(elastic_force(q.law, d), rate, 0.5 * q.mobility, q.damping)
        rise += q.mobility * (load - 1.0)
    return deepest
