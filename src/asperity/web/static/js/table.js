/** Tables, all made in one way. */
import { html } from "../vendor/preact.js";

/**
 * @typedef {[any, (row: any, at: number) => any, string?, object?]} Column what heads it, what is in
 *   a cell, "row" where the cell heads its row, "right" where it holds numbers or "taking" where it is of use on the
 *   page alone, and attributes of its head, with `data-head` where it is no text
 */

/**
 * @param {{columns: Column[], rows: any[], region?: string, wide?: string, label?: string,
 *   kind?: string, caption?: string}} props `region`: the name of what is scrolled
 */
export function Table({ columns, rows, region, wide = "", label, kind, caption }) {
  /** @param {Column} column @param {any} row @param {number} at */
  const cell = ([head, made, as, more], row, at) =>
    as === "row" ? html`<th scope="row">${made(row, at)}</th>`
      // On a phone it stands beside what is in the cell, see .cards.
      : html`<td class=${as} data-head=${typeof head === "string" ? head : more?.["data-head"]}>${made(row, at)}</td>`;
  const table = html`<table class=${kind} aria-label=${label}>
    ${caption ? html`<caption>${caption}</caption>` : null}
    ${columns.some(([head]) => head) ? html`<thead><tr>${columns.map(([head, , as, more]) => html`
      <th scope="col" class=${as === "row" ? undefined : as} ...${more}>${head}</th>`)}</tr></thead>` : null}
    <tbody>${rows.map((row, at) => html`<tr key=${row.key ?? at}>${columns.map((each) => cell(each, row, at))}</tr>`)}
    </tbody></table>`;
  return region
    ? html`<div class=${`scroll ${wide}`} tabindex="0" role="region" aria-label=${region}>${table}</div>`
    : html`<div class="across">${table}</div>`;
}

/** A label with its unit. @param {{label: string, unit?: string}} props */
export const named = ({ label, unit }) => (unit ? `${label} (${unit})` : label);
