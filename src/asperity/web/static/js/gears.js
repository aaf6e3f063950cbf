/** Worm and wheel turning in mesh, shaken as it is set, with the line on which teeth touch in its colours. */
import { html, useMemo, useRef, useState } from "../vendor/preact.js";
import { shade, span } from "./colours.js";
import { Play, usePlayed } from "./frames.js";
import { Legend } from "./map.js";
import { lineOf, sectionOf, threadsOf, wheelOf, windowOf } from "./mesh.js";
import * as turning from "./turning.js";
import { valueIn } from "./turning.js";
import { inText } from "./us.js";
import { digits } from "./units.js";

/** Ways to shake it: what is said of each. */
export const WAYS = {
  axial: "the worm along its axis", torsional: "the worm about its axis",
  "wheel-axial": "the wheel along its axis, seen obliquely", screw: "the worm along its own screw",
};
const arrows = (x, y, dx, dy, head) => {
  const size = Math.hypot(dx, dy) || 1;
  const [ux, uy] = [dx / size, dy / size];
  const tip = (s) => `M${x + s * dx} ${y + s * dy}l${s * head * (-ux - 0.5 * uy)} ${s * head * (-uy + 0.5 * ux)}`
    + `M${x + s * dx} ${y + s * dy}l${s * head * (-ux + 0.5 * uy)} ${s * head * (-uy - 0.5 * ux)}`;
  return `M${x - dx} ${y - dy}L${x + dx} ${y + dy}${tip(1)}${tip(-1)}`;
};

/** How it is shaken, as an arrow at the place of what is. */
function wayOf({ apart, module, pitch, rolling }, mode) {
  const head = 0.5 * module;
  if (mode === "axial") return arrows(-2.4 * pitch, apart + 1.2 * module, 1.3 * module, 0, head);
  if (mode === "torsional") return arrows(-2.4 * pitch, apart + 0.9 * module, 0, 1.2 * module, head);
  if (mode === "screw") return arrows(-2.4 * pitch, apart + 0.9 * module, 1.1 * module, 0.9 * module, head);
  if (mode === "wheel-axial") return arrows(-2.4 * pitch, rolling - 2.2 * module, 1.1 * module, -0.66 * module, head);
  return "";
}

/**
 * What moves in a picture of a gearset.
 * @param {{geometry: any, mode: string, speed: number, pressed?: any}} props `geometry` as `rate` tells it; `mode` ""
 *   where nothing is shaken; `speed` of the worm, rad/s; `pressed` as of Gears, where pressure is what is shown
 */
function useMesh({ geometry, mode, speed, pressed }) {
  const picture = useRef(null);
  const made = useMemo(() => {
    const section = sectionOf(geometry);
    const line = lineOf(section, valueIn(section, { speed, pressed }));
    const range = span(line.map(({ value }) => value));
    return { section, line, range, threads: threadsOf(section), wheel: wheelOf(section), view: windowOf(section) };
  }, [JSON.stringify(geometry), speed, pressed]);
  const { range } = made;
  usePlayed(picture, turning, { geometry, mode, speed, pressed, range }, [made, mode]);
  return { picture, made, colour: (value) => shade((value - range[0]) / (range[1] - range[0])) };
}

function Drawn({ picture, made: { section, line, threads, wheel, view }, colour, mode, says }) {
  const [left, top, wide, high] = view;
  const thin = section.module / 14;
  return html`<svg class="mesh" ref=${picture} viewBox=${view.join(" ")} role="img" aria-label=${says}>
    <g data-of="threads"><path class="steel" d=${threads} stroke-width=${thin} /></g>
    <g data-of="core"><rect class="core" x=${left - wide} y=${section.root} width=${3 * wide}
      height=${2 * (section.apart - section.root)} stroke-width=${thin} />
      <path data-of="marks" class="turning" stroke-width=${4 * thin} /></g>
    <g data-of="wheel"><path class="bronze" d=${wheel} stroke-width=${thin} /></g>
    <path class="axis" d=${`M${left} ${section.apart}H${left + wide}`} stroke-width=${thin} />
    ${line.slice(1).map((to, n) => html`<path d=${`M${near(line[n])}L${near(to)}`} stroke=${colour(to.value)}
      stroke-width=${3.2 * thin} />`)}
    ${[0, 1, 2, 3, 4].map(() => html`<circle class="touches" r=${0.22 * section.module} stroke-width=${1.4 * thin} />`)}
    ${mode ? html`<path class="shakes-so" d=${wayOf(section, mode)} stroke-width=${2.4 * thin} />` : null}
  </svg>`;
}
const near = ({ x, y }) => `${x.toFixed(3)} ${y.toFixed(3)}`;

/**
 * A gearset in motion, in a box.
 * @param {{geometry: any, mode?: string, speed: number, pressed?: {radius: number[], face: number[],
 *   pressure: number[]} | null}} props `pressed`: at the nodes of a flank, mm and MPa, where the answer has it
 */
export function Gears({ geometry, mode = "", speed, pressed = null }) {
  const [by, setBy] = useState("sliding");
  const shown = by === "pressure" ? pressed : null;
  const { picture, made, colour } = useMesh({ geometry, mode, speed, pressed: shown });
  const { range } = made;
  const does = shown ? "Pressed with" : "The surfaces slide at";
  const says = inText(`Worm and wheel in mesh, cut through the middle of the wheel. ${does}
    ${digits(range[0], 3)} to ${digits(range[1], 3)} ${shown ? "MPa" : "m/s"}.
    ${mode ? ` Shaken: ${WAYS[mode]}.` : ""}`);
  return html`<section class="panel at-stage" aria-label="in mesh"><h2>In mesh</h2>
    <${Drawn} picture=${picture} made=${made} colour=${colour} mode=${mode} says=${says} />
    <div class="row"><${Play} />
      ${pressed ? html`<span class="choice"><label for="line-shows">line</label>${" "}
        <select id="line-shows" value=${by} onChange=${(event) => setBy(event.target.value)}>
          <option value="sliding">sliding velocity</option><option value="pressure">pressure</option></select></span>`
        : null}
      <${Legend} range=${range} unit=${shown ? "MPa" : "m/s"} label=${shown
        ? "largest pressure over a pitch, in the middle of the wheel's face"
        : "sliding velocity, along the line on which teeth touch"} /></div>
    <p class="says">To scale, cut through the middle of the wheel, with straight flanks of the worm; slowed. Ringed
      dots are where teeth touch now; the small ones on the worm turn with it: its flanks slide out of the picture.
      ${mode ? ` Shaken: ${WAYS[mode]}, far more than it is${mode === "screw" ? ""
        : ", so that teeth seem to overlap"}.` : ""}</p>
  </section>`;
}

/** One way to shake it, small, with what comes of it beneath. */
export function Way({ geometry, mode, speed, children }) {
  const { picture, made, colour } = useMesh({ geometry, mode, speed });
  return html`<figure class="way"><${Drawn} picture=${picture} made=${made} colour=${colour} mode=${mode}
    says=${`shaken: ${WAYS[mode]}`} /><figcaption><b>${mode}</b> <span class="says">${WAYS[mode]}</span>
    ${children}</figcaption></figure>`;
}
