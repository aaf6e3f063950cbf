/** The flanks of worm and wheel in mesh: in space, as maps, and over the angle of the worm. */
import { html, useEffect, useMemo, useRef, useState } from "../../vendor/preact.js";
import { fetchRaw, useAsked } from "../api.js";
import { gridCells, span } from "../colours.js";
import { Folded, Form } from "../form.js";
import { moving } from "../frames.js";
import * as lines from "../lines.js";
import { FlankMap, Legend } from "../map.js";
import { AllNumbers, byKey, Facts } from "../number.js";
import { unpacked } from "../packed.js";
import * as pictures from "../pictures.js";
import { Plot } from "../plot.js";
import { nearest, stage } from "../scene.js";
import { Report } from "../report.js";
import { Screen } from "../shell.js";
import { route, setParam, useCase } from "../state.js";
import { useTaken } from "../taken.js";
import { useTouch } from "../touch.js";
import { digits } from "../units.js";
import { amount } from "../us.js";
import { Files, placeOf, useJob, Work } from "../work.js";

const PACKED = "flanks.bin";
/** Of a turn of the worm. */
const SECONDS = 12;
/** Pictures of a pitch in space for a shared file: at most, at least, and how long they may take, ms. */
const [MOST, LEAST, PATIENCE] = [24, 6, 6000];
/** Between two readings of the angle while it plays, ms. */
const SELDOM = 120;
/** Places of a count over a pitch. */
const STEPS = 240;
const PARTS = [["mesh", "the mesh"], ["whole", "whole"], ["tooth", "one tooth"]];
const WORMS = [["clear", "see-through"], ["solid", "solid"], ["none", "left out"]];
const SIDES = [["+1", "s = +1"], ["-1", "s = −1"]];
const still = matchMedia("(prefers-reduced-motion: reduce)");

/** Values of a layer and their range; the compound is only where the gap is thinner than it. */
function layerOf({ header, arrays }, key, side) {
  const values = arrays[`layer.${key}.${side}`];
  if (key !== "gap") return { values, range: span(values) };
  const film = header.sides[side].film_um;
  return { values: values.map((gap) => (gap < film ? gap : NaN)), range: [0, film] };
}

const Choice = ({ label, param, options, value }) => html`<span class="choice">
  <label for=${`choose-${param}`}>${label}</label>
  <select id=${`choose-${param}`} value=${value} onChange=${(event) => setParam(param, event.target.value)}>
  ${options.map(([key, said]) => html`<option value=${key}>${said}</option>`)}</select></span>`;

/** The angle of the worm, whether it turns by itself, and what follows each step. */
function useTurning(pitch, onStep) {
  const [phi, setPhi] = useState(0);
  const [playing, setPlaying] = useState(false);
  const at = useRef(0);
  const put = (angle) => {
    at.current = angle;
    setPhi(angle);
    onStep(angle);
  };
  useEffect(() => {
    if (!playing) return;
    let [frame, before, told] = [0, performance.now(), 0];
    const step = (time) => {
      // However seldom it is drawn, it moves on by no more than a few lines.
      const passed = Math.min((time - before) / 1000, 0.1);
      before = time;
      at.current = (at.current + (2 * Math.PI * passed) / SECONDS) % pitch;
      onStep(at.current);
      if (time - told > SELDOM) {
        told = time;
        setPhi(at.current);
      }
      frame = requestAnimationFrame(step);
    };
    frame = requestAnimationFrame(step);
    return () => cancelAnimationFrame(frame);
  }, [playing, pitch]);
  return { phi, put, playing, setPlaying };
}

function Space({ gears, shown, options }) {
  const { header } = gears;
  const canvas = useRef(null);
  const drawn = useRef(null);
  const [without, setWithout] = useState(false);
  const turning = useTurning(header.pitch, (phi) => drawn.current?.turn(phi));
  const { phi, put, playing, setPlaying } = turning;
  const latest = useRef(shown);
  latest.current = shown;
  useEffect(() => {
    let gone = false;
    stage(canvas.current, gears).then((made) => {
      if (gone) return made?.close();
      if (!made) return setWithout(true);
      drawn.current = made;
      made.show(latest.current);
      moving.set(canvas.current, { module: pictures.NAME, of: () => taken(made, header.pitch) });
      setPlaying(!still.matches);
    }, () => setWithout(true));
    return () => {
      gone = true;
      drawn.current?.close();
      drawn.current = null;
    };
  }, [gears]);
  const { part, layer, side, worm, range } = shown;
  useEffect(() => drawn.current?.show(shown), [part, layer, side, worm, ...range]);
  const degrees = (angle) => (angle * 180) / Math.PI;
  const turned = (event) => {
    setPlaying(false);
    put((Number(event.target.value) * Math.PI) / 180);
  };
  const touch = useTouch(turned);
  return html`<section class="panel at-stage" aria-label="in space">
    ${without ? html`<p class="notes" role="status">This browser draws nothing in space (no WebGL); the maps beneath
      show the same.</p>` : null}
    <canvas ref=${canvas} class=${without ? "hidden" : "space"} tabindex="0" role="img"
      aria-label=${`${header.name}: worm and wheel in mesh at ${digits(degrees(phi), 3)} degrees; arrow keys move the
        view, with Shift they turn it`}></canvas>
    <div class="row turning">
      <button type="button" aria-pressed=${playing} onClick=${() => setPlaying(!playing)}>
        ${playing ? "❚❚ pause" : "▶ play"}</button>
      <input type="range" aria-label="angle of the worm" min="0" max=${degrees(header.pitch)} step="0.5"
        value=${degrees(phi)} aria-valuetext=${`${digits(degrees(phi), 3)} degrees`} ...${touch} />
      <output>${degrees(phi).toFixed(1)}° of a pitch of ${digits(degrees(header.pitch), 4)}°</output>
    </div>
    <div class="row">${options}</div>
    <${Over} gears=${gears} shown=${shown} phi=${phi} />
  </section>`;
}

/** How long a pitch takes, s. */
const lasts = (pitch) => (SECONDS * pitch) / (2 * Math.PI);

/** Pictures of what is drawn in space, over a pitch. */
async function taken(drawn, pitch) {
  const began = performance.now();
  const found = [drawn.picture(0)];
  // Without a graphics card each takes a second.
  const count = Math.min(MOST, Math.max(LEAST, Math.floor(PATIENCE / (performance.now() - began))));
  for (let n = 1; n < count; n += 1) {
    await new Promise((done) => setTimeout(done));
    found.push(drawn.picture((n * pitch) / count));
  }
  return { pictures: found, seconds: lasts(pitch) };
}

/** The contact lines of an angle as they lie on a map: on them the gap is least, nought or not. */
function linesOf({ arrays }, side, n) {
  const [from, to] = arrays[`lines.begin.${side}`].slice(n, n + 2);
  const p = arrays[`lines.points.${side}`];
  const end = (at) => `${p[at + 2].toFixed(3)} ${(-Math.hypot(p[at], p[at + 1])).toFixed(3)}`;
  let path = "";
  for (let k = from; k < to; k += 1) path += `M${end(6 * k)}L${end(6 * k + 3)}`;
  return path;
}

/** The layer as a map, and what happens over the angle, with a mark where the worm is. */
function Over({ gears, shown: { layer, side, values, range }, phi }) {
  const { header, arrays } = gears;
  const told = header.layers.find(({ key }) => key === layer);
  const grid = useMemo(() => {
    const p = arrays[`flank.points.${side}`];
    const at = Array.from({ length: p.length / 3 }, (_, k) => 3 * k);
    const cells = gridCells(...header.arrays[`flank.points.${side}`].shape);
    return { x: at.map((k) => p[k + 2]), y: at.map((k) => Math.hypot(p[k], p[k + 1])), cells };
  }, [gears, side]);
  const touching = linesOf(gears, side, nearest(header, phi));
  const box = useRef(null);
  useEffect(() => {
    const of = () => ({ seconds: lasts(header.pitch),
      lines: Array.from({ length: header.angles }, (_, n) => linesOf(gears, side, n)) });
    moving.set(box.current, { module: lines.NAME, of });
  }, [gears, side]);
  const title = `${told?.word}, flank s = ${side}, and the lines nearest to the worm`;
  const map = useMemo(() => told && html`<${FlankMap} title=${title}
    label=${told.meaning} unit=${told.unit} ...${grid} values=${values} range=${range} lines=${touching} />`,
  [grid, values, touching]);
  const sides = ["+1", "-1"].map((each) => [each, header.sides[each]]);
  const { angle_deg: angle, teeth, teeth_marked: marked, loaded, film_um: film } = header.sides[side];
  const marks = [{ x: (phi * 180) / Math.PI }];
  const x = { label: "angle of the worm", unit: "°", values: angle };
  const none = sides.every(([, { transmission_error_urad: peak }]) => !peak);
  const errors = sides.map(([each, { error_urad: found }]) =>
    ({ label: `flank s = ${each}`, unit: "µrad", values: found, dash: each === side ? undefined : [6, 4] }));
  const fine = Array.from({ length: STEPS + 1 }, (_, n) => (n * angle.at(-1)) / STEPS);
  // A count is what it is at the nearest angle that it is known at, and nothing between.
  const counted = (found, count) => fine.map((_, n) => found[Math.round((n * count) / STEPS) % found.length]);
  const counts = [
    { label: "rigid", values: counted(teeth, teeth.length - 1) },
    { label: `gap under ${amount(film, "µm", 2)}`, values: counted(marked, marked.length - 1), dash: [6, 4] },
    ...(loaded ? [{ label: "under load", values: counted(loaded.teeth, loaded.teeth.length), dash: [2, 3] }] : []),
  ];
  return html`<div class="grid" ref=${box}>${map}
    <${Plot} title="Transmission error about its mean" x=${x} series=${errors} marks=${marks} height=${200}
      range=${none ? [-1, 1] : undefined} />
    <${Plot} title="Teeth in contact" x=${{ ...x, values: fine }} series=${counts} marks=${marks} height=${200} />
  </div>`;
}

const FACTS = ["contact_ratio", "contact_ratio_marked", "pattern_area_fraction", "transmission_error_rad",
  "ease_off_max_um", "backlash_normal_mm"];

/** What the flanks do, in a sentence. */
function touches(found) {
  const { contact_ratio: ratio, pattern_area_fraction: share } = found;
  if (typeof ratio?.value !== "number" || typeof share?.value !== "number") return null;
  return html`<b>${digits(ratio.value, 3)}</b> teeth touch at a time, over${" "}
    ${digits(100 * share.value, 2)} % of a flank.`;
}

export function view() {
  const { name, settings } = useCase();
  const body = name ? { case: name, settings, options: { density: "coarse" } } : null;
  const work = useJob("flank", body, "", true);
  const taken = useTaken("flank", [body], work);
  const path = (work.files ?? work.job?.files)?.includes(PACKED) ? placeOf(work.from, PACKED) : "";
  const packed = useAsked(path, async (leave) => unpacked(await (await fetchRaw(path, leave)).arrayBuffer()));
  const gears = packed.found;
  const { part = "mesh", layer = "gap", side = "+1", worm = "clear" } = route.value.params;
  const layers = gears?.header.layers ?? [];
  const told = layers.find(({ key }) => key === layer) ?? layers.find(({ key }) => key === "gap");
  const values = useMemo(() => gears && layerOf(gears, told.key, side), [gears, told?.key, side]);
  const found = byKey(work.data?.entries);
  const of = { ...found, ...ofSide(found, side) };
  const options = [
    html`<${Choice} label="shown" param="part" value=${part} options=${PARTS} />`,
    html`<${Choice} label="worm" param="worm" value=${worm} options=${WORMS} />`,
    html`<${Choice} label="bearing flank" param="side" value=${side} options=${SIDES} />`,
    gears && html`<${Choice} label="colours" param="layer" value=${told.key}
      options=${layers.map(({ key, word }) => [key, word])} />`,
    gears && html`<${Legend} range=${values.range} unit=${told.unit} label=${told.meaning} />`,
  ];
  const shown = { part, layer: told?.key, side, worm, ...values };
  return html`<${Screen} title="Flanks" kinds=${["gear", "drive"]} first="gearset-3"
      ...${taken} error=${taken.error ?? packed.error}
      actions=${html`<${Report} work=${work} />`}
      lead="The wheel cut exactly as its hob cuts it: where it touches the worm, and what that does.">
    <div class="columns headed moving">
      <section class="controls" aria-label="what is set"><${Work} work=${work} label="cut the wheel" />
        <${Files} job=${work.job} />
        <${Folded}><${Form} tables=${["hob", "mount", "modification"]} brief /><//></section>
      <div class=${work.stale ? "headline before" : "headline"}><p class="big">${touches(of)}</p></div>
      ${gears ? html`<${Space} gears=${gears} options=${options} shown=${shown} />` : null}
      <section class=${work.stale ? "shown before" : "shown"}>
        ${gears ? html`<div class="panel"><${Facts} found=${of} keys=${FACTS} />
            ${of.backlash_normal_mm?.value < 0 ? html`<p class="says">A backlash below nothing: so far the teeth
              overlap.</p>` : null}</div>`
          : html`<p class="wait">${work.id ? "The wheel is being cut."
            : "Cut the wheel to see it: some ten seconds, the first time on a machine two minutes."}</p>`}
        ${work.data ? html`<${AllNumbers} entries=${work.data.entries} />` : null}
      </section></div>
  <//>`;
}

/** Numbers of one flank, by the key without it. */
function ofSide(found, side) {
  const place = `flanks.${side}.`;
  const own = Object.entries(found).filter(([key]) => key.startsWith(place));
  return Object.fromEntries(own.map(([key, entry]) => [key.slice(place.length), entry]));
}
