/** What the reader is shown: SI, or units of the US as `--units us` has them; what is kept stays as it is written. */
import { html, signal } from "../vendor/preact.js";
// First, so that what the address says of units has been read.
import "./state.js";
import { digits, readable as inSI, split } from "./units.js";

const KEY = "asperity-units";
const [IN, LBF, PSI, LB, HP] = [25.4, 4.4482216152605, 6894.757293168361, 0.45359237, 745.69987158227022];
/** Units by those of an answer: another, and what a value is times and plus in it. @type {Record<string, any>} */
export const US = {
  mm: ["in", 1 / IN], m: ["in", 1e3 / IN], um: ["µin", 1e3 / IN], "µm": ["µin", 1e3 / IN], mm2: ["in2", IN ** -2],
  m2: ["ft2", 0.3048 ** -2], mm3: ["in3", IN ** -3], "1/mm": ["1/in", IN], "mm/rad": ["in/rad", 1 / IN],
  "m/s": ["ft/min", 60 / 0.3048], "mm/s": ["in/s", 1 / IN], N: ["lbf", 1 / LBF], kN: ["lbf", 1e3 / LBF],
  "N/mm": ["lbf/in", IN / LBF], "N m": ["lbf·in", 1e3 / (LBF * IN)], W: ["hp", 1 / HP], kW: ["hp", 1e3 / HP],
  Pa: ["psi", 1 / PSI], kPa: ["psi", 1e3 / PSI], MPa: ["psi", 1e6 / PSI], GPa: ["ksi", 1e6 / PSI],
  "N/mm2": ["psi", 1e6 / PSI], degC: ["degF", 1.8, 32], kg: ["lb", 1 / LB],
};

/** What the reader chose, kept by the browser; "" follows the case. */
const chosen = signal(sessionStorage.getItem(KEY) ?? localStorage.getItem(KEY) ?? "");
/** The system that is shown. */
const system = signal("si");
let ofCase = "";
const look = () => (system.value = (chosen.peek() || ofCase) === "us" ? "us" : "si");
look();

/** Follow the case that is open, where the reader chose none. @param {string} said its `[project] units` */
export function follow(said) {
  ofCase = said;
  look();
}

/** What is chosen; it stays. */
export function Units() {
  const choose = (event) => {
    chosen.value = event.target.value;
    sessionStorage.removeItem(KEY);
    localStorage.setItem(KEY, chosen.value);
    look();
  };
  return html`<p class="units"><label for="units">units</label> <select id="units" value=${chosen.value}
    onChange=${choose}>${[["", "as the case"], ["si", "SI"], ["us", "US: in, lbf, °F"]].map(([key, said]) =>
      html`<option value=${key}>${said}</option>`)}</select></p>`;
}

/** Whether all is shown in SI. */
export const asKept = () => system.value === "si";

/** The unit that one is shown in. @returns {[string, number, number] | null} null: as it is */
export const to = (unit) => (!asKept() && Object.hasOwn(US, unit) ? /** @type {any} */ ([...US[unit], 0]) : null);

/** A value and its unit as they are shown. @returns {[any, string]} */
export function shown(value, unit) {
  const found = to(unit);
  return found ? [typeof value === "number" ? value * found[1] + found[2] : value, found[0]] : [value, unit];
}

/** A value that is shown, in the unit that it is kept in. */
export function back(value, unit) {
  const found = to(unit);
  return found ? (value - found[2]) / found[1] : value;
}

/** A number with its unit, in words. */
export function amount(value, unit, count = 4) {
  const [number, of] = shown(value, unit);
  return `${digits(number ?? NaN, count)} ${of}`.trimEnd();
}

/** What is less than so much, in SI, is told in the smaller unit. @type {Record<string, [number, string, number]>} */
const SMALL = { m: [2.5e-5, "um", 1e6] };

/** Value and unit as a reader wants them. @returns {[string, string]} */
export function readable(value, unit, count = 5) {
  if (asKept() || !Number.isFinite(value)) return inSI(value, unit, count);
  const [below, other, times] = SMALL[unit] ?? [0, "", 1];
  const [number, of] = Math.abs(value) < below ? shown(value * times, other) : shown(value, unit);
  return inSI(number, of, count);
}

/** Numbers with their unit, of a plot or a table. @param {any} one with `unit` and `values` @returns {any} */
export function column(one) {
  const found = to(one.unit ?? "");
  if (!found) return one;
  return { ...one, unit: found[0], values: Array.from(one.values, (each) => shown(each, one.unit)[0]) };
}

/** What stands above numbers, such as "mass (kg)", and how each of them is shown. @param {string} said */
export function headed(said) {
  const [, unit = ""] = /[(,] ?([^(),]+)\)?$/.exec(said) ?? [];
  const found = to(unit);
  return { unit, head: found ? said.slice(0, said.lastIndexOf(unit)) + found[0] + said.slice(said.lastIndexOf(unit)
    + unit.length) : said, of: (value) => shown(value, unit)[0] };
}

const NUMBER = String.raw`[+-]{0,2}\d+(?:\.\d+)?(?:[eE][+-]?\d+)?`;
const NAMES = Object.keys(US).filter((unit) => unit !== "m").sort((one, other) => other.length - one.length).join("|");
/** Numbers before a unit, "3 to 4 mm"; not what is to be given as it stands, "key=3 mm". */
const RUN = new RegExp(String.raw`(?<![\w.+/*^=-])(${NUMBER}(?:(?:, | to | of | and |/)${NUMBER})*) (${NAMES})`
  + String.raw`(?![\w/^*(]|\s*/)`, "g");

/** A number as a text in another unit, with as many digits as it has, at least three. */
export function again(text, unit) {
  const sign = text.startsWith("+-") ? "+-" : "";
  const bare = text.slice(sign.length);
  const [, times, plus] = /** @type {[string, number, number]} */ (to(unit));
  const value = Number(bare) * times + (sign ? 0 : plus);
  const count = bare.replace(/[eE].*/, "").replace(/\D/g, "").replace(/^0+/, "").length;
  return sign + digits(value, Math.max(count, String(Math.trunc(Math.abs(value))).length, 3));
}

/** A sentence as it is shown. @param {any} text */
export const inText = (text) => (asKept() || typeof text !== "string" ? text
  : text.replace(RUN, (_, numbers, unit) =>
    `${numbers.replace(new RegExp(NUMBER, "g"), (each) => again(each, unit))} ${US[unit][0]}`));

/** What is written, "300 N m", as its box shows it: units as printed, all of which are read. */
export function written(text, count = 5) {
  const [number, unit] = split(text);
  if (Number.isNaN(number)) return text;
  const found = to(unit.replace("°", "deg"));
  const said = found ? `${digits(number * found[1] + found[2], count)} ${found[0]}` : text;
  return said.replace(/\bdeg([CF])\b/, "°$1").replace(/(?<=\d )u(?=[msNW]\b)/, "µ").replaceAll("**2", "²")
    .replaceAll("**3", "³");
}

/** What is typed into a box, with the unit that stood there if none is typed. @param {string} typed */
export function withUnitOf(typed, was) {
  const [number, unit] = split(typed);
  const usual = split(written(was))[1];
  return Number.isNaN(number) || unit || !usual ? typed : `${typed} ${usual}`;
}
