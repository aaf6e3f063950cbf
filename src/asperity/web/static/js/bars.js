/** Bars that say in words what they show: margins against a limit, and what moves a number. */
import { html } from "../vendor/preact.js";
import { Num } from "./number.js";
import { symbol } from "./symbols.js";
import { Table } from "./table.js";
import { digits } from "./units.js";

/** What people call the standards. */
export const STANDARDS = { iso14521: "ISO/TR 14521", bs721: "BS 721", agma6034: "AGMA 6034" };
/** Times what is asked at which a bar ends. */
const MOST = 3;

/** A sign and a word, with the colour besides; neither good nor bad, in the word of `other`, where nothing tells. */
export const Verdict = ({ ok, yes = "holds", no = "fails", other = "" }) =>
  ok === null ? html`<span class="verdict">? ${other}</span>`
    : html`<span class=${ok ? "verdict good" : "verdict bad"}>${ok ? `✓ ${yes}` : `✗ ${no}`}</span>`;

/**
 * A bar; `on`: it goes on beyond its end.
 * @param {{from: number, to: number, kind: string, mark: number, on?: boolean}} props
 */
export function Bar({ from, to, kind, mark, on = false }) {
  return html`<svg class="bar" viewBox="0 0 300 12" preserveAspectRatio="none" aria-hidden="true">
    <rect class="ground" width="300" height="12" />
    <rect class=${kind} x=${Math.min(from, to)} width=${Math.max(Math.abs(to - from), 1)} height="12" />
    <path class="mark" d=${`M${mark} 0V12`} />
    ${on ? html`<path class="goes-on" d="M284 1L292 6L284 11M291 1L299 6L291 11" />` : null}
  </svg>`;
}

/** A bar to either side of nothing. */
export const Sided = ({ value, most, kind = value < 0 ? "less" : "more" }) =>
  html`<${Bar} from=${150} to=${150 + (150 * value) / most} mark=${150} kind=${kind} />`;

/**
 * Safeties over what is asked of them.
 * @param {{rows: {name: string, symbol: string, value: number, asked: number, holds: boolean,
 *   entry: any}[]}} props
 */
export const Margins = ({ rows }) => html`<${Table} kind="bars" rows=${rows} columns=${[
  ["safety", (row) => html`${row.name} <span class="of">${symbol(row.symbol)}</span>`, "row"],
  ["0 to 3 × asked", ({ value, asked, holds }) => html`<${Bar} from=${0}
    to=${Math.min(value / asked / MOST, 1) * 300} mark=${300 / MOST} kind=${holds ? "good" : "bad"}
    on=${value / asked > MOST} />`],
  ["value", ({ entry, value }) => (entry ? html`<${Num} entry=${entry} count=${3} />` : digits(value, 3)), "right"],
  ["asked", ({ asked }) => digits(asked, 3), "right"],
  ["verdict", ({ holds }) => html`<${Verdict} ok=${holds} />`],
]} />`;

/**
 * What moves a number, the strongest first; a bar with `pick` is tried by a click.
 * @param {{label: string, rows: {name: string, change: number | null, says: string, why?: string,
 *   pick?: () => void}[], unit: string}} props `change` null where there is no answer: `why`
 */
export function Tornado({ label, rows, unit }) {
  const most = Math.max(...rows.map(({ change }) => Math.abs(change ?? 0)), 1e-9);
  const sorted = rows.toSorted((a, b) => Math.abs(b.change ?? 0) - Math.abs(a.change ?? 0));
  const signed = (change) => `${change < 0 ? "−" : "+"}${digits(Math.abs(change), 3)} ${unit}`;
  return html`<${Table} kind="bars" label=${label} rows=${sorted} columns=${[
    ["", ({ says, pick }) =>
      (pick ? html`<button type="button" class="quiet" onClick=${pick}>try ${says}</button>` : says), "row"],
    ["", ({ change, why }) =>
      (change === null ? html`<span class="says">${why}</span>` : html`<${Sided} value=${change} most=${most} />`)],
    ["", ({ change }) => (change === null ? "–" : signed(change)), "right"],
  ]} />`;
}
