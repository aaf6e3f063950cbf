/** What stands below the answer of a shaken drive: teeth under load, ways to shake it, what holds without its motor. */
import { html } from "../vendor/preact.js";
import { Verdict } from "./bars.js";
import { span } from "./colours.js";
import { Way } from "./gears.js";
import { FlankMap } from "./map.js";
import { Facts } from "./number.js";
import { Plot } from "./plot.js";
import { route, setParam, useCase } from "./state.js";
import { inWords } from "./symbols.js";
import { Table } from "./table.js";
import { digits } from "./units.js";
import { amount, headed } from "./us.js";
import { rows } from "./work.js";

const RANKINGS = {
  per_micrometre: "most saved for a micrometre", per_watt: "most saved for a watt of the actuator",
  by_force: "least force on the teeth",
};
const LOADED = ["efficiency", "input_torque_Nm", "transmission_error_rad", "load_share_max", "pressure_flank_MPa",
  "pressure_worm_tip_MPa", "force_worm_tip_N", "pressure_wheel_tip_MPa", "force_wheel_tip_N", "pressure_mean_MPa",
  "flow_pressure_MPa"];
const HELD = ["holding_share", "threshold_m", "threshold_closed_form_m", "creep_rad_s"];
const DASHES = [[], [6, 4], [2, 3], [8, 3, 2, 3]];

export function Pattern({ data, found }) {
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
        ${loads.map((load, n) => html`<option value=${String(n)}>${amount(load, "N m")}</option>`)}</select></p>
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
export function Ways({ answer, geometry, speed }) {
  const { set } = useCase();
  return html`<div class="ways">${answer.directions.map((way) => html`<${Way} key=${way.mode} mode=${way.mode}
      geometry=${geometry} speed=${speed}>
    <p>${way.settled ? html`<b>${digits(way.torque_ratio, 3)}</b> of the torque, ${amount(way.saved_W, "W", 3)} saved`
      : html`<${Verdict} ok=${false} no="not settled" />: no saving is told`}</p>
    <button type="button" onClick=${() => set("vibration.mode", way.mode)}>take ${way.mode}</button><//>`)}</div>`;
}

export function Directions({ answer }) {
  const number = (said, key, count = 4) => {
    const { head, of } = headed(said);
    return [head, (way) => digits(of(way[key] ?? NaN), count), "right"];
  };
  return html`<${Table} region="directions" wide="cards" rows=${answer.directions} columns=${[
      ["way", ({ mode }) => mode, "row"],
      ["torque ratio", (way) => bracketed(digits(way.torque_ratio, 4), way.settled), "right"],
      number("balance", "torque_balance", 2),
      ["state", (way) => html`<${Verdict} ok=${way.settled} yes="settled" no="not settled" />`],
      number("saved (W)", "saved_W"), number("per µm (W)", "saved_per_micrometre_W"),
      number("per W", "saved_per_actuator_W_W"), number("force", "force_ratio"),
    ]} />
    <ul class="plain">${Object.entries(answer.rankings).map(([key, order]) =>
      html`<li>${RANKINGS[key]}: ${order.join(", ") || "none told"}</li>`)}</ul>`;
}

export function Locking({ answer, found, data }) {
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
