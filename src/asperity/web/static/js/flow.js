/** Where power comes from and where it goes, and what the balance misses. */
import { html } from "../vendor/preact.js";
import { Figure } from "./figure.js";
import { Num } from "./number.js";

const IN = ["power_drive_W", "power_vibration_W", "power_normal_W"];
const OUT = ["power_friction_W", "power_damping_W", "power_contact_damping_W", "power_stored_W"];
/** Of all powers together, what is below is none. */
const ROUNDING = 1e-9;
/** Where the bars of both sides lie. */
const [WIDTH, BAR, STEP] = [100, 6, 11];

const total = (entries) => entries.reduce((sum, { value }) => sum + Math.abs(value), 0);

/** @param {{numbers: Record<string, import("./number.js").Entry>}} props */
export function Flow({ numbers }) {
  const known = (keys) => keys.map((key) => numbers[key]).filter((entry) => typeof entry?.value === "number");
  const all = [...known(IN), ...known(OUT)];
  if (!all.length) return null;
  const nothing = ROUNDING * total(all);
  // What is below nothing goes the other way.
  const side = (keys, others) => [
    ...known(keys).filter(({ value }) => value > nothing),
    ...known(others).filter(({ value }) => value < -nothing),
  ];
  /** @type {[string, any[]][]} */
  const sides = [["put in", side(IN, OUT)], ["goes to", side(OUT, IN)]];
  const most = Math.max(...sides.map(([, entries]) => total(entries))) || 1;
  const fill = (entry) => `fill${(all.indexOf(entry) % 7) + 1}`;
  const bar = (entries, row) => {
    let from = 0;
    return entries.map((entry) => {
      const width = (WIDTH * Math.abs(entry.value)) / most;
      from += width;
      return html`<rect key=${entry.key} class=${fill(entry)} x=${from - width} y=${STEP * row + 4}
        width=${Math.max(width - 0.3, 0.2)} height=${BAR} />`;
    });
  };
  const columns = () => [{ label: "power", values: all.map(({ meaning }) => meaning) },
    { label: "value", unit: "W", values: all.map(({ value }) => value) }];
  return html`<${Figure} title="Power" kind="flow" columns=${columns}>
    <svg class="drawn" viewBox=${`0 0 ${WIDTH} ${2 * STEP}`} aria-hidden="true">
      ${sides.map(([title, entries], row) => html`<text x="0" y=${STEP * row + 3}>${title}</text>${bar(entries, row)}`)}
    </svg>
    ${sides.map(([title, entries]) => html`<ul class="legend" key=${title} aria-label=${title}>
      ${entries.map((entry) => html`<li key=${entry.key}>
        <svg width="12" height="12" aria-hidden="true"><rect width="12" height="12" class=${fill(entry)} /></svg>
        <${Num} entry=${entry} label count=${4} /></li>`)}</ul>`)}
    <p class="says">${numbers.power_residual?.value > 1e-3 ? "✗ the balance misses" : "✓ the balance closes to"}
      ${" "}<${Num} entry=${numbers.power_residual} count=${2} /></p>
  <//>`;
}
