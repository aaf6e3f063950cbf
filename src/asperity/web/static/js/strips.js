/** Mean powers as strips, as wide as they are: what is put in, and where it goes. */
import { html, useRef } from "../vendor/preact.js";
import * as flowing from "./flowing.js";
import { usePlayed } from "./frames.js";
import { digits } from "./units.js";
import { readable } from "./us.js";

const [WIDTH, HIGH, MIDDLE, BAR] = [510, 150, [210, 300], 8];
/** Where strips begin on the left, and end on the right. */
const ENDS = [140, 370];
/** Between two strips, and the least room of a label. */
const [GAP, LINE] = [8, 38];
/** Of what is put in, below which a strip is left out. */
const LEAST = 2e-3;

/** Places of strips one under the other: at the outer end with room for words, at the inner without. */
function placed(strips, scale, inner) {
  let outer = 6;
  return strips.map((strip) => {
    const wide = strip.value * scale;
    const room = Math.max(wide, LINE);
    const from = outer + (room - wide) / 2;
    const to = inner;
    inner += wide;
    outer += room + GAP;
    return { ...strip, wide, from, to, end: outer };
  });
}

const band = (x0, y0, x1, y1, wide) => {
  const mid = (x0 + x1) / 2;
  return `M${x0} ${y0}C${mid} ${y0} ${mid} ${y1} ${x1} ${y1}V${y1 + wide}C${mid} ${y1 + wide} ${mid} ${y0 + wide} `
    + `${x0} ${y0 + wide}Z`;
};

/** The line in the middle of a strip, from its beginning on. */
const middle = (x0, y0, x1, y1, wide) => {
  const mid = (x0 + x1) / 2;
  return `M${x0} ${y0 + wide / 2}C${mid} ${y0 + wide / 2} ${mid} ${y1 + wide / 2} ${x1} ${y1 + wide / 2}`;
};

/**
 * @param {{powers: {name: string, value: number}[], label: string}} props W, what is put in above nothing and what
 *   goes below it
 */
export function Strips({ powers, label }) {
  const picture = useRef(null);
  const shown = powers.map(({ value }) => value).join();
  usePlayed(picture, flowing, {}, [shown]);
  const of = (sign) => powers.filter(({ value }) => sign * value > 0)
    .map(({ name, value }) => ({ name, value: Math.abs(value) }));
  const [into, out] = [of(1), of(-1)];
  const sum = Math.max(...[into, out].map((all) => all.reduce((total, { value }) => total + value, 0)));
  if (!(sum > 0)) return null;
  const kept = (all) => all.filter(({ value }) => value > LEAST * sum);
  const scale = HIGH / sum;
  const [left, right] = [kept(into), kept(out)].map((all) => placed(all, scale, 24));
  const high = Math.max(HIGH + 34, ...[...left, ...right].map(({ end }) => end));
  const said = ({ name, value }) => `${name} ${readable(value, "W", 3).join(" ")}, ${digits((100 * value) / sum, 2)} %`;
  const words = [...left, ...right].map(said).join("; ");
  const Name = ({ one, x, anchor }) => html`<text text-anchor=${anchor}>
    <tspan x=${x} y=${one.from + one.wide / 2 - 2}>${one.name}</tspan>
    <tspan x=${x} y=${one.from + one.wide / 2 + 15}>${said(one).slice(one.name.length + 1)}</tspan></text>`;
  return html`<svg class="strips" ref=${picture} viewBox=${`0 0 ${WIDTH} ${high}`} role="img"
      aria-label=${`${label}: ${words}`}>
    <rect class="middle" x=${MIDDLE[0]} y="24" width=${MIDDLE[1] - MIDDLE[0]} height=${HIGH} />
    ${left.map((one, n) => html`<path class=${`strip in-${n}`}
        d=${band(ENDS[0], one.from, MIDDLE[0], one.to, one.wide)} />
      <path class="runs-along" d=${middle(ENDS[0], one.from, MIDDLE[0], one.to, one.wide)} />
      ${Name({ one, x: ENDS[0] - BAR, anchor: "end" })}`)}
    ${right.map((one, n) => html`<path class=${`strip out-${n}`}
        d=${band(MIDDLE[1], one.to, ENDS[1], one.from, one.wide)} />
      <path class="runs-along" d=${middle(MIDDLE[1], one.to, ENDS[1], one.from, one.wide)} />
      ${Name({ one, x: ENDS[1] + BAR, anchor: "start" })}`)}
    <text class="strong" x=${(MIDDLE[0] + MIDDLE[1]) / 2} y=${24 + HIGH / 2 + 5} text-anchor="middle">
      ${readable(sum, "W", 3).join(" ")}</text>
  </svg>`;
}
