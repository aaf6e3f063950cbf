/** Work that takes longer: begin it, hear how far it is, stop it, read its answer. */
import { html, useEffect, useState } from "../vendor/preact.js";
import { returned } from "./again.js";
import { about, fetchRaw, follow, get, job as submit, post, Refused, shippedJobs, useAsked } from "./api.js";
import { download } from "./figure.js";
import { Notes } from "./shell.js";
import { route, setParam } from "./state.js";

/** Files that are shown without asking for more. */
const FEW = 6;
export const ENDED = ["stopped", "done", "failed"];
/** What a job is told in on paper; its name. */
export const REPORT = "report.html";

/** Hand a file of a job over, called `as`. */
export async function take(id, name, as = name) {
  download(as, await (await fetchRaw(placeOf(id, encodeURIComponent(name)))).blob());
}

/** Jobs that were begun here, by what was asked: another visit finds them again. */
const begun = {};

/** The same, with its keys in one order, whichever was set first. */
const ordered = (value) => (value?.constructor === Object
  ? Object.entries(value).sort().map(([key, each]) => [key, ordered(each)]) : value);

/** A short name for what is asked. @param {object} body */
export function nameOf(body) {
  let sum = 5381;
  for (const sign of JSON.stringify(ordered(body))) sum = (sum * 33 + Number(sign.codePointAt(0))) >>> 0;
  return sum.toString(36);
}

/** What a case is called on the page. */
const aliasOf = (name) => about.value?.cases.find((each) => each.name === name)?.alias || name;

/**
 * The answer that ships for what is asked, whatever else is set; null where there is none.
 * @param {any} asked @param {string} slot
 * @param {boolean} any whether that of another case is shown where the case has none of its own
 */
function exampleOf(asked, slot, any) {
  if (!asked) return null;
  const named = (name) => about.value?.cases.find(({ alias }) => alias && alias === name)?.name ?? name;
  // What was read from a file is an answer to no other.
  const kind = ({ command, options, arguments: given }) => nameOf({ command, options, given });
  const alike = shippedJobs.value.filter((each) => each.slot === slot && kind(each.asked) === kind(asked));
  const own = alike.find((each) => named(each.asked.case) === named(asked.case));
  const found = own ?? (any ? alike[0] : null);
  const same = own && nameOf({ ...own.asked, case: asked.case });
  return found ? { ...found, id: `shown/${found.at}`, name: same, other: own ? "" : aliasOf(found.asked.case) } : null;
}

/** The answer that ships for a command, whatever is set: its id and itself; null until it is there, or unwanted. */
export function useShipped(command, wanted) {
  const example = wanted && shippedJobs.value.find(({ asked }) => asked.command === command);
  const id = example ? `shown/${example.at}` : "";
  const data = useAsked(id && answerOf(id), (leave) => get(answerOf(id), leave)).found;
  return data && { ...example, id, data };
}

const isShipped = (id) => id.startsWith("shown/");
/** Where a file of a job is, or of an answer that ships. @param {string} id @param {string} name */
export const placeOf = (id, name) => (isShipped(id) ? `${id}/${name}` : `/api/jobs/${id}/files/${name}`);
const answerOf = (id) => (isShipped(id) ? `${id}/answer.json` : `/api/jobs/${id}/answer`);
/** @param {string} id @param {string[]} names of variables; none: what there is, without values */
export const dataOf = (id, names = []) => (isShipped(id) ? `${id}/data.json`
  : `/api/jobs/${id}/data${names.length ? `?names=${names.join()}` : ""}`);

const NOTHING = { job: null, data: null, error: null, of: null, asking: false };

/**
 * A job of a command; which one stands in the address, with a name for what was asked of it.
 *
 * @typedef {{id: string, job: any, data: any, error: Error | null, asking: boolean, can: boolean,
 *   stale: boolean, from: string, files?: string[], start: () => Promise<void>, stop: () => void}} Job `asking`:
 *   begun, not heard of yet; `stale`: something was set since; `from`: which job or shipped answer `data` is of
 *
 * @param {string} command
 * @param {object | null} body what a new one would be asked: case, settings, options
 * @param {string} slot what tells it from another job of the same command on the screen
 * @param {boolean} any whether an answer that ships may be of another case
 * @returns {Job}
 */
export function useJob(command, body, slot = "", any = false) {
  const asked = body && { command, ...body };
  const name = asked ? nameOf(asked) : "";
  const param = `job-${command}${slot}`;
  const [id, of] = (route.value.params[param] ?? begun[name] ?? "").split(".");
  const [state, setState] = useState(NOTHING);
  const [round, setRound] = useState(0);
  const put = (more) => setState((old) => ({ ...old, ...more }));
  useEffect(() => {
    setState({ ...NOTHING, asking: Boolean(id) });
    if (!id) return;
    const leave = new AbortController();
    const failed = (error) => error.name === "AbortError" || put({ error, of: null, asking: false });
    let answered = false;
    const hear = (job) => {
      const error = job.error ? new Refused(job.error, 0) : null;
      put({ job: { ...job, heard: performance.now() }, asking: false, error, of });
      // Its pictures may come later.
      if (!job.answered || answered) return;
      answered = true;
      get(answerOf(id), leave).then((data) => put({ data }), failed);
    };
    follow(id, hear, leave.signal).then(() => get(`/api/jobs/${id}`, leave)).then(hear).catch(failed);
    return () => leave.abort();
  }, [id, round, returned.value]);
  const start = async () => {
    put({ asking: true, error: null });
    try {
      const made = await submit(asked);
      begun[name] = `${made.id}.${name}`;
      setParam(param, begun[name]);
      // The same job again: it is heard of anew.
      if (made.id === id) setRound((old) => old + 1);
    } catch (error) {
      put({ error, of: name, asking: false });
    }
  };
  const stop = () => post(`/api/jobs/${id}/stop`, {});
  // What ships is shown until the reader's own is there.
  const example = state.data ? null : exampleOf(asked, slot, any);
  const ships = useAsked(example ? answerOf(example.id) : "", (leave) => get(answerOf(example.id), leave)).found;
  // What was refused is told as long as it is set.
  const error = state.of === null || state.of === name ? state.error : null;
  const found = { can: Boolean(asked), start, stop, id, ...state, error };
  if (!ships) return { ...found, from: state.data ? id : "", stale: Boolean(id) && of !== name };
  const job = state.job ?? { state: "done", files: example.files, shipped: true, other: example.other };
  return { ...found, job, from: example.id, files: example.files, data: ships, stale: example.name !== name };
}

/** Whether something was there and drawn: what stands below it waits for that. @param {boolean} there */
export function useAfter(there) {
  const [drawn, setDrawn] = useState(false);
  useEffect(() => {
    if (!there) return;
    const frame = requestAnimationFrame(() => setTimeout(() => setDrawn(true)));
    return () => cancelAnimationFrame(frame);
  }, [there]);
  return drawn;
}

/** Variables of what a job left, null until they are there. @param {Job} work */
export function useData({ from, job }, names) {
  const path = from && (isShipped(from) || job?.state === "done") ? dataOf(from, names) : "";
  return useAsked(path, (leave) => get(path, leave)).found;
}

/** What lies one after the other, as rows. */
export const rows = ({ shape: [count, width], values }) =>
  Array.from({ length: count }, (_, row) => values.slice(row * width, (row + 1) * width));

/** A time in words. */
export function lasting(seconds) {
  /** @type {[number, string][]} */
  const sizes = [[86400, "days"], [3600, "hours"], [60, "min"]];
  const [size, unit] = sizes.find(([each]) => seconds >= 2 * each) ?? [1, "s"];
  return `${seconds < size ? "1" : (seconds / size).toFixed(0)} ${unit}`;
}

/** Draw anew every second while something goes on. */
export function useTicking(on) {
  const [, setCount] = useState(0);
  useEffect(() => {
    const timer = on ? setInterval(() => setCount((old) => old + 1), 1000) : 0;
    return () => clearInterval(timer);
  }, [on]);
}

/** How far a job is, how long it has run and still takes at its pace so far, in words. */
export function left({ state, done, total, seconds: told, heard, answered }) {
  // Since it was told, time goes on.
  const seconds = told + (state === "running" && heard ? (performance.now() - heard) / 1000 : 0);
  const without = answered && state === "stopped" ? ", with its answer, without all of its files" : "";
  if (ENDED.includes(state)) return `${state} after ${lasting(seconds)}${without}`;
  if (answered) return "answered; its files are being written";
  const so = state === "running" ? `for ${lasting(seconds)}` : "";
  if (!total) return so ? `${state} ${so}` : state;
  const rest = done > 0.02 * total && seconds > 2 ? `, about ${lasting((seconds * (total - done)) / done)} left` : "";
  return `${state}, ${done} of ${total}${so && `, ${so}`}${rest}`;
}

const shippedSays = ({ other }, stale) => `an answer that ships${other ? `, of the case ${other}`
  : stale ? ", to the case as it is written" : ""}; your own takes its place`;

/** Begin, how far it is, stop. @param {{work: Job, label: string}} props */
export function Work({ work, label }) {
  const { job, asking, can, stale, start, stop } = work;
  const running = job && !ENDED.includes(job.state);
  useTicking(running);
  const said = asking ? "begun" : running ? left(job)
    : job?.shipped ? shippedSays(job, stale)
    : stale && job ? (work.data ? "something was set since; this is the answer to what was asked before"
      : `${left(job)}; something was set since`)
    : job ? left(job) : "";
  return html`<div class="work">
    <button type="button" disabled=${running || asking || !can}
      class=${job?.state === "done" && !job.shipped && !stale ? "" : "main"}
      onClick=${start}>${job?.state === "stopped" && !stale ? `go on: ${label}` : label}</button>
    ${running || asking ? html`<progress aria-label=${label} max=${job?.total || 1}
      value=${job?.total ? job.done : undefined}></progress>` : null}
    ${running ? html`<button type="button" onClick=${stop}>stop</button>` : null}
    <span class="says" role="status">${said}</span>
  </div>`;
}

/** A job in a box of its own: what it is, how long it takes, how far it is, and what came of it. */
export const WorkPanel = ({ title, name, says, label, work, children }) => html`
  <section class="panel" aria-label=${name ?? title}><h2>${title}</h2>
    ${says ? html`<p class="says to-press">${says}</p>` : null}
    <${Work} work=${work} label=${label} />
    <div class=${work.stale ? "before" : ""}>
      ${work.data ? html`<${Notes} notes=${work.data.notes} />` : null}
      ${children}
      <${Files} job=${work.job} /></div>
  </section>`;

/** A part of the screen that is loaded once what stands above it does. */
export function Later({ load, part, ...given }) {
  const { found } = useAsked(part, load);
  return found ? html`<${found[part]} ...${given} />` : null;
}
/** What else may be asked, of several screens. */
export const further = () => import("./further.js");

/** Several errors or none, as a screen tells one. */
export const firstError = (...works) => works.map(({ error }) => error).find(Boolean) ?? null;

/** What a job has left, to take along. @param {{job: any}} props */
export function Files({ job }) {
  if (!job?.files?.length || job.shipped) return null;
  // What people read stands before what programs do.
  const names = job.files.toSorted((one, other) => Number(other === REPORT) - Number(one === REPORT));
  const buttons = names.map((name) => html`<button type="button" class="quiet" key=${name}
    onClick=${() => take(job.id, name)}>${name}</button>`);
  return html`<p class="row"><span class="says">files:</span> ${buttons.slice(0, FEW)}</p>
    ${buttons.length > FEW ? html`<details><summary>${buttons.length - FEW} more ${
      buttons.length - FEW === 1 ? "file" : "files"}</summary>
      ${buttons.slice(FEW)}</details>` : null}`;
}
