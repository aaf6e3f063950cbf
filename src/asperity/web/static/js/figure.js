/** Pictures, and what stands beneath each: as table, PNG, SVG, CSV. */
import { html, useRef, useState } from "../vendor/preact.js";
import { inWords, plain } from "./symbols.js";
import { named, Table } from "./table.js";
import { column } from "./us.js";
import { digits } from "./units.js";

const SVG = "http://www.w3.org/2000/svg";
/** What of its style a drawing takes along into a file. */
const KEPT = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "vector-effect", "font-size",
  "font-weight"];
const [MARGIN, TITLE, ENTRY] = [12, 28, 20];

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

/** @param {{label: string, unit?: string, values: any[]}[]} columns */
function csv(columns) {
  const cell = (text) => {
    const plain = String(text ?? "");
    return /[",\n]/.test(plain) ? `"${plain.replaceAll('"', '""')}"` : plain;
  };
  const rows = columns[0].values.map((_, row) => columns.map(({ values }) => cell(values[row])));
  return [columns.map((column) => cell(named(column))), ...rows].map((cells) => cells.join(",")).join("\n") + "\n";
}

function element(name, attributes, ...inside) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...inside);
  return made;
}

/** The drawing of a figure with title and legend as SVG text, in the colours of a white page. */
function pictureOf(figure) {
  const drawn = figure.querySelector("svg.drawn");
  const { width, height } = drawn.getBoundingClientRect();
  const lasting = (node) => {
    const copy = node.cloneNode(true);
    copy.querySelectorAll(".passing").forEach((each) => each.remove());
    return copy;
  };
  const put = (svg, x, y) => {
    const copy = lasting(svg);
    const size = svg.getBoundingClientRect();
    const place = { x, y, width: size.width, height: size.height };
    for (const [key, value] of Object.entries(place)) copy.setAttribute(key, value);
    return copy;
  };
  const text = (said, x, y, more = {}) => element("text", { x, y, "font-size": 13, ...more }, said);
  const entries = [...figure.querySelectorAll(".legend li:not(.passing)")];
  const below = TITLE + height + MARGIN;
  const whole = element("svg", { width: width + 2 * MARGIN, height: below + ENTRY * entries.length + MARGIN });
  whole.append(
    element("rect", { class: "sheet", width: "100%", height: "100%" }),
    text(figure.querySelector("figcaption").dataset.title, MARGIN, MARGIN + 12, { class: "title" }),
    put(drawn, MARGIN, TITLE),
  );
  entries.forEach((entry, at) => {
    const middle = below + ENTRY * (at + 0.5);
    const sign = entry.querySelector("svg");
    const { width: wide, height: high } = sign.getBoundingClientRect();
    const said = lasting(entry).textContent.replace(/\s+/g, " ").trim();
    const placed = put(sign, MARGIN, middle - high / 2);
    placed.classList.add("sign");
    whole.append(placed, text(said, MARGIN + wide + 8, middle + 4));
  });
  const paper = document.createElement("div");
  paper.className = "paper";
  const frame = figure.cloneNode(false);
  frame.append(whole);
  paper.append(frame);
  document.body.append(paper);
  for (const each of whole.querySelectorAll("*")) {
    const style = getComputedStyle(each);
    for (const name of KEPT) each.setAttribute(name, style.getPropertyValue(name));
  }
  paper.remove();
  whole.setAttribute("font-family", "sans-serif");
  return new XMLSerializer().serializeToString(whole);
}

/** An SVG text as a PNG, twice as fine as it is large. @returns {Promise<Blob>} */
async function png(svg) {
  const address = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  const image = new Image();
  image.src = address;
  await image.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [2 * image.naturalWidth, 2 * image.naturalHeight];
  /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d")).drawImage(image, 0, 0, canvas.width, canvas.height);
  URL.revokeObjectURL(address);
  return new Promise((done, failed) => canvas.toBlob((blob) =>
    (blob ? done(blob) : failed(new Error("the picture is too large"))), "image/png"));
}

/** A name for a file: letters, digits and hyphens. */
const stem = (title) => title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "") || "plot";

/**
 * What stands beneath a picture.
 * @param {{title: string, columns: () => {label: string, unit?: string, values: any[]}[],
 *   svg?: () => string}} props
 */
export function Beneath({ title, columns: made, svg }) {
  const [open, setOpen] = useState(false);
  const shown = () => made().map(column);
  const columns = open ? shown() : [];
  const name = stem(title);
  const button = (label, run) =>
    html`<button type="button" class="quiet" aria-label=${`${title} as ${label}`} onClick=${run}>${label}</button>`;
  const cell = (value) => (typeof value === "number" ? digits(value, 6) : (value ?? ""));
  return html`<div class="beneath">
    <details onToggle=${(event) => setOpen(event.target.open)}>
      <summary aria-label=${`${title} as table`}>as table</summary>
      ${columns.length ? html`<${Table} region=${`${title}, table`} rows=${columns[0].values}
        columns=${columns.map((column) => [named(column), (_, at) => cell(column.values[at]), "right"])} />` : null}
    </details>
    <span class="files">
      ${svg ? button("PNG", async () => download(`${name}.png`, await png(svg()))) : null}
      ${svg ? button("SVG", () => download(`${name}.svg`, svg())) : null}
      ${button("CSV", () => download(`${name}.csv`, csv(shown())))}
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
    <${Beneath} title=${title} columns=${columns} svg=${() => pictureOf(figure.current)} />
  </figure>`;
}
