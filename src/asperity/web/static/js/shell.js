/** What is around every screen: where to go, the case, what to take along, what went wrong. */
import { html, signal, useEffect, useRef, useState } from "../vendor/preact.js";
import { about, useAsked, useCaseFile } from "./api.js";
import { Behind } from "./number.js";
import { address, called, caseParams, fault, go, redo, route, undo, undoable, useCase } from "./state.js";
import { inWords, printed } from "./symbols.js";
import { follow, Units } from "./us.js";
import { visited } from "./visited.js";

/**
 * @typedef {{name: string, title: string, kind: string, group: string,
 *   load: () => Promise<{view: () => any}>}} Listed a screen; `kind` of the cases it opens
 */

/** The group of screens that stand in no list. */
export const HIDDEN = "hidden";

/** What was just done, for a moment. */
const said = signal("");
/** Whether a file of the screen is being made. */
const sharing = signal(false);
let timer = 0;

/** Tell what was done. @param {string} text */
export function tell(text) {
  said.value = text;
  clearTimeout(timer);
  timer = setTimeout(() => (said.value = ""), 6000);
}

/** Make a file of the screen, and say so where that takes longer. */
async function shared(title, answer) {
  sharing.value = true;
  tell("the file is being made");
  try {
    const { share } = await import("./share.js");
    await share(title, answer, called());
    tell("the file is made: all of this, for anyone, without server and network");
  } catch (error) {
    tell(`no file: ${error.message}`);
  } finally {
    sharing.value = false;
  }
}

/** With which case each kind was last seen, so that a link leads back to it. */
const last = {};

/** @param {{screens: Listed[], children: any}} props */
export function App({ screens, children }) {
  const { screen, params } = route.value;
  const here = screens.find(({ name }) => name === screen);
  if (here?.kind) last[here.kind] = caseParams(params);
  const before = useRef("");
  useEffect(() => {
    // Not by scrollIntoView: Tab would go on there.
    const at = [...document.links].find((each) => each.ariaCurrent);
    at?.closest("nav")?.scroll(at.offsetLeft - 40, at.offsetTop - 90);
    // What was pressed is gone with its screen: the keyboard goes on from the answer.
    if (before.current && document.activeElement === document.body) document.getElementById("main")?.focus();
    before.current = screen;
  }, [screen]);
  useEffect(() => {
    document.title = `${here?.title ?? "?"} · asperity`;
  }, [here]);
  useEffect(() => {
    // Not each place that a slider passes.
    const note = () => here && visited(here.title, address({ screen, params }), params);
    const timer = here && params.case ? setTimeout(note, 1500) : 0;
    return () => clearTimeout(timer);
  }, [screen, params]);
  const link = ({ name, title, kind }) => html`<li key=${name}>
    <a href=${address({ screen: name, params: last[kind] ?? {} })}
      onClick=${(event) => {
        if (event.ctrlKey || event.metaKey || event.shiftKey) return;
        event.preventDefault();
        go(name, last[kind] ?? {});
      }}
      aria-current=${name === screen ? "page" : undefined}>${title}</a></li>`;
  return html`
    <button type="button" class="skip" onClick=${() => document.getElementById("main")?.focus()}>
      skip to the answer</button>
    <nav aria-label="screens">
      <p class="brand"><img src="icon.svg" alt="" width="22" height="22" /> asperity</p>
      ${[...new Set(screens.map(({ group }) => group))].filter((group) => group !== HIDDEN).map((group) => html`
        <div class="group" key=${group}>${group ? html`<p>${group}</p>` : null}
          <ul>${screens.filter((each) => each.group === group).map(link)}</ul></div>`)}
      <${Units} />
    </nav>
    <main id="main" tabindex="-1">
      ${about.value && !about.value.ready ? html`<p class="wait" role="status">
        What computes is starting: a moment, or some seconds the first time on this machine. The page
        comes alive by itself.</p>` : null}
      ${children}
    </main>
    <${Behind} />
    <div role="status" class=${said.value ? "toast shown" : "toast"}>${said.value}</div>`;
}

/** @type {[string, string, () => void][]} */
const STEPS = [["undo", "↶", undo], ["redo", "↷", redo]];

/** Which case is open. */
function CasePicker({ kinds, first, start = {} }) {
  const { name, settings, reset } = useCase();
  const cases = (about.value?.cases ?? []).filter(({ kind }) => kinds.includes(kind));
  const says = settings["project.units"] ?? useCaseFile(name)?.tables.project?.units ?? "";
  useEffect(() => {
    if (!name && first) reset(first, start, true);
  }, [name]);
  useEffect(() => (follow(says), () => follow("")), [says]);
  const option = (each) => html`<option key=${each.name} value=${each.alias || each.name}>
    ${each.alias || each.name}</option>`;
  const known = cases.find((each) => each.name === name || each.alias === name);
  const taken = settings["gearset.name"];
  const count = Object.entries(settings).filter(([path, text]) => start[path] !== text).length;
  return html`<div class="case">
    <label for="case">case</label>
    <select id="case" value=${known ? known.alias || known.name : name}
      onChange=${(event) => reset(event.target.value, start)}>
      ${known ? null : html`<option value=${name}>${name || "–"}</option>`}
      ${[false, true].map((shipped) => {
        const these = cases.filter((each) => each.shipped === shipped);
        return these.length ? html`<optgroup label=${shipped ? "shipped" : "in this folder"}>
          ${these.map(option)}</optgroup>` : null;
      })}
    </select>
    ${STEPS.map(([word, sign, act]) => html`<button type="button" class="quiet"
      title=${word === "undo" ? "Ctrl-Z" : "Ctrl-Shift-Z"} disabled=${!undoable.value[word]} onClick=${act}>
      <span aria-hidden="true">${sign}</span> <span class="word">${word}</span></button>`)}
    <button type="button" class="quiet as-it-was" disabled=${!count} onClick=${() => reset(name, start)}
      title=${count ? `${count} set` : ""}><span class="sign" aria-hidden="true">↺ </span><span class="word">as the case
        has it</span></button>
    <span class="on-paper"><b>${taken || known?.alias || name}</b></span>
    <span class="says">${taken ? html`now <b>${taken}</b>; all else as this case has it` : (known?.title ?? "")}</span>
  </div>`;
}

/** What saves the case, loaded once somebody wants to. @param {{toml: string | null, unless: any}} props */
function Save({ toml, unless }) {
  const [wanted, setWanted] = useState(0);
  const { found, error } = useAsked(wanted ? "save" : "", () => import("./save.js"));
  useEffect(() => error && tell(error.message), [error, wanted]);
  return html`<button type="button" disabled=${!toml} onClick=${unless(() => setWanted(wanted + 1))}>
      save case</button>
    ${found ? html`<${found.Saving} toml=${toml} wanted=${wanted} />` : null}`;
}

/** What is refused as it was given, and what it must be in the units that are shown. @param {string} line */
const refusal = (line) => line.split(/(?=; it must )/).map((part, at) => (at ? printed(part) : part)).join("");

/**
 * @typedef {{said: string, text: string, put: (text: string) => void, usual?: string,
 *   field: import("./mends.js").Bounds}} Other what a screen asks beside its case: what it is called, what stands
 *   there, what sets it, what stands there where nothing is set, and what may
 */

/**
 * What mends what is refused, of the screen's case or beside it; loaded once something is.
 * @param {{error: any, now: boolean, others: Record<string, Other>}} props
 */
function Mends({ error, now, others }) {
  const { name, settings, setAll, unset } = useCase();
  const own = useCaseFile(name)?.tables;
  // What was set when there was an answer, of the same case.
  const before = useRef({ name, settings: {} });
  const beside = Object.entries(others).map(([key, { text }]) => [key, text]);
  if (now && !error) before.current = { name, settings: { ...settings, ...Object.fromEntries(beside) } };
  const { found } = useAsked(error ? "mend" : "", () => import("./mend.js"));
  const last = before.current.name === name ? before.current.settings : {};
  return error && found ? html`<${found.Mending} error=${error} own=${own} settings=${settings} before=${last}
    others=${others} setAll=${setAll} unset=${unset} />` : null;
}

/** What a reader of the numbers should know. @param {{notes: string[] | undefined}} props */
export const Notes = ({ notes }) => notes?.length ? html`<details class="notes">
  <summary>${notes.length === 1 ? "1 note" : `${notes.length} notes`}</summary>
  <ul aria-label="notes">${notes.map((note) =>
    html`<li key=${note}>${inWords(printed(note))}</li>`)}</ul></details>` : null;

/** Put a text on the clipboard, or show it where there is none. */
export async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    tell(`copied: ${text}`);
  } catch {
    tell(text);
  }
}

/**
 * A screen: title, case, what to take along, what went wrong, what should be known.
 *
 * @param {{title: string, lead?: string, kinds?: string[], first?: string, start?: Record<string, string>,
 *   answer?: any, error?: any, busy?: boolean, late?: boolean, now?: boolean, actions?: any,
 *   others?: Record<string, Other>, children: any}} props
 *   `kinds` of the cases it opens, the `first` one of them, and the settings that each starts with;
 *   `answer` as the server gives it, with command, toml and notes; `late` and `now` as of `useLive`;
 *   `others`: what it asks beside the case, by the word that a refusal begins with, or that stands in its `of`
 */
export function Screen({ title, lead, kinds, first, start, answer, error, busy, late, now = true, actions, others = {},
  children }) {
  useEffect(() => {
    fault.value = error?.message ?? "";
  }, [error]);
  // Of what is refused, or not answered yet, nothing is handed out: it would be of something else.
  const unless = (act) => () => (now ? act() : tell(`not yet: ${error?.message ?? "what is set is not answered"}`));
  const reached = Object.entries(error?.reached ?? {});
  return html`
    <header>
      <h1>${title}</h1>
      ${lead ? html`<p class="lead">${lead}</p>` : null}
      ${kinds ? html`<${CasePicker} kinds=${kinds} first=${first} start=${start} />` : null}
      <div class="actions">
        ${answer?.answer ? html`<button type="button" title="all of this as one file that anyone opens"
          disabled=${sharing.value} onClick=${unless(() => shared(title, answer))}>share</button>` : null}
        ${actions}
        ${answer?.answer ? html`<button type="button" title="on paper, or as a PDF"
          onClick=${unless(() => print())}>print</button>` : null}
        ${kinds ? html`<${Save} toml=${answer?.toml} unless=${unless} />` : null}
        ${answer?.command ? html`<button type="button" title=${answer.command}
          onClick=${unless(() => copy(answer.command))}>copy command</button>` : null}
        <span class=${busy ? "busy on" : "busy"} aria-hidden="true"></span>
      </div>
    </header>
    <div role="alert" class=${error ? "fault" : ""}>
      ${error ? html`<p>✗ ${refusal(error.message)}</p>` : null}
      ${error && answer?.answer ? html`<p class="says">What is shown below is of before, not of what is set now.</p>`
        : null}
      ${kinds ? html`<${Mends} error=${error} now=${now} others=${others} />` : null}
      ${reached.length ? html`<p class="says">
        reached: ${reached.map(([key, value]) => `${key} ${value}`).join(", ")}</p>` : null}
    </div>
    ${error ? null : html`<${Notes} notes=${answer?.notes} />`}
    <div class=${`body${error || late ? " stale" : ""}${error ? " of-before" : ""}`}>${children}</div>`;
}
