/** The rig: a recording, its segments, what vibration did in each, and a law fitted to that. */
import { html, useState } from "../../vendor/preact.js";
import { about, get, job as submit, loadAbout, upload, useAsked, useLive } from "../api.js";
import { Field, words } from "../form.js";
import { Law } from "../law.js";
import { Plot } from "../plot.js";
import { Report } from "../report.js";
import { Screen, tell } from "../shell.js";
import { OWN, Refusals, Signals } from "../signals.js";
import { go, route, setParam, useCase } from "../state.js";
import { Table } from "../table.js";
import { useChecked } from "../taken.js";
import { digits } from "../units.js";
import { headed } from "../us.js";
import { Files, Later, placeOf, useJob, useShipped, Work, WorkPanel } from "../work.js";

const EXPORTS = ".csv,.txt,.asc,.lvm,.dat,.mat,.tdms,.wav,.sr,.mf4,.nc";
/** What a page can record by itself: one file of a few cells on the simulated rig. */
const TRIAL = {
  "plan.modes": '["transverse"]', "plan.lubricants": '["oil"]', "plan.excluded": "[]",
  "plan.waveforms": '["sine"]', "plan.steel_supplies": '["1 V"]', "plan.repeats": "1",
  "plan.frequencies": '["750 Hz", "1650 Hz"]', "plan.sample_rate": "5 kHz",
};
/** What a law begins from where nothing else is set. */
const LAW = {
  "friction.mu": "0.1", "friction.max_deflection": "70 nm", "friction.law": "split", "friction.transfer": "0.7",
};
const FREE = ["friction.transfer", "friction.max_deflection", "friction.transfer,friction.max_deflection"];
const FINDING = ["settling", "speed_settling", "least_window", "threshold", "block"];

/** Signals of the recording whose answer ships. */
const SEEN = "signals.json";

const live = () => import("../live.js");

export function view() {
  const { name, settings } = useCase();
  const { rec = "", free = FREE[0] } = route.value.params;
  const kept = Object.fromEntries(Object.entries(settings).filter(([path]) => path.startsWith(OWN)));
  const asked = rec ? { arguments: { recordings: [rec] }, settings: kept } : null;
  const seen = useLive("signals", asked && { ...asked, case: name }, 60);
  const reduced = useJob("rig reduce", asked);
  const found = reduced.data?.answer;
  const example = useExample(!rec);
  // What the law begins from is asked of no recording.
  const { error: wrong, toml, now } = useChecked(name ? { case: name, settings: { ...LAW, ...settings } } : null);
  const again = (file) => `The command reads ${rec || example?.seen.recording}, which is not in here: in its folder it \
gives what vibration did again. Save the case as ${file}, and asperity fit measurements.csv ${file} --free ${
    free}, of what the command leaves with --out, fits the law.`;
  return html`<${Screen} title="Rig" kinds=${["rig"]} first="disc-on-disc" busy=${seen.busy}
      now=${now && (!rec || seen.now)}
      lead="Drop a recording of a disc-on-disc rig: its segments are found, and what vibration did in each of them."
      answer=${rec ? seen.data && { ...seen.data, toml, again, ...(reduced.data && { notes: reduced.data.notes }) }
        : example && { ...example.reduced, notes: [], again }}
      error=${(rec ? seen.error : null) ?? wrong ?? (rec ? reduced.error : null)}
      actions=${html`<${Report} work=${reduced} />`}>
    <${Later} load=${live} part="Live" />
    ${found || example ? html`<${Most} segments=${(found ?? example).segments} />` : null}
    <${Bring} name=${name} rec=${rec} />
    ${example ? html`<section class="panel" aria-label="signals">
        <h2>${example.seen.recording}, simulated</h2>
        <p class="says" role="status">an answer that ships; your own takes its place</p>
        <${Signals} ...${example.seen} /></section>
      <${Levels} segments=${example.segments} />
      <section class="panel" aria-label="fit"><h2>A friction law fitted to it</h2>
        <${Law} work=${example.fitted} segments=${example.segments} /></section>` : null}
    ${rec && seen.data ? html`<section class="panel" aria-label="signals">
      <h2>${seen.data.answer.recording}${seen.data.answer.simulated ? ", simulated" : ""}</h2>
      <${Signals} ...${seen.data.answer} />
      <${Refusals} segments=${seen.data.answer.segments} />
      <details><summary>how segments are found</summary>
        ${FINDING.map((key) => html`<${Field} key=${key} path=${OWN + key} />`)}</details>
      <${Work} work=${reduced} label="reduce" />
      <${Files} job=${reduced.job} />
    </section>` : rec && !seen.error ? html`<p class="wait">One moment.</p>` : null}
    ${found ? html`<${Levels} segments=${found.segments} />
      <${Fit} name=${name} segments=${found.segments}
        id=${reduced.job.state === "done" ? reduced.id : ""} told=${wrong} />` : null}
  <//>`;
}

/** What the screen opens with: a recording that ships, what it is reduced to, a law fitted to that. */
function useExample(wanted) {
  const reduced = useShipped("rig reduce", wanted);
  const fitted = useShipped("fit", wanted);
  const path = reduced ? placeOf(reduced.id, SEEN) : "";
  const seen = useAsked(path, (leave) => get(path, leave)).found;
  if (!reduced || !fitted || !seen) return null;
  const { segments } = reduced.data.answer;
  return { seen: seen.answer, reduced: { ...reduced.data, toml: fitted.data.toml }, segments,
    fitted: { from: fitted.id, data: fitted.data } };
}

/** Recordings there are, and how another one comes. */
function Bring({ name, rec }) {
  const [said, setSaid] = useState("");
  const [over, setOver] = useState(false);
  const made = route.value.params.made?.split(",").filter(Boolean) ?? [];
  const open = (path, own) => {
    if (own) setParam("made", [...new Set([...made, path])].join(","));
    setParam("rec", path);
  };
  /** A job whose recording is opened. */
  const through = async (body, words) => {
    setSaid(`${words} …`);
    const { id } = await submit(body);
    for (;;) {
      const job = await get(`/api/jobs/${id}`);
      if (job.total) setSaid(`${words}: ${job.done} of ${job.total} …`);
      if (["failed", "stopped"].includes(job.state)) throw new Error(job.error || job.state);
      if (job.state === "done") {
        const file = job.files.find((each) => each.endsWith(".nc") && each !== "run.nc");
        return open(`jobs/${id}/${file}`, true);
      }
      await new Promise((done) => setTimeout(done, 500));
    }
  };
  const bring = async (run) => {
    try {
      await run();
      setSaid("");
    } catch (error) {
      setSaid(`✗ ${error.message}`);
    }
  };
  const take = (file) => file && bring(async () => {
    const { name: put } = await upload(file);
    await loadAbout();
    tell(`${put} is in the folder`);
    const one = about.value.cases.find(({ name: known }) => known === put);
    if (one) go(one.kind, { case: put });
    else if (put.endsWith(".nc")) open(put);
    else await through({ command: "rig import", case: name, arguments: { file: put } }, `importing ${put}`);
  });
  const trial = { command: "rig run", case: name, settings: TRIAL };
  const record = () => bring(() => through(trial, "recording on the simulated rig"));
  const files = [...(about.value?.files ?? []).filter((each) => each.endsWith(".nc")), ...made];
  const drop = (event) => {
    event.preventDefault();
    setOver(false);
    take(event.dataTransfer.files[0]);
  };
  return html`<section class=${over ? "panel drop over" : "panel drop"} aria-label="recording"
      onDragOver=${(event) => (event.preventDefault(), setOver(true))} onDragLeave=${() => setOver(false)}
      onDrop=${drop}>
    <div class="row">
      <label for="recording">recording</label>
      <select id="recording" value=${rec} onChange=${(event) => open(event.target.value)}>
        <option value="">–</option>
        ${[...new Set([...files, rec].filter(Boolean))].map((each) => html`<option key=${each} value=${each}>
          ${each.replace(/^jobs\/(.{6}).*\//, "$1…/")}</option>`)}
      </select>
      <span>or drop a file here</span>
      <label class="pressed">choose a file <input type="file" class="hidden" accept=${EXPORTS}
        onChange=${(event) => take(event.target.files[0])} /></label>
      <button type="button" disabled=${!name} onClick=${record}>record one on the simulated rig</button>
    </div>
    <p class="says" role="status">${said || html`A recording (.nc), or what an oscilloscope exported
      (text, .lvm, .mat, .tdms, .wav, .sr), which is read by the case's channels.`}</p>
  </section>`;
}

const SIGNS = { good: ["✓", "good"], doubtful: ["~", "warn"], refused: ["✗", "bad"] };
const NUMBERS = [
  ["frequency (Hz)", "commanded_Hz"], ["torque before (N m)", "torque_before_Nm"],
  ["torque with (N m)", "torque_with_Nm"], ["change (%)", "torque_change_percent"], ["kᵥ", "k_v"],
  ["sliding before (mm/s)", "sliding_velocity_before_mm_s"],
];
const percent = (ratio) => (ratio === null ? null : 100 * (ratio - 1));
const shown = (value) => (value === null ? "–" : digits(value, 4));

/** What a change lies between. */
export const between = ([low, high]) => low * high > 0
  ? `${digits(Math.max(low, -high), 3)} to ${digits(Math.max(-low, high), 3)} %`
  : `${digits(-low, 3)} % less to ${digits(high, 3)} % more`;

/** The segment in which the most was spared, in a sentence. */
function Most({ segments }) {
  const [best] = segments.filter(({ quality }) => quality !== "refused")
    .toSorted((one, other) => one.torque_change_percent - other.torque_change_percent);
  if (!best) return html`<p class="big">No segment tells what vibration did.</p>`;
  const { torque_change_percent: change, torque_change_ci95_percent: ends, commanded_Hz: at, quality, flags } = best;
  const [sign, kind] = SIGNS[quality];
  return html`<p class="big"><b>${digits(Math.abs(change), 3)} %</b> ${change < 0 ? "less" : "more"} torque${
    at ? ` at ${digits(at, 4)} Hz` : ""}${ends ? html`, <span class="says">95 % sure of ${
    between(ends)}</span>` : null}${
    quality === "good" ? null : html`, <span class=${kind} title=${flags.join("; ")}>${sign} ${quality} for ${
    flags.length} ${flags.length === 1 ? "reason" : "reasons"}, told in its row</span>`}</p>`;
}

/** What vibration did, with intervals, and the model beside it. */
function Levels({ segments }) {
  const kept = segments.filter(({ quality }) => quality !== "refused");
  // Over the frequency where each has its own, else one after the other.
  const own = new Set(kept.map((one) => one.commanded_Hz)).size === kept.length;
  const used = own ? kept.toSorted((one, other) => one.commanded_Hz - other.commanded_Hz) : kept;
  const ends = [0, 1].map((at) => used.map(({ torque_change_ci95_percent: found }) => found?.[at] ?? null));
  const x = own ? { label: "frequency", unit: "Hz", values: used.map((one) => one.commanded_Hz) }
    : { label: "segment", whole: true, values: used.map((_, at) => at + 1) };
  const quality = ({ quality: found, flags }) => html`
    <span class=${SIGNS[found][1]}>${SIGNS[found][0]} ${found}</span> <span class="says">${flags.join("; ")}</span>`;
  return html`<section class="panel" aria-label="levels"><h2>What vibration did</h2>
    <${Table} region="levels of all segments" wide="levels cards" rows=${segments} columns=${[
      ["segment", (_, at) => at + 1, "row"],
      ...NUMBERS.map(([said, key]) => ({ key, ...headed(said) }))
        .map(({ key, head, of }) => [head, (one) =>
          html`<span data-key=${key} data-value=${one[key]}>${shown(of(one[key]))}</span>`, "right"]),
      ["95 % interval (%)", (one) => one.torque_change_ci95_percent?.map(shown).join(" to ") ?? "–", "right"],
      ["model (%)", (one) => shown(percent(one.model_ratio)), "right"], ["quality", quality]]} />
    ${used.length ? html`<${Plot} title="Measured change of torque, its interval, and the model" x=${x} y="change (%)"
      series=${[{ label: "measured", unit: "%", values: used.map((one) => one.torque_change_percent), ends,
        points: "round", bare: true },
      { label: "model", unit: "%", values: used.map((one) => percent(one.model_ratio)), points: "square", colour: 1,
        dash: [8, 4], bare: used.length === 1 }]} />` : null}
  </section>`;
}

/** A friction law fitted to what was measured. */
function Fit({ name, id, segments, told }) {
  const { settings, setAll } = useCase();
  const { free = FREE[0] } = route.value.params;
  const own = Object.fromEntries(Object.entries(settings).filter(([path]) => path.startsWith("friction.")));
  const work = useJob("fit", name && id ? {
    case: name, settings: { ...LAW, ...own }, arguments: { data: `jobs/${id}/measurements.csv` }, options: { free },
  } : null);
  const said = (keys) => words(keys.replaceAll("friction.", "")).replace(",", " and ");
  return html`<${WorkPanel} title="Fit a friction law" name="fit" label="fit" work=${work}
      says="To the measured change of every segment, by marching each of them again and again: minutes.">
    <div class="row"><label class="asked">free
      <select value=${free} onChange=${(event) => setParam("free", event.target.value)}>
        ${FREE.map((each) => html`<option value=${each}>${said(each)}</option>`)}</select></label></div>
    <details onToggle=${(event) => event.target.open && setAll({ ...LAW, ...own })}>
      <summary>the law it begins from</summary>
      ${Object.keys(LAW).map((path) => html`<${Field} key=${path} path=${path} />`)}</details>
    ${work.error && !told ? html`<p class="fault" role="alert">✗ ${work.error.message}</p>` : null}
    ${work.data ? html`<${Law} work=${work} segments=${segments} />` : null}
  <//>`;
}
