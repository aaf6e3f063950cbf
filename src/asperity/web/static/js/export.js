/** What is shown as a file: numbers as CSV, a figure as SVG in the colours of a white page, a drawing as PNG. */
import { named } from "./table.js";

const SVG = "http://www.w3.org/2000/svg";
/** What of its style a drawing takes along into a file. */
const KEPT = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "vector-effect", "font-size",
  "font-weight"];
const [MARGIN, TITLE, ENTRY] = [12, 28, 20];

/** @param {{label: string, unit?: string, values: any[]}[]} columns */
export function csv(columns) {
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
export function pictureOf(figure) {
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
export async function png(svg) {
  const address = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  const image = new Image();
  image.src = address;
  await image.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [2 * image.naturalWidth, 2 * image.naturalHeight];
  const on = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  on.fillStyle = "#fff";
  on.fillRect(0, 0, canvas.width, canvas.height);
  on.drawImage(image, 0, 0, canvas.width, canvas.height);
  URL.revokeObjectURL(address);
  return new Promise((done, failed) => canvas.toBlob((blob) =>
    (blob ? done(blob) : failed(new Error("the picture is too large"))), "image/png"));
}
