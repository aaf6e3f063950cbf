/** The direction in space as a ball: the line along which the plate is shaken goes in and out where one drags. */
import { html, useRef } from "../vendor/preact.js";
import { useValue } from "./form.js";
import { useCase } from "./state.js";
import { anyWay } from "./touch.js";
import { digits, inUnit } from "./units.js";

const turn = (degrees) => (degrees * Math.PI) / 180;
const degrees = (angle) => Math.round((angle * 180) / Math.PI);
/** From where it is seen: turned about the normal, and from above. */
const [ASIDE, ABOVE] = [turn(28), turn(24)];
const RIGHT = [Math.cos(ASIDE), Math.sin(ASIDE), 0];
const TOWARDS = [Math.sin(ASIDE) * Math.cos(ABOVE), -Math.cos(ASIDE) * Math.cos(ABOVE), Math.sin(ABOVE)];
const UP = [-Math.sin(ABOVE) * Math.sin(ASIDE), Math.sin(ABOVE) * Math.cos(ASIDE), Math.cos(ABOVE)];
/** How far it reaches in the picture, and half of the picture. */
const [RADIUS, HALF] = [52, 76];

const dot = (one, other) => one.reduce((sum, each, k) => sum + each * other[k], 0);
const place = (point) => [RADIUS * dot(point, RIGHT), -RADIUS * dot(point, UP)];
const at = (point) => place(point).map((each) => each.toFixed(1)).join(" ");

/** Along the pull, across it, and along the normal: the line of two angles, degrees. */
export const lineOf = (direction, elevation) => {
  const [across, up] = [turn(direction), turn(elevation)];
  return [Math.cos(up) * Math.cos(across), Math.cos(up) * Math.sin(across), Math.sin(up)];
};

/**
 * The angles of the line that goes in at a place of the ball that is seen, in its radii to the right and up; to and
 * fro it is one line, so that both go from 0 to 180 degrees.
 * @returns {[number, number]} direction and elevation, degrees
 */
export function anglesAt(right, up) {
  const far = Math.max(Math.hypot(right, up), 1);
  const [u, v] = [right / far, up / far];
  const near = Math.sqrt(Math.max(0, 1 - u * u - v * v));
  const point = RIGHT.map((each, k) => u * each + v * UP[k] + near * TOWARDS[k]);
  const [x, y, z] = point[2] < 0 ? point.map((each) => -each) : point;
  const [direction, elevation] = [degrees(Math.atan2(y, x)), degrees(Math.asin(Math.min(z, 1)))];
  // Beyond half a turn it is the line that leans to the other side.
  if (direction >= 0 && direction < 180) return [direction, elevation];
  return [direction < 0 ? direction + 180 : 0, (180 - elevation) % 180];
}

/** Where a line goes in or out on the side that is seen, in radii to the right and up. */
export function seenAt(line) {
  const side = dot(line, TOWARDS) < 0 ? -1 : 1;
  return [side * dot(line, RIGHT), side * dot(line, UP)];
}

/** A circle about an axis of the ball: what of it is seen, and what is behind. */
function circle(one, other) {
  const points = Array.from({ length: 73 }, (_, n) => one.map((each, k) =>
    each * Math.cos(turn(5 * n)) + other[k] * Math.sin(turn(5 * n))));
  const part = (seen) => points.map((point, n) => {
    const [now, before] = [point, points[Math.max(n - 1, 0)]].map((each) => (dot(each, TOWARDS) >= 0) === seen);
    return now ? `${n && before ? "L" : "M"}${at(point)}` : "";
  }).join("");
  return { seen: part(true), behind: part(false) };
}
const [X, Y, Z] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
/** @type {[string, {seen: string, behind: string}][]} */
const CIRCLES = [["plane", circle(X, Y)], ["upright", circle(X, Z)], ["upright", circle(Y, Z)]];

/**
 * The ball of a body that may be shaken any way.
 * @param {{refused: boolean, now: boolean}} props what is set is `refused`: the ball is as it was then; or answered
 */
export function Ball({ refused, now }) {
  const { setAll } = useCase();
  const box = useRef(null);
  const typed = ["direction", "elevation"].map((key) => inUnit(useValue(`vibration.${key}`).text, "deg") || 0);
  const known = useRef(typed);
  if (now && !refused) known.current = typed;
  const [direction, elevation] = refused ? known.current : typed;
  const line = lineOf(direction, elevation);
  const other = line.map((each) => -each);
  const [front, back] = dot(line, TOWARDS) >= 0 ? [line, other] : [other, line];
  const [px, py] = seenAt(line).map((each, k) => (k ? -RADIUS : RADIUS) * each);
  const dragged = (event) => {
    if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
    const { left, top, width } = box.current.getBoundingClientRect();
    const scale = (2 * HALF) / width / RADIUS;
    const found = anglesAt((event.clientX - left - width / 2) * scale, -(event.clientY - top - width / 2) * scale);
    setAll({ "vibration.direction": `${found[1] === 90 ? direction : found[0]} deg`,
      "vibration.elevation": `${found[1]} deg` });
  };
  const beyond = (point) => point.map((each) => 1.32 * each);
  return html`<figure class="ball"><svg ref=${box} viewBox=${`${-HALF} ${-HALF} ${2 * HALF} ${2 * HALF}`} role="img"
      aria-label=${`Shaken in space: direction ${digits(direction, 3)} degrees, elevation
        ${digits(elevation, 3)} degrees above the plate; sliders set the same.`}>
    <circle class="globe" r=${RADIUS} />
    ${CIRCLES.map(([kind, { behind }]) => html`<path class=${`${kind} behind`} d=${behind} />`)}
    <path class="axis" d=${`M0 0L${at(beyond(X))}M0 0L${at(beyond(Z))}`} />
    <path class="line behind" d=${`M0 0L${at(beyond(back))}`} />
    ${CIRCLES.map(([kind, { seen }]) => html`<path class=${kind} d=${seen} />`)}
    <path class="line" d=${`M0 0L${at(beyond(front))}`} />
    <text x=${place(beyond(X))[0] + 3} y=${place(beyond(X))[1] + 4}>pull</text>
    <text x=${place(beyond(Z))[0]} y=${place(beyond(Z))[1] - 4} text-anchor="middle">normal</text>
    <circle class="grip" cx=${px} cy=${py} r="8" ...${anyWay} onPointerMove=${dragged}
      onPointerDown=${(event) => event.currentTarget.setPointerCapture(event.pointerId)}><title>drag: which way it is
        shaken, in space</title></circle></svg>
    <figcaption class="says">${refused ? "before: " : ""}direction ${
      digits(direction, 3)}°, elevation ${digits(elevation, 3)}°</figcaption>
  </figure>`;
}
