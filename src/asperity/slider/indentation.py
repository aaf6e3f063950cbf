"""How deep a contact is pressed: the motion normal to the plane alone, from rest.

It asks nothing of what happens in the plane, and so is known before the springs of a contact are
laid out to the depth they need.
"""

from asperity.kernels.compiled import kernel
from asperity.normal import elastic_force, indentation
from asperity.slider.pressed import node_load
from asperity.vibration.waveform import displacement_at


@kernel
def greatest_indentation(q, wave, cycles_per_step, steps):
    """Return the greatest `indentation` of a march of `asperity.slider.pressed.march_pressed`."""
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
        rate = 0.5 * (height + q.base * (there - here)) - rise
        elastic = elastic_force(q.law, d)
        load = node_load(elastic, rate, 0.5 * q.mobility, q.damping)
        deepest = max(deepest, indentation(q.law, d, elastic, load))
        rise += q.mobility * (load - 1.0)
    return deepest
