/** What mends a value that is refused: buttons for what may stand there instead, as far as the line says it. */
import { html, useEffect } from "../vendor/preact.js";
import { fieldOf, words } from "./form.js";
import { fault } from "./state.js";
import { printed } from "./symbols.js";
import { digits, split } from "./units.js";
import { written } from "./us.js";

const KEY = /\b([a-z]\w*\.\w+) is /;
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

/** The names of a list that are nearest to a word, all of a short list; those that have the word in them first. */
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
  const AMOUNT = String.raw`([+-]?[\d.]+(?:e[+-]?\d+)? ?[^\s;,]*?)(?= and |;|,|$)`;
  return [end(new RegExp(`(?:at least|from) ${AMOUNT}`)), end(new RegExp(`(?:at most|up to) ${AMOUNT}`))];
}

/** The names that a line allows, or means. */
const namesIn = (must) => (/one of|allowed:|did you mean/.test(must)
  ? [...must.matchAll(QUOTED)].map(([, name]) => name) : []);

/** What may stand there instead of what was typed. @param {string} must @param {string} typed @param {any} field */
export function offered(must, typed, field) {
  const point = typed.replace(/^(\s*[+-]?\d+),(?=\d)/, "$1.");
  const [number, unit] = split(point);
  const usual = split(field?.example)[1] || field?.unit || "";
  const [low, high] = bounds(must);
  const names = namesIn(must);
  if (names.length) return nearest(names, typed);
  if (Number.isNaN(number)) return [];
  if (/whole number|integer/.test(must)) {
    return [Math.floor(number), Math.ceil(number)].filter((each) => each > 0).map(String);
  }
  if (/positive|above 0\b/.test(must) && number < 0) return [`${digits(-number, 12)} ${unit}`.trim()];
  if (low || high) {
    const least = split(low)[0];
    const below = low && (unit && unit !== split(low)[1] ? number < 0 : number < least);
    return [below || !high ? low : high];
  }
  // A unit that is none of this, or none at all.
  if (/ such as /.test(must) && usual && unit !== usual) return [`${digits(number, 12)} ${usual}`];
  return point === typed ? [] : [point];
}

/**
 * Buttons beneath a line that refuses. What was changed since the last answer is named where the line names another
 * key: it is what led there.
 * @param {{line: string, settings: Record<string, string>, before: Record<string, string>, own: any,
 *   setAll: (texts: Record<string, string>) => void, unset: (path: string) => void}} props `before`: what was set at
 *   the last answer; `own`: the case's tables as they are written
 */
export function Mending({ line, settings, before, own, setAll, unset }) {
  const [, named = ""] = KEY.exec(line) ?? [];
  const must = line.split(/; /).slice(1).join("; ");
  const changed = Object.keys(settings).filter((path) => settings[path] !== before[path]);
  const paths = settings[named] !== undefined ? [named] : changed;
  const key = paths.map((path) => `${path} `).join("");
  useEffect(() => {
    // Its field is marked, too, where the line names another.
    if (!fault.peek().includes(key)) fault.value = `${line} ${key}`;
  }, [line, key]);
  if (!paths.length) return null;
  const say = (path) => words(path.split(".")[1] ?? path);
  const names = named === paths[0] ? namesIn(must) : [];
  const texts = (path) => (path === named ? offered(must, settings[path], fieldOf(path)) : []);
  const was = (path) => before[path] ?? own?.[path.split(".")[0]]?.[path.split(".")[1]];
  const back = (path) => (before[path] === undefined ? unset(path) : setAll({ [path]: before[path] }));
  return html`<p class="row mending">
    ${named && named !== paths[0] ? html`<span class="says">Set since the last answer: ${
      paths.map((path) => `${say(path)}, ${written(settings[path])}`).join("; ")}.</span>` : null}
    ${paths.map((path) => html`
      ${texts(path).map((text) => html`<button type="button" class="main" key=${text}
        onClick=${() => setAll({ [path]: text })}>${say(path)} ${printed(written(text))}</button>`)}
      ${names.length > texts(path).length ? html`<select aria-label=${`all for ${say(path)}`} value=""
        onChange=${({ target }) => target.value && setAll({ [path]: target.value })}>
        <option value="">one of the ${names.length}</option>
        ${names.map((name) => html`<option>${name}</option>`)}</select>` : null}
      ${settings[path] !== before[path] && !texts(path).includes(was(path)) ? html`<button type="button"
        onClick=${() => back(path)}>
        ${was(path) ? `back to ${written(was(path))}` : `without ${say(path)}`}</button>` : null}`)}</p>`;
}
