/** Texts such as "4 kHz": number and unit apart, and one unit in another. */

const PREFIX = {
  "": 1, G: 1e9, M: 1e6, k: 1e3, h: 100, d: 0.1, c: 0.01, m: 1e-3, u: 1e-6, µ: 1e-6, μ: 1e-6, n: 1e-9, p: 1e-12,
  giga: 1e9, mega: 1e6, kilo: 1e3, hecto: 100, deci: 0.1, centi: 0.01, milli: 1e-3, micro: 1e-6, nano: 1e-9,
  pico: 1e-12,
};
const BASES = ["m", "s", "g", "K", "A", "rad"];
/** Units as on the command line: names, how much of what one is, where its scale begins. */
const UNITS = Object.fromEntries(`m meter metre=1 m;s second sec=1 s;g gram=1 g;K kelvin=1 K;A ampere=1 A;
% percent=0.01;rad radian=1 rad;deg degree °=0.017453292519943295 rad;arcmin arcminute=2.908882086657216e-4 rad;
turn rev revolution=360 deg;rpm=1 turn/min;min minute=60 s;h hr hour=3600 s;Hz hertz=1 1/s;
N newton=1 kg m/s2;Pa pascal=1 N/m2;bar=1e5 Pa;J joule Nm=1 N m;W watt=1 J/s;V volt=1 W/A;ohm=1 V/A;
F farad=1 A s/V;t tonne=1e3 kg;l L liter=1e-3 m3;P poise=0.1 Pa s;St stokes=1e-4 m2/s;
degC=1 K@273.15;degR rankine=0.5555555555555556 K;
degF=1 degR@255.3722222222222;in inch=0.0254 m;
ft foot=0.3048 m;lb pound=0.45359237 kg;lbf=4.4482216152605 N;psi=1 lbf/in2;ksi=1e3 psi;
BTU Btu=1055.05585262 J;acre=43560 ft2;hp horsepower=550 ft lbf/s`
  .split(/;\s*/).flatMap((line) => {
    const [names, is] = line.split("=");
    return names.split(" ").map((name) => [name, is]);
  }));
const FACTOR = /(?:^|\s*([*/·])\s*|\s+)(?:1(?!\d)|([a-zµμ]+|[%°]))(?:\s*\^\s*(-?\d+)|([23]))?/iy;

/** Of each unit {size, powers, zero}, in the bases. */
/** @type {Record<string, any>} */
const known = Object.fromEntries(["", ...BASES].map((one) =>
  [one, { size: 1, powers: BASES.map((each) => Number(each === one)), zero: 0 }]));

function named(name) {
  const start = Object.keys(PREFIX).find((each) =>
    name.startsWith(each) && Object.hasOwn(UNITS, name.slice(each.length)));
  if (start === undefined) return null;
  const [, size, of, zero] = /^(\S+) ?([^@]*)@?(.*)/.exec(UNITS[name.slice(start.length)]) ?? [];
  const unit = zero && start ? null : measure(of);
  return unit && { ...unit, size: PREFIX[start] * Number(size) * unit.size, zero: Number(zero) };
}

/** What a unit is worth, of names and powers; null where it is none. @returns {any} */
function measure(text) {
  if (Object.hasOwn(known, text)) return known[text];
  known[text] = null;
  let { size, powers } = known[""];
  for (let end = 0, next = 0; end < text.length; end = next) {
    FACTOR.lastIndex = end;
    const [all, sign, name = "", raised, plain] = FACTOR.exec(text) ?? [];
    next = FACTOR.lastIndex;
    const unit = all && !(sign && !end) ? (name ? named(name) : known[""]) : null;
    if (!unit || (unit.zero && name !== text)) return null;
    if (unit.zero) return (known[text] = unit);
    const power = Number(raised ?? plain ?? 1) * (sign === "/" ? -1 : 1);
    size *= unit.size ** power;
    powers = powers.map((own, k) => own + power * unit.powers[k]);
  }
  return (known[text] = { size, powers, zero: 0 });
}

/** A typed unit by names and powers; `kind`: the powers wanted. */
function read(unit, kind) {
  const text = unit.replaceAll("**", "^").replaceAll("²", "2").replaceAll("³", "3").replace(/°(?=[CF])/g, "deg")
    .replace(/\/\s*\(([^()/]+)\)/, (_, under) => `/${under.trim().split(/\s*[*·]\s*|\s+/).join("/")}`);
  const torque = /^lbf?[- ·*]?(in|ft)$|^(in|ft)[- ·*]?lbf?$/.exec(text);
  if (/^1? ?\/ ?min$|^min ?\^ ?-1$/.test(text) && kind === "0,-1,0,0,0,1") return "rpm";
  if (torque && kind === "2,-2,1,0,0,0") return `lbf*${torque[1] ?? torque[2]}`;
  // Of "W/m2/degC" the degree is one of a difference.
  return /^deg[CF]$/.test(text) ? text : text.replace(/\bdegC\b/g, "K").replace(/\bdegF\b/g, "degR");
}

/** Number and unit of a text; the number is NaN where there is none. @returns {[number, string]} */
export function split(text) {
  const found = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)$/.exec(text ?? "");
  const number = Number(found?.[1]);
  return found ? [Number.isFinite(number) ? number : NaN, found[2].trim()] : [NaN, ""];
}

/** The number of a text in a unit; NaN where it cannot be, such as of another quantity. */
export function inUnit(text, unit) {
  const [number, own] = split(text);
  if (own === unit || !own) return number;
  const other = measure(read(unit));
  const one = measure(read(own, String(other?.powers)));
  if (!one || String(one.powers) !== String(other?.powers)) return NaN;
  return one.zero === other.zero ? number * (one.size / other.size)
    : (number * one.size + one.zero - other.zero) / other.size;
}

/** A ratio as a number, also of "40:1" or "1:40"; what is none stays as it is. @param {string} text */
export function ratioOf(text) {
  const [, one, other] = /^\s*([\d.]+)\s*:\s*([\d.]+)\s*$/.exec(text) ?? [];
  const ratio = Math.max(Number(one) / Number(other), Number(other) / Number(one));
  return Number.isFinite(ratio) ? digits(ratio, 8) : text;
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
