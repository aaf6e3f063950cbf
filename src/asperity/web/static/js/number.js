/** A number that opens what is behind it: symbol, equation, source, trust. */
import { html, signal, useEffect, useRef, useState } from "../vendor/preact.js";
import { Beneath } from "./figure.js";
import { inWords, symbol, unitOf } from "./symbols.js";
import { Table } from "./table.js";
import { digits } from "./units.js";
import { readable, shown } from "./us.js";

const TRUST = {
  verified: "✓ verified", computed: "✓ computed",
  "one source": "~ one source", "own choice": "~ own choice", "from memory": "? from memory",
};

/**
 * @typedef {{key: string, symbol: string, value: any, unit: string, meaning: string,
 *   equation: string, source: string, own?: string, trust: string, resolution?: number}} Entry `own`:
 *   where the equation is from, if that is not the weakest `source` on the way; `resolution`: less
 *   than that is rounding
 */

/** The entry whose origin is shown, and the button that asked for it. */
const asked = signal(null);

/** @param {{entry: Entry | undefined, label?: boolean, count?: number}} props */
export function Num({ entry, label = false, count = 5 }) {
  if (!entry) return null;
  // What is rounding is told as nothing, as in the terminal.
  const none = entry.value && Math.abs(entry.value) <= (entry.resolution ?? 0);
  const [value, unit] =
    none ? [`0 within ${readable(entry.resolution, entry.unit, 1)[0]}`, readable(entry.resolution, entry.unit)[1]]
    : typeof entry.value === "number" ? readable(entry.value, entry.unit, count)
    : Array.isArray(entry.value) && entry.value.every((each) => typeof each === "number")
      ? [entry.value.map((each) => digits(shown(each, entry.unit)[0], count)).join(", "), shown(0, entry.unit)[1]]
    : [entry.value === null ? "–" : String(entry.value), entry.unit];
  return html`<span class="num">
    ${label ? html`<span class="of">${inWords(entry.meaning)}</span> ` : null}
    <button type="button" data-key=${entry.key} data-value=${entry.value ?? ""} data-unit=${entry.unit}
      title="where it comes from" aria-haspopup="dialog"
      onClick=${(event) => (asked.value = { entry, button: event.currentTarget })}>
      <b>${value}</b>${unit ? html` <i>${unitOf(unit)}</i>` : null}
    </button>
  </span>`;
}

/** What is behind the number that was clicked; once on the page. */
export function Behind() {
  const box = useRef(null);
  const { entry, button } = asked.value ?? {};
  useEffect(() => {
    if (!button) return;
    box.current.showPopover({ source: button });
    const { left, bottom } = button.getBoundingClientRect();
    const { style, offsetWidth, offsetHeight } = box.current;
    style.left = `${Math.max(8, Math.min(left, innerWidth - offsetWidth - 8))}px`;
    style.top = `${Math.max(8, Math.min(bottom + 6, innerHeight - offsetHeight - 8))}px`;
    box.current.focus();
  }, [asked.value]);
  const closed = (event) => {
    if (event.newState !== "closed") return;
    if (document.activeElement === document.body) asked.peek()?.button.focus();
    asked.value = null;
  };
  const rows = entry
    ? [
        ["symbol", symbol(entry.symbol)],
        ["exactly", `${[entry.value ?? "none"].flat().join(", ")} ${unitOf(entry.unit)}`],
        ["equation", symbol(entry.equation)], ["equation from", entry.own],
        [entry.trust === "computed" ? "source" : "weakest source of what it follows from", entry.source],
        ["trust", TRUST[entry.trust] ?? entry.trust], ["in --json", entry.key],
      ]
    : [];
  return html`<div popover="auto" ref=${box} class="behind" tabindex="-1" role="dialog"
      aria-label="where the number comes from" onToggle=${closed}>
    <p><b>${inWords(entry?.meaning)}</b></p>
    <dl>${rows.filter(([, text]) => (Array.isArray(text) ? text.length : String(text ?? "").trim()))
      .map(([name, text]) => html`<dt>${name}</dt><dd>${text}</dd>`)}</dl>
  </div>`;
}

/** Entries by the key of `--json`. @param {Entry[] | undefined} entries */
export function byKey(entries) {
  return Object.fromEntries((entries ?? []).map((entry) => [entry.key, entry]));
}

/** Some numbers of an answer side by side, those that there are. */
export const Facts = ({ found, keys }) => html`<p class="facts">${keys.map((key) => found[key])
  .filter((entry) => entry && entry.value !== null)
  .map((entry) => html`<${Num} key=${entry.key} entry=${entry} label count=${4} />`)}</p>`;

const SHOWN = ["value", "unit"];
const COLUMNS = [
  ["what", ({ meaning, key }) => inWords(meaning) || key], ["symbol", (entry) => symbol(entry.symbol)],
  ["value", (entry) => html`<${Num} entry=${entry} />`, "right"],
];

/**
 * All numbers of an answer, folded away; `of` tells them from others of the screen.
 * @param {{entries: Entry[], of?: string}} props
 */
export function AllNumbers({ entries, of = "" }) {
  const [open, setOpen] = useState(false);
  const columns = () => ["key", "symbol", "value", "unit", "meaning", "equation", "source"].map((label) =>
    ({ label, values: entries.map((entry) => (
      SHOWN.includes(label) ? shown(entry.value, entry.unit)[SHOWN.indexOf(label)] : entry[label])) }));
  return html`<details class="all" onToggle=${(event) => setOpen(event.target.open)}>
    <summary>all ${entries.length} numbers</summary>
    ${open ? html`<${Table} region=${`all numbers${of}`} rows=${entries} columns=${COLUMNS} />
      <${Beneath} title=${`All numbers${of}`} columns=${columns} />` : null}
  </details>`;
}
