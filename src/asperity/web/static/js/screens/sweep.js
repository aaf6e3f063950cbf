/** A case over a grid: axes, how long it takes, a map that fills, and the file of it. */
import { html, useEffect, useState } from "../../vendor/preact.js";
import { axisOf, MOST, over, refusedEnd, textOf } from "../axes.js";
import { commandLine, forms, get, useCaseFile, useLive } from "../api.js";
import { AllKeys, Box, fieldOf, words } from "../form.js";
import { Heat } from "../heat.js";
import { Plot } from "../plot.js";
import { Report } from "../report.js";
import { Screen } from "../shell.js";
import { fault, route, setParam, useCase } from "../state.js";
import { inWords, plain, printed } from "../symbols.js";
import { digits, split } from "../units.js";
import { amount, withUnitOf, written } from "../us.js";
import { dataOf, Files, lasting, useJob, Work } from "../work.js";

const SLIDE = { tables: ["slider", "friction", "vibration", "normal"], rest: ["solve"], verb: "slide", shown: "ratio",
  start: { "solve.method": "periodic" },
  axes: ["vibration.velocity_ratio~0.5~20~21~log", "vibration.direction~0 deg~90 deg~19~even"] };
const GEAR = { tables: ["gearset", "operation"], rest: ["rating"], verb: "rate", shown: "efficiency",
  start: {}, axes: ["operation.output_torque~50~500~10~even", ""] };
/** How often a map that fills is looked at, ms. */
const LOOK = 1000;
/** Of a point that takes longer than a page waits: no mistake of the case, whose grid is a job. */
const SLOW = 504;
/** The least that a point of many takes, s. */
const LEAST = 5e-4;
/** The variable that says which points have settled. */
const SETTLED = "settled";
export function view() {
  const { name, settings } = useCase();
  const { params } = route.value;
  const file = useCaseFile(name);
  const kind = file && "gearset" in file.tables ? GEAR : SLIDE;
  const texts = ["x", "y"].map((key, place) => params[key] ?? kind.axes[place]);
  const axes = texts.flatMap((text) => axisOf(text) ?? []);
  const points = axes.reduce((product, { count }) => product * count, 1);
  const [wrong] = ["x", "y"].flatMap((key, place) => [axisOf(texts[place]) ?? []].flat()
    .flatMap((axis) => refusals(axis).map(([what, why]) => ({ key, axis, what, why }))));
  const refused = wrong && { message: `${saidOf(wrong)}: ${wrong.why}`, of: `${wrong.key}.${wrong.what}` };
  const others = Object.fromEntries(["x", "y"].flatMap((key, place) => endsOf(key, axisOf(texts[place]))));
  const body = name && axes.length && !wrong ? { case: name, settings, options: { over: axes.map(over) } } : null;
  const work = useJob("sweep", body);
  // One point is solved at once: it refuses what cannot be, and tells how long the others take.
  const one = useLive(kind.verb, name ? { case: name, settings } : null, 300);
  const each = one.error ? null : one.data?.answer.seconds;
  const time = each ? `about ${lasting(points * Math.max(each, LEAST))} to solve on one core`
    : one.busy ? "time being found" : "time not known";
  const found = useSoFar(work);
  const running = work.job?.state === "running";
  return html`<${Screen} title="Sweep" kinds=${["slide", "gear"]} first="body-shaken-along" start=${SLIDE.start}
    lead="A case at every point of a grid. What is solved is kept: stop when you like, and go on later."
    answer=${{ toml: one.data?.toml, ...(work.stale ? null : work.data), notes: running ? work.job.notes : [],
      command: body && commandLine("sweep", body) }}
    actions=${html`<${Report} work=${work} />`}
    error=${refused ?? work.error ?? (one.error?.status === SLOW ? null : one.error)} busy=${one.busy}
    now=${one.now && !refused} others=${others}>
    <div class="columns answer-first">
      <section class="controls" aria-label="the grid">
        ${["x", "y"].map((key, place) => html`<${AxisForm} key=${key} name=${key} tables=${kind.tables}
          label=${place ? "second axis" : "first axis"} axis=${axisOf(texts[place])} file=${file} />`)}
        <p role="status">${wrong ? "–" : html`<b>${points}</b> ${points === 1 ? "point" : "points"}, ${time}`}</p>
        <${Work} work=${work} label="solve the grid" />
        <${AllKeys} tables=${[...kind.tables, ...kind.rest]} brief />
      </section>
      <section class="shown" aria-label="what is found">
        ${found.names.length ? null : html`<p class="says">${running || work.asking
            ? "The first points are being solved."
            : "Nothing is solved yet: choose the axes and begin."}</p>`}
        ${found.data ? html`<${Found} ...${found} />` : null}
        <${Files} job=${work.job} />
      </section>
    </div>
  <//>`;
}

/** What of an axis is refused, and why. @returns {[string, string][]} */
const refusals = (axis) => /** @type {[string, string][]} */ ([["from", refusedEnd(axis, "from")],
  ["to", refusedEnd(axis, "to")],
  ["points", axis.count ? "" : `${JSON.stringify(axis.points)}; it must be a whole number from 1 to ${MOST}`],
]).filter(([, why]) => why);

/** What is refused of an axis, in words. */
const saidOf = ({ what, axis }) => `${what} of ${words(axis.path.split(".")[1])}`;
const COUNT = { example: "11", minimum: 1, maximum: MOST };

/** What of an axis may be refused, as a screen tells of it. @returns {[string, import("../shell.js").Other][]} */
const endsOf = (key, axis) => (axis ? ["from", "to", "points"].map((what) => [`${key}.${what}`, {
  said: saidOf({ what, axis }), text: axis[what] ?? "", field: what === "points" ? COUNT : fieldOf(axis.path) ?? {},
  put: (text) => setParam(key, textOf({ ...axis, [what]: text })),
}]) : []);

function AxisForm({ name, label, axis, tables, file }) {
  const change = (more) => setParam(name, textOf({ ...axis, ...more }));
  const choose = (path) => {
    if (!path) return setParam(name, "none");
    const field = fieldOf(path);
    const [table, key] = path.split(".");
    const [found, unit] = split(file?.tables[table]?.[key] ?? (field.default || field.example));
    const value = found || 1;
    const has = unit || field.unit ? ` ${unit || field.unit}` : "";
    const ends = path === "vibration.direction" ? [0, 90] : [value / 2, value * 2];
    const [from, to] = ends.map((end) => `${digits(end)}${has}`);
    setParam(name, textOf({ path, from, to, points: "11", spacing: field.log ? "log" : "even" }));
  };
  const numeric = ({ kind }) => ["quantity", "number", "integer"].includes(kind);
  // A bare number has the unit of an end that is not refused.
  const right = (...ends) => axis[ends.find((end) => !refusedEnd(axis, end)) ?? ""] ?? fieldOf(axis.path)?.example;
  const boxes = axis ? [
    ["from", written(axis.from), (from) => change({ from: withUnitOf(from, right("from", "to")) })],
    ["to", written(axis.to), (to) => change({ to: withUnitOf(to, right("to", "from")) })],
    ["points", axis.points, (points) => change({ points })]] : [];
  const why = Object.fromEntries(axis ? refusals(axis) : []);
  // What only the server knows to be wrong names its key.
  const all = axis && fault.value.includes(`${axis.path} `);
  return html`<fieldset><legend>${label}</legend>
    <div class="field"><label for=${`${name}-path`}>key</label>
      <select id=${`${name}-path`} value=${axis?.path ?? ""} onChange=${(event) => choose(event.target.value)}>
        ${name === "y" ? html`<option value="">none</option>` : null}
        ${tables.filter((table) => forms.value?.[table]).map((table) => html`<optgroup label=${table}>
          ${forms.value[table].keys.filter(numeric).map(({ key }) =>
            html`<option value=${`${table}.${key}`}>${words(key)}</option>`)}
        </optgroup>`)}
      </select></div>
    ${boxes.map(([what, text, put]) => html`<div class="field" key=${what}>
      <label for=${`${name}-${what}`}>${what}</label>
      <${Box} id=${`${name}-${what}`} text=${text} onSet=${put}
        invalid=${what in why || (all && what !== "points")}
        describedby=${what in why ? `${name}-${what}-why` : undefined} />
      ${what in why ? html`<p class="says bad" id=${`${name}-${what}-why`}>✗ ${why[what]}</p>` : null}
      ${what === "points" && !(what in why)
        ? html`<p class="says">a whole number from 1 to ${MOST}</p>` : null}</div>`)}
    ${axis ? html`<div class="field"><label for=${`${name}-spacing`}>spacing</label>
      <select id=${`${name}-spacing`} value=${axis.spacing}
        onChange=${(event) => change({ spacing: event.target.value })}>
        <option value="even">even steps</option><option value="log">even ratios</option></select></div>` : null}
  </fieldset>`;
}

/** Variables of a file over all its axes, by key, with what is said of each. */
function overAll(listed) {
  const dims = Math.max(...Object.values(listed).map((one) => one.dims.length));
  return Object.entries(listed).filter(([, one]) => one.dims.length === dims)
    .map(([key, one]) => [key, one.long_name || words(key)]);
}

/** What is solved so far of what is shown; looked at again while the job runs, and until it is seen. */
function useSoFar({ id: own, from, job }) {
  const id = own || from;
  const [known, setKnown] = useState({ id: "", names: [], data: null });
  const [look, setLook] = useState(0);
  const wanted = route.value.params.shown;
  const state = job?.done || job?.state === "done" ? job.state : "";
  useEffect(() => {
    if (!id || !state) return;
    const leave = new AbortController();
    let timer = 0;
    const again = () => (timer = setTimeout(() => setLook((old) => old + 1), LOOK));
    (async () => {
      const names = overAll(await get(dataOf(id), leave));
      const name = [wanted, SLIDE.shown, GEAR.shown, names[0]?.[0]].find((each) => names.some(([key]) => key === each));
      const wants = names.some(([key]) => key === SETTLED) ? `${name},${SETTLED}` : name;
      setKnown({ id, names, name, data: await get(dataOf(id, wants.split(",")), leave) });
      if (state === "running") again();
    })().catch((error) => error.name === "AbortError" || again());
    return () => {
      leave.abort();
      clearTimeout(timer);
    };
  }, [id, state, wanted, look]);
  return known.id === id ? known : { names: [], data: null };
}

const plainUnit = (unit) => (unit === "1" ? "" : (unit ?? ""));

/** Where the least is, in a sentence; of what has settled. */
function Least({ title, unit, values, loose, axes }) {
  const known = values.map((value, at) => [value, at]).filter(([value, at]) => value !== null && !loose[at]);
  if (!known.length) return null;
  const [value, at] = known.reduce((best, one) => (one[0] < best[0] ? one : best));
  const count = axes.at(-1).values.length;
  const places = axes.length > 1 ? [Math.floor(at / count), at % count] : [at];
  const where = axes.map(({ label, unit: of, values: all }, k) =>
    printed(`${label} ${amount(all[places[k]], of)}`));
  return html`<p class="big"><span class="says">${inWords(title)}</span><br />Least: <b>${
    amount(value, unit, 3)}</b> at ${where.join(", ")}</p>`;
}

/** What is shown of all that was solved. */
const Choice = ({ name, names }) => html`<p class="row"><label for="variable">shown</label>
  <select id="variable" value=${name} onChange=${(event) => setParam("shown", event.target.value)}>
    ${names.map(([key, meaning]) => html`<option value=${key}>${plain(meaning)}</option>`)}</select></p>`;

function Found({ name, names, data }) {
  const { dims, values, units } = data[name];
  const title = names.find(([key]) => key === name)[1];
  const [down, across] = dims.map((dim) =>
    ({ label: words(dim), unit: plainUnit(data[dim]?.units), values: data[dim]?.values ?? [] }));
  const loose = values.map((value, at) => value !== null && data[SETTLED]?.values[at] === 0);
  const count = loose.filter(Boolean).length;
  const says = count ? html`<p role="status">${count} of ${values.length} points${" "}
    ${count === 1 ? "has" : "have"} not settled: no prediction.</p>` : null;
  const marks = count ? [{ label: "not settled", unit: plainUnit(units), points: "square",
    bare: true, values: values.map((value, at) => (loose[at] ? value : null)), colour: 6 }] : [];
  const least = html`<${Least} title=${title} unit=${plainUnit(units)} values=${values} loose=${loose}
    axes=${[down, across].filter(Boolean)} /><${Choice} name=${name} names=${names} />`;
  return across ? html`${least}${says}<${Heat} title=${title} unit=${plainUnit(units)} down=${down} across=${across}
      values=${values} />`
    : html`${least}${says}<${Plot} title=${title} x=${down} height=${340}
      series=${[{ label: title, unit: plainUnit(units), values, points: "round" }, ...marks]} />`;
}
