/** An elastic block: what it settles to beside a rigid body, and the pressure under it. */
import { html, useMemo } from "../../vendor/preact.js";
import { fetchRaw, useAsked } from "../api.js";
import { span } from "../colours.js";
import { Deformed } from "../deformed.js";
import { AllKeys, Amplitude, Field, Slider, useValue } from "../form.js";
import { FlankMap } from "../map.js";
import { AllNumbers, byKey, Num } from "../number.js";
import { unpacked } from "../packed.js";
import { Plot } from "../plot.js";
import { Report } from "../report.js";
import { Screen } from "../shell.js";
import { useCase } from "../state.js";
import { inWords } from "../symbols.js";
import { useTaken } from "../taken.js";
import { digits, inUnit } from "../units.js";
import { lasting, placeOf, useData, useJob, WorkPanel } from "../work.js";

const START = { "block.elements": "[4, 3, 3]", "block.element": "hex8", "vibration.start": "2 ms",
  "solve.step": "4 us", "solve.duration": "20 ms" };
const BOUNDS = {
  velocity_ratio: { low: 0.1, high: 100, unit: "" }, velocity_amplitude: { low: 0.01, high: 1000, unit: "mm/s" },
  displacement_amplitude: { low: 0.001, high: 100, unit: "um" },
};
const MESHES = [4, 8, 12, 16];
/** Increments of the settled state, its calm cycles and the windows that are read. */
const SETTLED = 6600;
const NODES = { hex8: 1, hex8i: 1, hex27: 2 };
/** What a node under the block costs in an increment, and what an increment costs besides, s. */
const COST = [2.5e-5, 4e-4];
/** The least that is told of a job, which must begin, s. */
const LEAST = 60;

export function view() {
  const { name, settings } = useCase();
  const ask = (method) => (name ? { case: name, settings: { ...settings, "solve.method": method } } : null);
  const settled = useJob("block", ask("settled"), "-settled", true);
  const marched = useJob("block", ask("march"), "-march", true);
  const taken = useTaken("block", [ask("settled"), ask("march")], settled, marched);
  const mesh = useMesh();
  return html`<${Screen} title="Elastic block" kinds=${["block"]} first="block-shaken-along" start=${START}
    lead="The same body, elastic: meshed with solid elements, pressed, pulled and shaken."
    actions=${html`<${Report} work=${settled} />`} ...${taken} answer=${{ ...taken.answer, notes: [] }}>
    <div class="columns headed moving">
      <section class="controls" aria-label="what is set">
        <${Mesh} ...${mesh} />
        <${Field} path="block.element" brief />
        <${Field} path="block.modes" brief />
        <${Amplitude} bounds=${BOUNDS} />
        <${Slider} path="vibration.direction" low=${0} high=${90} step=${1} unit="deg" log=${false} />
        <${Field} path="solve.duration" label="time marched" brief />
        <${Field} path="solve.step" brief />
        <${AllKeys} tables=${["block", "contact", "slider", "friction", "vibration", "solve"]} />
      </section>
      <${Headline} work=${settled} />
      <${Moving} work=${marched} />
      <section class="shown" aria-label="what comes of it">
        <${WorkPanel} title="What it settles to" label="settle" work=${settled}
          says=${`Under lasting vibration, beside the rigid body: about ${mesh.time(SETTLED)}.`}>
          <${Settled} work=${settled} /><//>
        <${WorkPanel} title="Marched in time" label="march" work=${marched}
          says=${`From rest, with the pressure under it: about ${mesh.time(mesh.increments)}.`}>
          <${Marched} work=${marched} /><//>
      </section>
    </div>
  <//>`;
}

const PACKED = "frames.bin";

/** How fine the mesh is and what it takes. */
function useMesh() {
  const { text } = useValue("block.elements");
  const elements = /^\[.*\]$/.test(text) ? JSON.parse(text) : [8, 6, 6];
  const order = NODES[useValue("block.element").text] ?? 2;
  const duration = inUnit(useValue("solve.duration").text, "s");
  const step = inUnit(useValue("solve.step").text || "1 us", "s");
  const nodes = (elements[0] * order + 1) * (elements[1] * order + 1);
  const time = (increments) => lasting(Math.max(increments * (COST[0] * nodes + COST[1]), LEAST));
  return { text, elements, nodes, increments: Math.round(duration / step) || 0, time };
}

function Mesh({ text, elements, nodes }) {
  const { set } = useCase();
  const choices = MESHES.map((along) => `[${along}, ${Math.round(along * 0.75)}, ${Math.round(along * 0.75)}]`);
  const said = (each) => each.replace(/[[\]]/g, "").replaceAll(", ", " × ");
  return html`<div class="field"><label for="mesh">mesh density</label>
    <select id="mesh" value=${text} onChange=${(event) => set("block.elements", event.target.value)}>
      ${[...new Set([text, ...choices])].filter(Boolean).map((each) =>
        html`<option value=${each}>${said(each)}</option>`)}
    </select>
    <p class="says">${elements.reduce((product, each) => product * each, 1)} elements,${" "}
      ${nodes} nodes on the base</p></div>`;
}

/** What an answer that has not settled lacks. */
function Loose({ numbers }) {
  if (numbers.settled?.value !== false) return null;
  return html`<p role="status">Not settled, no prediction: ${inWords(numbers.settled_by.value)}.</p>`;
}

/** How the elastic block does beside the rigid body, in words. */
function besides(numbers) {
  const [elastic, rigid] = [numbers.ratio.value, numbers.slider_ratio.value];
  if (typeof elastic !== "number" || !rigid) return ".";
  const more = 100 * (elastic / rigid - 1);
  return `: ${digits(Math.abs(more), 2)} % ${more < 0 ? "less" : "more"} than of a rigid body.`;
}

/** What is left of the force, on top. */
function Headline({ work }) {
  const numbers = byKey(work.data?.entries);
  if (!work.data) return html`<div class="headline"><p class="large">…</p></div>`;
  const loose = numbers.settled?.value === false;
  return html`<div class="headline">
    <p class="large">${loose ? "(" : null}<${Num} entry=${numbers.ratio} count=${4} />${loose ? ")" : null}</p>
    <div><p>of the force without vibration is left${loose ? "." : besides(numbers)}<br />
      <span class="of">of the rigid body</span> <${Num} entry=${numbers.slider_ratio} count=${4} /></p>
      <${Loose} numbers=${numbers} /></div></div>`;
}

function Settled({ work }) {
  const numbers = byKey(work.data?.entries);
  const data = useData(work, ["friction", "slider_friction"]);
  if (!work.data) return null;
  const along = ({ values }) => values.filter((_, at) => at % 2 === 0);
  return html`<p><${Num} entry=${numbers.unsteadiness} label count=${2} /></p>
    ${data ? html`<${Plot} title="Friction over a settled cycle" y="friction (N)"
      x=${{ label: "phase, cycles", values: data.phase.values }} series=${[
        { label: "elastic block", unit: "N", values: along(data.friction) },
        { label: "rigid body", unit: "N", values: along(data.slider_friction), dash: [4, 3], colour: 6 }]} />` : null}
    <${AllNumbers} entries=${work.data.entries} />`;
}

const UNDER = ["pressure", "faces", "node_x", "node_y", "drive_force"];
const milli = ({ values }) => values.map((value) => 1e3 * value);

/** The states that a march kept, played. */
function Moving({ work }) {
  const data = useData(work, UNDER);
  const files = work.files ?? work.job?.files ?? [];
  const path = files.includes(PACKED) ? placeOf(work.from, PACKED) : "";
  const packed = useAsked(path, async (leave) => unpacked(await (await fetchRaw(path, leave)).arrayBuffer())).found;
  const contact = useMemo(() => data && (
    { x: milli(data.node_x), y: milli(data.node_y), cells: quads(data.faces) }), [data]);
  return work.data && contact && packed ? html`<section class="panel at-stage" aria-label="in motion">
    <${Deformed} packed=${packed} contact=${contact} /></section>` : null;
}

function Marched({ work }) {
  const numbers = byKey(work.data?.entries);
  const data = useData(work, UNDER);
  if (!work.data) return null;
  const pressure = data?.pressure.values.map((value) => value / 1e3);
  return html`<${Loose} numbers=${numbers} />
    <p class="row">${["ratio", "drive_force_N", "peak_pressure_Pa"].map((key) =>
      html`<${Num} entry=${numbers[key]} label count=${4} />`)}</p>
    ${data ? html`<div class="pair">
      <${FlankMap} title="Pressure under the block, its mean" label="mean pressure at a node" unit="kPa"
        x=${milli(data.node_x)} y=${milli(data.node_y)} cells=${quads(data.faces)} values=${pressure}
        range=${span(pressure)} says="seen from below; along the drive to the right, across it upwards" />
      <${Plot} title="Drive force over time" x=${{ label: "time", unit: "ms", values: milli(data.time) }}
        series=${[{ label: "drive force", unit: "N", values: data.drive_force.values }]} /></div>` : null}
    <${AllNumbers} entries=${work.data.entries} of=", marched" />`;
}

/** Quadrilaterals of the faces of elements, of which those of nine nodes have four. */
function quads({ shape: [count, corners], values }) {
  const parts = corners === 4 ? [[0, 1, 2, 3]] : [[0, 4, 8, 7], [4, 1, 5, 8], [8, 5, 2, 6], [7, 8, 6, 3]];
  return Array.from({ length: count }, (_, at) => values.slice(at * corners, (at + 1) * corners))
    .flatMap((face) => parts.map((part) => part.map((corner) => face[corner])));
}
