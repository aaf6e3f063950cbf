/** How the picture of an elastic block moves, between the frames that a march kept; nothing here needs the page. */
import { painted, span } from "./colours.js";
import { digits } from "./units.js";

export const NAME = "deforming.js";
/** How far the skin deforms in the picture, of the block's height; how long all frames are looked at, s. */
export const [FAR, SECONDS] = [0.14, 6];
/** Seen obliquely: how far a place behind the picture lies aside and up. */
const [ASIDE, UP] = [0.42, 0.3];

/** Where a point is seen, mm. */
export const seen = ([x, y, z]) => [1e3 * (x + ASIDE * y), 1e3 * (z + UP * y)];
const pointOf = (values, at) => [values[3 * at], values[3 * at + 1], values[3 * at + 2]];
const minus = (one, other) => one.map((each, k) => each - other[k]);

/** Whether a face looks to the reader, by the corners it has, counterclockwise from outside. */
function looksHere(corners) {
  const [[a, b, c], [d, e, f]] = [minus(corners[2], corners[0]), minus(corners[3], corners[1])];
  return (b * f - c * e) * ASIDE - (c * d - a * f) + (a * e - b * d) * UP > 0;
}

/**
 * What is drawn of the frames: faces that are seen, how much is magnified, ranges of the colours.
 * @param {{header: any, arrays: Record<string, any>}} packed of the march
 */
export function framesOf({ header, arrays: { points, quads, deformation, pressure } }) {
  const count = header.time_s.length;
  const nodes = points.length / 3;
  const each = (values, width) => Array.from({ length: count }, (_, k) => values.subarray(k * width, (k + 1) * width));
  const rest = Array.from({ length: nodes }, (_, at) => pointOf(points, at));
  const cells = Array.from({ length: quads.length / 4 }, (_, at) => [...quads.subarray(4 * at, 4 * at + 4)])
    .filter((cell) => looksHere(cell.map((at) => rest[at])));
  const moved = each(deformation, 3 * nodes);
  const sizes = moved.map((one) => rest.map((_, at) => Math.hypot(...pointOf(one, at))));
  const most = Math.max(...sizes.flat()) || 1;
  const heights = rest.map(([, , z]) => z);
  return {
    times: header.time_s, forces: header.drive_force_N, rest, cells, moved, sizes, pressures: each(pressure,
      pressure.length / count), magnified: (FAR * (Math.max(...heights) - Math.min(...heights))) / most,
    range: span(sizes.flat()), loads: span(Array.from(pressure)),
  };
}

/** The frames at a part of the way through all of them, as numbers between two. */
export function frameAt({ times }, part) {
  const place = part * (times.length - 1);
  const low = Math.min(Math.floor(place), times.length - 2);
  return (values, at) => values[low][at] + (place - low) * (values[low + 1][at] - values[low][at]);
}

/**
 * What draws an elastic block at a time, s, into the box of its two pictures.
 * @param {Element} box
 * @param {{packed: any, contact: {x: number[], y: number[], cells: number[][]}, force?: [number, string]}} of
 *   as of Deformed; `force`: what a newton is in the unit that is shown, and that unit
 */
export function playing(box, { packed, contact, force: [newton, unit] = [1, "N"] }) {
  const made = framesOf(packed);
  const { rest, cells, magnified, range, loads, times } = made;
  const put = (name, paths) => {
    const drawn = box.querySelectorAll(`[data-of=${name}] path`);
    paths.forEach(([d, fill], k) => {
      drawn[k]?.setAttribute("d", d);
      for (const key of ["fill", "stroke"]) drawn[k]?.setAttribute(key, fill);
    });
  };
  return (seconds) => {
    const find = frameAt(made, (seconds / SECONDS) % 1);
    const place = (point, at) => seen(point.map((each, k) => each + magnified * find(made.moved, 3 * at + k)));
    const places = rest.map(place);
    put("skin", painted({ x: places.map(([x]) => x), y: places.map(([, y]) => y), cells,
      values: rest.map((_, at) => find(made.sizes, at)), range }));
    put("under", painted({ ...contact, values: contact.x.map((_, at) => find(made.pressures, at)), range: loads }));
    const now = box.querySelector("[data-of=now]");
    const scalar = (values) => find(values.map((value) => [value]), 0);
    const pulls = `${digits(newton * scalar(made.forces), 3)} ${unit}`;
    if (now) now.textContent = `${digits(1e3 * scalar(times), 4)} ms, drive force ${pulls}`;
  };
}
