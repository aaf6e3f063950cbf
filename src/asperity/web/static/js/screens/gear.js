/** A worm gearset: whether it holds, by whom, what fails first and what moves it. */
import { html, useMemo } from "../../vendor/preact.js";
import { useAddress, useCaseFile, useLive } from "../api.js";
import { Margins, STANDARDS, Tornado, Verdict } from "../bars.js";
import { Beneath } from "../figure.js";
import { Box, Folded, Form, useValue, words } from "../form.js";
import { Gears } from "../gears.js";
import { AllNumbers, byKey, Num } from "../number.js";
import { ReportOf } from "../report.js";
import { Screen } from "../shell.js";
import { caseParams, go, route, setParam, useCase } from "../state.js";
import { printed, symbol } from "../symbols.js";
import { Table } from "../table.js";
import { digits, inUnit, ratioOf, split } from "../units.js";
import { amount, written } from "../us.js";
import { further, Later } from "../work.js";

/** What stands side by side: a meaning, and its key by each standard. */
const SIDE_BY_SIDE = [
  ["sliding velocity", "sliding_velocity_m_s", "sliding_velocity_m_s", "sliding_velocity_m_s"],
  ["friction of the teeth", "mu_zm", "mu", "mu"],
  ["efficiency of the teeth, worm driving", "eta_z1_2", "eta", "eta"],
  ["efficiency of the teeth, wheel driving", "eta_z2_1", "eta_back", "eta_back"],
  ["efficiency of the gearbox", "eta_ges"],
  ["torque of the worm", "input_torque_Nm", "", "input_torque_Nm"],
  ["power lost between the teeth", "loss_meshing_W", "", "loss_meshing_W"],
  ["power put in", "input_power_W", "", "input_power_W"],
  ["torque of the wheel permitted", "", "M_permissible_Nm", "allowable_torque_Nm"],
];
/** What stands there instead where the load drives throughout. */
const LOAD_DRIVES = {
  eta_ges: ["efficiency of the gearbox, wheel driving", "eta_ges2_1"],
  input_torque_Nm: ["torque of the worm, if it drives", "input_torque_Nm", "", "input_torque_Nm"],
  loss_meshing_W: ["power lost between the teeth, wheel driving", "loss_meshing_back_W"],
  input_power_W: ["power put in at the wheel", "output_power_W", "", "output_power_W"],
};
/** Where a study's input is set, and its unit. */
const INPUTS = {
  pressure_angle: ["gearset.pressure_angle", "deg"], worm_speed: ["operation.worm_speed", "rpm"],
  worm_roughness: ["gearset.worm_roughness", "um"], diameter_factor: ["gearset.diameter_factor", ""],
  axial_module: ["gearset.axial_module", "mm"], centre_distance: ["gearset.centre_distance", "mm"],
};
const MACRO = ["centre_distance", "axial_module", "diameter_factor"];
/** Of the wheel, which a gearset is refused beyond. */
const MOST_SHIFT = 1;
const USUAL = "10";
/** Beyond so many times its size it is another gearset. */
const MOST_TIMES = 5;
/** Sizes that stand in the drawing. */
const SIZES = /^(?:\w+_mm|\w+_deg|starts|wheel_teeth|diameter_factor|profile_shift)$/;

const text = (value, unit) => `${Number(value.toPrecision(12))} ${unit}`.trim();
const keyOf = (name, unit) => (unit ? `${name}_${unit}` : name);

/** Texts that make a case this geometry with one size changed, the others staying. */
function resized(geometry, name, value) {
  const sizes = MACRO.map((key) => (key === name ? value : geometry[keyOf(key, INPUTS[key][1])]));
  const [a, m, q] = sizes;
  const texts = sizes.map((size, at) => [`gearset.${MACRO[at]}`, text(size, INPUTS[MACRO[at]][1])]);
  return { texts: Object.fromEntries(texts), shift: a / m - (q + geometry.wheel_teeth) / 2 };
}

/** Where a centre distance is no size of this shape: the module that makes it one, all else staying. */
function Fitting({ error, settings, geometry, setAll }) {
  const wanted = settings["gearset.centre_distance"];
  if (!wanted || !geometry || !error?.message.includes("profile shift")) return null;
  const module = (inUnit(wanted, "mm") / geometry.centre_distance_mm) * geometry.axial_module_mm;
  const fit = () => setAll({ "gearset.axial_module": `${Number(module.toPrecision(6))} mm` });
  return html`<p><button type="button" class="main" onClick=${fit}>
    the same shape at ${written(wanted)}: axial module ${amount(module, "mm")}</button></p>`;
}

/** Where the torque is lower than that through the travel: the latter in its usual part, or left out. */
function Travel({ error, setAll }) {
  const torque = useValue("operation.output_torque").text;
  const valve = useValue("operation.service").text === "valve";
  if (!/through_travel_torque/.test(error?.message ?? "")) return null;
  const [number, unit] = split(torque);
  const wanted = valve ? text(Number((number / 3).toPrecision(5)), unit) : torque;
  return Number.isNaN(number) ? null : html`<p><button type="button" class="main"
    onClick=${() => setAll({ "operation.through_travel_torque": wanted })}>
    ${valve ? "a third" : "all"} of it through the travel: ${written(wanted)}</button></p>`;
}

/** The ratio as the teeth have it; another one is a question for Size, with the torque and speed that are set. */
function Ratio() {
  const [teeth, starts, torque, speed] = ["gearset.wheel_teeth", "gearset.starts", "operation.output_torque",
    "operation.worm_speed"].map((path) => useValue(path).text);
  const ratio = Number(teeth) / Number(starts);
  // What is set may not be known yet, though an answer that ships is shown.
  const ask = (other) => torque && go("size", { ...caseParams(route.peek().params), ratio: ratioOf(other),
    output_torque: torque, worm_speed: speed }, false, true);
  return html`<div class="field"><label for="ratio">ratio</label>
    <${Box} id="ratio" text=${ratio > 0 && ratio < Infinity ? digits(ratio) : ""} onSet=${ask}
      describedby="ratio-says" />
    <p class="says" id="ratio-says">another ratio: gearsets that hold at this torque and speed are proposed</p></div>`;
}

function tried(sway, geometry, rise, setAll) {
  const at = sway.rises_percent.indexOf(Number(rise));
  return Object.entries(sway.inputs).map(([name, found]) => {
    const [path, unit] = INPUTS[name] ?? [];
    const value = found[keyOf(name, unit)][at];
    const efficiency = found.eta_z1_2[at];
    const { texts, shift } = MACRO.includes(name) ? resized(geometry, name, value)
      : { texts: { [path]: text(value, unit) }, shift: 0 };
    // What only the formulas can do, the others following it, is no gearset by itself.
    const alone = path && Math.abs(shift) <= MOST_SHIFT;
    const why = !path ? ", teeth are whole" : alone ? "" : `, which alone needs a profile shift of ${digits(shift, 2)}`;
    return {
      name, change: efficiency === null ? null : 100 * (efficiency - sway.eta_z1_2),
      says: printed(`${words(name)}${path ? ` to ${amount(value, unit)}` : ` +${rise} %`}${why}`),
      why: found.reason ?? "no answer", pick: alone ? () => setAll(texts) : undefined,
    };
  });
}

/** A drawing that the server made, with the sizes in it. */
function Drawing({ svg, geometry }) {
  const address = useAddress(useMemo(() => svg && new Blob([svg], { type: "image/svg+xml" }), [svg]));
  const sizes = Object.entries(geometry).filter(([key]) => SIZES.test(key));
  const columns = () => [0, 1].map((part) =>
    ({ label: ["size", "value"][part], values: sizes.map((each) => (part ? each[1] : each[0])) }));
  return html`<section class="panel"><h2>To scale</h2>
    ${address ? html`<img class="drawing" src=${address}
      alt="the gearset along the wheel's axis, to scale, with its main sizes" />
      <p class="says">Lengths in mm.</p>` : null}
    <${Beneath} title="To scale" svg=${() => svg} columns=${columns} /></section>`;
}

/** Texts that make keys so many times as great; null where the case says nothing of one of them. */
function more(keys, { tables }, settings, times) {
  const written = (path) => path.split(".").reduce((at, key) => at?.[key], tables);
  const texts = keys.map((path) => [path, split(settings[path] ?? written(path))]);
  return texts.some(([, [number]]) => Number.isNaN(number)) ? null
    : Object.fromEntries(texts.map(([path, [number, unit]]) =>
      [path, text(Number((times * number).toPrecision(6)), unit)]));
}

/** Which answers are missing and why, and what lies outside a standard's range. */
const standings = (standing) => Object.entries(standing).flatMap(([name, { word, unrated, outside, reasons }]) => [
  ...(unrated.length ? [`${STANDARDS[name]} has no answer for ${unrated.join(", ")}: ${reasons[0] ?? ""}`] : []),
  ...(word === "no answer" ? [`${STANDARDS[name]}: ${reasons[0] ?? ""}`] : []),
  ...(outside.length ? [`outside its range: ${STANDARDS[name]} (${outside.join(", ")})`] : []),
]);

/** What the command's last lines say: film, assumed, from memory, remarks. */
function notesOf({ assumed, verdict: { film, standing }, ...answer }, entries) {
  const found = Object.keys(STANDARDS).map((name) => [name, answer[name]]).filter(([, one]) => one);
  const [memory, count] = [found.filter(([, one]) => one.from_memory?.length),
    new Set(found.flatMap(([, one]) => one.from_memory ?? [])).size];
  const symbols = (name, keys) => keys.map((key) => entries[`${name}.${key}`]?.symbol || words(key)).join(", ");
  const keys = Object.entries(assumed);
  const said = new Set(Object.values(standing).flatMap(({ reasons }) => reasons));
  return [
    ...(film ? [`${film.regime} lubrication: film ${amount(film.thickness_um, "um", 2)}, lambda ${
      digits(film.lambda, 2)} (wheel as rough as the worm)`] : []),
    ...(keys.length ? [`${keys.length} assumed, give them to replace that: ${
      keys.map(([path, how]) => `${words(path.split(".")[1])} (${how})`).join("; ")}`] : []),
    ...(count ? [`${count} numbers rest on sources from memory, check before use: ${
      memory.map(([name, one]) => `${STANDARDS[name]} ${symbols(name, one.from_memory)}`).join("; ")}`] : []),
    ...found.flatMap(([name, one]) => one.notes.filter((each) => !/ fails: /.test(each) && !said.has(each))
      .map((each) => `${STANDARDS[name]}: ${each}`)),
    ...answer.notes ?? [],
  ];
}

/** The verdict in a sentence; where it fails, about how much larger it must be, with a button for it. */
function Headline({ verdict }) {
  const { first, safeties, holds, moved_by: levers } = verdict;
  const { name: opened, settings, setAll } = useCase();
  const file = useCaseFile(opened);
  const safety = safeties.find((each) => `${each.standard}.${each.key}` === first);
  const told = Object.values(holds).filter((ok) => ok !== null);
  const good = told.length > 0 && told.every(Boolean);
  if (!safety) return html`<p class="big"><${Verdict} ok=${told.length ? good : null} other="no answer" /></p>`;
  const { name, standard, value, asked } = safety;
  const size = levers.find((lever) => lever.name === "size");
  // As it is moved by one percent: about.
  const times = size?.exponent > 0 && value > 0 ? (asked / value) ** (1 / size.exponent) : NaN;
  const texts = file && times > 1 && times < MOST_TIMES && more(size.keys, file, settings, times);
  return html`<p class="big"><${Verdict} ok=${good} yes="it holds" no="it does not hold" />${safety.holds
      ? `: nearest to its limit is ${name} by ` : `: ${name} fails by `}${STANDARDS[standard]}, ${
      digits(value, 3)} of ${digits(asked, 3)} asked.</p>
    ${texts ? html`<p class="row"><span>It needs about <b>${digits(100 * (times - 1), 2)} %</b> more size.</span>
      <button type="button" onClick=${() => setAll(texts)}>do it</button></p>` : null}`;
}

function First({ verdict }) {
  const { first, safeties, moved_by: levers, alternatives } = verdict;
  const { name: opened, settings, setAll } = useCase();
  const file = useCaseFile(opened);
  const safety = safeties.find((each) => `${each.standard}.${each.key}` === first);
  if (!safety) return null;
  const rows = levers.map(({ name, keys, exponent }) => {
    const texts = file && more(keys, file, settings, 1.01);
    return { name, change: exponent, says: `1 % more ${name}`, pick: texts ? () => setAll(texts) : undefined };
  });
  return html`<section class="panel" aria-label="first to fail">
    <h2>${safety.holds ? "Nearest to its limit" : "First to fail"}</h2>
    <p class="big"><${Verdict} ok=${safety.holds} /> ${safety.name}, ${STANDARDS[safety.standard]}</p>
    <p>${symbol(safety.symbol)} is ${digits(safety.value, 3)} of ${digits(safety.asked, 3)} asked.</p>
    <h3>What moves it most</h3>
    <${Tornado} label="what moves it most" rows=${rows} unit="%" />
    ${alternatives.length ? html`<h3>Best listed instead</h3>
      <ul class="plain">${alternatives.map((other) => html`<li><button type="button" class="quiet"
        onClick=${() => setAll({ [other.key]: other.value })}>try ${other.value}</button>
        ${symbol(safety.symbol)} ${digits(other.safety, 3)}</li>`)}</ul>` : null}
  </section>`;
}

function Columns({ entries, answer }) {
  const names = Object.keys(STANDARDS);
  const { holds, standing } = answer.verdict;
  const back = answer.duty_cycle?.every((part) => part.load_drives);
  const rows = back ? SIDE_BY_SIDE.map((row) => LOAD_DRIVES[row[1]] ?? row) : SIDE_BY_SIDE;
  const held = entries["iso14521.eta_ges2_1"]?.value <= 0;
  const cell = (name, at) => ([what, ...keys]) => {
    const entry = entries[`${name}.${keys[at]}`];
    return what === "verdict" ? html`<${Verdict} ok=${holds[name]} other=${standing[name].word} />`
      : entry && !(held && /s2_1|_back_/.test(keys[at])) ? html`<${Num} entry=${entry} count=${4} />` : "–";
  };
  const columns = names.map((name, at) => [STANDARDS[name], cell(name, at), "right"])
    .filter((_, at) => answer[names[at]]);
  return html`<section class="panel wide"><h2>By three standards</h2>
    <${Table} region="three standards" wide="whole standards" rows=${[["verdict"], ...rows]}
      columns=${[["what", ([what]) => what, "row"], ...columns]} /></section>`;
}

function Locking({ locking: { verdicts, lead_angle_deg: lead } }) {
  const state = (wanted) => (name) => {
    const one = verdicts.find((each) => each.standard === name && each.state === wanted);
    return one ? `${digits(one.friction, 3)} ${one.locks ? "● locks" : "○ free"}` : "–";
  };
  const limit = (name) => digits(verdicts.find(({ standard }) => standard === name).limit, 3);
  return html`<section class="panel wide"><h2>Does it lock itself?</h2>
    <p>The lead angle is ${digits(lead, 4)}°; a worm locks where its friction is at least the limit, and is set
      free by a vibration that lowers it.</p>
    <${Table} rows=${[...new Set(verdicts.map(({ standard }) => standard))]} columns=${[
      ["friction of", (name) => STANDARDS[name] ?? name, "row"], ["at rest", state("static")],
      ["in motion", state("dynamic")], ["limit", limit, "right"]]} /></section>`;
}

function Efficiency({ sway, geometry, setAll }) {
  const rise = route.value.params.rise ?? USUAL;
  return html`<section class="panel wide"><h2>What moves the efficiency of the teeth</h2>
    <p class="choice"><label for="rise">each raised alone by</label>${" "}
      <select id="rise" value=${rise} onChange=${(event) => setParam("rise", event.target.value)}>
        ${sway.rises_percent.slice(1).map((each) => html`<option value=${String(each)}>${each} %</option>`)}
      </select></p>
    <${Tornado} label="what moves the efficiency" rows=${tried(sway, geometry, rise, setAll)} unit="points" />
  </section>`;
}

const bearings = () => import("../bearings.js");

export function view() {
  const { name, settings, setAll } = useCase();
  const body = name ? { case: name, settings } : null;
  const { data, error, busy, late, now } = useLive("rate", body, 60);
  const speed = inUnit(useValue("operation.worm_speed").text, "rad/s");
  const sway = useLive("sensitivity", body, 400).data?.answer;
  const answer = data?.answer;
  const entries = byKey(data?.entries);
  const safeties = answer?.verdict.safeties.map((each) => ({
    ...each, name: `${STANDARDS[each.standard]}: ${each.name}`, entry: entries[`${each.standard}.${each.key}`],
  }));
  return html`<${Screen} title="Gearset" kinds=${["gear", "drive"]} first="gearset-3"
      answer=${answer && { ...data, notes: notesOf(answer, entries) }} error=${error}
      busy=${busy} late=${late} now=${now}
      actions=${html`<${ReportOf} command="rate" body=${body} />`}
      lead="A worm gearset rated by three standards at once: whether it holds, what fails first, what moves it.">
    <${Travel} error=${error} setAll=${setAll} />
    <${Fitting} error=${error} settings=${settings} geometry=${answer?.geometry} setAll=${setAll} />
    <div class="columns headed moving">
      <div class="controls"><${Ratio} />
        <${Folded}><${Form} tables=${["operation", "gearset"]} brief=${true} />
          <${Later} load=${bearings} part="ShaftBearings" name=${name} /><//></div>
      <div class="headline said-first">${answer ? html`<${Headline} verdict=${answer.verdict} />` : null}</div>
      ${answer && speed ? html`<${Gears} geometry=${answer.geometry} speed=${speed} />` : null}
      ${answer ? html`<div class="pair shown">
        <section class="panel wide" aria-label="verdict"><h2>Does it hold?</h2>
          <p class="big">${Object.entries(answer.verdict.holds).map(([standard, ok]) => html`
            <span class="said" key=${standard}>${STANDARDS[standard]} <${Verdict} ok=${ok}
              other=${answer.verdict.standing[standard].word} /></span>`)}</p>
          ${standings(answer.verdict.standing).map((text) => html`<p class="says" key=${text}>${text}</p>`)}
          <${Margins} rows=${safeties} /></section>
        <${First} verdict=${answer.verdict} />
        <${Drawing} svg=${data.svg.gearset} geometry=${answer.geometry} />
        <${Columns} entries=${entries} answer=${answer} />
        ${sway ? html`<${Efficiency} sway=${sway} geometry=${answer.geometry} setAll=${setAll} />` : null}
        <${Locking} locking=${answer.self_locking} />
        <${AllNumbers} entries=${data.entries} />
        <${Later} load=${further} part="Further" of="gear" name=${name} settings=${settings} />
      </div>` : error ? null : html`<p class="wait shown">One moment.</p>`}
    </div>
  <//>`;
}
