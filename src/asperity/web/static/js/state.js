/** Where the page is, and what is set there: all of it stands in the address. */
import { signal } from "../vendor/preact.js";

/** @typedef {{screen: string, params: Record<string, string>}} Route */

const SET = "set.";
const TOKEN = "asperity-token";
/** Tokens that this browser was handed at this address, the latest first, and how many are kept. */
const TOKENS = "asperity-tokens";
const MOST = 8;
/** How long nothing must change before a change is a step to go back from, ms. */
const REST = 300;

function known() {
  try {
    return JSON.parse(localStorage.getItem(TOKENS) ?? "[]").filter((each) => typeof each === "string");
  } catch {
    return [];
  }
}

/** The token that stood in the address, of which other tabs may not know. */
let fresh = "";

/** Take a token for this tab, and keep it for those that begin with a bookmark. */
function take(token) {
  sessionStorage.setItem(TOKEN, token);
  const others = known().filter((each) => each !== token);
  localStorage.setItem(TOKENS, JSON.stringify([token, ...others].slice(0, MOST)));
}

/** @returns {Route} */
function read() {
  const [path, query] = location.hash.replace(/^#\/?/, "").split("?");
  const params = new URLSearchParams(query ?? "");
  const token = params.get("token");
  if (token) take((fresh = token));
  params.delete("token");
  const units = params.get("units");
  // As the page was asked to open; what the reader chooses takes its place.
  if (units) sessionStorage.setItem("asperity-units", units);
  params.delete("units");
  const found = { screen: path || "home", params: Object.fromEntries(params) };
  if (token || units) history.replaceState(null, "", address(found));
  return found;
}

/** The address of a screen. @param {Route} route */
export function address({ screen, params }) {
  const query = new URLSearchParams(params).toString();
  return `#/${screen}${query ? `?${query}` : ""}`;
}

export const route = signal(read());

/** What a request must bring, as it was handed over in the address. */
export const token = () => sessionStorage.getItem(TOKEN) ?? known()[0] ?? "";

/**
 * Take another token than those that were refused, of another folder's page that was served here.
 * @param {{has: (token: string) => boolean}} refused @returns {boolean} whether there is one
 */
export function takeAnother(refused) {
  const other = known().find((each) => !refused.has(each));
  if (other) sessionStorage.setItem(TOKEN, other);
  return Boolean(other);
}

/** What is done with a token of another tab while this tab's own is refused. */
let onOther = null;
/** @param {() => void} then */
export const whenHanded = (then) => (onOther = then);

/** What tabs of this page tell each other: nothing asks for the token, a text is it. */
const tabs = new BroadcastChannel(TOKEN);
/** How long a tab without a token waits for one that has it, ms. */
const PATIENCE = 300;

/**
 * Done once the token is there, of the address or of another tab, or nobody has it.
 * @type {Promise<void>}
 */
export const handed = new Promise((done) => {
  tabs.onmessage = ({ data }) => {
    if (!data && token() && !onOther) tabs.postMessage(token());
    if (!data || (token() && !onOther) || data === token()) return;
    take(data);
    done();
    onOther?.();
  };
  if (fresh) tabs.postMessage(fresh);
  if (token()) return done();
  tabs.postMessage("");
  setTimeout(done, PATIENCE);
});

/** Forms of the same thing, by `table.key`: of those only one may be set. Filled with the forms. */
export const instead = new Map();

/** The line that says what is wrong now, which a field looks for its own name in. */
export const fault = signal("");

/** Where this tab has been, in order, and where of it it is: what is undone and done again. */
let trail = [location.hash];
let at = 0;
/** Whether there is a step to go back, or on again. */
export const undoable = signal({ undo: false, redo: false });
/** Screens opened with something taken from another: such a step is one to go back from too. */
const carried = new Set();

const screenOf = (hash) => hash?.replace(/^#\/?/, "").split("?")[0];

function look() {
  const step = (from, to) => trail[from] !== undefined && trail[to] !== undefined
    && (screenOf(trail[from]) === screenOf(trail[to]) || carried.has(trail[to]));
  undoable.value = { undo: step(at - 1, at), redo: step(at, at + 1) };
}

/** Go a step of this screen back, or on again; what was taken from another screen is one. */
export const undo = () => undoable.peek().undo && history.back();
export const redo = () => undoable.peek().redo && history.forward();

addEventListener("keydown", (event) => {
  const typing = /** @type {HTMLElement} */ (event.target).matches?.("input:not([type=range]), textarea, select");
  if (typing || event.altKey || !(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
  event.preventDefault();
  if (event.shiftKey) redo();
  else undo();
});

let timer = 0;
/** Whether a slider is held: what it passes is no step to go back to. */
let held = false;
addEventListener("pointerdown", ({ target }) =>
  (held = /** @type {HTMLInputElement} */ (target).type === "range"), true);
for (const name of ["pointerup", "pointercancel"]) addEventListener(name, () => (held = false), true);

function write() {
  clearTimeout(timer);
  timer = held ? setTimeout(write, REST) : 0;
  if (held) return;
  const wanted = address(route.peek());
  if (location.hash === wanted) return;
  history.pushState(null, "", wanted);
  trail = [...trail.slice(0, at + 1), wanted];
  at += 1;
  look();
}

function change(params) {
  route.value = { screen: route.peek().screen, params };
  clearTimeout(timer);
  timer = setTimeout(write, REST);
}

addEventListener("popstate", () => {
  clearTimeout(timer);
  const before = token();
  route.value = read();
  at = [at - 1, at + 1, at].find((each) => trail[each] === location.hash) ?? 0;
  if (trail[at] !== location.hash) trail = [location.hash];
  look();
  // With another token all that was refused is asked anew.
  if (token() !== before) location.reload();
});
addEventListener("pagehide", () => timer && ((held = false), write()));

/**
 * Open a screen.
 * @param {string} screen @param {Record<string, string>} params
 * @param {boolean} here whether it takes the place of this one, which nobody goes back to
 * @param {boolean} taking whether something is taken there, which is undone as any change is
 */
export function go(screen, params = {}, here = false, taking = false) {
  if (timer) write();
  route.value = { screen, params };
  if (taking) carried.add(address(route.value));
  if (!here) return write();
  trail[at] = address(route.value);
  history.replaceState(null, "", trail[at]);
}

/** Set what belongs to the screen alone, such as an axis; an empty text forgets it. */
export function setParam(name, text) {
  const { [name]: _, ...rest } = route.peek().params;
  change(text ? { ...rest, [name]: text } : rest);
}

/** The params that make the case: its name and what is set in it. */
export function caseParams(params) {
  const kept = Object.entries(params).filter(([key]) => key === "case" || key.startsWith(SET));
  return Object.fromEntries(kept);
}

/**
 * The case of the screen and what is set in it, by `table.key`; read in a component, it is drawn
 * again when they change.
 */
export function useCase() {
  const { params } = route.value;
  const settings = Object.fromEntries(
    Object.entries(params).flatMap(([key, text]) =>
      key.startsWith(SET) ? [[key.slice(SET.length), text]] : [],
    ),
  );
  return { name: params.case ?? "", settings, set, setAll, unset, reset };
}

/** What the case is called now: as the gearset that was taken, or else as its file. */
export const called = ({ params } = route.peek()) => params[`${SET}gearset.name`] || params.case || "";

/** Set a key of the case; another form of the same thing is left out. */
function set(path, text) {
  setAll({ [path]: text });
}

/** Set several keys at once. @param {Record<string, string>} texts */
function setAll(texts) {
  const params = { ...route.peek().params };
  for (const [path, text] of Object.entries(texts)) {
    for (const other of instead.get(path) ?? []) delete params[SET + other];
    params[SET + path] = text;
  }
  change(params);
}

function unset(path) {
  setParam(SET + path, "");
}

/**
 * Open a case with no other settings than these.
 * @param {boolean} here whether nobody should go back to what was here
 */
function reset(name, settings = {}, here = false) {
  const { screen, params } = route.peek();
  const own = Object.entries(params).filter(([key]) => key !== "case" && !key.startsWith(SET));
  const set = Object.entries(settings).map(([path, text]) => [SET + path, text]);
  go(screen, Object.fromEntries([...own, ["case", name], ...set]), here);
}
