/** Runs of a rig in the folder: what they do, what is on, and a button that switches off. */
import { html, useEffect, useState } from "../vendor/preact.js";
import { get, post } from "./api.js";
import { words } from "./form.js";
import { Plot } from "./plot.js";
import { Table } from "./table.js";

/** How often runs are looked at while one goes on, and while none does, ms. */
const [SOON, LATER] = [500, 2500];
/** A run that shows nothing new for so long may hang, s; one that ended so long ago is shown no more. */
const [HANGS, PAST] = [2, 60];
const KINDS = ["torque", "speed", "current"];

const goesOn = ({ state, ended }) => state === "runs" && !ended;

/** What there is to be seen of runs, the latest first. */
function useRuns() {
  const [found, setFound] = useState({ runs: [], error: null });
  const [round, setRound] = useState(0);
  useEffect(() => {
    const leave = new AbortController();
    let timer = 0;
    const again = (runs) => {
      timer = setTimeout(() => setRound((old) => old + 1), runs.some(goesOn) ? SOON : LATER);
    };
    get("/api/runs", leave).then(
      (runs) => (setFound({ runs, error: null }), again(runs)),
      (error) => error.name === "AbortError" || (setFound((old) => ({ ...old, error })), again([])),
    );
    return () => (leave.abort(), clearTimeout(timer));
  }, [round]);
  return { ...found, look: () => setRound((old) => old + 1) };
}

/** What goes on at the rig, and what has just ended. */
export function Live() {
  const { runs, error, look } = useRuns();
  const shown = runs.filter((run) => goesOn(run) || run.age < PAST);
  return html`${shown.map((run) => html`<${Run} key=${run.name} run=${run} look=${look} lost=${error} />`)}`;
}

function Run({ run, look, lost }) {
  const { name, state, age, step, next, done, cells, asks, off, ended, simulated } = run;
  const [asked, setAsked] = useState("");
  const runs = goesOn(run);
  useEffect(() => setAsked(""), [runs]);
  const stop = () => {
    setAsked("a stop is asked for …");
    post("/api/runs/stop", { run: name }).then(look, (error) => setAsked(`✗ ${error.message}`));
  };
  const told = !runs ? `${ended?.kind ?? state}${ended?.reason ? `: ${ended.reason}` : ""}`
    : off?.still_on ? "not all of it was read back to be off"
    : off?.by_hand ? "a person is asked to switch off what only a person can"
    : off?.not_yet_heard ? "read back to be off; the drive has yet to be heard"
    : off ? "read back to be off; the procedure has yet to end"
    : age > HANGS && asks ? "it waits for a person at the rig"
    : age > HANGS ? `nothing new for ${age.toFixed(0)} s: it may hang; stop works all the same` : "it goes on";
  return html`<section class="panel live" aria-label="live">
    <h2>The rig, live: ${name.replace(/^jobs\/(.{6}).*/, "job $1…")}${simulated ? ", simulated" : ""}</h2>
    ${lost ? html`<p class="fault" role="alert">✗ What is shown is old: ${lost.message}</p>` : null}
    <div class="row">
      ${runs ? html`<button type="button" class="stop" onClick=${stop}>stop: switch everything off</button>` : null}
      <span role="status">${asked && !off ? asked : told}</span>
    </div>
    ${runs ? html`<progress aria-label="cells" max=${cells || 1} value=${done}></progress>
      <p>${done} of ${cells} cells.${off ? "" : ` Now: ${step}. Next: ${next || "the end"}.`}</p>` : null}
    <${Verdict} off=${off} />
    <${Outputs} run=${run} />
    ${KINDS.map((kind) => html`<${Trace} key=${kind} kind=${kind} run=${run} />`)}
  </section>`;
}

/** What the guardian read back when it switched off. */
function Verdict({ off }) {
  if (!off) return null;
  const [still, hand, took] = [off.still_on ?? [], off.by_hand ?? [], Math.ceil(100 * off.took_s) / 100];
  const read = Object.keys(off.read_back ?? {}).length > 0;
  const unheard = Object.keys(off.not_yet_heard ?? {});
  return still.length ? html`<p class="fault" role="alert">✗ Not read back to be off: ${still.join("; ")}.
      Switch it off by hand.</p>`
    : html`${read ? html`<p class="good">✓ Read back to be off within ${took.toFixed(2)} s: ${off.why}.</p>` : null}
      ${unheard.length ? html`<p>Not yet heard to be still: ${unheard.join("; ")}.</p>` : null}
      ${hand.length
        ? html`<p class="fault">Nothing reads back, and a person is asked to switch off: ${hand.join("; ")}.</p>`
        : read ? null : html`<p class="fault">✗ Nothing was read back: ${off.why}.</p>`}`;
}

/** What each output was told, by the guardian at last, and what was read back of it. */
function Outputs({ run: { outputs, off } }) {
  if (!outputs.length) return null;
  const still = (output) => off?.still_on?.find((line) => line.startsWith(`${output}: `));
  const read = ({ output }) => {
    const [proven, unheard] = [off?.read_back?.[output], off?.not_yet_heard?.[output]];
    if (still(output)) return html`<span class="bad">✗ ${still(output).slice(output.length + 2)}</span>`;
    return proven ? html`<span class="good">✓ ${proven}</span>` : unheard ?? "–";
  };
  const last = ({ output, told }) =>
    (still(output) || off?.read_back?.[output] || off?.not_yet_heard?.[output] ? "off" : told);
  const shown = (row) => (last(row).startsWith("on") ? html`<b>${last(row)}</b>` : last(row));
  return html`<${Table} region="outputs" rows=${outputs} columns=${[["output", ({ output }) => output, "row"],
    ["told to be", shown], ["read back", read]]} />`;
}

/** One kind of signal over the last minute. */
function Trace({ kind, run: { time, signals } }) {
  const shown = signals.filter(({ name }) => name.startsWith(kind));
  if (!shown.length || time.length < 2) return null;
  const unit = shown[0].unit.replaceAll("**2", "²");
  return html`<${Plot} title=${`Live: ${kind}`} height=${180} y=${`${kind} (${unit})`}
    x=${{ label: "time", unit: "s", values: time }}
    series=${shown.map(({ name, values }) => ({ label: words(name), unit, values }))} />`;
}
