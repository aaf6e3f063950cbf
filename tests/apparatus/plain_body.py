r"""A sliding body by plain means, for the package's ways to be compared with.

Written from the equations of motion alone; of the package it takes the tables of a case and nothing
that calculates. In absolute coordinates, with the contact's slip :math:`v = v_1 + v_2`:

- Dahl and LuGre: classical Runge-Kutta of fourth order on
  :math:`\dot s = v - (a/s_{max}) s` in the form each law has, the deflection brought back to its
  limit where the load lets that fall below it;
- Coulomb: tiny implicit steps, the friction found by halving an interval;
- springs: many of them, moved and cut off at their limits in tiny steps.

Steps end on the corners of the waveform. Everything is done twice, in half the steps, until it no
longer matters: `solved` tells by how much it does.
"""

import math
from typing import NamedTuple

import numpy as np

from apparatus import kept
from asperity.kernels.compiled import kernel

DAHL, LUGRE, COULOMB, SPRINGS = range(4)
SPLIT, UNSPLIT, VECTOR = range(3)
CONSTANT, LINEAR, HERTZ, ROUGH = range(4)
MODELS = {"dahl": DAHL, "lugre": LUGRE, "coulomb": COULOMB, "springs": SPRINGS}
LAWS = {"split": SPLIT, "unsplit": UNSPLIT, "vector": VECTOR}
NORMALS = {None: CONSTANT, "linear": LINEAR, "hertz": HERTZ, "rough": ROUGH}
FEET = 64
MOST_STEPS = 25_000
ASKEW = 1e-6  # rad


class Body(NamedTuple):
    """Numbers of a body in SI; ``own_1`` and ``own_2`` of its sideways motion are in the slip."""

    drive: float
    stiffness: float
    damping: float
    mass: float
    rigid: bool
    free: bool
    model: int
    law: int
    exponent: float
    full: float
    limit: float
    static_ratio: float
    stribeck: float
    rate_damping: float
    viscous: float
    keeps_deflection: bool
    own_1: float
    own_2: float
    base_x: float
    base_y: float
    base_z: float
    normal: int
    dead: bool
    load: float
    length: float
    loss: float
    power: float


class Found(NamedTuple):
    """Mean drive force over mu F_N, mean load over F_N; what half the steps change of either."""

    ratio: float
    load: float
    error: float
    steps: int


def harmonics(phase, order):
    """Displacement (0) or velocity over the phase (1) of the sampled wave, not normalised."""
    turn = 2.0 * np.pi * np.asarray(phase)
    terms = ((1.0, 1, 0.0), (0.3, 2, 0.5), (0.15, 3, 2.0))
    if order == 0:
        return sum(a * np.sin(n * turn + at) for a, n, at in terms)
    return sum(2.0 * np.pi * n * a * np.cos(n * turn + at) for a, n, at in terms)


def _middle_and_half():
    fine = harmonics(np.linspace(0.0, 1.0, 100_001), 0)
    return 0.5 * (fine.max() + fine.min()), 0.5 * (fine.max() - fine.min())


def samples(frequency, count=240):
    """Text of a file of that wave."""
    phase = np.linspace(0.0, 1.0, count + 1)
    rows = zip((phase / frequency).tolist(), harmonics(phase, 0).tolist(), strict=True)
    return "time,displacement\n" + "\n".join(f"{t!r},{u!r}" for t, u in rows) + "\n"


class Wave:
    """A waveform of unit amplitude over its phase."""

    def __init__(self, waveform, rise=0.0):
        self.waveform, self.rise = waveform, rise
        # The package takes the mean of the samples away, not the middle between their ends.
        self.half = _middle_and_half()[1] if waveform == "sampled" else 1.0

    @property
    def corners(self):
        if self.waveform == "triangle":
            return [0.25, 0.75]
        if self.waveform == "square":
            half = 0.5 * self.rise
            return [half, 0.5 - half, 0.5 + half, 1.0 - half]
        return []

    @property
    def steepness(self):
        """Peak velocity over amplitude and frequency."""
        if self.waveform == "sampled":
            fine = np.linspace(0.0, 1.0, 100_001)
            return float(np.abs(harmonics(fine, 1)).max()) / self.half
        return {"sine": 2.0 * math.pi, "triangle": 4.0}.get(self.waveform) or 2.0 / self.rise

    def place(self, phase):
        phase = np.asarray(phase) % 1.0
        if self.waveform == "sine":
            return np.sin(2.0 * np.pi * phase)
        if self.waveform == "sampled":
            return harmonics(phase, 0) / self.half
        off = np.where(phase < 0.25, phase, np.where(phase < 0.75, 0.5 - phase, phase - 1.0))
        if self.waveform == "triangle":
            return 4.0 * off
        return np.clip(2.0 * off / self.rise, -1.0, 1.0)

    def speed(self, phase, within):
        """Velocity over frequency; of straight flanks, that at a phase ``within`` the step."""
        if self.waveform == "sine":
            return 2.0 * np.pi * np.cos(2.0 * np.pi * np.asarray(phase))
        if self.waveform == "sampled":
            return harmonics(phase, 1) / self.half
        within = np.asarray(within) % 1.0
        sign = np.where((within > 0.25) & (within < 0.75), -1.0, 1.0)
        if self.waveform == "triangle":
            return 4.0 * sign
        off = np.minimum(np.minimum(within, 1.0 - within), np.abs(within - 0.5))
        return np.where(off < 0.5 * self.rise, 2.0 * sign / self.rise, 0.0)


class Cycle(NamedTuple):
    """Steps of a cycle and the wave at begin, middle and end of each: times, speeds, places."""

    step: np.ndarray
    speed: np.ndarray
    rise_speed: np.ndarray
    rise: np.ndarray
    way: np.ndarray


def cycle_of(wave, lead, frequency, steps):
    """Return a cycle's steps, which end on the corners of both parts of the wave."""
    corners = [*wave.corners, *((corner - lead) % 1.0 for corner in wave.corners)] if lead else (
        wave.corners
    )  # fmt: skip
    edges = np.unique(np.concatenate([[0.0, 1.0], corners]))
    edges = edges[np.append(np.diff(edges) > 1e-12, True)]
    counts = np.maximum(np.ceil(np.diff(edges) * steps).astype(int), 4)
    parts = zip(edges[:-1], edges[1:], counts, strict=True)
    nodes = np.concatenate([*(np.linspace(a, b, n, endpoint=False) for a, b, n in parts), [1.0]])
    begin, end = nodes[:-1], nodes[1:]
    middle = 0.5 * (begin + end)
    phases = np.stack([begin, middle, end], axis=1)
    within = np.repeat(middle[:, None], 3, axis=1)
    return Cycle(
        (end - begin) / frequency,
        frequency * wave.speed(phases, within),
        frequency * wave.speed(phases + lead, within + lead),
        wave.place(phases + lead),
        wave.place(end) - wave.place(begin),
    )


@kernel
def elastic(p, d):
    """Elastic force between the bodies at a penetration ``d``, N."""
    if p.normal == ROUGH:
        return p.load * math.exp(d / p.length)
    if d <= 0.0:
        return 0.0
    if p.normal == HERTZ:
        return p.load * (d / (1.5 * p.length)) ** 1.5
    return p.load * d / p.length


@kernel
def share_of(p, force):
    """Friction limit over that under the load W."""
    return (force / p.load) ** p.power


@kernel
def lost(u, size, exponent):
    """What Dahl's asperity of a relative size loses of a slip ``u`` along itself."""
    if exponent == 1.0:
        return abs(u) * size  # of LuGre's asperity too, which may stand beyond its limit
    left = 1.0 - size if u >= 0.0 else 1.0 + size
    if left <= 0.0:
        return u
    return u * (1.0 - left**exponent)


@kernel
def deflecting(p, sx, sy, v1x, v1y, v2y, limit):
    """Rate of the deflection under the two parts of a slip, at a limit above 0."""
    vx = v1x
    vy = v1y + v2y
    if p.law == VECTOR:
        speed = math.sqrt(vx * vx + vy * vy)
        if speed == 0.0:
            return 0.0, 0.0
        wx = vx / speed - sx / limit
        wy = vy / speed - sy / limit
        size = math.sqrt(wx * wx + wy * wy)
        if size == 0.0:
            return 0.0, 0.0
        pace = speed * size ** (p.exponent - 1.0)
        return pace * wx, pace * wy
    size = math.sqrt(sx * sx + sy * sy)
    if size == 0.0:
        return vx, vy
    ex = sx / size
    ey = sy / size
    if p.law == UNSPLIT:
        off = lost(ex * vx + ey * vy, size / limit, p.exponent)
    else:
        off = lost(ex * v1x + ey * v1y, size / limit, p.exponent)
        off += lost(ey * v2y, size / limit, p.exponent)
    return vx - ex * off, vy - ey * off


@kernel
def rates(p, e, vx, vy, sx, sy, z, w, speed, rise_speed, rise, rest):
    """Derivatives of stretch, velocities, deflection and height; drive force and load."""
    share = 1.0
    force = p.load
    if p.normal != CONSTANT:
        d = rest + p.base_z * rise - z
        force = max(elastic(p, d) * (1.0 + p.loss * (p.base_z * rise_speed - w)), 0.0)
        share = share_of(p, force)
    v1x = vx - p.base_x * speed
    v1y = p.own_1 * vy
    v2y = p.own_2 * vy - p.base_y * speed
    slip_y = v1y + v2y
    limit = p.limit
    if p.model == LUGRE and p.stribeck > 0.0:
        fast = math.sqrt(v1x * v1x + slip_y * slip_y) / p.stribeck
        limit *= 1.0 + (p.static_ratio - 1.0) * math.exp(-fast * fast)
    stiffness = p.full / p.limit
    if p.keeps_deflection:
        stiffness *= share
    else:
        limit *= share
    rx = 0.0
    ry = 0.0
    if share > 1e-12:
        rx, ry = deflecting(p, sx, sy, v1x, v1y, v2y, limit)
    fx = stiffness * sx + share * (p.rate_damping * rx + p.viscous * v1x)
    fy = stiffness * sy + share * (p.rate_damping * ry + p.viscous * slip_y)
    if p.rigid:
        fd = fx
        ax = 0.0
    else:
        fd = p.stiffness * e + p.damping * (p.drive - vx)
        ax = (fd - fx) / p.mass
    ay = -fy / p.mass if p.free else 0.0
    az = (force - p.load) / p.mass if p.dead else 0.0
    return p.drive - vx, ax, ay, rx, ry, w, az, fd, force


@kernel
def follow(p, step, speed, rise_speed, rise, before, pause, cycles, window):
    """Follow Dahl's or LuGre's body; means of drive force and load over the last cycles."""
    rest = 0.0
    if p.normal == HERTZ:
        rest = 1.5 * p.length
    elif p.normal == LINEAR:
        rest = p.length
    if p.dead:
        rest -= p.base_z * rise[0, 0]
    e = 0.0
    vx = p.drive if p.rigid else 0.0
    vy = 0.0
    sx = 0.0
    sy = 0.0
    z = 0.0
    w = 0.0
    drive_sum = 0.0
    load_sum = 0.0
    time = 0.0
    count = step.size
    share = 1.0
    if p.normal != CONSTANT:
        share = share_of(p, elastic(p, rest + p.base_z * rise[0, 0]))
    for c in range(-1, cycles):
        steps = before if c < 0 else count
        for j in range(steps):
            at = j
            on = 1.0
            h = step[at] if c >= 0 else pause / before
            if c < 0:
                at = 0
                on = 0.0
            r0 = rise[at, 0]
            r1 = rise[at, 1] if c >= 0 else r0
            r2 = rise[at, 2] if c >= 0 else r0
            u0 = on * speed[at, 0]
            u1 = on * speed[at, 1]
            u2 = on * speed[at, 2]
            n0 = on * rise_speed[at, 0]
            n1 = on * rise_speed[at, 1]
            n2 = on * rise_speed[at, 2]
            a = rates(p, e, vx, vy, sx, sy, z, w, u0, n0, r0, rest)
            g = 0.5 * h
            b = rates(
                p, e + g * a[0], vx + g * a[1], vy + g * a[2], sx + g * a[3], sy + g * a[4],
                z + g * a[5], w + g * a[6], u1, n1, r1, rest,
            )  # fmt: skip
            m = rates(
                p, e + g * b[0], vx + g * b[1], vy + g * b[2], sx + g * b[3], sy + g * b[4],
                z + g * b[5], w + g * b[6], u1, n1, r1, rest,
            )  # fmt: skip
            q = rates(
                p, e + h * m[0], vx + h * m[1], vy + h * m[2], sx + h * m[3], sy + h * m[4],
                z + h * m[5], w + h * m[6], u2, n2, r2, rest,
            )  # fmt: skip
            g = h / 6.0
            e += g * (a[0] + 2.0 * (b[0] + m[0]) + q[0])
            vx += g * (a[1] + 2.0 * (b[1] + m[1]) + q[1])
            vy += g * (a[2] + 2.0 * (b[2] + m[2]) + q[2])
            last = math.sqrt(sx * sx + sy * sy)
            sx += g * (a[3] + 2.0 * (b[3] + m[3]) + q[3])
            sy += g * (a[4] + 2.0 * (b[4] + m[4]) + q[4])
            z += g * (a[5] + 2.0 * (b[5] + m[5]) + q[5])
            w += g * (a[6] + 2.0 * (b[6] + m[6]) + q[6])
            # Back to the limit, and where the load lets that fall, along with it.
            was = share
            if p.normal != CONSTANT:
                force = elastic(p, rest + p.base_z * r2 - z)
                share = share_of(p, max(force * (1.0 + p.loss * (p.base_z * n2 - w)), 0.0))
            if share <= 1e-12:
                sx = 0.0
                sy = 0.0
            elif not p.keeps_deflection or p.model == DAHL:
                held = 1.0 if p.keeps_deflection else share
                most = p.limit * held
                if p.model == LUGRE:
                    most = 1e300
                    if share < was and not p.keeps_deflection:
                        v1x = vx - p.base_x * u2
                        vsy = (p.own_1 + p.own_2) * vy - p.base_y * u2
                        g1 = 1.0
                        if p.stribeck > 0.0:
                            fast = math.sqrt(v1x * v1x + vsy * vsy) / p.stribeck
                            g1 += (p.static_ratio - 1.0) * math.exp(-fast * fast)
                        most = max(p.limit * share * g1, last * share / was)
                size = math.sqrt(sx * sx + sy * sy)
                if size > most:
                    sx *= most / size
                    sy *= most / size
            if c >= cycles - window:
                drive_sum += g * (a[7] + 2.0 * (b[7] + m[7]) + q[7])
                load_sum += g * (a[8] + 2.0 * (b[8] + m[8]) + q[8])
                time += h
    return drive_sum / time, load_sum / time


@kernel
def opposed(fx, fy, bx, by):
    """Friction over its limit that stops a slip ``f`` it takes ``b`` off, or is against it."""
    if bx == 0.0 and by == 0.0:
        size = math.sqrt(fx * fx + fy * fy)
        if size == 0.0:
            return 0.0, 0.0
        return fx / size, fy / size
    can = (bx > 0.0 or fx == 0.0) and (by > 0.0 or fy == 0.0)
    if can:
        kx = fx / bx if bx > 0.0 else 0.0
        ky = fy / by if by > 0.0 else 0.0
        if kx * kx + ky * ky <= 1.0:
            return kx, ky
    low = 0.0
    high = math.sqrt(fx * fx + fy * fy)
    for _ in range(60):
        slip = 0.5 * (low + high)
        kx = fx / (slip + bx) if fx != 0.0 else 0.0
        ky = fy / (slip + by) if fy != 0.0 else 0.0
        if kx * kx + ky * ky > 1.0:
            low = slip
        else:
            high = slip
    slip = 0.5 * (low + high)
    kx = fx / (slip + bx) if fx != 0.0 else 0.0
    ky = fy / (slip + by) if fy != 0.0 else 0.0
    size = math.sqrt(kx * kx + ky * ky)
    return kx / size, ky / size


@kernel
def depth_of(p, force):
    """Indentation that bears a load."""
    if p.normal == ROUGH:
        return p.length * math.log(force / p.load) if force > 0.0 else -1e3 * p.length
    if p.normal == HERTZ:
        return 1.5 * p.length * (force / p.load) ** (2.0 / 3.0)
    return p.length * force / p.load


@kernel
def follow_feet(p, step, way, rise_speed, rise, before, pause, cycles, window, heights, weights):
    """Follow a body on rigid friction or on springs, as `follow`."""
    rest = 0.0
    if p.normal == HERTZ:
        rest = 1.5 * p.length
    elif p.normal == LINEAR:
        rest = p.length
    if p.dead:
        rest -= p.base_z * rise[0, 0]
    feet_x = np.zeros(heights.size)
    feet_y = np.zeros(heights.size)
    e = 0.0
    vx = p.drive if p.rigid else 0.0
    vy = 0.0
    z = 0.0
    w = 0.0
    fx = 0.0
    fy = 0.0
    drive_sum = 0.0
    load_sum = 0.0
    time = 0.0
    force = p.load
    if p.normal != CONSTANT:
        force = elastic(p, rest + p.base_z * rise[0, 0])
    own = p.own_1 + p.own_2
    count = step.size
    for c in range(-1, cycles):
        steps = before if c < 0 else count
        for j in range(steps):
            at = j if c >= 0 else 0
            h = step[at] if c >= 0 else pause / before
            on = 1.0 if c >= 0 else 0.0
            u = on * way[at]
            r2 = rise[at, 2] if c >= 0 else rise[at, 0]
            n2 = on * rise_speed[at, 2]
            last = force
            if p.normal != CONSTANT:
                if p.dead:
                    w += 0.5 * h * (force - p.load) / p.mass
                    z += h * w
                el = elastic(p, rest + p.base_z * r2 - z)
                if p.dead:
                    half = 0.5 * h / p.mass
                    force = el * (1.0 + p.loss * (p.base_z * n2 - w + half * p.load))
                    force = max(force / (1.0 + el * p.loss * half), 0.0)
                    w += half * (force - p.load)
                else:
                    force = max(el * (1.0 + p.loss * p.base_z * n2), 0.0)
            if p.model == COULOMB:
                full = p.full * 0.5 * (share_of(p, last) + share_of(p, force))
                free_x = p.drive
                bx = 0.0
                if not p.rigid:
                    heavy = 1.0 + h * p.damping / p.mass + 0.5 * h * h * p.stiffness / p.mass
                    pull = p.stiffness * (e + 0.5 * h * p.drive) + p.damping * p.drive
                    free_x = (vx + h / p.mass * pull) / heavy
                    bx = h * full / p.mass / heavy
                by = h * full / p.mass if p.free else 0.0
                kx, ky = opposed(
                    h * free_x - p.base_x * u, h * own * vy - p.base_y * u, h * bx, h * own * by
                )
                fx = full * kx
                fy = full * ky
                e0 = e
                vx = free_x - bx * kx
                vy -= by * ky
                e += h * (p.drive - vx)
                fd = fx
                if not p.rigid:
                    fd = p.stiffness * 0.5 * (e0 + e) + p.damping * (p.drive - vx)
                mean = fd
            else:
                fd0 = fx
                if not p.rigid:
                    fd0 = p.stiffness * e + p.damping * (p.drive - vx)
                    vx += 0.5 * h * (fd0 - fx) / p.mass
                if p.free:
                    vy -= 0.5 * h * fy / p.mass
                e += h * (p.drive - vx)
                dx = h * vx - p.base_x * u
                dy = h * own * vy - p.base_y * u
                depth = depth_of(p, force)
                fx = 0.0
                fy = 0.0
                scale = p.limit / p.length
                for n in range(heights.size):
                    most = max(depth - heights[n], 0.0) * scale
                    ax = feet_x[n] + dx
                    ay = feet_y[n] + dy
                    size = math.sqrt(ax * ax + ay * ay)
                    if size > most:
                        ax *= most / size
                        ay *= most / size
                    feet_x[n] = ax
                    feet_y[n] = ay
                    fx += weights[n] * ax
                    fy += weights[n] * ay
                fd = fx
                if not p.rigid:
                    half = 0.5 * h / p.mass
                    vx = vx + half * (p.stiffness * e + p.damping * p.drive - fx)
                    vx /= 1.0 + half * p.damping
                    fd = p.stiffness * e + p.damping * (p.drive - vx)
                if p.free:
                    vy -= 0.5 * h * fy / p.mass
                mean = 0.5 * (fd0 + fd)
            if c >= cycles - window:
                drive_sum += h * mean
                load_sum += h * 0.5 * (last + force)
                time += h
    return drive_sum / time, load_sum / time


def feet(p, deepest):
    """Heights at which springs begin to touch, and what each adds to k_t, N/m.

    Each stands at the mean of the heights it stands for, so that together they bear the load.
    """
    # Parts of the stiffness, finer where the load is small.
    ends = (np.arange(FEET + 1) / FEET) ** 3
    a, b = ends[:-1], ends[1:]
    stiffness = p.full / p.limit
    if p.normal == LINEAR:
        return np.zeros(1), np.full(1, stiffness)
    if p.normal == HERTZ:
        # The stiffness grows as the root of the depth.
        heights = deepest * (a * a + a * b + b * b) / 3.0
        return heights, stiffness * math.sqrt(deepest / (1.5 * p.length)) * (b - a)
    grown = math.exp(deepest / p.length)
    whole = ends * (np.log(ends, where=ends > 0.0, out=np.zeros(FEET + 1)) - 1.0)
    return deepest + p.length * np.diff(whole) / (b - a), stiffness * grown * (b - a)


def body_of(model):
    """Return the numbers of a case."""
    slider, friction, vibration, normal = (
        model.slider, model.friction, model.vibration, model.normal,
    )  # fmt: skip
    wave = wave_of(vibration)
    sign = -1.0 if vibration.applied_to == "body" else 1.0
    amplitude = vibration.displacement_amplitude
    if amplitude is None:
        velocity = vibration.velocity_amplitude
        if velocity is None:
            velocity = vibration.velocity_ratio * slider.drive_velocity
        amplitude = velocity / (wave.steepness * vibration.frequency)
    flat, up = math.cos(vibration.elevation), math.sin(vibration.elevation)
    full = friction.mu * slider.normal_force
    limit = 1.0
    if friction.model != "coulomb":
        limit = friction.max_deflection or full / friction.tangential_stiffness
    length, loss = 0.0, 0.0
    if normal is not None:
        slope = normal.stiffness
        if slope is None:
            bend = 1.5 if normal.law == "hertz" else 1.0
            slope = bend * slider.normal_force / normal.penetration
        length = slider.normal_force / slope
        loss = normal.damping or 0.0
        if normal.damping_ratio:
            critical = 2.0 * math.sqrt(slope * slider.mass)
            loss = normal.damping_ratio * critical / slider.normal_force
    on_body = vibration.applied_to == "body"
    free = slider.mass is not None and slider.lateral != "guided"
    across = flat * math.sin(vibration.direction)
    # Nothing is aligned better than that; what is marched straight never leaves its way.
    across = ASKEW if free and abs(across) < 1e-12 else across * friction.transfer
    return Body(
        drive=slider.drive_velocity,
        stiffness=slider.drive_stiffness or 0.0,
        damping=slider.drive_damping,
        mass=slider.mass or 1.0,
        rigid=slider.drive_stiffness is None,
        free=free,
        model=MODELS[friction.model],
        law=LAWS[friction.law],
        exponent=friction.exponent,
        full=full,
        limit=limit,
        static_ratio=(friction.static_mu or friction.mu) / friction.mu,
        stribeck=friction.stribeck_velocity,
        rate_damping=friction.contact_damping,
        viscous=friction.viscous_damping,
        keeps_deflection=friction.keeps == "deflection" and friction.model != "coulomb",
        own_1=0.0 if on_body else 1.0,
        own_2=friction.transfer if on_body else 0.0,
        base_x=sign * amplitude * flat * math.cos(vibration.direction),
        base_y=sign * amplitude * across,
        base_z=sign * amplitude * up,
        normal=NORMALS[None if normal is None else normal.law],
        dead=normal is not None and normal.control == "force",
        load=slider.normal_force,
        length=length,
        loss=loss,
        power=friction.load_exponent,
    )


def wave_of(vibration):
    rise = (vibration.rise_time or 0.0) * vibration.frequency
    return Wave(vibration.waveform, rise)


def steps_for(p, frequency, wave):
    """Steps a cycle to begin with."""
    amplitude = math.hypot(p.base_x, p.base_y, p.base_z)
    fastest = amplitude * wave.steepness * frequency + p.drive
    needed = [600.0]
    if p.mass and not (p.rigid and not p.free):
        needed.append(math.sqrt(p.stiffness / p.mass) / (0.1 * frequency))
        needed.append((p.rate_damping + p.viscous) / p.mass / (0.3 * frequency))
    if p.model != COULOMB:
        needed.append(fastest / (0.05 * p.limit * frequency))
        stiff = p.full / p.limit * max(1.0, 2.0**p.exponent - 1.0 if p.exponent > 1 else 1.0)
        if not (p.rigid and not p.free):
            needed.append(math.sqrt(stiff / p.mass) / (0.1 * frequency))
    if p.normal != CONSTANT:
        swing = abs(p.base_z) / p.length
        stiff = (
            p.load
            / p.length
            * {LINEAR: 1.0, HERTZ: math.sqrt(1.0 + 2.0 * swing)}.get(
                p.normal, math.exp(min(2.0 * swing, 6.0))
            )
        )
        if p.dead:
            needed.append(math.sqrt(stiff / p.mass) / (0.1 * frequency))
        needed.append(swing * wave.steepness / 0.03)
    if p.model == COULOMB:
        needed.append(20.0 * fastest / p.drive)
        needed.append(2000.0)
    if p.model == SPRINGS:
        needed.append(1500.0)
    return math.ceil(max(needed))


def _followed(p, step, way, speed, rise_speed, rise, before, pause, cycles, window, deepest):
    if p.model in (DAHL, LUGRE):
        return follow(p, step, speed, rise_speed, rise, before, pause, cycles, window)
    heights, weights = feet(p, deepest) if p.model == SPRINGS else np.zeros((2, 0))
    return follow_feet(
        p, step, way, rise_speed, rise, before, pause, cycles, window, heights, weights
    )


def once(model, p, wave, steps, cycles, window):
    vibration = model.vibration
    frequency = vibration.frequency
    lead = vibration.normal_phase / (2.0 * math.pi)
    cycle = cycle_of(wave, lead, frequency, steps)
    pause = vibration.start
    before = math.ceil(pause * frequency * steps)
    deepest = model.deepest * p.length if p.model == SPRINGS else 0.0
    found = kept.answer(
        __file__, _followed, p, cycle.step, cycle.way, cycle.speed, cycle.rise_speed, cycle.rise,
        before, pause, cycles, window, deepest,
    )  # fmt: skip
    return found[0] / p.full, found[1] / p.load


def solved(model, cycles, window, wanted=2e-4, most=MOST_STEPS):
    """Follow a case from rest over so many cycles; means over the last ``window`` of them."""
    p, wave = body_of(model), wave_of(model.vibration)
    steps = steps_for(p, model.vibration.frequency, wave)
    # What is of first order is carried on to steps of nothing.
    order = 1 if p.model == COULOMB else 2
    last = once(model, p, wave, steps, cycles, window)
    while True:
        steps *= 2
        here = once(model, p, wave, steps, cycles, window)
        error = max(abs(a - b) for a, b in zip(here, last, strict=True))
        if error <= wanted or 2 * steps > most:
            break
        last = here
    gain = 1.0 / (2.0**order - 1.0)
    ratio, load = (a + gain * (a - b) for a, b in zip(here, last, strict=True))
    return Found(ratio, load, error, steps)
