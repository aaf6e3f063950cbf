/** Pictures, and what stands beneath each: as table; as PNG, SVG and CSV, which `export.js` makes once asked for. */
import { html, useRef, useState } from "../vendor/preact.js";
import { inWords, plain, printed, unitOf } from "./symbols.js";
import { named, Table } from "./table.js";
import { column } from "./us.js";
import { digits } from "./units.js";

/** What a file is called for something. @param {string} name */
export const fileOf = (name) => name.replace(/\.toml$/i, "").replace(/[^\w.-]+/g, "-").replace(/^[-.]+|-+$/g, "");

/** Hand a file to the reader. @param {string} name @param {Blob | string} content */
export function download(name, content) {
  const blob = content instanceof Blob ? content : new Blob([content]);
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const made = () => import("./export.js");
// Once there is nothing else to do, so that it is there when the server is not.
setTimeout(() => made().catch(() => {}), 3000);

/** A name for a file: letters, digits and hyphens. */
const stem = (title) => title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "") || "plot";

/**
 * What stands beneath a picture.
 * @param {{title: string, columns: () => {label: string, unit?: string, values: any[]}[],
 *   svg?: () => string | Promise<string>}} props
 */
export function Beneath({ title, columns: given, svg }) {
  const [open, setOpen] = useState(false);
  const shown = () => given().map(column);
  const columns = open ? shown() : [];
  const name = stem(title);
  const button = (label, run) =>
    html`<button type="button" class="quiet" aria-label=${`${title} as ${label}`} onClick=${run}>${label}</button>`;
  const cell = (value) => (typeof value === "number" ? digits(value, 6) : (value ?? ""));
  return html`<div class="beneath">
    <details onToggle=${(event) => setOpen(event.target.open)}>
      <summary aria-label=${`${title} as table`}>as table</summary>
      ${columns.length ? html`<${Table} region=${`${title}, table`} rows=${columns[0].values}
        columns=${columns.map(({ label, unit, values }) => [printed(named({ label, unit: unitOf(unit) })),
          (_, at) => cell(values[at]), "right"])} />` : null}
    </details>
    <span class="files">
      ${svg ? button("PNG", async () => download(`${name}.png`, await (await made()).png(await svg()))) : null}
      ${svg ? button("SVG", async () => download(`${name}.svg`, await svg())) : null}
      ${button("CSV", async () => download(`${name}.csv`, (await made()).csv(shown())))}
    </span>
  </div>`;
}

/**
 * A picture: what is in `svg.drawn` among its children, and the entries of its `.legend`, are what
 * goes into a file; what is `passing` is left out.
 */
export function Figure({ title, kind = "", columns, children }) {
  const figure = useRef(null);
  return html`<figure class=${`plot ${kind}`} ref=${figure}>
    <figcaption data-title=${plain(title)}>${inWords(title)}</figcaption>
    ${children}
    <${Beneath} title=${title} columns=${columns} svg=${async () => (await made()).pictureOf(figure.current)} />
  </figure>`;
}
