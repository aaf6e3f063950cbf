"""The march of elastic teeth: the loop over steps, compiled with its mesh."""

import numpy as np

from asperity.drive.elastic.mesh import advance
from asperity.drive.elastic.near import forget
from asperity.drive.interface import AT, OUTS, POSES, SOLVED
from asperity.drive.motion.kernels import arrive, clear, move, next_step
from asperity.kernels.compiled import kernel
from asperity.kernels.dense import copy

_LEAST = 1.0 / 64.0  # of a step that a tooth is not solved for


@kernel
def march(mesh, system, states, committed, stretch, rows, stop):
    """March so many stretches of equal length; all as `asperity.drive.reduced.march.march`.

    A step that a tooth is not solved for is taken in parts, down to a 64th of it.
    """
    state = states[0]
    q = np.zeros(POSES)
    v = np.zeros(POSES)
    out = np.zeros(OUTS)
    here = np.empty_like(committed)
    trial = np.empty_like(committed)
    copy(committed, here)
    copy(committed, trial)
    began = state.time
    done = 0
    forget(mesh)
    for row in range(rows.size):
        sums = rows[row]
        clear(sums)
        end = began + (row + 1) * stretch
        while state.time < end:
            dt = next_step(system, state, end)
            least = _LEAST * dt
            move(system, state, dt, q, v)
            advance(mesh, here, trial, q, v, dt, out)
            while not out[AT.residual] <= SOLVED and dt > least:
                dt *= 0.5
                move(system, state, dt, q, v)
                advance(mesh, here, trial, q, v, dt, out)
            arrive(system, state, dt, q, v, out, sums)
            if not out[AT.residual] <= SOLVED:
                copy(here, committed)
                return done
            here, trial = trial, here
            if state.time + 1e-12 * stretch >= end:
                state.time = end
        done += 1
        if stop[0] != 0 or not np.isfinite(state.torque):
            break
    copy(here, committed)
    return done
