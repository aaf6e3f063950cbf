/** Fields made from the tables of a case: unit, bounds, choices, example, one line of meaning. */
import { html, useEffect, useRef, useState } from "../vendor/preact.js";
import { forms, useCaseFile } from "./api.js";
import { fault, instead, useCase } from "./state.js";
import { inWords, printed } from "./symbols.js";
import { useTouch } from "./touch.js";
import { digits, inUnit, split } from "./units.js";
import { shown, written } from "./us.js";

/** Words of a key: `drive_velocity` is "drive velocity". */
export const words = (key) => key.replaceAll("_", " ");

/** What the forms say of a key; undefined where there is none or they are not there yet. */
export function fieldOf(path) {
  const [table, key] = path.split(".");
  return forms.value?.[table]?.keys.find((each) => each.key === key);
}

/**
 * What a key is now and where that comes from.
 * @returns {{text: string, from: "set" | "case" | "default" | "example" | "", own?: string}} `own`: what
 *   the case says of what is set
 */
export function useValue(path) {
  const { name, settings } = useCase();
  const file = useCaseFile(name);
  const [table, key] = path.split(".");
  const displaced = (instead.get(path) ?? []).some((other) => other in settings);
  const written = file?.tables[table]?.[key];
  if (path in settings) return { text: settings[path], from: "set", own: written };
  if (written !== undefined && !displaced) return { text: written, from: "case" };
  const others = (instead.get(path) ?? []).length > 0;
  const fallback = others ? "" : (fieldOf(path)?.default ?? "");
  return { text: fallback, from: fallback ? "default" : "" };
}

/** SI units behind a comma: a box takes a text with a unit of its own. */
const SI = /, (?:rad\/s|rad|N m|N s\/m|N\/m|m\/s|m\/N|s\/m|kg m2|kg|Pa|Hz|m|s|N|K|V)(?=[.:;,]|$)/;
/** What the other form of a key is, which is said behind it anyway. */
const GIVE = / *(?:Give this|Exactly one of)[^.;]*\.?/;

/** What a key means, as it is said beside its box. */
function meaningOf({ meaning, kind, follows }) {
  const said = kind === "quantity" ? meaning.replace(SI, "").replace(/, rad (?=\()/, " ") : meaning;
  return follows?.length ? said.replace(GIVE, "").replace(".;", ";") : said;
}

function hint(field) {
  const unit = field.unit ? ` ${field.unit}` : "";
  const { minimum: low, maximum: high } = field;
  const above = field.open ? "above" : "from";
  const bounds =
    low === null && high === null ? ""
    : high === null ? `${above} ${digits(low)}${unit}`
    : low === null ? `up to ${digits(high)}${unit}`
    : `${above} ${digits(low)} to ${digits(high)}${unit}`;
  const example = field.example ? `such as ${field.example}` : "";
  return [bounds, example].filter(Boolean).join(", ");
}

/** A text box that says what was typed when it is left or Enter is pressed. */
export function Box({ id, text, onSet, describedby, invalid, placeholder, label, list }) {
  const [typed, setTyped] = useState(null);
  useEffect(() => setTyped(null), [text]);
  const done = () => {
    if (typed !== null && typed.trim() !== text) onSet(typed.trim());
    setTyped(null);
  };
  return html`<input
    type="text" id=${id} class="box" autocomplete="off" spellcheck=${false}
    value=${typed ?? text} placeholder=${placeholder ?? ""} aria-label=${label}
    list=${list} aria-describedby=${describedby} aria-invalid=${invalid ? "true" : undefined}
    onInput=${(event) => setTyped(event.target.value)}
    onChange=${done} onBlur=${done}
    onKeyDown=${(event) => event.key === "Enter" && done()}
  />`;
}

/** A number of another base, which TOML would take. */
const BASED = /^\s*[+-]?0[box]/i;

/** With the unit that was there before, if a bare number was typed. */
function withUnit(typed, before, field) {
  if (BASED.test(typed) && field.kind !== "text") return JSON.stringify(typed);
  const [number, unit] = split(typed);
  if (field?.kind !== "quantity" || unit || Number.isNaN(number)) return typed;
  const usual = split(written(before))[1] || shown(0, field.unit)[1];
  return usual ? `${typed} ${usual}` : typed;
}

/** One key of the case with its label. `label` is said instead of the key's own words. */
export function Field({ path, label, brief }) {
  const { set, unset } = useCase();
  const { text, from, own = "" } = useValue(path);
  const field = fieldOf(path);
  if (!field) return null;
  const id = `field-${path.replace(".", "-")}`;
  const said = label ?? words(field.key);
  const wrong = fault.value.includes(`${path} `);
  const others = (field.follows ?? []).map(words).join(" or ");
  const put = (typed) =>
    typed === "" ? unset(path) : set(path, withUnit(typed, wrong ? own : text, field));
  const listed = field.listed ?? [];
  const figures = listed.find(({ name }) => name === text)?.says;
  return html`<div class=${`field ${from}`}>
    <label for=${id}>${said}</label>
    ${field.kind === "choice" || field.kind === "flag"
      ? html`<select id=${id} value=${text} aria-describedby=${`${id}-says`}
          aria-invalid=${wrong ? "true" : undefined}
          onChange=${(event) => put(event.target.value)}>
          ${text ? null : html`<option value="">–</option>`}
          ${(field.kind === "flag" ? ["true", "false"] : field.choices).map(
            (each) => html`<option value=${each}>${each}</option>`,
          )}
        </select>`
      : html`<${Box} id=${id} text=${field.kind === "quantity" ? written(text) : text} onSet=${put} invalid=${wrong}
          list=${listed.length ? `${id}-list` : undefined}
          placeholder=${written(field.example)} describedby=${`${id}-says`} />
        ${listed.length ? html`<datalist id=${`${id}-list`}>${listed.map(({ name, says }) =>
          html`<option value=${name}>${says}</option>`)}</datalist>` : null}`}
    ${from === "set"
      ? html`<button type="button" class="quiet" title="back to the case's own"
          aria-label=${`${said}: back to the case's own`} onClick=${() => unset(path)}>↺</button>`
      : null}
    ${figures ? html`<p class="says figures">${printed(figures)}</p>` : null}
    <p class=${brief ? "says hidden" : "says"} id=${`${id}-says`}>
      ${inWords(printed(meaningOf(field)))}${hint(field) ? ` (${printed(hint(field))})` : ""}${
        others ? ` Instead of ${others}.` : ""}
    </p>
  </div>`;
}

/** Tables of the case, a group of fields each; what is not said in it is folded away. */
export function Form({ tables, brief = false }) {
  const { name, settings } = useCase();
  const file = useCaseFile(name);
  if (!forms.value) return html`<p class="wait">The forms are coming.</p>`;
  return tables.map((table) => {
    const { meaning, keys } = forms.value[table];
    const said = ({ key, required }) =>
      required || `${table}.${key}` in settings || file?.tables[table]?.[key] !== undefined;
    const field = ({ key }) =>
      html`<${Field} key=${key} path=${`${table}.${key}`} brief=${brief} />`;
    const others = keys.filter((key) => !said(key));
    return html`<fieldset class="table" key=${table}>
      <legend>${words(table)}</legend>
      ${brief ? null : html`<p class="says">${meaning}</p>`}
      ${keys.filter(said).map(field)}
      ${others.length
        ? html`<${Unfolded} says=${`${others.length} more`} made=${() => others.map(field)} />`
        : null}
    </fieldset>`;
  });
}

/**
 * What is folded away, made when it is opened: a slider that is dragged draws none of it.
 * @param {{says: string, made: () => any}} props
 */
export function Unfolded({ says, made }) {
  const [open, setOpen] = useState(false);
  return html`<details onToggle=${(event) => event.target.open !== open && setOpen(event.target.open)}>
    <summary>${says}</summary>${open ? made() : null}</details>`;
}

/** Every key of some tables. */
export const AllKeys = ({ tables, brief }) => html`<${Unfolded} says="every key of the case"
  made=${() => html`<${Form} tables=${tables} brief=${brief} />`} />`;

/** What is set, folded away at first where there is room for one column only. */
export const Folded = ({ children }) => html`<details open=${innerWidth > 900}>
  <summary>what is set</summary>${children}</details>`;

/** Digits of what a slider says, few enough to read and enough to tell its steps apart. */
const KEPT = 3;
const STEPS_A_DECADE = 100;

/**
 * A slider with a number box, for a key of the case.
 *
 * @param {{path: string, label?: string, low?: number, high?: number, unit?: string,
 *   log?: boolean, step?: number}} props bounds and step in `unit`, that of the forms if left out
 */
export function Slider({ path, label, low, high, unit, log, step }) {
  const { set, unset } = useCase();
  const { text, own: before = "" } = useValue(path);
  const field = fieldOf(path);
  const moved = useRef(null);
  const touch = useTouch((event) => moved.current(event));
  if (!field) return null;
  const wrong = fault.value.includes(`${path} `);
  const own = unit ?? field.unit;
  const usual = split(field.example)[0] || 1;
  const byRatio = log ?? field.log;
  const least = low ?? (byRatio ? usual / 100 : (field.minimum ?? 0));
  const most = high ?? (byRatio ? usual * 100 : (field.maximum ?? 2 * usual));
  const now = inUnit(text, own);
  const spread = Math.log10(most / least);
  const steps = byRatio ? Math.round(STEPS_A_DECADE * spread) : 0;
  const place = byRatio ? Math.log10(Math.max(now, least) / least) * STEPS_A_DECADE : now;
  moved.current = (event) => {
    const at = Number(event.target.value);
    const wanted = byRatio ? least * 10 ** (at / STEPS_A_DECADE) : at;
    // In the unit that is written, so that 0.5 mm/s does not become 0.0005 m/s.
    const written = (Number.isFinite(now) && split(text)[1]) || own;
    const value = inUnit(`${wanted} ${own}`, written);
    set(path, `${digits(value, byRatio ? KEPT : 6)}${written ? ` ${written}` : ""}`);
  };
  const id = `slide-${path.replace(".", "-")}`;
  const said = label ?? words(field.key);
  const put = (typed) =>
    typed === "" ? unset(path) : set(path, withUnit(typed, (wrong ? before : text) || `0 ${own}`, field));
  return html`<div class="slider">
    <label for=${id} title=${meaningOf(field)}>${said}</label>
    <${Box} text=${written(text, 4)} onSet=${put} label=${`${said}, typed`} placeholder=${written(field.example)}
      invalid=${wrong} />
    <input type="range" id=${id} min=${byRatio ? 0 : least} max=${byRatio ? steps : most}
      step=${byRatio ? 1 : (step ?? (most - least) / 200)}
      value=${Number.isFinite(place) ? place : 0} aria-valuetext=${written(text) || "not given"}
      ...${touch} />
  </div>`;
}

/** Forms of an amplitude: what is said of each. */
const AMPLITUDES = {
  velocity_ratio: "velocity ratio k", velocity_amplitude: "velocity amplitude", displacement_amplitude: "amplitude",
};

/**
 * How strong a vibration is, in the form that the case says it.
 * @param {{bounds: Record<string, {low: number, high: number, unit: string}>}} props by form
 */
export function Amplitude({ bounds }) {
  const forms = Object.keys(AMPLITUDES);
  const texts = forms.map((key) => useValue(`vibration.${key}`).text);
  const key = forms[Math.max(texts.findIndex(Boolean), 0)];
  return html`<${Slider} path=${`vibration.${key}`} label=${AMPLITUDES[key]} log ...${bounds[key]} />`;
}
