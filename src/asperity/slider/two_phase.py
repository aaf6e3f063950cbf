r"""The thesis's coupled model marched as printed: Table 4.2, equations (38)-(59) and (77)-(91).

For the base vibrated (4.5): (42) takes the base's increment :math:`\Delta x_b` stored in the
previous step, the drive force (20) follows from the position so obtained, which is relative to the
base, and the forces of the previous step drive a semi-implicit Euler step of the body. For the
body vibrated (7.3) the prescribed motion is added to the body's own, and the drive sees its own.

Defects beyond those of the explicit update (`asperity.friction.two_phase`): the drive force
contains an undulation :math:`k_d x_b` that is not physical (0.026 N peak to peak in the thesis's
case at k = 6 instead of 0.003 N) and a real error at low frequency, and the power ledger does not
close. Without the stored increment the coupled directions come out differently.
"""

from asperity.compiled import kernel
from asperity.friction.two_phase import phases
from asperity.slider.kernels import (
    BREAKAWAY,
    FD,
    FX,
    FY,
    MAX_FX,
    MAX_FY,
    MIN_FX,
    MIN_FY,
    STATE,
    STEPS,
    STRETCH,
    SUM_DRAG,
    SUM_FD,
    SUM_FX,
    SUM_FY,
    SUM_SLIP,
    SUM_VX,
    SUM_VY,
    SX,
    SY,
    WX,
    WY,
    Y,
)
from asperity.slider.model import (
    BASE_X,
    BASE_Y,
    CHI,
    DRIVE,
    EXPONENT,
    GIVE_X,
    GIVE_Y,
    KAPPA,
    OWN_2,
    RIGID,
)
from asperity.vibration import fill_increments


@kernel
def march_two_phase(
    state, extra, sums, p, waveform, rise, table, first_cycles, cycles_per_step,
    records, stride, increments, history, on_body,
):  # fmt: skip
    """March ``records`` stretches of ``stride`` steps, writing the state after each.

    ``extra`` keeps the asperity's direction and the stored increment of the base between calls.
    """
    rigid = p[RIGID] > 0.0
    for r in range(records):
        first = first_cycles + r * stride * cycles_per_step
        fill_increments(waveform, rise, table, first, cycles_per_step, increments)
        for n in range(stride):
            u = increments[n]
            ux = p[BASE_X] * u
            uy = p[BASE_Y] * u
            fx = state[FX]
            fy = state[FY]
            fd = state[FD]
            wx = state[WX]
            if not rigid:
                wx += p[GIVE_X] * (fd - fx)
            wy = state[WY] - p[GIVE_Y] * fy
            way_x = wx if on_body else wx - extra[2]
            stretch = state[STRETCH] + p[DRIVE] - way_x
            if on_body:
                d1x, d1y, d2y = wx - ux, 0.0, p[OWN_2] * wy - uy
            else:
                d1x, d1y, d2y = way_x, wy, -uy
            one_sided = first + (n + 1) * cycles_per_step <= 0.0
            size = state[SX] * extra[0] + state[SY] * extra[1]
            size, ca, sa = phases(
                size, extra[0], extra[1], d1x, d1y, 0.0, d2y, p[EXPONENT], one_sided
            )
            extra[0] = ca
            extra[1] = sa
            extra[2] = ux
            state[SX] = size * ca
            state[SY] = size * sa
            state[FX] = size * ca
            state[FY] = size * sa
            state[WX] = wx
            state[WY] = wy
            state[Y] += wy
            state[STRETCH] = stretch
            drag = p[CHI] * (p[DRIVE] - wx)
            state[FD] = state[FX] if rigid else p[KAPPA] * stretch + drag
            mx = 0.5 * (fx + state[FX])
            my = 0.5 * (fy + state[FY])
            sums[SUM_FD] += 0.5 * (fd + state[FD])
            sums[SUM_FX] += mx
            sums[SUM_FY] += my
            sums[SUM_VX] += mx * u
            sums[SUM_VY] += my * u
            sums[SUM_SLIP] += mx * (d1x if on_body else wx - ux) + my * (d1y + d2y)
            if not rigid:
                sums[SUM_DRAG] += drag * (p[DRIVE] - wx)
            sums[MAX_FX] = max(sums[MAX_FX], state[FX])
            sums[MIN_FX] = min(sums[MIN_FX], state[FX])
            sums[MAX_FY] = max(sums[MAX_FY], state[FY])
            sums[MIN_FY] = min(sums[MIN_FY], state[FY])
            sums[STEPS] += 1.0
            if sums[BREAKAWAY] < 0.0:
                sums[BREAKAWAY] -= 1.0
                if state[FD] >= 1.0 and not rigid:
                    sums[BREAKAWAY] = -1.0 - sums[BREAKAWAY]
        for i in range(STATE):
            history[r, i] = state[i]
