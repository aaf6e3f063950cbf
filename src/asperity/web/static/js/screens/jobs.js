/** What runs, what waits and what is done, with its files. */
import { html, useEffect, useRef, useState } from "../../vendor/preact.js";
import { get, post, remove } from "../api.js";
import { belongsTo } from "../belongs.js";
import { copy, Screen } from "../shell.js";
import { address, go } from "../state.js";
import { Drawn } from "../told.js";
import { Files, left, placeOf } from "../work.js";

/** In the order in which they are listed; what waits stands beside what runs. */
const SIGNS = { running: "▶", queued: "…", stopped: "❚❚", done: "✓", failed: "✗" };
const ORDER = { running: 0, queued: 0, stopped: 1, done: 2, failed: 3 };
const GOING = ["running", "queued"];
/** How often what runs is looked at, ms. */
const LOOK = 1500;

export function view() {
  const [jobs, setJobs] = useState(null);
  const [error, setError] = useState(null);
  const [look, setLook] = useState(0);
  const again = () => setLook((old) => old + 1);
  useEffect(() => {
    const leave = new AbortController();
    let timer = 0;
    get("/api/jobs", leave).then((list) => {
      setJobs(list);
      if (list.some(({ state }) => GOING.includes(state))) timer = setTimeout(again, LOOK);
    }).catch((found) => found.name === "AbortError" || setError(found));
    return () => {
      leave.abort();
      clearTimeout(timer);
    };
  }, [look]);
  const act = (work) => work.then(() => (setError(null), again()), setError);
  const sorted = (jobs ?? []).toSorted((one, other) => ORDER[one.state] - ORDER[other.state]);
  return html`<${Screen} title="Jobs" error=${error}
    lead="Work that takes longer than a moment. Two run at once, eight wait; what is stopped is gone on with.">
    ${jobs && !jobs.length ? html`<p>Nothing was begun in this folder yet. Screens such as${" "}
      <a href="#/sweep" onClick=${(event) => (event.preventDefault(), go("sweep"))}>Sweep</a>${" "}
      begin jobs.</p>` : null}
    <ul class="jobs">${sorted.map((job) => html`<${Job} key=${job.id} job=${job} jobs=${jobs} act=${act} />`)}</ul>
  <//>`;
}

/** The drawing of a gearset, which stands in its answer. @param {Response} answer */
const drawing = async (answer) => new Blob([(await answer.json()).svg.gearset], { type: "image/svg+xml" });

/** A small picture of what a job left; nothing where it left none. */
function Picture({ job: { id, command, files, state }, name }) {
  const file = files.find((each) => each.endsWith(".png"));
  const alt = `what ${command} ${name} drew`;
  return state !== "done" ? null
    : file ? html`<${Drawn} at=${placeOf(id, encodeURIComponent(file))} kind="small" alt=${alt} />`
    : command === "rate" ? html`<${Drawn} at=${`/api/jobs/${id}/answer`} kind="small" alt=${alt} made=${drawing} />`
    : null;
}

function Job({ job, jobs, act }) {
  const { id, command, case: of, asked, state, done, total, error, notes, line } = job;
  // As the gearset that was taken.
  const name = asked?.settings?.["gearset.name"] ?? of;
  const running = state === "running";
  const button = (said, run, kind) => html`<button type="button" class=${kind} aria-label=${`${said}: ${line}`}
    onClick=${run}>${said}</button>`;
  const path = `/api/jobs/${id}`;
  const told = notes.filter((note) => running || !note.startsWith("this will take")).slice(-2);
  const there = belongsTo(job, jobs);
  const open = (event) => {
    if (!there || event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    go(there.screen, there.params);
  };
  return html`<li class="panel"><${Picture} job=${job} name=${name} />
    <p><b>${there ? html`<a href=${address(there)} onClick=${open}>${command} ${name}</a>`
      : `${command} ${name}`}</b> <span class=${`state ${state}`}>${SIGNS[state]} ${left(job)}</span></p>
    ${running ? html`<progress aria-label=${`${command} ${name}`} max=${total || 1}
      value=${total ? done : undefined}></progress>` : null}
    ${error ? html`<p class="bad">✗ ${error}</p>` : null}
    ${told.map((note) => html`<p class="says">${note}</p>`)}
    <p class="row"><code>${line}</code></p>
    <div class="row">
      ${GOING.includes(state) ? button("stop", () => act(post(`${path}/stop`, {}))) : null}
      ${["stopped", "failed"].includes(state) ? button("go on", () => act(post(`${path}/resume`, {}))) : null}
      ${button("copy command", () => copy(line), "quiet")}
      ${GOING.includes(state) ? null : html`<${Delete} line=${line} run=${() => act(remove(path))} />`}
      <${Files} job=${job} />
    </div>
  </li>`;
}

/** Delete a job with its files, once that was said twice. */
function Delete({ line, run }) {
  const box = useRef(null);
  return html`<button type="button" class="quiet" aria-label=${`delete: ${line}`}
      onClick=${() => box.current.showModal()}>delete</button>
    <dialog ref=${box} aria-label="delete the job"><p>Delete this job and its files for good?</p>
      <p><code>${line}</code></p>
      <p class="row"><button type="button" class="main" onClick=${() => (box.current.close(), run())}>delete it</button>
        <button type="button" onClick=${() => box.current.close()}>keep it</button></p></dialog>`;
}
