"""Dahl's law itself, step by step, as functions in C and MATLAB with the numbers of a case.

The step is `asperity.friction.advance_loaded` for law ``vector``, of any exponent, with whatever
the asperities keep under a normal force that changes. C and MATLAB are the same text twice: who
changes a line of one changes it in the other.
"""

import textwrap
from collections.abc import Sequence

from asperity.errors import InputError, plain
from asperity.slider.law_files import commented
from asperity.slider.model import Model

NAME = "asperity_dahl"

_SAID = (
    "Dahl's law in the plane of contact, exact for a slip of constant direction in each step.",
    "state: deflection of the asperities along x and y, m, and the normal force, N, at the end of "
    "the last step; at the start 0, 0 and the normal force there.",
    "velocity: mean slip velocity of the body over its base in the step, x and y, m/s.",
    "normal_force: at the end of the step, N; below 0 counts as 0, an open contact, whose "
    "asperities are straight.",
    "dt: length of the step, s, of any size.",
    "next: state at the end of the step. force: friction there, N, along x and y; it acts on the "
    "base so, and on the body against it.",
    "Finite numbers go in; nothing is kept between calls.",
)


def dahl_files(model: Model, about: Sequence[str]) -> dict[str, str]:
    """Return the step of Dahl's law as C99 with header and as MATLAB, by the names of the files.

    Parameters
    ----------
    model : Model
        A body with friction of model 'dahl' and law 'vector'; its motion is not looked at.
    about : sequence of str
        What is said of the case, a line each.

    Raises
    ------
    InputError
        For another friction model or law.
    """
    friction = model.friction
    if friction.model != "dahl":
        raise InputError(
            f"friction.model is '{friction.model}'; the law that is written step by step is "
            "'dahl': change friction.model, or take c, csv or mat for the mean friction"
        )
    if friction.law != "vector":
        raise InputError(
            f"friction.law is '{friction.law}'; the law that is written step by step is 'vector', "
            "which is the same along a line: set friction.law to 'vector'"
        )
    load = model.slider.normal_force
    numbers = {
        "length": friction.deflection_limit(load),
        "full": model.full_friction,
        "load": load,
        "power": friction.load_exponent,
        "exponent": friction.exponent,
    }
    values = {name: repr(float(value)) for name, value in numbers.items()}
    values["keeps"] = "1" if friction.keeps == "stiffness" else "0"
    told = [plain(line) for line in (*about, *_wrapped(friction.transfer))]
    stars = "\n".join(f" * {line}".rstrip() for line in commented(told))
    percents = "\n".join(f"% {line}".rstrip() for line in told)
    return {
        f"{NAME}.c": _filled(_C, stars, values),
        f"{NAME}.h": _filled(_HEADER, stars, values),
        f"{NAME}.m": _filled(_MATLAB, percents, values),
    }


def _wrapped(transfer: float) -> list[str]:
    said = list(_SAID)
    if transfer != 1.0:
        said.append(
            f"Of a vibration along y the share friction.transfer = {transfer:g} reaches the "
            "contact: multiply its velocity by it before it goes in."
        )
    return [line for text in said for line in textwrap.wrap(text, 92)]


def _filled(text: str, told: str, values: dict[str, str]) -> str:
    # Braces are the C language's own, so that names stand between @.
    for name, value in values.items():
        text = text.replace(f"@{name}@", value)
    return text.replace("@told@", told)


_HEADER = f"""\
/*
@told@
 */
#ifndef {NAME.upper()}_H
#define {NAME.upper()}_H

#ifdef __cplusplus
extern "C" {{
#endif

/* next may be state itself. */
void {NAME}(const double state[3], const double velocity[2], double normal_force, double dt,
                   double next[3], double force[2]);

#ifdef __cplusplus
}}
#endif

#endif
"""

_C = """\
/*
@told@
 */
#include "asperity_dahl.h"

#include <math.h>

#define LENGTH @length@ /* deflection at full friction under LOAD, m */
#define FULL @full@ /* friction force at full slip under LOAD, N */
#define LOAD @load@ /* N */
#define POWER @power@ /* of the normal force, with which friction goes */
#define EXPONENT @exponent@ /* Dahl's */
#define KEEPS_STIFFNESS @keeps@ /* as the normal force changes; 0: LENGTH */
#define TINY 1e-150

/* Friction force at full slip over FULL. */
static double limit_at(double normal_force)
{
    const double share = normal_force > 0.0 ? normal_force / LOAD : 0.0;
    if (POWER == 1.0)
        return share;
    return pow(share, POWER);
}

/* Deflection after a slip d of constant direction; both over their limit. */
static void relax(double sx, double sy, double dx, double dy, double *wx, double *wy)
{
    const double length = sqrt(dx * dx + dy * dy);
    double nx, ny, rho, base, left, gain;
    if (length <= TINY) {
        *wx = sx + dx;
        *wy = sy + dy;
        return;
    }
    if (EXPONENT == 1.0) {
        left = exp(-length);
        gain = -expm1(-length) / length;
        *wx = sx * left + dx * gain;
        *wy = sy * left + dy * gain;
        return;
    }
    nx = dx / length;
    ny = dy / length;
    rho = sqrt((nx - sx) * (nx - sx) + (ny - sy) * (ny - sy));
    left = 0.0;
    if (rho > TINY) {
        base = 1.0 - (1.0 - EXPONENT) * length * pow(rho, EXPONENT - 1.0);
        if (base > 0.0)
            left = pow(base, 1.0 / (1.0 - EXPONENT));
    }
    *wx = nx - left * (nx - sx);
    *wy = ny - left * (ny - sy);
}

/* How an asperity at its limit turns to the slip, over the part of the slip across it. */
static double turning(double sx, double sy, double dx, double dy, double limit_1)
{
    double length, cosine, base, rate;
    if (EXPONENT == 1.0)
        return 1.0;
    length = sqrt(dx * dx + dy * dy);
    cosine = (dx * sx + dy * sy) / (length * sqrt(sx * sx + sy * sy));
    base = fmax(2.0 - 2.0 * cosine, 0.0);
    rate = limit_1 / length;
    if (base > 0.0 || EXPONENT > 1.0)
        rate = fmin(pow(base, 0.5 * (EXPONENT - 1.0)), rate);
    return fmax(0.5 * (3.0 - EXPONENT), 0.0) * rate;
}

void asperity_dahl(const double state[3], const double velocity[2], double normal_force, double dt,
                   double next[3], double force[2])
{
    const double limit_0 = limit_at(state[2]);
    const double limit_1 = limit_at(normal_force);
    const double sx = state[0] / LENGTH;
    const double sy = state[1] / LENGTH;
    const double dx = velocity[0] * dt / LENGTH;
    const double dy = velocity[1] * dt / LENGTH;
    double wx = 0.0, wy = 0.0, limit = 1.0, share = limit_1;
    double above, most, size, turn;
    if (KEEPS_STIFFNESS) {
        share = 1.0;
        limit = 0.5 * (limit_0 + limit_1);
        if (EXPONENT == 0.0)
            limit = limit_1;
    }
    if (limit_1 > TINY) {
        relax(sx / limit, sy / limit, dx / limit, dy / limit, &wx, &wy);
        wx = wx * limit;
        wy = wy * limit;
        if (KEEPS_STIFFNESS && limit_1 < limit_0) {
            /* The limit fell: what stands above it slips back, and turns to the slip meanwhile. */
            above = fmax(1.0, sqrt(sx * sx + sy * sy) / limit_0);
            most = limit_1 * above;
            size = sqrt(wx * wx + wy * wy);
            if (size > most) {
                turn = 0.0;
                if (EXPONENT > 0.0 && fabs(sx * dy - sy * dx) > 0.0)
                    turn = turning(sx, sy, dx, dy, limit_1) * (size - most)
                        / ((limit_0 + limit_1) * above);
                wx = wx + turn * dx;
                wy = wy + turn * dy;
                size = sqrt(wx * wx + wy * wy);
                wx = wx * (most / size);
                wy = wy * (most / size);
            }
        }
    }
    next[0] = LENGTH * wx;
    next[1] = LENGTH * wy;
    next[2] = normal_force > 0.0 ? normal_force : 0.0;
    force[0] = FULL * share * wx;
    force[1] = FULL * share * wy;
}
"""

_MATLAB = """\
function [next, force] = asperity_dahl(state, velocity, normal_force, dt)
%#codegen
@told@
%
% In Simulink: a MATLAB Function block of sample time dt; a Unit Delay leads next back to state, its
% initial condition is [0; 0; normal force].

next = zeros(3, 1);
force = zeros(2, 1);
len = @length@;  % deflection at full friction under load_0, m
full_friction = @full@;  % friction force at full slip under load_0, N
load_0 = @load@;  % N
load_power = @power@;  % of the normal force, with which friction goes
expo = @exponent@;  % Dahl's exponent
keeps_stiffness = @keeps@;  % as the normal force changes; 0: len
tiny = 1e-150;

limit_0 = limit_at(state(3), load_0, load_power);
limit_1 = limit_at(normal_force, load_0, load_power);
sx = state(1) / len;
sy = state(2) / len;
dx = velocity(1) * dt / len;
dy = velocity(2) * dt / len;
wx = 0.0;
wy = 0.0;
limit = 1.0;
share = limit_1;
if keeps_stiffness > 0
    share = 1.0;
    limit = 0.5 * (limit_0 + limit_1);
    if expo == 0.0
        limit = limit_1;
    end
end
if limit_1 > tiny
    [wx, wy] = relax(sx / limit, sy / limit, dx / limit, dy / limit, expo, tiny);
    wx = wx * limit;
    wy = wy * limit;
    if keeps_stiffness > 0 && limit_1 < limit_0
        % The limit fell: what stands above it slips back, and turns to the slip meanwhile.
        above = max(1.0, sqrt(sx * sx + sy * sy) / limit_0);
        most = limit_1 * above;
        size_w = sqrt(wx * wx + wy * wy);
        if size_w > most
            turn = 0.0;
            if expo > 0.0 && abs(sx * dy - sy * dx) > 0.0
                turn = turning(sx, sy, dx, dy, limit_1, expo);
                turn = turn * (size_w - most) / ((limit_0 + limit_1) * above);
            end
            wx = wx + turn * dx;
            wy = wy + turn * dy;
            size_w = sqrt(wx * wx + wy * wy);
            wx = wx * (most / size_w);
            wy = wy * (most / size_w);
        end
    end
end
next(1) = len * wx;
next(2) = len * wy;
next(3) = max(normal_force, 0.0);
force(1) = full_friction * share * wx;
force(2) = full_friction * share * wy;
end

function limit = limit_at(normal_force, load_0, load_power)
% Friction force at full slip over full_friction.
limit = max(normal_force, 0.0) / load_0;
if abs(load_power - 1.0) > 0.0
    limit = limit ^ load_power;
end
end

function [wx, wy] = relax(sx, sy, dx, dy, expo, tiny)
% Deflection after a slip d of constant direction; both over their limit.
slip = sqrt(dx * dx + dy * dy);
if slip <= tiny
    wx = sx + dx;
    wy = sy + dy;
elseif expo == 1.0
    left = exp(-slip);
    gain = -expm1(-slip) / slip;
    wx = sx * left + dx * gain;
    wy = sy * left + dy * gain;
else
    nx = dx / slip;
    ny = dy / slip;
    rho = sqrt((nx - sx) * (nx - sx) + (ny - sy) * (ny - sy));
    left = 0.0;
    if rho > tiny
        base = 1.0 - (1.0 - expo) * slip * rho ^ (expo - 1.0);
        if base > 0.0
            left = base ^ (1.0 / (1.0 - expo));
        end
    end
    wx = nx - left * (nx - sx);
    wy = ny - left * (ny - sy);
end
end

function turn = turning(sx, sy, dx, dy, limit_1, expo)
% How an asperity at its limit turns to the slip, over the part of the slip across it.
turn = 1.0;
if abs(expo - 1.0) > 0.0
    slip = sqrt(dx * dx + dy * dy);
    cosine = (dx * sx + dy * sy) / (slip * sqrt(sx * sx + sy * sy));
    base = max(2.0 - 2.0 * cosine, 0.0);
    rate = limit_1 / slip;
    if base > 0.0 || expo > 1.0
        rate = min(base ^ (0.5 * (expo - 1.0)), rate);
    end
    turn = max(0.5 * (3.0 - expo), 0.0) * rate;
end
end
"""
