/** What mends a value that is refused: buttons for what may stand there instead, as far as the line says it. */
import { html, useEffect } from "../vendor/preact.js";
import { fieldOf, words } from "./form.js";
import { namesIn, offered } from "./mends.js";
import { fault } from "./state.js";
import { printed } from "./symbols.js";
import { written } from "./us.js";

/** What is longer is told by its name alone. */
const LONG = 60;
const KEY = /\b([a-z]\w*\.\w+) is /;

/**
 * Buttons beneath a line that refuses. What was changed since the last answer is named where the line names another
 * key: it is what led there.
 * @param {{error: {message: string, of?: string}, settings: Record<string, string>, before: Record<string, string>,
 *   own: any, others: Record<string, import("./shell.js").Other>, setAll: (texts: Record<string, string>) => void,
 *   unset: (path: string) => void}} props `before`: what was set at the last answer; `own`: the case's tables as they
 *   are written; `others`: what is set beside the case
 */
export function Mending({ error, settings, before, own, others, setAll, unset }) {
  const { message: line, of } = error;
  const beside = of ?? Object.keys(others).find((key) => line.startsWith(`${key} is `));
  const named = beside ?? KEY.exec(line)?.[1] ?? "";
  const must = line.split(/; /).slice(1).join("; ");
  const changed = Object.keys(settings).filter((path) => settings[path] !== before[path]);
  const now = (path) => others[path]?.text ?? settings[path];
  const paths = now(named) !== undefined ? [named] : changed;
  const key = paths.map((path) => `${path} `).join("");
  const said = fault.value;
  useEffect(() => {
    // Its field is marked, too, where the line names another; again once the screen has said the next line.
    if (!said.includes(key)) fault.value = `${line} ${key}`;
  }, [line, key, said]);
  if (!paths.length) return null;
  const say = (path) => others[path]?.said ?? words(path.split(".")[1] ?? path);
  const names = named === paths[0] ? namesIn(must) : [];
  const ownOf = (path) => own?.[path.split(".")[0]]?.[path.split(".")[1]];
  // What the case itself has there is known to be taken.
  const fieldHere = (path) => others[path]?.field ?? { ...fieldOf(path), ...(ownOf(path) && { example: ownOf(path) }) };
  const texts = (path) => (path === named ? offered(must, now(path), fieldHere(path)) : []);
  const was = (path) => before[path] ?? others[path]?.usual ?? ownOf(path);
  // A list of tables is no word to read.
  const brief = (text) => (!text || text.length > LONG ? "" : written(text));
  const put = (path, text) => (others[path] ? others[path].put(text) : setAll({ [path]: text }));
  const back = (path) => (others[path] || before[path] !== undefined ? put(path, was(path)) : unset(path));
  return html`<p class="row mending">
    ${named && named !== paths[0] ? html`<span class="says">Set since the last answer: ${
      paths.map((path) => [say(path), brief(now(path))].filter(Boolean).join(", ")).join("; ")}.</span>` : null}
    ${paths.map((path) => html`
      ${texts(path).map((text) => html`<button type="button" class="main" key=${text} data-text=${text}
        onClick=${() => put(path, text)}>${say(path)} ${printed(brief(text))}</button>`)}
      ${names.length > texts(path).length ? html`<select aria-label=${`all for ${say(path)}`} value=""
        onChange=${({ target }) => target.value && put(path, target.value)}>
        <option value="">one of the ${names.length}</option>
        ${names.map((name) => html`<option>${name}</option>`)}</select>` : null}
      ${now(path) !== before[path] && !texts(path).includes(was(path)) && (was(path) || !others[path])
        ? html`<button type="button" onClick=${() => back(path)}>
        ${brief(was(path)) ? `back to ${printed(brief(was(path)))}`
          : `${was(path) ? "back to the former" : "without"} ${say(path)}`}</button>` : null}`)}</p>`;
}
