/** Symbols set as they are printed: S_delta with its index below, mu as µ. */
import { html } from "../vendor/preact.js";
import { inText } from "./us.js";

const GREEK = {
  alpha: "α", beta: "β", gamma: "γ", delta: "δ", epsilon: "ε", zeta: "ζ", eta: "η", theta: "θ", lambda: "λ",
  mu: "µ", nu: "ν", xi: "ξ", pi: "π", rho: "ρ", sigma: "σ", tau: "τ", phi: "φ", chi: "χ", psi: "ψ", omega: "ω",
};
const NAMES = Object.keys(GREEK).join("|");
/** In a formula: a letter or two, or a Greek one by its name, and what stands below it. */
const SYMBOL = new RegExp(`(?<![A-Za-z0-9_.])(${NAMES}|[A-Za-z]{1,2})(?:_([A-Za-z0-9_]+))?(?![A-Za-z0-9_])`, "g");
/** In a sentence: only what has something below it, or is a factor before such a thing. */
const IN_WORDS = new RegExp(
  `(?<![A-Za-z0-9_.])(?:(${NAMES}|[A-Za-z]|Ra)_([A-Za-z0-9]{1,6})(?![A-Za-z0-9_.]\\w|\\w)|(mu)(?= [A-Z]_))`, "g");

/** Units as they are printed: 40 degC is 40 °C, mm^2/s is mm²/s. @param {string} [text] */
const print = (text) => String(text ?? "").replace(/\bdeg([CF])\b/g, "°$1")
  .replace(/(?:\^|\*\*)2\b/g, "²")
  .replace(/(?:\^|\*\*)3\b/g, "³").replace(/(?<=\d |\()u(?=[mAVNs]\b)/g, "µ").replace(/(?<=\d) deg\b/g, "°")
  .replace(/(?<=(?:\d |\(|\/)(?:[cmuµ]?m|in|ft))[23](?![\w.])/g, (power) => (power === "2" ? "²" : "³"))
  .replace(/\(deg\)/g, "(°)");

/** A unit by itself as it is printed: um is µm, mm2/s is mm²/s. @param {string} [unit] */
export const unitOf = (unit) => print(unit).replace(/^deg$/, "°").replace(/\bu(?=(?:m|s|rad|in|N|V)(?![a-z]))/g, "µ")
  .replace(/(?<=[A-Za-z])([23])(?!\d)/g, (_, power) => (power === "2" ? "²" : "³"));

/** The same in the units that the reader is shown. @param {string} text */
export const printed = (text) => print(inText(text));

/** @returns {{text: string, below: string}[]} pieces of a text, each with what stands below it */
export function pieces(text, pattern = SYMBOL) {
  const found = [];
  let at = 0;
  for (const match of String(text).matchAll(pattern)) {
    const [whole, base = match[3], below = ""] = match;
    if (!below && !GREEK[base]) continue;
    found.push({ text: text.slice(at, match.index) + (GREEK[base] ?? base), below: GREEK[below] ?? below });
    at = match.index + whole.length;
    // A factor is set close to what it multiplies.
    if (match[3]) at += 1;
  }
  return [...found, { text: String(text).slice(at), below: "" }];
}

const set = (text, pattern) => (text ? pieces(text, pattern).map((each) => html`${each.text}${
  each.below ? html`<sub>${each.below.replace("_", ",")}</sub>` : null}`) : text);

/** A symbol or a formula. @param {string} text */
export const symbol = (text) => set(text, SYMBOL);
/** The same where nothing can stand below a letter. @param {string} text */
export const plain = (text) => String(text ?? "").replace(/\bmu (?=[A-Z]_)/g, "µ ");
/** A sentence with symbols in it. @param {string} text */
export const inWords = (text) => set(inText(text), IN_WORDS);
/** What somebody wrote, in the units that it has. @param {string} text */
export const quoted = (text) => set(print(text), IN_WORDS);
