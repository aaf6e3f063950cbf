/** Colours of a value, and maps of a flank: cells of a mesh, filled by what holds in them. */
import { html } from "../vendor/preact.js";
import { Figure } from "./figure.js";
import { inWords } from "./symbols.js";
import { digits } from "./units.js";

/** From low to high, told apart by those who do not see all colours: cividis. */
const STOPS = "00224e 123570 3b496c 575d6d 707173 8a8678 a59c74 c3b369 e1cc55 fee838".split(" ");
const RGB = STOPS.map((text) => [0, 2, 4].map((at) => parseInt(text.slice(at, at + 2), 16)));
export const LEVELS = 24;

/** Red, green and blue, 0 to 255, of a share from 0 to 1. */
export function colourAt(share) {
  const place = Math.min(Math.max(share, 0), 1) * (RGB.length - 1);
  const low = Math.min(Math.floor(place), RGB.length - 2);
  return RGB[low].map((from, k) => Math.round(from + (place - low) * (RGB[low + 1][k] - from)));
}

/** The same as a drawing takes it. */
export const shade = (share) => `rgb(${colourAt(share).join()})`;

/** The least and the greatest of numbers, without those that are none. @returns {[number, number]} */
export function span(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low < high ? [low, high] : [low === Infinity ? 0 : low, (low === Infinity ? 0 : low) + 1];
}

/** Corners of the cells of a grid of points. */
export function gridCells(rows, columns) {
  const cells = [];
  for (let row = 0; row + 1 < rows; row += 1)
    for (let column = 0; column + 1 < columns; column += 1) {
      const at = row * columns + column;
      cells.push([at, at + 1, at + columns + 1, at + columns]);
    }
  return cells;
}

/** A path of the cells of each level, and of those without a value. */
export function painted({ x, y, cells, values, range: [low, high] }) {
  const paths = Array.from({ length: LEVELS + 1 }, () => "");
  for (const cell of cells) {
    const mean = cell.reduce((sum, at) => sum + values[at], 0) / cell.length;
    const level = Math.floor(((mean - low) / (high - low)) * LEVELS);
    const place = Number.isFinite(mean) ? Math.min(Math.max(level, 0), LEVELS - 1) : LEVELS;
    const corners = cell.map((at) => `${x[at].toFixed(3)} ${(-y[at]).toFixed(3)}`);
    paths[place] += `M${corners.join("L")}Z`;
  }
  return paths.map((d, level) => [d, level === LEVELS ? "#9a9a9a" : shade((level + 0.5) / LEVELS)]);
}

/** Which colour is which value. @param {{range: [number, number], unit: string, label: string}} props */
export function Legend({ range: [low, high], unit, label }) {
  const steps = Array.from({ length: LEVELS }, (_, level) => level);
  const ends = `${digits(low, 3)} to ${digits(high, 3)} ${unit}`.trim();
  return html`<ul class="legend ramp"><li>
    <svg viewBox=${`0 0 ${LEVELS} 1`} preserveAspectRatio="none" role="img" aria-label=${`colours from ${ends}`}>
      ${steps.map((level) => html`<rect x=${level} width="1.05" height="1" fill=${shade((level + 0.5) / LEVELS)} />`)}
    </svg> ${ends}: ${inWords(label)}</li></ul>`;
}

/**
 * A map over a flank as it is seen along the tooth, with its files beneath.
 * @param {{title: string, label: string, unit: string, x: ArrayLike<number>, y: ArrayLike<number>,
 *   cells: number[][], values: ArrayLike<number>, range: [number, number], lines?: string,
 *   says?: string}} props
 *   places along the face and from the axis in mm; `lines` a path drawn over it; `says` where it is
 */
export function FlankMap({ title, label, unit, x, y, cells, values, range, lines = "", says }) {
  const [left, right] = span(x);
  const [low, high] = span(y);
  const [width, height] = [right - left, high - low];
  const box = `${left - 0.02 * width} ${-high - 0.03 * height} ${1.04 * width} ${1.06 * height}`;
  const thin = width / 160;
  const columns = () => [["along the face", x, "mm"], ["from the axis", y, "mm"], [label, values, unit]]
    .map(([name, of, more]) => ({ label: name, unit: more, values: Array.from(of, Number) }));
  const where = `across ${digits(left, 3)} to ${digits(right, 3)} mm along the wheel's axis, `
    + `up ${digits(low, 4)} to ${digits(high, 4)} mm from it`;
  return html`<${Figure} title=${title} kind="map" columns=${columns}>
    <svg class="drawn" viewBox=${box} role="img" aria-label=${`${title}: ${label}, ${digits(range[0], 3)} to
      ${digits(range[1], 3)} ${unit}; the numbers are in the table beneath`}>
      ${painted({ x, y, cells, values, range }).map(([d, fill]) =>
        html`<path d=${d} fill=${fill} stroke=${fill} stroke-width=${thin / 4} />`)}
      ${lines ? html`<path class="touching" d=${lines} stroke-width=${thin} />` : null}
    </svg>
    <p class="says">${says ?? where}</p>
    <${Legend} range=${range} unit=${unit} label=${label} />
  <//>`;
}
