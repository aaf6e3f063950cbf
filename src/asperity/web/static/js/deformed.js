/** An elastic block in motion: its skin deformed, and the pressure under it, in the frames that a march kept. */
import { html, useMemo, useRef } from "../vendor/preact.js";
import { Play, usePlayed } from "./frames.js";
import { Legend, LEVELS, painted, span } from "./map.js";
import { digits } from "./units.js";

/** How far the skin deforms in the picture, of the block's height, and how long a look at all frames takes, s. */
const [FAR, SECONDS] = [0.14, 6];
const rounded = new Intl.NumberFormat("en", { maximumSignificantDigits: 2 });
/** Seen obliquely: how far a place behind the picture lies aside and up. */
const [ASIDE, UP] = [0.42, 0.3];

/** Where a point is seen, mm. */
const seen = ([x, y, z]) => [1e3 * (x + ASIDE * y), 1e3 * (z + UP * y)];
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

/** A block whose frames play. @param {{packed: any, contact: {x: number[], y: number[], cells: number[][]}}} props */
export function Deformed({ packed, contact }) {
  const box = useRef(null);
  const made = useMemo(() => framesOf(packed), [packed]);
  const { rest, cells, magnified, range, loads, times } = made;
  const draw = (seconds) => {
    const find = frameAt(made, (seconds / SECONDS) % 1);
    const along = (_, at) => find(made.moved, at);
    const places = rest.map((point, at) => seen(point.map((each, k) => each + magnified * along(0, 3 * at + k))));
    put("skin", painted({ x: places.map(([x]) => x), y: places.map(([, y]) => y), cells,
      values: rest.map((_, at) => find(made.sizes, at)), range }));
    put("under", painted({ ...contact, values: contact.x.map((_, at) => find(made.pressures, at)), range: loads }));
    const now = box.current?.querySelector("[data-of=now]");
    const scalar = (values) => find(values.map((value) => [value]), 0);
    if (now) now.textContent = `${digits(1e3 * scalar(times), 4)} ms, drive force ${digits(scalar(made.forces), 3)} N`;
  };
  const put = (name, paths) => {
    const drawn = box.current?.querySelectorAll(`[data-of=${name}] path`) ?? [];
    paths.forEach(([d, fill], k) => {
      drawn[k]?.setAttribute("d", d);
      for (const key of ["fill", "stroke"]) drawn[k]?.setAttribute(key, fill);
    });
  };
  const playing = usePlayed(box, draw, [made]);
  const view = (points, room) => {
    const [[left, right], [low, high]] = [0, 1].map((k) => span(points.map((each) => each[k])));
    const edge = room * Math.max(right - left, high - low);
    return { box: `${left - edge} ${-high - edge} ${right - left + 2 * edge} ${high - low + 2 * edge}`,
      thin: (right - left) / 400 };
  };
  const [skin, under] = [view(rest.map(seen), 0.07), view(contact.x.map((x, at) => [x, contact.y[at]]), 0.03)];
  const part = (name, { box: seenIn, thin }, ends, unit, label, title) => html`<figure><figcaption>${title}</figcaption>
    <svg class="map-of" viewBox=${seenIn} role="img" aria-label=${`${title}: ${label}, ${digits(ends[0], 3)} to
      ${digits(ends[1], 3)} ${unit}`}><g data-of=${name} class=${name}>
      ${Array.from({ length: LEVELS + 1 }, () => html`<path stroke-width=${thin} />`)}</g></svg>
    <${Legend} range=${ends} unit=${unit} label=${label} /></figure>`;
  return html`<div class="deformed" ref=${box}>
    <div class="grid">
      ${part("skin", skin, range.map((each) => 1e9 * each), "nm", "deformation",
        `The block, deformed ${rounded.format(magnified)} times as much as it is`)}
      ${part("under", under, loads.map((each) => each / 1e3), "kPa", "pressure at a node",
        "The pressure under it at that moment")}</div>
    <p class="row"><${Play} ...${playing} /> <span class="says" data-of="now" aria-hidden="true"></span></p>
    <p class="says">The last ${digits(1e3 * (times.at(-1) - times[0]), 3)} ms of the march, over and over, slowed
      ${" "}${rounded.format(SECONDS / (times.at(-1) - times[0]))} times; what the block moves
      as a whole is left out.</p>
  </div>`;
}
