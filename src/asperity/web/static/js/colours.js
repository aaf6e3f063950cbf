/** Colours of a value, and cells filled by what holds in them; nothing here needs the page. */

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

/** Of what has no value. */
const NONE = "#9a9a9a";

/** The same as a drawing takes it. */
export const shade = (share) => (Number.isFinite(share) ? `rgb(${colourAt(share).join()})` : NONE);

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
  return paths.map((d, level) => [d, level === LEVELS ? NONE : shade((level + 0.5) / LEVELS)]);
}
