/** An elastic block in motion: its skin deformed, and the pressure under it, in the frames that a march kept. */
import { html, useMemo, useRef } from "../vendor/preact.js";
import { LEVELS, span } from "./colours.js";
import * as deforming from "./deforming.js";
import { framesOf, seen, SECONDS } from "./deforming.js";
import { Play, usePlayed } from "./frames.js";
import { Legend } from "./map.js";
import { digits } from "./units.js";
import { amount, shown } from "./us.js";

const rounded = new Intl.NumberFormat("en", { maximumSignificantDigits: 2 });

/** A block whose frames play. @param {{packed: any, contact: {x: number[], y: number[], cells: number[][]}}} props */
export function Deformed({ packed, contact }) {
  const box = useRef(null);
  const made = useMemo(() => framesOf(packed), [packed]);
  const { rest, magnified, range, loads, times } = made;
  const force = shown(1, "N");
  usePlayed(box, deforming, { packed, contact, force }, [packed, force[1]]);
  const view = (points, room) => {
    const [[left, right], [low, high]] = [0, 1].map((k) => span(points.map((each) => each[k])));
    const edge = room * Math.max(right - left, high - low);
    return { box: `${left - edge} ${-high - edge} ${right - left + 2 * edge} ${high - low + 2 * edge}`,
      thin: (right - left) / 400 };
  };
  const [skin, under] = [view(rest.map(seen), 0.07), view(contact.x.map((x, at) => [x, contact.y[at]]), 0.03)];
  const part = (name, { box: seenIn, thin }, ends, unit, label, title) => html`<figure><figcaption>${title}</figcaption>
    <svg class="map-of" viewBox=${seenIn} role="img"
      aria-label=${`${title}: ${label}, ${digits(shown(ends[0], unit)[0], 3)} to
      ${amount(ends[1], unit, 3)}`}><g data-of=${name} class=${name}>
      ${Array.from({ length: LEVELS + 1 }, () => html`<path stroke-width=${thin} />`)}</g></svg>
    <${Legend} range=${ends} unit=${unit} label=${label} /></figure>`;
  return html`<div class="deformed" ref=${box}>
    <div class="grid">
      ${part("skin", skin, range.map((each) => 1e9 * each), "nm", "deformation",
        `The block, deformed ${rounded.format(magnified)} times as much as it is`)}
      ${part("under", under, loads.map((each) => each / 1e3), "kPa", "pressure at a node",
        "The pressure under it at that moment")}</div>
    <p class="row"><${Play} /> <span class="says" data-of="now" aria-hidden="true"></span></p>
    <p class="says">The last ${digits(1e3 * (times.at(-1) - times[0]), 3)} ms of the march, over and over, slowed
      ${" "}${rounded.format(SECONDS / (times.at(-1) - times[0]))} times; what the block moves
      as a whole is left out.</p>
  </div>`;
}
