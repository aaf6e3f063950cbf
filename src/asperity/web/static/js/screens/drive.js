/** A worm gearset under load and shaken: what the motor is spared, and what that costs. */
import { html, useMemo } from "../../vendor/preact.js";
import { useAsked, useLive } from "../api.js";
import { Sided, Verdict } from "../bars.js";
import { span } from "../colours.js";
import { Amplitude, Folded, Form, Slider, useValue } from "../form.js";
import { Gears, Way } from "../gears.js";
import { FlankMap } from "../map.js";
import { AllNumbers, byKey, Facts, Num } from "../number.js";
import { Plot } from "../plot.js";
import { Report } from "../report.js";
import { Screen } from "../shell.js";
import { Strips } from "../strips.js";
import { route, setParam, useCase } from "../state.js";
import { Table } from "../table.js";
import { inWords } from "../symbols.js";
import { digits, inUnit } from "../units.js";
import { firstError, useAfter, useData, useJob, useTaken, WorkPanel } from "../work.js";

/** @type {[string, string, number][]} */
const POWERS = [["power_drive_W", "motor", 1], ["power_actuator_W", "actuator", 1], ["power_load_W", "load", -1],
  ["power_friction_W", "friction", -1], ["power_damping_W", "damping", -1], ["power_stored_W", "stored", -1]];
const RANKINGS = {
  per_micrometre: "most saved for a micrometre", per_watt: "most saved for a watt of the actuator",
  by_force: "least force on the teeth",
};
const BOUNDS = {
  velocity_ratio: { low: 0.01, high: 100, unit: "" }, velocity_amplitude: { low: 0.01, high: 10, unit: "m/s" },
  displacement_amplitude: { low: 0.1, high: 500, unit: "um" },
};
const UNDER = ["phase", "tooth_force", "load", "pattern", "node_radius", "node_face", "faces"];
const WORTH = ["saved_per_actuator_W_W", "actuator_electrical_W", "actuator_apparent_VA", "force_max_N", "open_share",
  "second_flank_share", "resonance_worm_Hz", "resonance_wheel_Hz"];
const LOADED = ["efficiency", "input_torque_Nm", "transmission_error_rad", "load_share_max", "pressure_flank_MPa",
  "pressure_worm_tip_MPa", "force_worm_tip_N", "pressure_wheel_tip_MPa", "force_wheel_tip_N", "pressure_mean_MPa",
  "flow_pressure_MPa"];
const HELD = ["holding_share", "threshold_m", "threshold_closed_form_m", "creep_rad_s"];
const DASHES = [[], [6, 4], [2, 3], [8, 3, 2, 3]];

/** What lies one after the other, as rows. */
const rows = ({ shape: [count, width], values }) =>
  Array.from({ length: count }, (_, row) => values.slice(row * width, (row + 1) * width));

const less = (ratio) => (typeof ratio !== "number" ? "."
  : `: the motor gives ${digits(100 * Math.abs(1 - ratio), 3)} % ${ratio < 1 ? "less" : "more"}.`);

/** A torque ratio never stands alone: beside it, whether it is balanced and settled. */
const Ratio = ({ found, answer }) => html`
  <p class="large">${answer.settled ? null : "("}<${Num} entry=${found.torque_ratio} count=${4} />${
    answer.settled ? null : ")"}</p>
  <div class="ratio"><p>of the worm's torque without vibration is left${
    answer.settled ? less(answer.torque_ratio) : "."}<br />
  <${Verdict} ok=${answer.settled} yes="settled" no="not settled" />${" "}
    <span class="of">balance of the wheel</span>${" "}<${Num} entry=${found.torque_balance} count=${3} /></p>
  ${answer.settled ? null : html`<p class="warn" role="status">▲ Not settled, no prediction: ${
    inWords(answer.settled_by)}.</p>`}</div>`;

function Ledger({ answer, found }) {
  const most = Math.max(...POWERS.map(([key]) => Math.abs(answer[key])), 1e-12);
  const bar = ([key, , sign]) =>
    html`<${Sided} value=${sign * answer[key]} most=${most} kind=${sign > 0 ? "more" : "less"} />`;
  const powers = POWERS.map(([key, name, sign]) => ({ name, value: sign * answer[key] }));
  return html`<${Strips} powers=${powers} label="mean powers" />
    <${Table} kind="bars" caption="Mean powers: what is put in, right, is what goes, left" rows=${POWERS}
      columns=${[["", ([, said]) => said, "row"], ["", bar],
        ["", ([key]) => html`<${Num} entry=${found[key]} count=${4} />`, "right"]]} />
    <p class="says">what is missing, over what is put in: ${digits(answer.closure, 2)}</p>`;
}

/** Whether the actuator's power is won back; on demand, whether a smaller motor is. */
function Worth({ answer, found }) {
  const electrical = answer.system_efficiency !== null;
  const [after, before] = electrical ? [answer.system_efficiency, answer.efficiency_static]
    : [0.995 / answer.energy_ratio, 1];
  const says = electrical
    ? `with the actuator's electrical power the efficiency is ${digits(100 * after, 3)} %, `
      + `without vibration ${digits(100 * before, 3)} %`
    : `mechanical power put in is ${digits(answer.energy_ratio, 3)} times that without; `
      + "give an [actuator] for its electrical power";
  return html`<h3>Worth it?</h3>
    <p>${answer.settled
      ? html`<${Verdict} ok=${after > before} yes="it saves power" no="it saves no power" />`
      : "no verdict, since the state has not settled:"} ${says}</p>
    ${answer.settled && answer.motor_shaken ? html`<p>
      <${Verdict} ok=${answer.saved_mass_kg > 0} yes="a smaller motor pays" no="a smaller motor does not pay" />
      ${` motor ${answer.motor_shaken} for ${answer.motor_plain}; with the actuator `}
      ${digits(answer.saved_mass_kg, 3)} kg saved</p>` : null}
    <${Facts} found=${found} keys=${WORTH} />`;
}

function Pattern({ data, found }) {
  const value = (name, times = 1) => data[name].values.map((each) => times * each);
  const loads = value("load");
  const at = Number(route.value.params.load ?? loads.length - 1);
  const values = rows(data.pattern)[at].map((pressure) => pressure / 1e6);
  const force = rows(data.tooth_force);
  const sums = force.map((row) => row.reduce((sum, each) => sum + each, 0));
  const teeth = force[0].map((_, tooth) => force.map((row, n) => row[tooth] / sums[n]));
  const series = teeth.filter((shares) => Math.max(...shares) > 1e-3)
    .map((shares, n) => ({ label: `tooth ${n + 1}`, values: shares, dash: DASHES[n % DASHES.length] }));
  return html`<p class="choice"><label for="load">torque of the wheel</label>${" "}
      <select id="load" value=${String(at)} onChange=${(event) => setParam("load", event.target.value)}>
        ${loads.map((load, n) => html`<option value=${String(n)}>${digits(load, 4)} N m</option>`)}</select></p>
    <div class="pair">
      <${FlankMap} title="Where it bears over a pitch, and how hard" label="largest pressure" unit="MPa"
        x=${value("node_face", 1e3)} y=${value("node_radius", 1e3)} cells=${rows(data.faces)} values=${values}
        range=${[0, span(values)[1]]} />
      <${Plot} title="Share of each tooth" series=${series} x=${{
        label: "angle of the worm", unit: "°", values: value("phase", 180 / Math.PI) }} /></div>
    <${Facts} found=${found} keys=${LOADED} />`;
}

/** What is no prediction stands in brackets. */
const bracketed = (text, settled) => (settled ? text : `(${text})`);

/** The ways side by side, each taken by a click. */
function Ways({ answer, geometry, speed }) {
  const { set } = useCase();
  return html`<div class="ways">${answer.directions.map((way) => html`<${Way} key=${way.mode} mode=${way.mode}
      geometry=${geometry} speed=${speed}>
    <p>${way.settled ? html`<b>${digits(way.torque_ratio, 3)}</b> of the torque, ${digits(way.saved_W, 3)} W saved`
      : html`<${Verdict} ok=${false} no="not settled" />: no saving is told`}</p>
    <button type="button" onClick=${() => set("vibration.mode", way.mode)}>take ${way.mode}</button><//>`)}</div>`;
}

function Directions({ answer }) {
  const number = (said, key, count = 4) => [said, (way) => digits(way[key] ?? NaN, count), "right"];
  return html`<${Table} region="directions" rows=${answer.directions} columns=${[
      ["way", ({ mode }) => mode, "row"],
      ["torque ratio", (way) => bracketed(digits(way.torque_ratio, 4), way.settled), "right"],
      number("balance", "torque_balance", 2),
      ["state", (way) => html`<${Verdict} ok=${way.settled} yes="settled" no="not settled" />`],
      number("saved (W)", "saved_W"), number("per µm (W)", "saved_per_micrometre_W"),
      number("per W", "saved_per_actuator_W_W"), number("force", "force_ratio"),
    ]} />
    <ul class="plain">${Object.entries(answer.rankings).map(([key, order]) =>
      html`<li>${RANKINGS[key]}: ${order.join(", ") || "none settled"}</li>`)}</ul>`;
}

function Locking({ answer, found, data }) {
  const x = data && { label: "amplitude", unit: "µm", values: data.amplitude.values.map((u) => 1e6 * u) };
  const loose = data?.settled_over?.values.map((stays) => stays === 0) ?? [];
  return html`<p class="big"><${Verdict} ok=${answer.locked}
      yes="holds its load without vibration" no="runs back without vibration" /></p>
    ${answer.settled ? null
      : html`<p role="status">The creep has not settled, no prediction: ${inWords(answer.settled_by)}.</p>`}
    <${Facts} found=${found} keys=${HELD} />
    ${data ? html`<${Plot} title="Creep of the wheel, the motor off" y="creep (rad/s)" x=${x} xlog=${true} series=${[
      { label: "marched", unit: "rad/s", values: data.creep_over.values, points: "round" },
      { label: "far beyond the threshold, closed form", unit: "rad/s", values: data.creep_limit.values, dash: [6, 4] },
      ...(loose.some(Boolean) ? [{ label: "not settled", unit: "rad/s", points: "square", bare: true, colour: 6,
        values: data.creep_over.values.map((value, at) => (loose[at] ? value : null)) }] : []),
    ]} />` : null}`;
}

/** What is further asked, loaded once the screen stands. */
function Later(given) {
  const { found } = useAsked("further", () => import("../further.js"));
  return found ? html`<${found.Further} ...${given} />` : null;
}

export function view() {
  const { name, settings } = useCase();
  const body = name ? { case: name, settings, options: {} } : null;
  const shaken = useJob("drive", body, "", true);
  // The answer and its picture come first, what stands below them after that.
  const below = useAfter(Boolean(shaken.data || shaken.error || shaken.job)) ? body : null;
  const loaded = useJob("drive", below && { ...below, options: { static: true } }, "-static", true);
  const ways = useJob("directions", below, "", true);
  const held = useJob("locking", below, "", true);
  const { geometry } = useLive("rate", body && { case: name, settings }, 200).data?.answer ?? {};
  const speed = inUnit(useValue("operation.worm_speed").text, "rad/s");
  const mode = useValue("vibration.mode").text;
  const taken = useTaken(shaken, "drive", body);
  const under = useData(loaded, UNDER);
  const pressed = useMemo(() => (under && !loaded.stale ? {
    radius: under.node_radius.values.map((r) => 1e3 * r), face: under.node_face.values.map((z) => 1e3 * z),
    pressure: rows(under.pattern).at(-1).map((pressure) => pressure / 1e6),
  } : null), [under, loaded.stale]);
  const creep = useData(held, ["amplitude", "creep_over", "creep_limit", "settled_over"]);
  const [of, still, holding] = [shaken, loaded, held].map(({ data }) => byKey(data?.entries));
  return html`<${Screen} title="Drive" kinds=${["drive"]} first="drive-actuator"
      answer=${{ ...taken, notes: [] }} error=${firstError(shaken, loaded, ways, held)}
      actions=${html`<${Report} work=${shaken} />`}
      lead="A gearset under load, shaken: what the motor is spared, what that costs, and what it does to the teeth.">
    <div class="columns headed moving"><section class="controls" aria-label="what is set">
      <${Slider} path="vibration.frequency" low=${100} high=${100000} unit="Hz" log />
      <${Amplitude} bounds=${BOUNDS} />
      <${Folded}><${Form} tables=${["vibration", "drive", "actuator", "operation", "friction", "shaft"]} brief /><//>
    </section>
    <div class="headline">${shaken.data ? html`<${Ratio} found=${of} answer=${shaken.data.answer} />` : null}</div>
    ${geometry && speed ? html`<${Gears} geometry=${geometry} speed=${speed} mode=${mode} pressed=${pressed} />` : null}
    <section class="shown">
      <${WorkPanel} title="Shaken" name="shaken" label="shake it" work=${shaken}
          says="A minute or several: the more the gearset must be shaken until it settles, the longer.">
        ${shaken.data ? html`<${Ledger} found=${of} answer=${shaken.data.answer} />
          <${Worth} found=${of} answer=${shaken.data.answer} />
          <${AllNumbers} entries=${shaken.data.entries} />` : null}<//>
      <${WorkPanel} title="Under load" name="under load" label="load it" work=${loaded}
          says="A minute or two: elastic teeth at several angles of the worm.">
        ${under ? html`<${Pattern} data=${under} found=${still} />` : null}<//>
      <${WorkPanel} title="Which way to shake it" name="which way" label="try each way" work=${ways}
          says="As long as shaking it once for each of the ways.">
        ${ways.data && geometry && speed
          ? html`<${Ways} answer=${ways.data.answer} geometry=${geometry} speed=${speed} />` : null}
        ${ways.data ? html`<${Directions} answer=${ways.data.answer} />` : null}<//>
      <${WorkPanel} title="Does it hold when the motor stops?" name="locking" label="take the motor off" work=${held}
          says="A minute or several: it is marched at several amplitudes.">
        ${held.data ? html`<${Locking} answer=${held.data.answer} found=${holding} data=${creep} />` : null}<//>
      ${below ? html`<${Later} name=${name} settings=${settings} />` : null}
    </section></div>
  <//>`;
}
