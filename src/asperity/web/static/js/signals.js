/** A recording's signals over time, with the windows of its segments, which are moved by hand. */
import { html, useRef, useState } from "../vendor/preact.js";
import { Figure } from "./figure.js";
import { useValue, words } from "./form.js";
import { path, ticks } from "./plot.js";
import { useCase } from "./state.js";
import { along as sideways } from "./touch.js";
import { digits, inUnit } from "./units.js";
import { column } from "./us.js";

/** Of the keys that say how segments are found. */
export const OWN = "reduction.";
const SHOWN = ["torque_steel", "speed_steel", "drive_deviation"];
const [WIDTH, ROW, LEFT, RIGHT] = [900, 110, 64, 8];

/** Signals over time with the windows of each segment; an edge that is dragged moves the settling. */
export function Signals({ time, signals, segments, settling_s: answered, duration_s: duration }) {
  const { settings, set } = useCase();
  const least = inUnit(useValue(`${OWN}least_window`).text, "s") || 0;
  const box = useRef(null);
  const grip = useRef(null);
  const [held, setHeld] = useState(null);
  const written = settings[`${OWN}settling`];
  // What is dragged or set is drawn at once: an answer to what was set before moves nothing back.
  const settling = held ?? (written ? inUnit(written, "s") : answered);
  const rows = SHOWN.map((name) => signals.find((each) => each.name === name)).filter(Boolean);
  const height = rows.length * ROW + 24;
  const along = (seconds) => LEFT + ((WIDTH - LEFT - RIGHT) * seconds) / duration;
  // Of the segment whose edge is moved, the least window stays.
  const settle = (seconds, { with: [from, to] }) =>
    Math.max(0, Math.round(Math.min(seconds, to - from + answered - least) * 20) / 20);
  const put = (seconds) => set(`${OWN}settling`, `${digits(seconds, 4)} s`);
  const grab = (event, one) => {
    grip.current = one;
    event.preventDefault();
    event.currentTarget.focus();
    event.currentTarget.setPointerCapture(event.pointerId);
  };
  const move = (event) => {
    if (grip.current === null) return;
    const { left, width } = box.current.getBoundingClientRect();
    const place = ((event.clientX - left) / width) * WIDTH - LEFT;
    setHeld(settle((place / (WIDTH - LEFT - RIGHT)) * duration - grip.current.start, grip.current));
  };
  // A finger that scrolls instead has moved nothing.
  const leave = () => {
    grip.current = null;
    setHeld(null);
  };
  const drop = () => {
    if (held !== null) put(held);
    leave();
  };
  const keyed = (event, one) => {
    const step = { ArrowLeft: -0.1, ArrowRight: 0.1 }[event.key];
    if (!step) return;
    event.preventDefault();
    put(settle(settling + step, one));
  };
  const columns = () => [{ label: "time", unit: "s", values: time },
    ...signals.map(({ name, unit, values }) => ({ label: words(name), unit, values }))];
  // The left edges move with the settling, the right ones are where something changes.
  const ends = ([from, to]) => [Math.min(from + settling - answered, to), to].map((at) => Math.min(at, duration));
  const window = (kind, colour) => {
    const [from, to] = ends(kind).map(along);
    return html`<rect class=${`window fill${colour}`} x=${from} width=${to - from} y="4"
      height=${rows.length * ROW - 8} />`;
  };
  const drawn = rows.map(column);
  return html`<${Figure} title="Signals, and the windows before and with vibration" kind="bare" columns=${columns}>
    <div class="scroll wide"><svg ref=${box} class="signals drawn" viewBox=${`0 0 ${WIDTH} ${height}`} role="group"
        aria-label="signals over time" onPointerMove=${move} onPointerUp=${drop} onPointerCancel=${leave}>
      ${segments.map((one, at) => html`<g key=${at} class=${one.refused ? "segment refused" : "segment"}>
        <title>${told(one, at)}</title>${window(one.before, 3)}${window(one.with, 1)}
        <text x=${along(ends(one.with)[0]) + 10} y="18">
          ${one.commanded_Hz ? `${digits(one.commanded_Hz, 4)} Hz` : "?"}${one.refused ? " ✗" : ""}</text>
      </g>`)}
      ${drawn.map(({ name, unit, values }, row) => html`<${Line} key=${name} label=${`${words(name)} (${unit})`}
        time=${time} values=${values} along=${along} top=${row * ROW} />`)}
      ${ticks(0, duration, false, 10).map((at) => html`<text key=${at} class="tick" x=${along(at)} y=${height - 6}
        text-anchor="middle">${at}</text>`)}
      ${segments.map((one, at) => html`<rect key=${at} class="grip" x=${along(ends(one.with)[0]) - 4} width="8" y="4"
        height=${rows.length * ROW - 8} role="slider" tabindex="0" aria-label=${`settling, at segment ${at + 1}`}
        aria-valuemin="0" aria-valuemax=${duration} aria-valuenow=${settling}
        aria-valuetext=${`${digits(settling, 3)} s`} onKeyDown=${(event) => keyed(event, one)} ...${sideways}
        onPointerDown=${(event) => grab(event, one)} />`)}
    </svg></div>
    <p class="says">Time in s. Green: sliding before; blue: with vibration. Drag the left edge of a blue window,
      or press ← →: what is left out behind every change is ${digits(settling, 3)} s.</p>
  <//>`;
}

function Line({ label, time, values, along, top }) {
  const known = values.filter((value) => value !== null);
  const [low, high] = [Math.min(...known), Math.max(...known)];
  // Beneath the least of it is room for its name.
  const up = { at: (value) => top + ROW - 24 - ((ROW - 38) * (value - low)) / (high - low || 1) };
  const end = (value) => html`<text class="tick" x=${LEFT - 6} y=${up.at(value) + 4}
    text-anchor="end">${digits(value, 3)}</text>`;
  return html`<g class="row-of"><path class="trace" d=${path(time, values, { at: along }, up)} />
    <text class="name" x=${LEFT + 4} y=${top + ROW - 3}>${label}</text>${end(high)}${end(low)}</g>`;
}

const told = ({ start, refused }, at) =>
  `segment ${at + 1}, ${digits(start, 4)} s${refused ? `: refused, ${refused}` : ""}`;

export function Refusals({ segments }) {
  const odd = segments.map((one, at) => ({ ...one, at })).filter(({ refused, flags }) => refused || flags.length);
  if (!segments.length) {
    return html`<p class="notes">No vibration was found in it: its drive signal never varies for long.</p>`;
  }
  return odd.length ? html`<ul class="notes" aria-label="what to know of the segments">${odd.map((one) => html`
    <li key=${one.at}>${one.refused ? "✗" : "~"} ${told(one, one.at)}
      ${one.refused ? "" : `: ${one.flags.join("; ")}`}</li>`)}
    </ul>` : null;
}
