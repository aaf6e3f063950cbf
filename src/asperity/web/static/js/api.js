/** What is asked of the server. Every answer is JSON; every error is one line. */
import { signal, useEffect, useLayoutEffect, useRef, useState } from "../vendor/preact.js";
import { awaitServer, returned } from "./again.js";
import { instead, takeAnother, token } from "./state.js";

/** What the command line says before what is wrong with a setting; here the field says it. */
const SETTING = /^--(?:set|over) ([\w.]+)=(?:.*?: (?=\1\b)|[^:]*: )/;

/** An error as the server tells it: a line, and what was reached on the way. */
export class Refused extends Error {
  constructor(line, status, told = {}) {
    super(line.replace(SETTING, ""));
    this.status = status;
    this.exitCode = told.exit_code ?? null;
    this.reached = told.reached ?? null;
  }
}

/** What is told while nothing answers; what was asked is asked again once something does. */
function silent() {
  awaitServer();
  return new Refused("the server does not answer: is asperity page still running? It is asked every second", 0);
}

/** Of a file that is there already and holds something else. */
export const THERE = 409;

/** Tokens that were refused, and how: with one of them nothing more is asked. */
const barred = new Map();

async function ask(path, options = {}) {
  const mine = token();
  if (barred.has(mine)) throw barred.get(mine);
  const headers = { "X-Asperity-Token": mine, ...options.headers };
  let response;
  try {
    response = await fetch(path, { ...options, headers });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw silent();
  }
  if (response.ok) return response;
  const told = await response.json().catch(() => ({}));
  const refused = new Refused(told.error ?? `the server answered ${response.status}`, response.status, told);
  if (response.status === 403) {
    barred.set(mine, refused);
    if (token() !== mine || takeAnother(barred)) return ask(path, options);
  }
  throw refused;
}

/** @param {string} path such as "/api/about" @param {{signal?: AbortSignal}} [options] */
export async function get(path, { signal: stop } = {}) {
  return (await ask(path, { signal: stop })).json();
}

/**
 * Send an object and return the one that is answered.
 * @param {string} path @param {any} body @param {{signal?: AbortSignal}} [options]
 */
export async function post(path, body, { signal: stop } = {}) {
  const headers = { "Content-Type": "application/json" };
  const text = JSON.stringify(body);
  return (await ask(path, { method: "POST", headers, body: text, signal: stop })).json();
}

/**
 * Ask a live verb.
 * @param {string} verb
 * @param {{case?: string, settings?: object, options?: object, report?: boolean}} body
 *   `report`: as a page that prints, of those that have one
 * @param {{signal?: AbortSignal}} [options]
 */
export const call = (verb, body, options) => post(`/api/do/${verb}`, body, options);

/** What does the same on a terminal. @param {string} command @param {object} body as of a job */
export function commandLine(command, { case: name, settings = {}, options = {} }) {
  const set = Object.entries(settings).flatMap(([path, text]) => ["--set", `${path}=${text}`]);
  const more = Object.entries(options).flatMap(([key, value]) =>
    [value].flat().flatMap((each) => (each === true ? [`--${key}`] : each ? [`--${key}`, each] : [])),
  );
  const quoted = (word) =>
    /^[\w./:=,+-]+$/.test(word) ? word : `'${word.replaceAll("'", `'"'"'`)}'`;
  return ["asperity", command, name, ...set, ...more].map(quoted).join(" ");
}

/** Start a job, or find the one that is the same. */
export const job = (body) => post("/api/jobs", body);

/**
 * What is in a file of the server, as it is.
 * @param {string} path @param {{signal?: AbortSignal}} [options] @returns {Promise<Response>}
 */
export const fetchRaw = (path, { signal: stop } = {}) => ask(path, { signal: stop });

/** Take something away for good. */
export const remove = (path) => ask(path, { method: "DELETE" });

/** Put a recording, an export or a case into the folder; another of its name only if that is wanted. */
export async function upload(file, replace = false) {
  const path = `/api/files/${encodeURIComponent(file.name)}?recorded${replace ? "&replace" : ""}`;
  const headers = { "Content-Type": "application/octet-stream" };
  try {
    return await (await ask(path, { method: "PUT", headers, body: file })).json();
  } catch (error) {
    if (error.status !== THERE || !confirm(`${error.message}. Replace it?`)) throw error;
    return upload(file, true);
  }
}

/** Hear of a job until it ends. @param {(event: object) => void} onEvent @param {AbortSignal} stop */
export async function follow(id, onEvent, stop) {
  const response = await ask(`/api/jobs/${id}/events`, { signal: stop });
  const reader = /** @type {ReadableStream} */ (response.body).pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  for (;;) {
    const { value, done } = await reader.read().catch((error) => {
      throw error.name === "AbortError" ? error : silent();
    });
    if (done) return;
    const events = (rest + value).split("\n\n");
    rest = events.pop() ?? "";
    for (const event of events) {
      const data = event.split("\n").filter((line) => line.startsWith("data:"));
      if (data.length) onEvent(JSON.parse(data.map((line) => line.slice(5)).join("\n")));
    }
  }
}

/** What there is: version, folder, cases, files, and whether kernels are ready. */
export const about = signal(null);
/** The tables of a case with their keys. */
export const forms = signal(null);

export async function loadAbout() {
  about.value = await get("/api/about");
}

export async function loadForms() {
  const { tables, listed } = await get("/api/forms");
  for (const [table, { keys }] of Object.entries(tables)) {
    for (const field of keys) {
      const { key, follows } = field;
      field.listed = listed[`${table}.${key}`] ?? [];
      instead.set(`${table}.${key}`, (follows ?? []).map((other) => `${table}.${other}`));
    }
  }
  forms.value = tables;
}

/** Cases as they are written, by name, and those that are on their way. */
const opened = signal({});
const coming = new Set();

/** The tables of a case as texts, null until they are there. */
export function useCaseFile(name) {
  const known = opened.value[name];
  useEffect(() => {
    if (!name || known || coming.has(name)) return;
    coming.add(name);
    get(`/api/case/${encodeURIComponent(name)}`)
      .then((file) => (opened.value = { ...opened.peek(), [name]: file }))
      .catch((error) => (opened.value = { ...opened.peek(), [name]: { tables: {}, error } }))
      .finally(() => coming.delete(name));
  }, [name, known]);
  return known ?? null;
}
// What could not be read while nothing answered.
returned.subscribe(() =>
  (opened.value = Object.fromEntries(Object.entries(opened.peek()).filter(([, { error }]) => error?.status !== 0))));

/**
 * What is asked for where a key says what, once for each.
 *
 * @template T
 * @param {string} key nothing is asked while it is empty
 * @param {(leave: AbortController) => Promise<T>} ask
 * @returns {{found: T | null, error: Error | null}} null until it is there
 */
export function useAsked(key, ask) {
  const [known, setKnown] = useState({ key: "", found: null, error: null });
  useEffect(() => {
    if (!key) return;
    const leave = new AbortController();
    ask(leave).then(
      (found) => setKnown({ key, found, error: null }),
      (error) => error.name === "AbortError" || setKnown({ key, found: null, error }),
    );
    return () => leave.abort();
  }, [key, returned.value]);
  return known.key === key ? known : { found: null, error: null };
}

/** An address of what is held here, as a picture has it; "" until it is there. */
export function useAddress(blob) {
  const [address, setAddress] = useState("");
  useEffect(() => {
    if (!blob) return;
    const made = URL.createObjectURL(blob);
    setAddress(made);
    return () => URL.revokeObjectURL(made);
  }, [blob]);
  return address;
}

/** Forget how a case was written, since it was written again. */
export function forgetCase(name) {
  const { [name]: _, ...rest } = opened.peek();
  opened.value = rest;
}

/** Answers that ship, of what screens ask as they open: what is answered until what computes has started. */
const shipped = signal([]);
get("shown/live/index.json").then((found) => (shipped.value = found), () => {});

/** Answers that ship, of jobs: what was asked, and their folder. Asked for before any screen is there. */
export const shippedJobs = signal([]);
get("shown/index.json").then((found) => (shippedJobs.value = found), () => {});

/** Where the answer to what is asked ships; "" where none does. */
const shippedAt = (verb, text) => {
  const found = shipped.value.find((each) => each.verb === verb && JSON.stringify(each.body) === text);
  return found ? `shown/live/${found.at}` : "";
};

/** How long what is shown may be of something set before, and a question go on that is of no use, ms. */
const [LATE, LONGEST] = [500, 1500];

/**
 * The answer to what is set now. One question is under way at a time; of those that come
 * meanwhile the last one is asked next, so that a slider that is dragged never waits in a queue.
 * `now` tells whether `data` are of what is set, `late` that they have not been for a while.
 *
 * @param {string} verb
 * @param {object | null} body null: nothing to ask yet
 * @param {number} delay how long nothing must change before it is asked, ms
 */
export function useLive(verb, body, delay = 0) {
  const [state, setState] = useState({ data: null, error: null, busy: false, of: "" });
  const [late, setLate] = useState(false);
  const queue = useRef({ running: false, next: "", timer: 0, gone: false, asked: "", since: 0, leave: null });
  const text = body ? JSON.stringify(body) : "";
  useEffect(() => () => {
    queue.current.gone = true;
    queue.current.leave?.abort();
  }, []);
  const waits = Boolean(text) && text !== state.of;
  useEffect(() => {
    setLate(false);
    const timer = waits ? setTimeout(() => setLate(true), LATE) : 0;
    return () => clearTimeout(timer);
  }, [waits, state.of]);
  useEffect(() => {
    // What was asked before makes room for what is set now once it has had its time.
    const { running, asked, since, leave } = queue.current;
    const timer = running && asked !== text ? setTimeout(() => leave.abort(), since + LONGEST - performance.now()) : 0;
    return () => clearTimeout(timer);
  }, [text, state.of]);
  // By layout: an effect waits for the next picture, and the question with it.
  useLayoutEffect(() => {
    if (!text) return;
    const mine = queue.current;
    const run = async () => {
      mine.running = true;
      setState((old) => ({ ...old, busy: true }));
      while (mine.next && !mine.gone) {
        const asked = mine.next;
        mine.next = "";
        Object.assign(mine, { asked, since: performance.now(), leave: new AbortController() });
        const answer = await call(verb, JSON.parse(asked), mine.leave).then(
          (data) => ({ data, error: null, of: asked }),
          (error) => (error.name === "AbortError" ? {} : { error, of: asked }),
        );
        if (!mine.gone) setState((old) => ({ ...old, ...answer, busy: Boolean(mine.next) }));
      }
      mine.running = false;
    };
    const begin = () => {
      mine.next = text;
      if (!mine.running) run();
    };
    clearTimeout(mine.timer);
    if (delay) mine.timer = setTimeout(begin, delay);
    else begin();
    return () => clearTimeout(mine.timer);
  }, [verb, text, delay, returned.value]);
  const path = state.data || state.error ? "" : shippedAt(verb, text);
  const ships = useAsked(path, (leave) => get(path, leave)).found;
  // As an answer is, it is shown until the next is there.
  const last = useRef(null);
  last.current = ships ?? last.current;
  return { ...state, data: state.data ?? last.current, error: late ? null : state.error, late: late && !ships,
    now: !waits && Boolean(state.data) && !state.error };
}
