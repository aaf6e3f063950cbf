/** The rig: a recording, its segments, what vibration did in each, and a law fitted to that. */
import { html, useRef, useState } from "../../vendor/preact.js";
import { about, get, job as submit, loadAbout, upload, useLive } from "../api.js";
import { Figure } from "../figure.js";
import { Field, useValue, words } from "../form.js";
import { Live } from "../live.js";
import { path, Plot, ticks } from "../plot.js";
import { Screen, tell } from "../shell.js";
import { go, route, setParam, useCase } from "../state.js";
import { Table } from "../table.js";
import { digits, inUnit } from "../units.js";
import { useJob, Work, WorkPanel } from "../work.js";

const OWN = "reduction.";
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
const SHOWN = ["torque_steel", "speed_steel", "drive_deviation"];
const FINDING = ["settling", "speed_settling", "least_window", "threshold", "block"];
const [WIDTH, ROW, LEFT, RIGHT] = [900, 110, 64, 8];

export function view() {
  const { name, settings } = useCase();
  const { rec = "" } = route.value.params;
  const kept = Object.fromEntries(Object.entries(settings).filter(([path]) => path.startsWith(OWN)));
  const asked = rec ? { arguments: { recordings: [rec] }, settings: kept } : null;
  const seen = useLive("signals", asked && { ...asked, case: name }, 60);
  const reduced = useJob("rig reduce", asked);
  const found = reduced.data?.answer;
  return html`<${Screen} title="Rig" kinds=${["rig"]} first="disc-on-disc" busy=${seen.busy} now=${!rec || seen.now}
      lead="Drop a recording of a disc-on-disc rig: its segments are found, and what vibration did in each of them."
      answer=${seen.data && { ...seen.data, ...(reduced.data && { notes: reduced.data.notes }) }}
      error=${rec ? (seen.error ?? reduced.error) : null}>
    <${Live} />
    <${Bring} name=${name} rec=${rec} />
    ${rec && seen.data ? html`<section class="panel" aria-label="signals">
      <h2>${seen.data.answer.recording}${seen.data.answer.simulated ? ", simulated" : ""}</h2>
      <${Signals} ...${seen.data.answer} />
      <${Refusals} segments=${seen.data.answer.segments} />
      <details><summary>how segments are found</summary>
        ${FINDING.map((key) => html`<${Field} key=${key} path=${OWN + key} />`)}</details>
      <${Work} work=${reduced} label="reduce" />
    </section>` : rec && !seen.error ? html`<p class="wait">One moment.</p>` : null}
    ${found ? html`<${Levels} segments=${found.segments} />
      <${Fit} name=${name} id=${reduced.job.state === "done" ? reduced.id : ""} />` : null}
  <//>`;
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
      <label for="drop">or drop a file here</label>
      <input id="drop" type="file" accept=${EXPORTS} onChange=${(event) => take(event.target.files[0])} />
      <button type="button" disabled=${!name} onClick=${record}>record one on the simulated rig</button>
    </div>
    <p class="says" role="status">${said || html`A recording (.nc), or what an oscilloscope exported
      (text, .lvm, .mat, .tdms, .wav, .sr), which is read by the case's channels.`}</p>
  </section>`;
}

/** Signals over time with the windows of each segment; an edge that is dragged moves the settling. */
function Signals({ time, signals, segments, settling_s: answered, duration_s: duration }) {
  const { settings, set } = useCase();
  const least = inUnit(useValue(`${OWN}least_window`).text, "s") || 0;
  const box = useRef(null);
  const grip = useRef(null);
  const [held, setHeld] = useState(null);
  const written = settings[`${OWN}settling`];
  // What is dragged or set is drawn at once: an answer to what was set before moves nothing back.
  const settling = held ?? (written ? inUnit(written, "s") : answered);
  const rows = SHOWN.map((name) => signals.find((each) => each.name === name)).filter(Boolean);
  const height = rows.length * ROW + 24;
  const along = (seconds) => LEFT + ((WIDTH - LEFT - RIGHT) * seconds) / duration;
  // Of the segment whose edge is moved, the least window stays.
  const settle = (seconds, { with: [from, to] }) =>
    Math.max(0, Math.round(Math.min(seconds, to - from + answered - least) * 20) / 20);
  const put = (seconds) => set(`${OWN}settling`, `${digits(seconds, 4)} s`);
  const grab = (event, one) => {
    grip.current = one;
    event.preventDefault();
    event.currentTarget.focus();
    event.currentTarget.setPointerCapture(event.pointerId);
  };
  const move = (event) => {
    if (grip.current === null) return;
    const { left, width } = box.current.getBoundingClientRect();
    const place = ((event.clientX - left) / width) * WIDTH - LEFT;
    setHeld(settle((place / (WIDTH - LEFT - RIGHT)) * duration - grip.current.start, grip.current));
  };
  const drop = () => {
    grip.current = null;
    if (held !== null) put(held);
    setHeld(null);
  };
  const keyed = (event, one) => {
    const step = { ArrowLeft: -0.1, ArrowRight: 0.1 }[event.key];
    if (!step) return;
    event.preventDefault();
    put(settle(settling + step, one));
  };
  const columns = () => [{ label: "time", unit: "s", values: time },
    ...signals.map(({ name, unit, values }) => ({ label: words(name), unit, values }))];
  // The left edges move with the settling, the right ones are where something changes.
  const ends = ([from, to]) => [Math.min(from + settling - answered, to), to].map((at) => Math.min(at, duration));
  const window = (kind, colour) => {
    const [from, to] = ends(kind).map(along);
    return html`<rect class=${`window fill${colour}`} x=${from} width=${to - from} y="4"
      height=${rows.length * ROW - 8} />`;
  };
  return html`<${Figure} title="Signals, and the windows before and with vibration" kind="bare" columns=${columns}>
    <div class="scroll wide"><svg ref=${box} class="signals drawn" viewBox=${`0 0 ${WIDTH} ${height}`} role="group"
        aria-label="signals over time" onPointerMove=${move} onPointerUp=${drop} onPointerCancel=${drop}>
      ${segments.map((one, at) => html`<g key=${at} class=${one.refused ? "segment refused" : "segment"}>
        <title>${told(one, at)}</title>${window(one.before, 3)}${window(one.with, 1)}
        <text x=${along(ends(one.with)[0]) + 10} y="18">
          ${one.commanded_Hz ? `${digits(one.commanded_Hz, 4)} Hz` : "?"}${one.refused ? " ✗" : ""}</text>
      </g>`)}
      ${rows.map(({ name, unit, values }, row) => html`<${Line} key=${name} label=${`${words(name)} (${unit})`}
        time=${time} values=${values} along=${along} top=${row * ROW} />`)}
      ${ticks(0, duration, false, 10).map((at) => html`<text key=${at} class="tick" x=${along(at)} y=${height - 6}
        text-anchor="middle">${at}</text>`)}
      ${segments.map((one, at) => html`<rect key=${at} class="grip" x=${along(ends(one.with)[0]) - 4} width="8" y="4"
        height=${rows.length * ROW - 8} role="slider" tabindex="0" aria-label=${`settling, at segment ${at + 1}`}
        aria-valuemin="0" aria-valuemax=${duration} aria-valuenow=${settling}
        aria-valuetext=${`${digits(settling, 3)} s`} onKeyDown=${(event) => keyed(event, one)}
        onPointerDown=${(event) => grab(event, one)} />`)}
    </svg></div>
    <p class="says">Time in s. Green: sliding before; blue: with vibration. Drag the left edge of a blue window,
      or press ← →: what is left out behind every change is ${digits(settling, 3)} s.</p>
  <//>`;
}

function Line({ label, time, values, along, top }) {
  const known = values.filter((value) => value !== null);
  const [low, high] = [Math.min(...known), Math.max(...known)];
  const up = { at: (value) => top + ROW - 14 - ((ROW - 28) * (value - low)) / (high - low || 1) };
  const end = (value) => html`<text class="tick" x=${LEFT - 6} y=${up.at(value) + 4}
    text-anchor="end">${digits(value, 3)}</text>`;
  return html`<g class="row-of"><path class="trace" d=${path(time, values, { at: along }, up)} />
    <text class="name" x=${LEFT + 4} y=${top + ROW - 3}>${label}</text>${end(high)}${end(low)}</g>`;
}

const told = ({ start, refused }, at) =>
  `segment ${at + 1}, ${digits(start, 4)} s${refused ? `: refused, ${refused}` : ""}`;

function Refusals({ segments }) {
  const odd = segments.map((one, at) => ({ ...one, at })).filter(({ refused, flags }) => refused || flags.length);
  if (!segments.length) {
    return html`<p class="notes">No vibration was found in it: its drive signal never varies for long.</p>`;
  }
  return odd.length ? html`<ul class="notes" aria-label="what to know of the segments">${odd.map((one) => html`
    <li key=${one.at}>${one.refused ? "✗" : "~"} ${told(one, one.at)}
      ${one.refused ? "" : `: ${one.flags.join("; ")}`}</li>`)}
    </ul>` : null;
}

const SIGNS = { good: ["✓", "good"], doubtful: ["~", "warn"], refused: ["✗", "bad"] };
const NUMBERS = [
  ["frequency (Hz)", "commanded_Hz"], ["torque before (N m)", "torque_before_Nm"],
  ["torque with (N m)", "torque_with_Nm"], ["change (%)", "torque_change_percent"], ["k_v", "k_v"],
  ["sliding before (mm/s)", "sliding_velocity_before_mm_s"],
];
const percent = (ratio) => (ratio === null ? null : 100 * (ratio - 1));
const shown = (value) => (value === null ? "–" : digits(value, 4));

/** What vibration did, with intervals, and the model beside it. */
function Levels({ segments }) {
  const kept = segments.filter(({ quality }) => quality !== "refused");
  // Over the frequency where each has its own, else one after the other.
  const own = new Set(kept.map((one) => one.commanded_Hz)).size === kept.length;
  const used = own ? kept.toSorted((one, other) => one.commanded_Hz - other.commanded_Hz) : kept;
  const ends = [0, 1].map((at) => used.map(({ torque_change_ci95_percent: found }) => found?.[at] ?? null));
  const x = own ? { label: "frequency", unit: "Hz", values: used.map((one) => one.commanded_Hz) }
    : { label: "segment", values: used.map((_, at) => at + 1) };
  const quality = ({ quality: found, flags }) => html`
    <span class=${SIGNS[found][1]}>${SIGNS[found][0]} ${found}</span> <span class="says">${flags.join("; ")}</span>`;
  return html`<section class="panel" aria-label="levels"><h2>What vibration did</h2>
    <${Table} region="levels of all segments" wide="levels" rows=${segments} columns=${[
      ["segment", (_, at) => at + 1, "row"],
      ...NUMBERS.map(([said, key]) =>
        [said, (one) => html`<span data-key=${key} data-value=${one[key]}>${shown(one[key])}</span>`, "right"]),
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
function Fit({ name, id }) {
  const { settings, setAll } = useCase();
  const { free = FREE[0] } = route.value.params;
  const own = Object.fromEntries(Object.entries(settings).filter(([path]) => path.startsWith("friction.")));
  const work = useJob("fit", name && id ? {
    case: name, settings: { ...LAW, ...own }, arguments: { data: `jobs/${id}/measurements.csv` }, options: { free },
  } : null);
  const found = work.data?.answer;
  const said = (keys) => words(keys.replaceAll("friction.", "")).replace(",", " and ");
  const ended = (end) => (end === null ? "open" : digits(end, 4));
  const sure = ({ identifiable, why }) => html`<span class=${identifiable ? "good" : "warn"}>
    ${identifiable ? "✓ both ends" : "~ an end is open"}</span> ${why}`;
  return html`<${WorkPanel} title="Fit a friction law" name="fit" label="fit" work=${work}
      says="To the measured change of every segment, by marching each of them again and again: minutes.">
    <div class="row"><label class="asked">free
      <select value=${free} onChange=${(event) => setParam("free", event.target.value)}>
        ${FREE.map((each) => html`<option value=${each}>${said(each)}</option>`)}</select></label></div>
    <details onToggle=${(event) => event.target.open && setAll({ ...LAW, ...own })}>
      <summary>the law it begins from</summary>
      ${Object.keys(LAW).map((path) => html`<${Field} key=${path} path=${path} />`)}</details>
    ${work.error ? html`<p class="fault" role="alert">✗ ${work.error.message}</p>` : null}
    ${found ? html`<${Table} rows=${found.parameters} columns=${[
        ["parameter", ({ key }) => key, "row"],
        ["value", ({ value, units }) => `${digits(value, 4)} ${units}`, "right"],
        ["95 % interval", ({ ci95 }) => ci95.map(ended).join(" to "), "right"],
        ["what the data tell", sure]]} />
      <p class="says">chi² ${digits(found.chi2, 4)} at ${found.dof} degrees of freedom, law ${found.law},${" "}
        ${found.points} measurements.</p>` : null}
  <//>`;
}
