/** Texts such as "4 kHz": number and unit apart, and one unit in another. */

const PREFIX = { "": 1, G: 1e9, M: 1e6, k: 1e3, c: 1e-2, m: 1e-3, u: 1e-6, µ: 1e-6, n: 1e-9, p: 1e-12 };
const PLAIN = {
  "": 1, m: 1, g: 1e-3, s: 1, N: 1, W: 1, J: 1, Pa: 1, Hz: 1, V: 1, A: 1, K: 1, rad: 1,
};
const WHOLE = {
  deg: Math.PI / 180, rpm: 2 * Math.PI / 60, min: 60, h: 3600, "%": 0.01, bar: 1e5, kg: 1, mm: 1e-3,
  in: 0.0254, inch: 0.0254, ft: 0.3048, foot: 0.3048, mil: 2.54e-5, lb: 0.45359237, lbf: 4.4482216152605,
  kgf: 9.80665, hp: 745.69987158227022, psi: 6894.757293168, ksi: 6894757.293168,
};

function simple(name) {
  if (name in WHOLE) return WHOLE[name];
  if (name in PLAIN) return PLAIN[name];
  const [prefix, base] = [name[0], name.slice(1)];
  return prefix in PREFIX && base in PLAIN && base ? PREFIX[prefix] * PLAIN[base] : NaN;
}

/** How much one of a unit is in SI; NaN where it is not known. */
export function factor(unit) {
  const [over, ...under] = unit.trim().split("/");
  const product = (text) =>
    text.split(/[\s*·]+/).reduce((made, name) => made * simple(name), 1);
  return under.reduce((made, text) => made / product(text), product(over));
}

/** Number and unit of a text; the number is NaN where there is none. @returns {[number, string]} */
export function split(text) {
  const found = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)$/.exec(text ?? "");
  return found ? [Number(found[1]), found[2].trim()] : [NaN, ""];
}

/** The number of a text in a unit; NaN where it cannot be. */
export function inUnit(text, unit) {
  const [number, own] = split(text);
  return own === unit || !own ? number : (number * factor(own)) / factor(unit);
}

/** A number with so many digits, without needless zeros. */
export function digits(value, count = 5) {
  if (!Number.isFinite(value)) return "–";
  return String(Number(value.toPrecision(count)));
}

/** @type {[string, number][]} */
const STEPS = [["G", 1e9], ["M", 1e6], ["k", 1e3], ["", 1], ["m", 1e-3], ["µ", 1e-6], ["n", 1e-9]];
const RAISED = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹";
const SCALED = new Set(["m", "s", "N", "W", "J", "Pa", "Hz", "m/s", "N/m", "V", "A"]);

/** Value and unit as a reader wants them: 0.00037 W is 0.37 mW. @returns {[string, string]} */
export function readable(value, unit, count = 5) {
  if (!Number.isFinite(value)) return ["–", unit];
  const size = Math.abs(value);
  if (unit === "rad" && size > 0 && size < 2e-3) return [digits(1e6 * value, count), "µrad"];
  if (unit === "rad") return [digits((value * 180) / Math.PI, count), "deg"];
  if (SCALED.has(unit) && size > 0) {
    const [prefix, one] = STEPS.find(([, step]) => size >= step * 0.99999) ?? STEPS[STEPS.length - 1];
    if (size < 1e12 && size >= 1e-12) return [digits(value / one, count), prefix + unit];
  }
  if (size !== 0 && (size >= 1e6 || size < 1e-4)) {
    const [mantissa, exponent] = value.toExponential(count - 1).split("e");
    const raised = [...String(Number(exponent))].map((sign) => RAISED["-0123456789".indexOf(sign)]);
    return [`${Number(mantissa)}·10${raised.join("")}`, unit];
  }
  return [digits(value, count), unit];
}
