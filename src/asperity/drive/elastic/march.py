"""The march of elastic teeth: the loop over steps, compiled with its mesh."""

import numpy as np

from asperity.compiled import kernel
from asperity.drive.elastic.mesh import advance
from asperity.drive.interface import OUTS, POSES
from asperity.drive.motion.kernels import arrive, clear, move, next_step


@kernel
def march(mesh, system, states, committed, stretch, rows, stop):
    """March so many stretches of equal length; all as `asperity.drive.reduced.march.march`."""
    state = states[0]
    q = np.zeros(POSES)
    v = np.zeros(POSES)
    out = np.zeros(OUTS)
    here = committed.copy()
    trial = committed.copy()
    began = state.time
    done = 0
    for row in range(rows.size):
        sums = rows[row]
        clear(sums)
        end = began + (row + 1) * stretch
        while state.time < end:
            dt = next_step(system, state, end)
            move(system, state, dt, q, v)
            advance(mesh, here, trial, q, v, dt, out)
            arrive(system, state, dt, q, v, out, sums)
            here, trial = trial, here
            if state.time + 1e-12 * stretch >= end:
                state.time = end
        done += 1
        if stop[0] != 0 or not np.isfinite(state.torque):
            break
    committed[:] = here
    return done
