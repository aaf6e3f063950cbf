/** Worm and wheel in mesh, cut through the middle of the wheel: how teeth follow threads, and where they touch. */

/** How far what is shaken goes in the picture, in modules, and how long a swing and a pitch take, s. */
const SWING = 0.22;
const SHAKE_SECONDS = 1.1;
const PITCH_SECONDS = 2.4;
/** Pitches that are seen to each side of the middle, and points of a tooth's flank. */
const PITCHES = 3.4;
const POINTS = 8;
/** Where the wheel goes as it is shaken along its axis, which points out of the picture: seen obliquely. */
const OBLIQUE = [0.75, -0.45];

const involute = (angle) => Math.tan(angle) - angle;
const near = (...numbers) => numbers.map((each) => each.toFixed(3)).join(" ");

/**
 * Sizes of the section in mm, from a rated gearset's geometry: the threads are a rack of straight flanks,
 * which the wheel's teeth envelop; x along the worm, y from the wheel's axis to the worm's.
 * @param {any} geometry as `rate` tells it
 */
export function sectionOf(geometry) {
  const { starts, wheel_teeth: teeth, axial_module_mm: module, centre_distance_mm: apart } = geometry;
  const alpha = (geometry.axial_pressure_angle_deg * Math.PI) / 180;
  const pitch = Math.PI * module;
  const rolling = (module * teeth) / 2;
  // Of the thread where it rolls on the wheel: the shift moves that line towards its tip.
  const thick = pitch / 2 - 2 * geometry.profile_shift * module * Math.tan(alpha);
  const tip = apart - geometry.worm_tip_diameter_mm / 2;
  const root = apart - geometry.worm_root_diameter_mm / 2;
  return { starts, teeth, module, apart, alpha, pitch, rolling, thick, tip, root,
    outside: geometry.wheel_throat_diameter_mm / 2, inside: geometry.wheel_root_diameter_mm / 2 };
}

/** The outline of the worm's threads, with one more at each end than is seen. */
export function threadsOf({ pitch, rolling, thick, alpha, tip, root, apart }) {
  const half = (y) => thick / 2 + (y - rolling) * Math.tan(alpha);
  const count = Math.ceil(PITCHES) + 1;
  let path = `M${near(-(count + 0.5) * pitch, apart)}`;
  for (let k = -count; k <= count; k += 1) {
    const x = k * pitch;
    path += [[-half(root), root], [-half(tip), tip], [half(tip), tip], [half(root), root]]
      .map(([dx, y]) => `L${near(x + dx, y)}`).join("");
  }
  return `${path}L${near((count + 0.5) * pitch, apart)}Z`;
}

/** The outline of the whole wheel, a gap in the middle above the worm. */
export function wheelOf({ teeth, rolling, pitch, thick, alpha, outside, inside }) {
  const base = rolling * Math.cos(alpha);
  const half = (pitch - thick) / (2 * rolling) + involute(alpha);
  const flank = Array.from({ length: POINTS }, (_, n) => {
    const r = inside + ((outside - inside) * n) / (POINTS - 1);
    return [r, half - (r > base ? involute(Math.acos(base / r)) : 0)];
  });
  const both = [...flank.map(([r, angle]) => [r, -angle]), ...flank.toReversed()];
  let path = "";
  for (let k = 0; k < teeth; k += 1) {
    const middle = ((k + 0.5) * 2 * Math.PI) / teeth;
    for (const [r, angle] of both) {
      path += `${path ? "L" : "M"}${near(r * Math.sin(middle + angle), r * Math.cos(middle + angle))}`;
    }
  }
  return `${path}Z`;
}

/** Where the flanks that bear touch once the worm has gone on by `gone` mm, all within both teeth. */
export function touching(section, gone) {
  const { pitch, thick, alpha } = section;
  const found = [];
  for (let k = -3; k <= 3; k += 1) {
    const along = (gone + k * pitch + thick / 2) * Math.cos(alpha);
    const point = onLine(section, along);
    if (point) found.push(point);
  }
  return found;
}

/** A point of the line of action, so far from where the pitch lines meet; null where there are no two teeth. */
function onLine({ alpha, rolling, tip, outside, root }, along) {
  const [x, y] = [along * Math.cos(alpha), rolling - along * Math.sin(alpha)];
  return y >= tip && y <= root && Math.hypot(x, y) <= outside ? { x, y } : null;
}

/**
 * How fast the surfaces slide at a point, m/s: the worm's goes round its axis, across the picture, and
 * the wheel's round its own, in it.
 */
export const sliding = ({ apart, starts, teeth }, { x, y }, speed) =>
  (1e-3 * speed * Math.hypot(apart - y, (starts / teeth) * Math.hypot(x, y)));

/**
 * The line on which teeth touch while they pass, in pieces, with the value of each.
 * @param {any} section @param {(point: {x: number, y: number}) => number} valueAt
 */
export function lineOf(section, valueAt) {
  const { module } = section;
  const steps = 120;
  const points = Array.from({ length: steps + 1 }, (_, n) => onLine(section, (n / steps - 0.5) * 14 * module));
  return points.flatMap((point) => (point ? [{ ...point, value: valueAt(point) }] : []));
}

/** Nodes so near to the middle of a face count as of it, of half of its width. */
const MIDDLE = 0.12;

/**
 * The pressure in the middle of a wheel's face over the distance from its axis, mm.
 * @param {{radius: ArrayLike<number>, face: ArrayLike<number>, pressure: ArrayLike<number>}} nodes of a flank
 * @returns {(point: {x: number, y: number}) => number} the pressure at a point of the section
 */
export function pressedBy({ radius, face, pressure }) {
  const most = Math.max(...Array.from(face, Math.abs));
  const near = Array.from(radius, (r, at) => [r, pressure[at], Math.abs(face[at])])
    .filter(([, , aside]) => aside <= MIDDLE * most).sort(([one], [other]) => one - other);
  return ({ x, y }) => {
    const r = Math.hypot(x, y);
    const next = near.findIndex(([at]) => at >= r);
    if (next <= 0) return near.at(next < 0 ? -1 : 0)?.[1] ?? NaN;
    const [[from, low], [to, high]] = [near[next - 1], near[next]];
    return low + ((r - from) / (to - from || 1)) * (high - low);
  };
}

/** What is seen: from left to right, and from the top, in mm. */
export function windowOf({ pitch, outside, apart, inside, tip, module }) {
  const wide = PITCHES * pitch;
  const top = Math.max(inside - 2.2 * module, 0.2 * outside);
  const bottom = 2 * apart - tip;
  return [-wide, top, 2 * wide, Math.min(bottom, apart + 2.6 * module) - top];
}

/**
 * Where everything is at a time, in mm and rad: the worm's place and turn, and the wheel's.
 * @param {any} section @param {string} mode which way it is shaken, "" for not @param {number} seconds
 */
export function poseOf(section, mode, seconds) {
  const { pitch, rolling, module, starts } = section;
  const gone = ((seconds / PITCH_SECONDS) % 1) * pitch;
  const turned = ((2 * Math.PI * seconds) / PITCH_SECONDS / starts) % (2 * Math.PI);
  const swing = SWING * module * Math.sin((2 * Math.PI * seconds) / SHAKE_SECONDS);
  // A worm that turns moves its threads on; along its own screw it moves back what it turns on.
  const turns = mode === "torsional" || mode === "screw" ? swing : 0;
  const along = mode === "axial" ? swing : mode === "screw" ? -swing : 0;
  const angle = turned + turns / ((starts * module) / 2);
  return {
    gone, threads: gone + turns + along, along, angle, wheel: gone / rolling,
    aside: mode === "wheel-axial" ? OBLIQUE.map((each) => each * swing) : [0, 0],
  };
}
