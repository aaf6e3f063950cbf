"""The march of the reduced mesh: the loop over steps, compiled with its mesh."""

import math

from asperity.drive.motion.kernels import arrive, clear, move, next_step
from asperity.drive.reduced.mesh import advance
from asperity.kernels.compiled import kernel
from asperity.kernels.uncounted import uncounted


@uncounted
@kernel
def march(mesh, system, states, committed, trial, poses, out, stretch, rows, stop):
    """March so many stretches of equal length, each summed up in a row.

    Parameters
    ----------
    mesh, system
        `asperity.drive.reduced.mesh.Mesh` and `asperity.drive.motion.system.System`.
    states : record array of one `STATE`
        Where it stands; walks on.
    committed, trial : ndarray
        What the mesh remembers; walks on. Room for as much.
    poses : ndarray, shape (2, POSES)
        Room for poses and rates.
    out : ndarray, shape (OUTS,)
        Room for what the mesh answers.
    stretch : float
        Length, s.
    rows : record array of `SUMS`
        Filled.
    stop : ndarray of int64, shape (1,)
        Set to 1 from another thread, it ends the march after the stretch.

    Returns
    -------
    int
        Stretches that were marched.
    """
    state = states[0]
    q = poses[0]
    v = poses[1]
    here = committed
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
        if stop[0] != 0 or not math.isfinite(state.torque):
            break
    for place in range(committed.size):
        committed[place] = here[place]
    return done
