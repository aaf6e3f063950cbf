/** An answer as its command tells it: sentences, tables with what is said below them, pictures. */
import { html, useEffect, useRef, useState } from "../vendor/preact.js";
import { fetchRaw, useAddress, useAsked } from "./api.js";
import { inWords, symbol } from "./symbols.js";
import { Table } from "./table.js";
import { again, headed, inText, shown, to } from "./us.js";
import { placeOf } from "./work.js";

/** What stands for the command of a job of any. */
export const ANY = "any";

/**
 * A picture that a job left, fetched once it is seen; `made`: how it is read, where it is no file of its own.
 * @param {{at: string, alt: string, kind: string, made?: (answer: Response) => Promise<Blob>}} props
 */
export function Drawn({ at, alt, kind, made = (answer) => answer.blob() }) {
  const box = useRef(null);
  const [seen, setSeen] = useState(false);
  useEffect(() => {
    if (!box.current) return;
    const watch = new IntersectionObserver(([entry]) => entry.isIntersecting && setSeen(true));
    watch.observe(box.current);
    return () => watch.disconnect();
  }, [at]);
  const path = seen ? at : "";
  const source = useAddress(useAsked(path, async (leave) => made(await fetchRaw(path, leave))).found);
  return html`<div class=${kind} ref=${box}>${source ? html`<img src=${source} alt=${alt} />` : null}</div>`;
}

/** Columns of which nothing is shown in other units. */
const KEPT = ["equation", "source", "as written", "key", "keys"];
const NUMBERS = /^[-+\d.eE]+(?: to [-+\d.eE]+)*$/;

/** A table in the units that the reader is shown: by its column of units, or by those above numbers. */
export function inUnits({ columns, rows, title, remarks }) {
  const place = columns.findIndex(({ heading }) => heading === "unit");
  const heads = columns.map(({ heading }) => headed(heading));
  const all = headed(title);
  const cell = (text, unit, { heading, right, typeset }) => (typeset || KEPT.includes(heading) ? text
    : right && to(unit) && NUMBERS.test(text) ? text.replace(/[-+\d.eE]+/g, (each) => again(each, unit))
    : inText(text));
  return {
    title: place < 0 ? all.head : inText(title), remarks: remarks.map(inText),
    columns: columns.map((one, at) => ({ ...one, heading: place < 0 ? heads[at].head : one.heading })),
    rows: rows.map((row) => row.map((text, at) => (at === place ? shown(0, text)[1]
      : cell(text, place < 0 ? (to(heads[at].unit) ? heads[at] : all).unit : row[place], columns[at])))),
  };
}

/** @param {{title: string, columns: any[], rows: string[][], remarks: string[], name: string}} props */
function One({ name, ...told }) {
  const { title, columns, rows, remarks } = inUnits(told);
  const cell = ({ typeset }, at) => (row) => (typeset ? symbol(row[at]) : inWords(row[at]));
  const shown = columns.map((one, at) => [inWords(one.heading), cell(one, at), one.right ? "right" : at ? "" : "row"]);
  return html`${rows.length ? html`<${Table} kind="of-command" caption=${title && inWords(title)} columns=${shown}
      rows=${rows} region=${title || name} wide="whole" />` : title ? html`<p><b>${inWords(title)}</b></p>` : null}
    ${remarks.length ? html`<ul class="says">${remarks.map((each) =>
      html`<li key=${each}>${inWords(each)}</li>`)}</ul>` : null}`;
}

/** What a job's command tells. @param {{work: import("./work.js").Job}} props */
export function Told({ work }) {
  const { told } = work.data ?? {};
  const pictures = work.job?.files?.filter((each) => each.endsWith(".png")) ?? [];
  const named = (file) => file.replace(/\.png$/, "").replaceAll(/[-_]/g, " ");
  if (!told) return null;
  const said = (text) => inWords(text.charAt(0).toUpperCase() + text.slice(1));
  return html`${told.sentences.map((each, at) => html`<p class=${at ? "" : "big"} key=${each}>${said(each)}</p>`)}
    ${told.tables.map((each, at) => html`<${One} key=${at} ...${each} name=${`table ${at + 1}`} />`)}
    <div class="grid">${pictures.map((file) => html`<figure class="plot" key=${file}>
      <figcaption>${named(file)}</figcaption>
      <${Drawn} at=${placeOf(work.id, encodeURIComponent(file))} kind="drawn-by"
        alt=${`${named(file)}, drawn`} /></figure>`)}</div>`;
}
