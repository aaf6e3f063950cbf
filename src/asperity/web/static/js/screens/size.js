/** Gearsets for a ratio, a torque and a speed; and what efficiency a higher torque costs. */
import { html, useRef } from "../../vendor/preact.js";
import { call, useAsked, useCaseFile, useLive } from "../api.js";
import { STANDARDS, Verdict } from "../bars.js";
import { Box, Field, useValue, words } from "../form.js";
import { Plot } from "../plot.js";
import { ReportNow } from "../report.js";
import { Screen } from "../shell.js";
import { caseParams, fault, go, route, setParam, useCase } from "../state.js";
import { Table } from "../table.js";
import { useChecked } from "../taken.js";
import { digits, ratioOf, split } from "../units.js";
import { amount, headed, withUnitOf, written } from "../us.js";
import { Later, useJob, WorkPanel } from "../work.js";

/**
 * What is asked: its key, what it is called, what is asked where nothing is said, and what may be, as far as the
 * series goes.
 * @type {[string, string, string, object][]}
 */
const ASKED = [["ratio", "ratio", "15", { minimum: 4, maximum: 100 }],
  ["output_torque", "torque of the wheel", "300 N m", { unit: "N m", minimum: 0, open: true }],
  ["worm_speed", "speed of the worm", "1500 rpm", { unit: "rpm", minimum: 0, open: true }]];
/** @type {[string, string, number][]} */
const COLUMNS = [
  ["centre_distance_mm", "a (mm)", 5], ["starts", "z₁", 3], ["wheel_teeth", "z₂", 4],
  ["axial_module_mm", "m (mm)", 4], ["diameter_factor", "q", 4], ["profile_shift", "x₂", 3],
  ["efficiency", "efficiency (%)", 4], ["margin", "margin", 3], ["mass_kg", "mass (kg)", 3],
];
/** Shares of one, told in percent. */
const PERCENT = ["efficiency"];
/** Of what is kept beside the safeties; the ratio is asked above. */
const KEPT = ["ratio_tolerance", "self_locking", "locking_margin", "centre_distance", "wheel_diameter", "hobs",
  "safety"];
/** Tables of the case that go into what is asked. */
const ASKING = ["gearset", "operation", "rating", "requirements", "spectrum", "housing", "tolerances",
  "worm_shaft", "wheel_shaft", "bearings"];
/** What is set of a load spectrum. */
const LOADS = ["duty_class", "duty", "cycle", "hours_per_day", "shock"];
const RANKS = ["size", "efficiency", "margin"];
const THROUGH = "operation.through_travel_torque";
/** What is proposed, and what is asked: all else is as the case has it. */
const OWN = ["gearset.name", "gearset.starts", "gearset.wheel_teeth", "gearset.centre_distance",
  "gearset.axial_module", "gearset.diameter_factor", "gearset.profile_shift", "gearset.worm_pitch_diameter",
  "operation.output_torque", "operation.worm_speed", THROUGH];
/** Those of which less is better. */
const LESS = ["centre_distance_mm", "axial_module_mm", "starts", "wheel_teeth", "diameter_factor", "mass_kg"];
/** Of a design of the trade-off. */
const FREE = [["pressure_angle", "deg"], ["diameter_factor", ""], ["axial_module", "mm"], ["worm_roughness", "um"]];

/** The smallest of those that hold, in words. */
function smallest(proposals) {
  const [first] = proposals.filter(({ holds }) => holds)
    .toSorted((one, other) => one.centre_distance_mm - other.centre_distance_mm);
  return first ? `; the smallest is ${first.wheel_teeth}:${first.starts} with a = ${
    amount(first.centre_distance_mm, "mm")}` : "";
}

const limit = (path) => {
  const [standard, key] = path.split(".");
  if (!key) return path;
  return `${STANDARDS[standard]}: ${key.replace("safety_", "")}`;
};

/** Open the gearset with these settings besides. @param {Record<string, string>} settings */
function apply(settings) {
  const set = Object.entries(settings).map(([path, text]) => [`set.${path}`, text]);
  go("gear", { ...caseParams(route.peek().params), ...Object.fromEntries(set) }, false, true);
}

/** What a case and its settings say beside what is proposed, and its torque through the travel. */
function useRest() {
  const { name, settings } = useCase();
  const file = useCaseFile(name);
  if (!file) return {};
  const written = ASKING.flatMap((table) =>
    Object.entries(file.tables[table] ?? {}).map(([key, text]) => [`${table}.${key}`, text]));
  const all = { ...Object.fromEntries(written), ...settings };
  const kept = Object.entries(all).filter(([path]) => !OWN.includes(path) && path !== "requirements.ratio");
  // Of a valve a third of the rated torque stands through the travel, else all of it.
  const parts = /valve/.test(all["operation.service"] ?? "") ? 3 : 1;
  const loads = loadsOf(all);
  const turns = Number(all["gearset.wheel_teeth"]) / Number(all["gearset.starts"]);
  // What a case says of its loads belongs to its own torque and speed.
  const own = loads ? { ratio: turns ? digits(turns, 5) : undefined, output_torque: all["operation.output_torque"],
    worm_speed: all["operation.worm_speed"] } : {};
  const asked = { ...own, ...(all["requirements.ratio"] && { ratio: all["requirements.ratio"] }) };
  return { rest: Object.fromEntries(kept), asked, through: all[THROUGH], parts, loads };
}

/** The load spectrum in words; "" without one. @param {Record<string, string>} all */
function loadsOf(all) {
  const { "spectrum.step": steps = "", "spectrum.duty_class": ofClass } = all;
  if (!steps) return ofClass ?? "";
  const count = stepsOf(steps).split(";").filter((each) => each.trim()).length;
  return `${count} ${count === 1 ? "step" : "steps"}${all["spectrum.duty"] ? `, ${all["spectrum.duty"]}` : ""}`;
}

function Proposals({ found, options, through, parts }) {
  const [by, way] = (route.value.params.sort ?? "").split(" ");
  const sorted = by ? found.toSorted((a, b) => (way === "down" ? b[by] - a[by] : a[by] - b[by])) : found;
  const sort = (key) => {
    const first = LESS.includes(key) ? "up" : "down";
    const other = first === "up" ? "down" : "up";
    setParam("sort", `${key} ${by === key && way === first ? other : first}`);
  };
  const [torque, unit] = split(options.output_torque);
  const take = (one) => apply({
    ...Object.fromEntries(one.settings.map((text) => text.split(/=(.*)/).slice(0, 2))),
    "operation.output_torque": options.output_torque, "operation.worm_speed": options.worm_speed,
    // Not the name of what it was before.
    "gearset.name": `${one.wheel_teeth}:${one.starts}, a ${digits(one.centre_distance_mm, 5)} mm`,
    // That of the case goes with another torque.
    ...(through && { [THROUGH]: parts === 1 ? options.output_torque : `${digits(torque / parts)} ${unit}` }),
  });
  const open = (one) => html`<button type="button" onClick=${() => take(one)} aria-label=${`take
    a = ${amount(one.centre_distance_mm, "mm", 12)}, ${one.wheel_teeth}:${one.starts}, m = ${
    amount(one.axial_module_mm, "mm", 12)}`}>take</button>`;
  return html`<${Table} region="proposals" wide="whole proposals cards" kind="middle" rows=${sorted} columns=${[
    ["open", open, "taking"], ["verdict", (one) => html`<${Verdict} ok=${one.holds} />`],
    ...COLUMNS.map(([key, said, count]) => ({ key, count, ...headed(said) })).map(({ key, count, head, of }) => [
      html`<button type="button" class="quiet" onClick=${() => sort(key)}>
        ${head}${by === key ? (way === "up" ? " ▲" : " ▼") : ""}</button>`,
      (one) => digits((PERCENT.includes(key) ? 100 : 1) * of(one[key]), count), "right",
      { "aria-sort": by === key ? `${way === "up" ? "a" : "de"}scending` : "none", "data-head": head },
    ]),
    ...(found.some(({ hob }) => hob) ? [["hob", ({ hob }) => hob]] : []),
    ["least safety", (one) => limit(one.limited_by)], ["locks itself", ({ locks }) => locks],
  ]} />`;
}

/** The settings of a design of the trade-off, with digits enough to be it. */
const settingsOf = (design, at) => Object.fromEntries(FREE.map(([key, unit]) => {
  const found = design[unit ? `${key}_${unit}` : key];
  return [`gearset.${key}`, `${Number((at === undefined ? found : found[at]).toPrecision(12))} ${unit}`.trim()];
}));

/** What fails of gearsets that a case becomes by settings, each rated; null until they are. */
function useVerdicts(designs) {
  const { name, settings } = useCase();
  const bodies = designs.map((one) => ({ case: name, settings: { ...settings, ...one } }));
  return useAsked(JSON.stringify(bodies), async (leave) => {
    const found = [];
    for (const body of bodies) {
      const { answer } = await call("rate", body, leave);
      found.push(answer.verdict.safeties.filter(({ holds }) => !holds));
    }
    return found;
  }).found;
}

function TradeOff({ answer }) {
  const { trade_off: curve, given, made } = answer;
  const torques = curve.M_permissible_Nm;
  const designs = [
    { says: "as it is", of: given, settings: {} },
    { says: "rounded optimum", of: made, settings: settingsOf(made) },
    ...torques.map((torque, at) => (
      { says: "on the curve", torque, efficiency: curve.eta_z1_2[at], settings: settingsOf(curve, at) })),
  ].map((one) => ({ torque: one.of?.bs721.M_permissible_Nm, efficiency: one.of?.iso14521.eta_z1_2, ...one }));
  const failing = useVerdicts(designs.map(({ settings }) => settings));
  const verdict = (_, at) => {
    if (!failing) return "…";
    const names = failing[at].map(({ standard, name }) => `${STANDARDS[standard]}: ${name}`);
    return html`<${Verdict} ok=${!names.length} /> <span class="says">${names.join(", ")}</span>`;
  };
  const single = ({ says, torque, efficiency }, colour) => ({
    label: says, unit: "%", x: [torque], values: [100 * efficiency], points: "square", bare: true, colour,
  });
  const pick = (x) => {
    const far = (at) => Math.abs(torques[at] - x);
    apply(settingsOf(curve, torques.reduce((best, _, at) => (far(at) < far(best) ? at : best), 0)));
  };
  const permitted = headed("permissible torque (N m)");
  const take = ({ says, torque, settings }) => html`<button type="button" onClick=${() => apply(settings)}
    aria-label=${`take ${says}, ${amount(torque, "N m")}`}>take</button>`;
  return html`<${Plot} title="Efficiency of the teeth against permissible torque" y="of the teeth (%)"
      onPick=${pick} height=${320}
      x=${{ label: "permissible torque by BS 721", unit: "N m", values: torques }}
      series=${[
        { label: "most efficient designs", unit: "%", values: curve.eta_z1_2.map((eta) => 100 * eta), points: "round" },
        single(designs[0], 1), single(designs[1], 2)]} />
    <p class="says to-press">A click on the curve opens that gearset.</p>
    <${Table} region="designs" wide="whole designs cards" kind="middle" rows=${designs} columns=${[
      ["open", take, "taking"], ["design", ({ says }) => says],
      [permitted.head, ({ torque }) => digits(permitted.of(torque), 4), "right"],
      ["efficiency of the teeth (%)", ({ efficiency }) => digits(100 * efficiency, 4), "right"], ["verdict", verdict],
    ]} />`;
}

/** Steps as one types them, also where a file has them as a list of tables. @param {string} text */
function stepsOf(text) {
  if (!text.startsWith("[")) return text;
  return [...text.matchAll(/\{([^}]*)\}/g)].map(([, step]) =>
    [...step.matchAll(/= *("?)([^",]*)\1/g)].map(([, , value]) => value.trim()).join(", ")).join("; ");
}

/** The loads of its life, folded away while there is one only. @param {{loads: string}} props */
function Loads({ loads }) {
  const { set, unset } = useCase();
  const { text } = useValue("spectrum.step");
  const put = (typed) => (typed ? set("spectrum.step", typed) : unset("spectrum.step"));
  return html`<details class="to-press"><summary>load spectrum: ${
      loads || "none, the torque above all of its life"}</summary>
    <label class="asked steps">steps of the whole life, as 250 N m, 1400 rpm, 500 h; 60 N m, 700 rpm, 3000 h
      <${Box} text=${stepsOf(text)} label="steps" onSet=${put} /></label>
    <div class="grid keeps">${LOADS.map((key) => html`<${Field} key=${key} path=${`spectrum.${key}`} />`)}</div>
    </details>`;
}

/** What a gearset must keep beside its safeties, folded away while nothing is asked. */
function Kept({ rest }) {
  const said = KEPT.map((key) => [key, rest?.[`requirements.${key}`]]).filter(([, text]) => text !== undefined);
  return html`<details class="to-press">
    <summary>what must be kept${said.length ? ": " : ""}${
      said.map(([key, text]) => `${words(key)} ${text}`).join(", ")}</summary>
    <div class="grid keeps">${KEPT.map((key) => html`<${Field} key=${key} path=${`requirements.${key}`} />`)}</div>
    </details>`;
}

const bearings = () => import("../bearings.js");

/** What gives the screen again. */
const again = (file) => `The command gives the proposals again, by itself. Save the case as ${file}, and asperity \
optimise ${file} finds what a higher torque costs.`;

export function view() {
  const { name, settings } = useCase();
  const { params } = route.value;
  const { rest, asked, through, parts, loads } = useRest();
  const others = Object.fromEntries(ASKED.map(([key, said, most, bounds]) => {
    const usual = asked?.[key] || most;
    const put = (text) => setParam(key, text);
    const own = params[key] || usual;
    const text = key === "ratio" ? ratioOf(own) : own;
    return [key, { said, usual, put, text, field: { ...bounds, example: usual } }];
  }));
  const options = Object.fromEntries(Object.entries(others).map(([key, { text }]) => [key, text]));
  const rank = params.rank ?? "size";
  const sized = useLive("size", rest && { settings: rest, options: { ...options, rank } }, 200);
  // What stands there is of what was asked last, as long as the next is not answered.
  const last = useRef(options);
  if (sized.now) last.current = options;
  const of = last.current;
  const body = name ? { case: name, settings } : null;
  const write = rest && (() => call("size", { settings: rest, options: { ...options, rank }, report: true }));
  const work = useJob("optimise", body);
  const { toml, error: wrong, now } = useChecked(body);
  const answer = sized.data?.answer;
  return html`<${Screen} title="Size and trade-off" kinds=${["gear", "drive"]} first="gearset-3"
      answer=${{ toml, ...sized.data, again }} error=${sized.error ?? wrong ?? work.error} busy=${sized.busy}
      now=${sized.now && now} others=${others}
      actions=${html`<${ReportNow} ask=${write} />`}
      lead="Gearsets of the standard series that hold, and what efficiency a higher torque costs.">
    ${answer ? html`<p class="big"><b>${answer.holding}</b> of ${answer.rated} gearsets hold ${
      written(of.output_torque)} at ${of.ratio}:1 and ${of.worm_speed} by every standard${
      smallest(answer.proposals)}.</p>` : null}
    <section class="panel" aria-label="what is asked"><div class="row asks-for">
      ${Object.entries(others).map(([key, { said, text, usual, put }]) => html`<label class="asked">${said}
        <${Box} text=${written(options[key])} label=${said} invalid=${fault.value.startsWith(`${key} is `)}
          onSet=${(typed) => put(withUnitOf(typed, Number.isNaN(split(text)[0]) ? usual : text))} /></label>`)}
      <span class="asked"><label for="rank">best in</label>
        <select id="rank" value=${rank} onChange=${(event) => setParam("rank", event.target.value)}>
          ${RANKS.map((each) => html`<option value=${each}>${each}</option>`)}</select></span>
      </div>
      <${Loads} loads=${loads} /><${Kept} rest=${rest} />
      <div class="to-press"><${Later} load=${bearings} part="ShaftBearings" name=${name} /></div>
      ${answer ? html`<p class="says">Shown are those that no other beats in size, efficiency (of the gearbox)
          and margin. Oil, materials, roughness and life are the case's${loads
          ? html`, and so are its loads (${loads}), which
          wear, pitting and heat are judged by; strength is by the torque above` : null}${through
          ? html`; its torque through the travel, ${written(through)}, is not, since it goes with another torque: ${
          parts === 3 ? "a third" : "all"} of the torque above is taken, as where none is given` : null}.</p>
        <${Proposals} found=${answer.proposals} options=${of} through=${through} parts=${parts} />`
        : sized.error ? null : html`<p class="wait">One moment.</p>`}
    </section>
    <${WorkPanel} title=${`What a higher torque costs ${name}`} name="trade-off" work=${work}
      label="find the most efficient designs" says="Of the gearset of the case as it is, with its own torque and
      speed, not of what is asked or proposed above. Pressure angle, diameter factor, module and roughness are free;
      every safety that holds goes on to hold, and what fails may go on to fail. Some seconds.">
      ${work.data ? html`<${TradeOff} answer=${work.data.answer} />` : null}<//>
  <//>`;
}
