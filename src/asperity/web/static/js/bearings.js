/** The bearings of a case's shafts: each chosen from a list, with the figures it is chosen by. */
import { html } from "../vendor/preact.js";
import { useCaseFile } from "./api.js";
import { fieldOf, Unfolded, useValue, words } from "./form.js";
import { fault, useCase } from "./state.js";
import { printed } from "./symbols.js";

const SHAFTS = ["worm_shaft", "wheel_shaft"];
const FIGURES = ["kind", "bore", "dynamic_rating", "static_rating"];
const BEARING = /[{,]\s*bearing\s*=\s*/;

/** A value that begins somewhere in a text of a case: a text, a number, a table or a list, as it is written. */
function valueAt(text, from) {
  let [deep, quoted, at] = [0, false, from];
  for (; at < text.length; at += 1) {
    const sign = text[at];
    if (sign === '"') quoted = !quoted;
    if (sign === "\\") at += 1;
    if (quoted) continue;
    if (sign === "{" || sign === "[") deep += 1;
    if (!deep && /[,}\]]/.test(sign)) break;
    if (sign === "}" || sign === "]") deep -= 1;
  }
  return text.slice(from, at).trimEnd();
}

/** The bearings of a list of places: where each stands, from where on to where it is written, and how. */
function placesOf(text) {
  const found = [];
  for (let at = text.indexOf("{"); at >= 0; at = text.indexOf("{", at)) {
    const place = valueAt(text, at);
    const key = BEARING.exec(place);
    const from = key ? at + key.index + key[0].length : at + place.length - 1;
    const value = key ? valueAt(text, from) : "";
    found.push({ from, to: from + value.length, value, where: /\bat\s*=\s*"([^"]*)"/.exec(place)?.[1] ?? "" });
    at += place.length;
  }
  return found;
}

/** A bearing that is written in the case: its name, and its figures in words. */
function readOf(value) {
  const own = (key) => {
    const written = new RegExp(`\\b${key}\\s*=\\s*(?:"((?:[^"\\\\]|\\\\.)*)"|([^,}]*))`);
    const [, quoted, plain = ""] = written.exec(value) ?? [];
    return quoted?.replace(/\\(.)/g, "$1") ?? plain.trim();
  };
  const says = FIGURES.map((key) => own(key) && (key === "kind" ? own(key) : `${words(key)} ${own(key)}`));
  return { name: own("name") || own("kind"), says: says.filter(Boolean).join(", ") };
}

/** What may be chosen, by how it is written: those of data files, and those of the case. */
function choicesOf(tables, texts) {
  const known = SHAFTS.flatMap((shaft) => fieldOf(`${shaft}.bearing`)?.listed ?? []);
  const written = [...SHAFTS.map((shaft) => tables[shaft]?.bearing ?? ""), ...texts].flatMap(placesOf)
    .map(({ value }) => value).filter((value) => value.startsWith("{"));
  return new Map(/** @type {[string, any][]} */ ([...written.map((value) => [value, readOf(value)]),
    ...known.map((one) => [JSON.stringify(one.name), one])]));
}

/** Both bearings of each shaft that the case has. @param {{name: string}} props */
export function ShaftBearings({ name }) {
  const { set } = useCase();
  const tables = useCaseFile(name)?.tables ?? {};
  const texts = SHAFTS.map((shaft) => useValue(`${shaft}.bearing`).text);
  if (!texts.some(Boolean)) return null;
  const choices = choicesOf(tables, texts);
  const listed = [...choices.keys()].some((value) => value.startsWith('"'));
  const made = () => html`<fieldset class="table">
    ${SHAFTS.flatMap((shaft, row) => placesOf(texts[row]).map(({ from, to, value, where }, at) => {
      const id = `${shaft}-bearing-${at}`;
      const put = ({ target }) => set(`${shaft}.bearing`, `${texts[row].slice(0, from)}${
        value ? "" : ", bearing = "}${target.value}${texts[row].slice(to)}`);
      return html`<div class="field" key=${id}>
        <label for=${id}>${words(shaft)}, bearing at ${printed(where)}</label>
        <select id=${id} value=${value} onChange=${put} aria-describedby=${`${id}-says`}
          aria-invalid=${fault.value.includes(`${shaft}.bearing `) ? "true" : undefined}>
          ${choices.has(value) ? null : html`<option value=${value}>${JSON.parse(value || '"none"')}</option>`}
          ${[...choices].map(([text, one]) => html`<option value=${text}>${one.name}: ${printed(one.says)}</option>`)}
        </select>
        <p class="says figures" id=${`${id}-says`}>${printed(choices.get(value)?.says)}</p></div>`;
    }))}
    ${listed ? null : html`<p class="says">Listed are those of the case; with a data file of your own, its own too:
      asperity --materials FILE page.</p>`}</fieldset>`;
  return html`<${Unfolded} says="bearings of the shafts" made=${made} />`;
}
