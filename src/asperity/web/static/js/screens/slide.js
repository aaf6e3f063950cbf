/** A sliding body: shake it, and see the force that still pulls it fall. */
import { html, useEffect, useMemo, useState } from "../../vendor/preact.js";
import { call, useLive } from "../api.js";
import { AllKeys, Amplitude, Field, Folded, Slider, useValue, words } from "../form.js";
import { AllNumbers, byKey, Num } from "../number.js";
import { Plot } from "../plot.js";
import { ReportOf } from "../report.js";
import { Screen } from "../shell.js";
import { moment, Stage } from "../stage.js";
import { route, setParam, useCase } from "../state.js";
import { digits, inUnit } from "../units.js";
import { readable, written } from "../us.js";
import { further, Later } from "../work.js";

const START = { "solve.method": "periodic" };
/** How long nothing must change before a curve is asked, ms. */
const REST = 120;
const MOST_PINS = 4;
const CLOSED = "rigid friction on a rigid drive, closed form";
const OVER = {
  direction: { label: "direction", unit: "deg", words: "direction" },
  k: { label: "velocity ratio k", unit: "", words: "strength" },
  elevation: { label: "elevation", unit: "deg", words: "elevation", normal: true },
  phase: { label: "phase of the normal part", unit: "deg", words: "phase", normal: true },
};
/** Angles that a curve goes over: their keys, and the angle of what is set. */
const ANGLES = {
  // A body that is shaken from behind is shaken as from before.
  direction: ["vibration.direction",
    (angle) => (Math.acos(Math.abs(Math.cos((angle * Math.PI) / 180))) * 180) / Math.PI],
  elevation: ["vibration.elevation", (angle) => angle], phase: ["vibration.normal_phase", (angle) => angle],
};
/** So much less must be left elsewhere on a curve for it to be worth a word. */
const WORTH = 0.01;

/** Bounds of the amplitude's slider by its form. */
const BOUNDS = {
  velocity_ratio: { low: 0.1, high: 100, unit: "" }, velocity_amplitude: { low: 0.01, high: 1000, unit: "mm/s" },
  displacement_amplitude: { low: 0.001, high: 100, unit: "um" },
};

/** @type {Record<string, [string, object][]>} */
const GROUPS = {
  body: [
    ["slider.drive_velocity", { low: 0.01, high: 100, unit: "mm/s", log: true }],
    ["slider.normal_force", { low: 0.1, high: 1000, unit: "N", log: true }],
    ["slider.mass", { low: 0.001, high: 100, unit: "kg", log: true }],
    ["slider.drive_stiffness", { low: 1e3, high: 1e8, unit: "N/m", log: true }],
  ],
  contact: [
    ["friction.mu", { label: "friction coefficient", low: 0.01, high: 1, log: true }],
    ["friction.max_deflection", { label: "deflection before slip", low: 1, high: 1e5, unit: "nm", log: true }],
    ["friction.transfer", { label: "transfer across", low: 0, high: 1, step: 0.01, log: false }],
    ["normal.stiffness", { label: "normal stiffness", low: 0.1, high: 1e4, unit: "MN/m", log: true }],
  ],
};

const flow = () => import("../flow.js");

export function view() {
  const { name, settings } = useCase();
  const point = useLive("slide", name ? { case: name, settings } : null);
  const numbers = byKey(point.data?.entries);
  const answer = point.data?.answer ?? {};
  const drawn = useMemo(() => html`<div class="grid">
    <${Waves} series=${point.data?.series} />
    <${Later} load=${flow} part="Flow" numbers=${numbers} /></div>`, [point.data]);
  return html`<${Screen} title="Sliding body"
    lead="Shake what a body slides on, and less force pulls it. Drag a slider; every number opens where it comes from."
    kinds=${["slide"]} first="body-shaken-along" start=${START}
    actions=${html`<${ReportOf} command="slide" body=${name ? { case: name, settings } : null} />`}
    answer=${point.data} error=${point.error} busy=${point.busy} late=${point.late} now=${point.now}>
    <div class="columns headed moving">
      <section class="controls" aria-label="what is set"><${Folded}>
        <${Strength} k=${answer.velocity_ratio} />
        <${Direction} />
        <${Known} path="vibration.frequency" low=${0.01} high=${100} unit="kHz" log />
        <${Field} path="vibration.waveform" brief />
        ${Object.entries(GROUPS).map(([title, sliders]) => html`<fieldset key=${title}>
          <legend>${title}</legend>
          ${title === "contact" ? html`<${Field} path="friction.model" label="friction law" brief />` : null}
          ${sliders.map(([path, more]) => html`<${Known} key=${path} path=${path} ...${more} />`)}
        </fieldset>`)}
        <${AllKeys} tables=${["slider", "friction", "vibration", "normal", "wear", "solve"]} /><//>
      </section>
      <${Headline} numbers=${numbers} />
      <${Stage} series=${point.data?.series} ratio=${answer.ratio} k=${answer.velocity_ratio}
        limit=${answer.static_drive_force_N} refused=${/n\.(dir|elev)/.test(point.error?.message)} now=${point.now} />
      <section class="shown" aria-label="what comes of it">
        <${Curves} k=${answer.velocity_ratio} ratio=${answer.ratio} failed=${Boolean(point.error)} />
        ${drawn}
        ${point.data ? html`<${AllNumbers} entries=${point.data.entries} />
          <${Later} load=${further} part="Further" of="slide" name=${name} settings=${settings} />` : null}
      </section>
    </div>
  <//>`;
}

/** A slider where the case says something of its key. */
function Known({ path, ...more }) {
  const { text } = useValue(path);
  return text ? html`<${Slider} path=${path} ...${more} />` : null;
}

function Direction() {
  const { text } = useValue("vibration.elevation");
  // Also of what is refused: it is mended where it was typed.
  const elevated = Boolean(text) && inUnit(text, "deg") !== 0;
  return html`
    <${Known} path="vibration.direction" low=${0} high=${elevated ? 180 : 90} step=${1} unit="deg" log=${false} />
    ${elevated ? html`
      <${Known} path="vibration.elevation" low=${0} high=${180} step=${1} unit="deg" log=${false} />
      <${Known} path="vibration.normal_phase" low=${-180} high=${180} step=${1} unit="deg" log=${false} />` : null}`;
}

/** How strong the vibration is, in the form that the case says it, or another. */
function Strength({ k }) {
  const { set } = useCase();
  const forms = Object.keys(BOUNDS);
  const texts = forms.map((key) => useValue(`vibration.${key}`).text);
  const drive = inUnit(useValue("slider.drive_velocity").text, "m/s");
  const frequency = inUnit(useValue("vibration.frequency").text, "Hz");
  const turn = { sine: 2 * Math.PI, triangle: 4 }[useValue("vibration.waveform").text];
  const key = forms[texts.findIndex(Boolean)];
  if (!key) return null;
  const inForm = {
    velocity_ratio: () => digits(k, 6),
    velocity_amplitude: () => `${digits(k * drive * 1e3, 6)} mm/s`,
    displacement_amplitude: () => `${digits((k * drive * 1e6) / (turn * frequency), 6)} um`,
  };
  const can = forms.filter((each) => turn || each !== "displacement_amplitude");
  return html`<${Amplitude} bounds=${BOUNDS} />
    <div class="field"><label for="form">strength given as</label>
      <select id="form" value=${key} disabled=${!k}
        onChange=${(event) => set(`vibration.${event.target.value}`, inForm[event.target.value]())}>
        ${can.map((each) => html`<option value=${each}>${words(each)}</option>`)}
      </select></div>`;
}

function Headline({ numbers }) {
  const ratio = numbers.ratio?.value;
  if (ratio === undefined) return html`<div class="headline"><p class="large">…</p></div>`;
  const loose = numbers.settled?.value === false;
  const says = loose ? `Not settled, no prediction: ${numbers.settled_by.value}.`
    : ratio < 0 ? "The vibration drives the body forward; the drive holds it back."
    : ratio > 0.9995 ? "The vibration takes nothing off the force."
    : `of the force without vibration is left: ${digits(100 * (1 - ratio), 3)} % less.`;
  const [shaken, still] = ["drive_force_N", "static_drive_force_N"]
    .map((key) => readable(numbers[key].value, "N").join(" "));
  const entry = { ...numbers.ratio, equation: `${numbers.ratio.symbol} = ${shaken} / ${still}` };
  return html`<div class="headline">
    <p class="large">${loose ? "(" : null}<${Num} entry=${entry} count=${4} />${loose ? ")" : null}</p>
    <p><span role="status">${says}</span><br />
      <${Num} entry=${numbers.drive_force_N} label /> of
      ${" "}<${Num} entry=${numbers.static_drive_force_N} />${" "}
      at k = <${Num} entry=${numbers.velocity_ratio} count=${4} /></p>
  </div>`;
}

const pinned = () => JSON.parse(route.value.params.pins ?? "[]");
const put = (pins) => setParam("pins", pins.length ? JSON.stringify(pins) : "");

/** Keys of what a curve goes over. */
const OWN = {
  ...Object.fromEntries(Object.entries(ANGLES).map(([key, [path]]) => [key, [path]])),
  k: Object.keys(BOUNDS).map((key) => `vibration.${key}`),
};

/** What a curve follows from: not from where on it the body is. */
function curveBody({ name, settings }, over, k) {
  const own = OWN[over];
  const kept = Object.entries(settings).filter(([path]) => !own.includes(path));
  // A curve goes to twice the strength; it is asked again only when that doubles.
  const reach = 5 * 2 ** Math.max(0, Math.ceil(Math.log2((k || 1) / 5)));
  const strength = over === "k" ? { "vibration.velocity_ratio": String(reach) } : {};
  const set = { ...Object.fromEntries(kept), ...strength };
  return { case: name, settings: set, options: { over, points: 37 } };
}

/** What tells a curve from others: what is set for it. */
function told({ case: name, settings, options }) {
  const hidden = ["solve.method", ...OWN[options.over]];
  const said = Object.entries(settings).filter(([path]) => !hidden.includes(path));
  return [name, ...said.map(([path, text]) => `${words(path.split(".")[1])} ${written(text)}`)].join(", ");
}

/** Curves that are pinned, asked for once each. */
function usePins() {
  const [known, setKnown] = useState({});
  const pins = pinned();
  const texts = pins.map((pin) => JSON.stringify(pin));
  useEffect(() => {
    for (const text of texts.filter((each) => !(each in known))) {
      const keep = (found) => setKnown((old) => ({ ...old, [text]: found }));
      keep(null);
      call("curve", JSON.parse(text)).then(({ series }) => keep(series), () => keep(null));
    }
  }, [texts.join()]);
  return pins.map((pin, at) => ({ pin, series: known[texts[at]] }));
}

/** Stretches of a curve on which it is unstable. */
function unstable({ x, unstable: flags }) {
  const half = (at, other) => (x[at] + (x[other] ?? x[at])) / 2;
  const starts = flags.flatMap((flag, at) => (flag && !flags[at - 1] ? [at] : []));
  return starts.map((from) => {
    const after = flags.indexOf(false, from);
    const to = after < 0 ? x.length - 1 : after - 1;
    return { from: half(from, from - 1), to: half(to, to + 1) };
  });
}

function Curves({ k, ratio, failed }) {
  const here = useCase();
  const normal = Boolean(useValue("normal.stiffness").text);
  const first = inUnit(useValue("vibration.elevation").text, "deg") > 0 ? "elevation" : "direction";
  const can = Object.keys(OVER).filter((key) => normal || !OVER[key].normal);
  const over = can.find((key) => key === route.value.params.over) ?? first;
  const body = here.name && k !== undefined ? curveBody(here, over, k) : null;
  const { data, error, busy } = useLive("curve", body, REST);
  const pins = usePins();
  const angles = Object.values(ANGLES).map(([path]) => inUnit(useValue(path).text, "deg") || 0);
  const curve = data?.answer.over === over ? data.series : null;
  const at = over === "k" ? k : ANGLES[over][1](angles[Object.keys(ANGLES).indexOf(over)]);
  const { label, unit } = OVER[over];
  const shown = pins.filter(({ pin, series }) => series && pin.options.over === over);
  const lines = !curve ? [] : [
    { label: "this body", values: curve.ratio, colour: 0 },
    ...(curve.closed ? [{ label: CLOSED, values: curve.closed, dash: [3, 4], colour: 6, faint: true }] : []),
    ...shown.map(({ pin, series }, place) => ({
      label: `pinned: ${told(pin)}`, x: series.x, values: series.ratio, dash: [10, 4, 2, 4], colour: place + 1,
    })),
  ];
  const shaky = curve ? unstable(curve) : [];
  const pick = (x) =>
    over === "k" ? here.set("vibration.velocity_ratio", digits(x, 3))
    : here.set(ANGLES[over][0], `${Math.round(Math.min(Math.max(...curve.x), Math.max(Math.min(...curve.x), x)))} deg`);
  return html`<section class="panel" aria-label="curve">
    <div class="row">
      <fieldset class="row choice"><legend class="hidden">ratio over</legend>
        ${can.map((key) => html`<label key=${key}>
          <input type="radio" name="over" value=${key} checked=${key === over}
            onChange=${() => setParam("over", key === first ? "" : key)} /> over ${OVER[key].words}</label>`)}
      </fieldset>
      <button type="button" disabled=${!curve || pins.length >= MOST_PINS}
        onClick=${() => put([...pinned(), body])}>pin this curve</button>
      ${pins.map(({ pin }, place) => html`<button type="button" class="quiet" key=${JSON.stringify(pin)}
        onClick=${() => put(pinned().filter((_, other) => other !== place))}>
        unpin ${told(pin)}</button>`)}
      <span class=${busy ? "busy on" : "busy"} aria-hidden="true"></span>
    </div>
    ${error ? html`<p class="says">no curve: ${error.message}</p>` : null}
    ${curve ? html`<${Plot} title=${`Force left over ${OVER[over].words}`} height=${300} xlog=${over === "k"}
      x=${{ label, unit, values: curve.x }} series=${lines} bands=${shaky} onPick=${pick} y="ratio"
      marks=${failed || ratio === undefined || ratio === null ? [] : [{ x: at, y: ratio }]} />` : null}
    ${curve && ratio !== null ? html`<${Best} curve=${curve} ratio=${ratio} over=${over} pick=${pick} />` : null}
    <p class="says">${shaky.length ? "Shaded: no stable state was found there. " : ""}
      <span class="to-press">Click into the curve to go there.</span></p>
  </section>`;
}

/** Where on the curve least is left, and how to go there. */
function Best({ curve, ratio, over, pick }) {
  const { x, ratio: left, unstable: flags } = curve;
  const known = left.map((value, at) => ({ value, at })).filter(({ value, at }) => value !== null && !flags[at]);
  if (over === "k" || !known.length || ratio === undefined) return null;
  const { value, at } = known.reduce((best, one) => (Math.abs(one.value) < Math.abs(best.value) ? one : best));
  const tried = `of the ${x.length} ${OVER[over].words}s tried`;
  if (ratio - value < WORTH) return html`<p role="status">None ${tried} leaves less by ${WORTH} or more.</p>`;
  return html`<p class="row"><span role="status">Least ${tried} is left at ${digits(x[at], 3)}°: ${
      digits(value, 3)}.</span>
    <button type="button" onClick=${() => pick(x[at])}>take it</button></p>`;
}

function Waves({ series }) {
  if (!series?.phase) return null;
  // What is nothing over all of the cycle is not sent.
  const none = series.phase.map(() => 0);
  const { phase, base_velocity: base = none, sliding_velocity: sliding = none } = series;
  const { force = none, force_across: across = none, normal_force: load = none } = series;
  const milli = (values) => values.map((value) => (value === null ? null : 1e3 * value));
  const varies = Math.max(...load) - Math.min(...load) > 1e-6 * Math.max(...load.map(Math.abs));
  const aside = across.some((value) => Math.abs(value) > 1e-9);
  const lines = [
    { label: "friction", unit: "N", values: force, colour: 1 },
    aside && { label: "friction across", unit: "N", values: across, dash: [8, 3, 2, 3], colour: 3 },
    varies && { label: "normal force", unit: "N", values: load, dash: [2, 3], colour: 2 },
    { label: "base", unit: "mm/s", values: milli(base), dash: [3, 3], colour: 6, faint: true },
    { label: "sliding", unit: "mm/s", values: milli(sliding), dash: [8, 4], colour: 0 },
  ];
  return html`<${Plot} title="Over a cycle" running=${moment} x=${{ label: "phase, cycles", values: phase }}
    series=${lines.filter(Boolean)} />`;
}
