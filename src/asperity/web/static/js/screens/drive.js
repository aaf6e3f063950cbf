/** A worm gearset under load and shaken: what the motor is spared, and what that costs. */
import { html, useMemo } from "../../vendor/preact.js";
import { useLive } from "../api.js";
import { Sided, Verdict } from "../bars.js";
import { Amplitude, Folded, Form, Slider, useValue } from "../form.js";
import { Gears } from "../gears.js";
import { AllNumbers, byKey, Facts, Num } from "../number.js";
import { Report } from "../report.js";
import { Screen } from "../shell.js";
import { Strips } from "../strips.js";
import { useCase } from "../state.js";
import { Table } from "../table.js";
import { inWords } from "../symbols.js";
import { useTaken } from "../taken.js";
import { digits, inUnit } from "../units.js";
import { amount } from "../us.js";
import { further, Later, rows, useAfter, useData, useJob, WorkPanel } from "../work.js";

/** @type {[string, string, number][]} */
const POWERS = [["power_drive_W", "motor", 1], ["power_actuator_W", "actuator", 1], ["power_load_W", "load", -1],
  ["power_friction_W", "friction", -1], ["power_damping_W", "damping", -1], ["power_stored_W", "stored", -1]];
const BOUNDS = {
  velocity_ratio: { low: 0.01, high: 100, unit: "" }, velocity_amplitude: { low: 0.01, high: 10, unit: "m/s" },
  displacement_amplitude: { low: 0.1, high: 500, unit: "um" },
};
const UNDER = ["phase", "tooth_force", "load", "pattern", "node_radius", "node_face", "faces"];
const WORTH = ["saved_per_actuator_W_W", "actuator_electrical_W", "actuator_apparent_VA", "force_max_N", "open_share",
  "second_flank_share", "resonance_worm_Hz", "resonance_wheel_Hz"];

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
    html`<${Sided} value=${-sign * answer[key]} most=${most} kind=${sign > 0 ? "more" : "less"} />`;
  const powers = POWERS.map(([key, name, sign]) => ({ name, value: sign * answer[key] }));
  return html`<div class="pair"><${Strips} powers=${powers} label="mean powers" />
      <${Table} kind="bars" caption="Mean powers: to the left what is put in, to the right where it goes" rows=${POWERS}
        columns=${[["", ([, said]) => said, "row"], ["", bar],
          ["", ([key]) => html`<${Num} entry=${found[key]} count=${4} />`, "right"]]} /></div>
    <p class="says">what is missing, over what is put in: ${digits(answer.closure, 2)}</p>`;
}

/** Whether the actuator's power is won back; on demand, whether a smaller motor is. */
function Worth({ answer, found }) {
  const { system_efficiency: after, efficiency_static: before, energy_ratio: ratio } = answer;
  const least = 1 - Math.max(0.005, answer.energy_ratio_error ?? 1);
  const says = after
    ? `with the actuator's electrical power the efficiency is ${digits(100 * after, 3)} %, `
      + `without vibration ${digits(100 * before, 3)} %`
    : `mechanical power put in is ${digits(ratio, 3)} times that without; give an [actuator] for its electrical power`;
  return html`<h3>Worth it?</h3>
    <p>${answer.settled
      ? html`<${Verdict} ok=${after ? after * least > before : ratio && ratio < least}
          yes="it saves power" no="it saves no power" />`
      : "no verdict, since the state has not settled:"} ${says}</p>
    ${answer.settled && answer.motor_shaken ? html`<p>
      <${Verdict} ok=${answer.saved_mass_kg > 0} yes="a smaller motor pays" no="a smaller motor does not pay" />
      ${` motor ${answer.motor_shaken} for ${answer.motor_plain}; with the actuator `}
      ${amount(answer.saved_mass_kg, "kg", 3)} saved</p>` : null}
    <${Facts} found=${found} keys=${WORTH} />`;
}

const below = () => import("../below.js");

export function view() {
  const { name, settings } = useCase();
  const body = name ? { case: name, settings, options: {} } : null;
  const shaken = useJob("drive", body, "", true);
  // The answer and its picture come first, what stands below them after that.
  const standing = useAfter(Boolean(shaken.data || shaken.error || shaken.job)) ? body : null;
  const loaded = useJob("drive", standing && { ...standing, options: { static: true } }, "-static", true);
  const ways = useJob("directions", standing, "", true);
  const held = useJob("locking", standing, "", true);
  const { geometry } = useLive("rate", body && { case: name, settings }, 200).data?.answer ?? {};
  const speed = inUnit(useValue("operation.worm_speed").text, "rad/s");
  const mode = useValue("vibration.mode").text;
  const taken = useTaken("drive", [body], shaken, loaded, ways, held);
  const under = useData(loaded, UNDER);
  const pressed = useMemo(() => (under && !loaded.stale ? {
    radius: under.node_radius.values.map((r) => 1e3 * r), face: under.node_face.values.map((z) => 1e3 * z),
    pressure: rows(under.pattern).at(-1).map((pressure) => pressure / 1e6),
  } : null), [under, loaded.stale]);
  const creep = useData(held, ["amplitude", "creep_over", "creep_limit", "settled_over"]);
  const [of, still, holding] = [shaken, loaded, held].map(({ data }) => byKey(data?.entries));
  return html`<${Screen} title="Drive" kinds=${["drive"]} first="drive-actuator"
      ...${taken} answer=${{ ...taken.answer, notes: [] }}
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
        ${under ? html`<${Later} load=${below} part="Pattern" data=${under} found=${still} />` : null}<//>
      <${WorkPanel} title="Which way to shake it" name="which way" label="try each way" work=${ways}
          says="As long as shaking it once for each of the ways.">
        ${ways.data && geometry && speed
          ? html`<${Later} load=${below} part="Ways" answer=${ways.data.answer} geometry=${geometry}
            speed=${speed} />` : null}
        ${ways.data ? html`<${Later} load=${below} part="Directions" answer=${ways.data.answer} />` : null}<//>
      <${WorkPanel} title="Does it hold when the motor stops?" name="locking" label="take the motor off" work=${held}
          says="A minute or several: it is marched at several amplitudes.">
        ${held.data ? html`<${Later} load=${below} part="Locking" answer=${held.data.answer} found=${holding}
          data=${creep} />` : null}<//>
      ${standing ? html`<${Later} load=${further} part="Further" of="drive" name=${name}
        settings=${settings} />` : null}
    </section></div>
  <//>`;
}
