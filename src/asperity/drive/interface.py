r"""What the march over time asks of a mesh, whatever teeth it is made of.

A mesh is a named tuple of numbers and arrays with a compiled function

::

    advance(mesh, committed, trial, q, v, dt, out)

``q`` and ``v`` are the poses and rates at the end of a step of length ``dt``, with everything that
is imposed: the worm's angle :math:`\beta`, its shift :math:`x` along its axis, the wheel's angle
:math:`\varphi`, its shift :math:`y` along its own axis as the worm sees it, the worm's shift
:math:`z` towards the wheel's axis. Positive are: :math:`\beta` and :math:`\varphi` as the gearset
runs forward; :math:`x` as the threads move forward, so that the flank that drives pushes on;
:math:`y` as the surface of the turning worm moves at the mesh. A left-handed gearset has the same
equations, since :math:`y` turns its sign with the hand. A worm that turns by :math:`\beta` and
shifts by :math:`x = -p\beta`, the reduced lead :math:`p`, slides in itself.

``committed`` holds what the mesh remembers (contacts, asperities) and is read, ``trial`` is
written: an iteration never moves history. ``out`` is filled, its places are those of `AT`.
"""

from typing import NamedTuple

POSES = 5
"""Worm angle, worm shift, wheel angle, wheel shift, worm shift towards the wheel."""


class Places(NamedTuple):
    """Where a mesh's answer to a step has what.

    Attributes
    ----------
    worm_torque, worm_force, wheel_torque, wheel_force, worm_radial : int
        What the mesh does to the five poses, N m, N, N m, N, N.
    driving, back : int
        Normal force on the flank that drives and on the other, N.
    stored : int
        Elastic energy, of normal approach and of friction's, J.
    friction, damping : int
        Lost over the step to friction and to the contact's damping, J.
    residual : int
        Of the mesh's own equations over the scale of its forces.
    approach : int
        Largest speed at which surfaces approach or part that touch or are about to, m/s.
    """

    worm_torque: int = 0
    worm_force: int = 1
    wheel_torque: int = 2
    wheel_force: int = 3
    worm_radial: int = 4
    driving: int = 5
    back: int = 6
    stored: int = 7
    friction: int = 8
    damping: int = 9
    residual: int = 10
    approach: int = 11


AT = Places()
OUTS = len(AT)

SOLVED = 1e-6
"""Of full friction, or of a tooth's forces, that a mesh's own equations may be off by."""
