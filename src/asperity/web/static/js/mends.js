/** What may stand instead of a value that is refused, read from the line that refuses it. */
import { digits, inUnit, split } from "./units.js";

const QUOTED = /'([^']*)'/g;
/** Of a list, so many that are nearest to what was typed. */
const NEAREST = 3;
/** So many different letters make another word. */
const FAR = 0.5;

/** How many letters must be changed, put in or left out to make one word of another. */
function apart(one, other) {
  let row = Array.from({ length: other.length + 1 }, (_, at) => at);
  for (let at = 0; at < one.length; at += 1) {
    const next = [at + 1];
    for (let k = 0; k < other.length; k += 1) {
      next.push(Math.min(next[k] + 1, row[k + 1] + 1, row[k] + Number(one[at] !== other[k])));
    }
    row = next;
  }
  return row[other.length];
}

/** The names of a list nearest to a word, all of a short list; those that have the word in them first. */
function nearest(names, typed) {
  const word = typed.toLowerCase();
  const far = (name) => (word && name.toLowerCase().includes(word) ? 0
    : apart(word, name.toLowerCase()) / Math.max(word.length, name.length));
  const sorted = names.toSorted((one, other) => far(one) - far(other));
  return names.length <= NEAREST + 2 ? sorted : sorted.filter((name) => far(name) <= FAR).slice(0, NEAREST);
}

/** The least and the greatest that a line allows, as texts with units; "" where it names none, or not itself. */
function bounds(must) {
  const end = (pattern) => pattern.exec(must)?.[1].trim() ?? "";
  const AMOUNT = String.raw`([+-]?[\d.]+(?:e[+-]?\d+)? ?[^\s;,]*?)(?= and | to |;|,|$)`;
  return [end(new RegExp(`(?:at least|from) ${AMOUNT}`)),
    end(new RegExp(`(?:at most|up to|from [^;,]+? to) ${AMOUNT}`))];
}

/** The names that a line allows, or means. */
export const namesIn = (must) => (/one of|allowed:|did you mean|\btakes '/.test(must)
  ? [...must.matchAll(QUOTED)].map(([, name]) => name) : []);

/**
 * @typedef {{example?: string, default?: string, unit?: string, minimum?: number | null, maximum?: number | null,
 *   open?: boolean}} Bounds what the form says of a key, or a screen of what it asks beside the case
 */

/** Whether a number lies within the bounds of its field. @param {string} text @param {Bounds} [field] */
function within(text, { unit = "", minimum = null, maximum = null, open = false } = {}) {
  const value = unit ? inUnit(text, unit) : split(text)[0];
  // As written: 180 deg is no more than 180.
  const [low, high] = [minimum ?? -Infinity, maximum ?? Infinity].map((end) => Number(digits(end, 9)) || end);
  return Number.isFinite(value) && (open ? value > low : Number(digits(value, 9)) >= low)
    && Number(digits(value, 9)) <= high;
}

/**
 * What may stand there instead of what was typed.
 * @param {string} must what the line says behind the value
 * @param {string} typed
 * @param {Bounds} [field]
 * @returns {string[]} texts that the case takes; none where the line does not tell
 */
export function offered(must, typed, field) {
  const names = namesIn(must);
  if (names.length) return nearest(names, typed);
  const found = instead(must, typed, field);
  const fitting = found.filter((text) => within(text, field) || text === field?.example || text === field?.default);
  return fitting.length || !field?.example || field.example === typed ? fitting : [field.example];
}

/** The same of what is no name. @param {string} must @param {string} typed @param {Bounds} [field] */
function instead(must, typed, field) {
  // What is no number, or may stand at no bound, becomes what the field has as an example, or the least of a count.
  const least = /whole number|integer/.test(must) ? String(field?.minimum ?? "") : "";
  const example = [field?.example || field?.default || least].filter((each) => each && each !== typed);
  const point = typed.replace(/^(\s*[+-]?\d+),(?=\d)/, "$1.");
  const [number, unit] = split(point);
  // What goes on with digits, such as 1 450 rpm or 1.234,5 mm, may mean more than one number.
  if (Number.isNaN(number) || /^(?:[.,]|\d\d)/.test(unit)) return example;
  const [low, high] = bounds(must);
  if (/whole number|integer/.test(must) && !(number > Number(high || Infinity))) {
    return [...new Set([Math.floor(number), Math.ceil(number)])]
      .filter((each) => each >= (field?.minimum ?? 1)).map(String);
  }
  if (/without a unit/.test(must)) return [String(number)];
  if (/positive|above 0\b/.test(must) && number < 0) return [`${digits(-number, 12)} ${unit}`.trim()];
  const beyond = (bound, way) => bound && way * (inUnit(point, split(bound)[1]) - split(bound)[0]) > 0;
  if (beyond(low, -1)) return [low, `${field?.minimum ?? low} ${field?.unit ?? ""}`.trim()].filter(
    (text) => within(text, field)).slice(0, 1);
  if (beyond(high, 1)) return [high];
  // A unit that is none of this, or none at all; one of the same quantity stays.
  const usual = split(field?.example)[1] || field?.unit || "";
  const kept = unit && Number.isFinite(inUnit(point, usual));
  if (/ such as /.test(must) && usual && !kept) return [`${digits(number, 12)} ${usual}`];
  return point === typed ? example : [point];
}
