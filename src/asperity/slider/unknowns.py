"""What shooting looks for in a body's state: taken from it, put into it, and by what measured."""

import math

import numpy as np

from asperity.kernels.compiled import kernel
from asperity.slider.scaled import COULOMB, SPRINGS


@kernel
def _slides_across(p):
    """Whether anything moves across the drive."""
    return p.base_y != 0.0 or p.mobility_y > 0.0


@kernel
def most_unknowns(springs):
    """Return the most unknowns a body with such springs can have."""
    return 7 + springs.size


@kernel
def read_unknowns(state, springs, p, q, unknowns):
    """Take the unknowns a body has from its state; returns how many they are."""
    count = 0
    if not p.rigid:
        unknowns[count] = state.stretch
        unknowns[count + 1] = state.velocity_x
        count += 2
    # A lateral motion the contact does not see (transfer 0) is as periodic at one speed as another.
    if p.mobility_y > 0.0 and p.own_1 + p.own_2 > 0.0:
        unknowns[count] = state.velocity_y
        count += 1
    if p.model != COULOMB and p.model != SPRINGS:
        unknowns[count] = state.deflection_x
        unknowns[count + 1] = state.deflection_y
        count += 2
    if q is not None:
        if q.mobility > 0.0:
            unknowns[count] = state.penetration
            unknowns[count + 1] = state.rise
            count += 2
        for axis in range(2 if _slides_across(p) else 1):
            for j in range(springs.shape[1]):
                unknowns[count] = springs[axis, j]
                count += 1
    return count


@kernel
def write_unknowns(unknowns, p, q, state, springs):
    """Put the unknowns into a state, as `read_unknowns` takes them from it."""
    count = 0
    if not p.rigid:
        state.stretch = unknowns[count]
        state.velocity_x = unknowns[count + 1]
        count += 2
    if p.mobility_y > 0.0 and p.own_1 + p.own_2 > 0.0:
        state.velocity_y = unknowns[count]
        count += 1
    if p.model != COULOMB and p.model != SPRINGS:
        state.deflection_x = unknowns[count]
        state.deflection_y = unknowns[count + 1]
        count += 2
    if q is not None:
        if q.mobility > 0.0:
            state.penetration = unknowns[count]
            state.rise = unknowns[count + 1]
            count += 2
        for axis in range(2 if _slides_across(p) else 1):
            for j in range(springs.shape[1]):
                springs[axis, j] = unknowns[count]
                count += 1


@kernel
def unknown_scales(state, springs, p, q, scales):
    """Size each unknown is measured by; returns how many they are."""
    sizes = np.zeros_like(state)
    if not p.rigid:
        sizes[0].stretch = 1.0 / p.stiffness
    sizes[0].velocity_x = p.drive
    sizes[0].velocity_y = p.drive
    sizes[0].deflection_x = 1.0
    sizes[0].deflection_y = 1.0
    if q is not None:
        sizes[0].penetration = 1.0
        sizes[0].rise = math.sqrt(q.mobility)
    return read_unknowns(sizes[0], np.ones_like(springs), p, q, scales)
