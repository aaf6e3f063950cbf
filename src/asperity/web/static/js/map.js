/** Maps of a flank: cells of a mesh, filled by what holds in them, and which colour is which value. */
import { html } from "../vendor/preact.js";
import { LEVELS, painted, shade, span } from "./colours.js";
import { Figure } from "./figure.js";
import { inWords } from "./symbols.js";
import { digits } from "./units.js";
import { amount, inText, shown } from "./us.js";

/** Which colour is which value. @param {{range: [number, number], unit: string, label: string}} props */
export function Legend({ range: [low, high], unit, label }) {
  const steps = Array.from({ length: LEVELS }, (_, level) => level);
  const ends = `${digits(shown(low, unit)[0], 3)} to ${amount(high, unit, 3)}`;
  return html`<ul class="legend ramp"><li>
    <svg viewBox=${`0 0 ${LEVELS} 1`} preserveAspectRatio="none" role="img" aria-label=${`colours from ${ends}`}>
      ${steps.map((level) => html`<rect x=${level} width="1.05" height="1" fill=${shade((level + 0.5) / LEVELS)} />`)}
    </svg> ${ends}: ${inWords(label)}</li></ul>`;
}

/**
 * A map over a flank as it is seen along the tooth, with its files beneath.
 * @param {{title: string, label: string, unit: string, x: ArrayLike<number>, y: ArrayLike<number>,
 *   cells: number[][], values: ArrayLike<number>, range: [number, number], lines?: string,
 *   says?: string}} props
 *   places along the face and from the axis in mm; `lines` a path drawn over it; `says` where it is
 */
export function FlankMap({ title, label, unit, x, y, cells, values, range, lines = "", says }) {
  const [left, right] = span(x);
  const [low, high] = span(y);
  const [width, height] = [right - left, high - low];
  const box = `${left - 0.02 * width} ${-high - 0.03 * height} ${1.04 * width} ${1.06 * height}`;
  const thin = width / 160;
  const columns = () => [["along the face", x, "mm"], ["from the axis", y, "mm"], [label, values, unit]]
    .map(([name, of, more]) => ({ label: name, unit: more, values: Array.from(of, Number) }));
  const where = inText(`across ${digits(left, 3)} to ${digits(right, 3)} mm along the wheel's axis, `
    + `up ${digits(low, 4)} to ${digits(high, 4)} mm from it`);
  return html`<${Figure} title=${title} kind="map" columns=${columns}>
    <svg class="drawn" viewBox=${box} role="img"
        aria-label=${`${title}: ${label}, ${digits(shown(range[0], unit)[0], 3)} to ${
          amount(range[1], unit, 3)}; the numbers are in the table beneath`}>
      ${painted({ x, y, cells, values, range }).map(([d, fill]) =>
        html`<path d=${d} fill=${fill} stroke=${fill} stroke-width=${thin / 4} />`)}
      ${lines ? html`<path class="touching" d=${lines} stroke-width=${thin} />` : null}
    </svg>
    <p class="says">${says ?? where}</p>
    <${Legend} range=${range} unit=${unit} label=${label} />
  <//>`;
}
