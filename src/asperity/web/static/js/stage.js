/** A body on its shaken plate, slowed until it is seen: what bends, what slips, which way friction points. */
import { html, signal, useLayoutEffect, useMemo, useRef } from "../vendor/preact.js";
import { useValue } from "./form.js";
import { moving as moves, Play, plays } from "./frames.js";
import {
  arrow, draw, HALF_X, HALF_Y, HEIGHT, MIDDLE, motionOf, NAME, NARROW, REACH, SHOWN, TILE, WIDTH, X, Y,
} from "./motion.js";
import { useCase } from "./state.js";
import { anyWay, useTouch } from "./touch.js";
import { digits, inUnit, split } from "./units.js";
import { Later } from "./work.js";

/** When the picture is, in cycles. */
export const moment = signal(0.25);
/** Parts of a cycle that a picture without motion is moved by. */
const STEPS = 128;
/** How far the handle is from the middle at the least and the greatest velocity ratio. */
const [NEAR, FAR] = [62, 138];
const [LEAST, MOST] = [0.1, 100];

/** What of the drawing is seen: on a phone its middle. @returns {[number, number]} from where, and how wide */
const seen = () => (innerWidth < NARROW ? MIDDLE : [0, WIDTH]);

/** Which way it is shaken in space, where it may be. */
const ball = () => import("./ball.js");
const rounded = new Intl.NumberFormat("en");
const turn = (degrees) => (degrees * Math.PI) / 180;

/** Why there is less friction, in a sentence. */
function why({ side, pulls, asides, load, mean }, ratio) {
  const share = (flags) => `${Math.round((100 * flags.filter(Boolean).length) / flags.length)}\u00a0%`;
  const left = `On average ${digits(100 * ratio, 3)}\u00a0% of it is left.`;
  const back = pulls.map((each) => each < 0);
  if (side && !back.some(Boolean) && Math.max(...load) > 1.02 * mean) {
    return `The body slides while it is pressed least, and waits while it is pressed most. ${left}`;
  }
  if (Math.max(...asides.map(Math.abs)) > 0.3) {
    return `Friction points against the momentary sliding, which the plate swings to and fro: most of it holds
      sideways, not against the pull. ${left}`;
  }
  if (back.some(Boolean)) {
    return `Friction points against the momentary sliding: for ${share(back)} of the time the plate runs ahead and
      carries the body forward. ${left}`;
  }
  return `The plate never runs ahead of the body: the bristles bend to and fro, but friction never turns. ${left}`;
}

/** The direction, and how strong, as a handle that is dragged. */
function useHandle(k) {
  const { setAll } = useCase();
  const taken = useRef({ value: NaN, unit: "", k: 0 });
  const direction = inUnit(useValue("vibration.direction").text, "deg") || 0;
  const forms = ["velocity_ratio", "velocity_amplitude", "displacement_amplitude"].map((key) => `vibration.${key}`);
  const texts = forms.map((path) => useValue(path).text);
  const form = texts.findIndex(Boolean);
  const folded = (Math.acos(Math.abs(Math.cos(turn(direction)))) * 180) / Math.PI;
  const span = Math.log(MOST / LEAST);
  const far = NEAR + (FAR - NEAR) * Math.min(1, Math.max(0, Math.log((k || LEAST) / LEAST) / span));
  // Behind the body, out of the way of what pulls: shaken to and fro, it is the same.
  const place = [-far * Math.cos(turn(folded)), -far * Math.sin(turn(folded))];
  const dragged = (event) => {
    if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
    const { left, top, width } = event.currentTarget.ownerSVGElement.getBoundingClientRect();
    const [from, wide] = seen();
    const [dx, dy] = [event.clientX - left, event.clientY - top].map((each) => (each * wide) / width);
    const [px, py] = [Math.max(X - from - dx, 0), Math.max(Y - dy, 0)];
    const angle = Math.round((Math.atan2(py, px) * 180) / Math.PI);
    const part = Math.min(1, Math.max(0, (Math.hypot(px, py) - NEAR) / (FAR - NEAR)));
    const wanted = LEAST * Math.exp(span * part);
    // In the form that is written, by what it was when the handle was taken: answers come later.
    const { value, unit, k: before } = taken.current;
    const strength = before && form >= 0
      ? { [forms[form]]: `${digits((value * wanted) / before, 3)}${unit ? ` ${unit}` : ""}` } : {};
    setAll({ "vibration.direction": `${angle} deg`, ...strength });
  };
  const grasped = (event) => {
    const [value, unit] = split(texts[form]);
    taken.current = { value, unit, k };
    event.currentTarget.setPointerCapture(event.pointerId);
  };
  return { place, direction: folded, dragged, grasped };
}

/** Advances the moment while the picture is seen and runs. */
function useMotion(picture, moving, runs) {
  // By layout: an effect waits for the next picture, and what is stopped would still move in it.
  useLayoutEffect(() => {
    if (!moving) return;
    draw(picture.current, moving, moment.peek());
    if (!runs) return;
    let frame = 0;
    let before = 0;
    const seen = new IntersectionObserver(([entry]) => (entry.isIntersecting ? start() : stop()));
    const next = (now) => {
      moment.value = moment.peek() + Math.min(now - (before || now), 100) / 1000 / SHOWN;
      before = now;
      frame = requestAnimationFrame(next);
    };
    const stop = () => (cancelAnimationFrame(frame), (frame = 0));
    const start = () => frame || ((before = 0), (frame = requestAnimationFrame(next)));
    seen.observe(picture.current);
    return () => (seen.disconnect(), stop());
  }, [moving, runs]);
  useLayoutEffect(() => {
    if (moving) return moment.subscribe((time) => draw(picture.current, moving, time));
  }, [moving]);
}

const slower = (frequency) => (frequency > 0 && frequency < 1e300
  ? `${rounded.format(Number(digits(frequency * SHOWN, 2)))} times slower than it is, ` : "");

/**
 * The picture, with what stops it.
 * @param {{series?: Record<string, number[]>, ratio?: number, k?: number, limit?: number, refused?: boolean,
 *   now?: boolean}} props
 */
export function Stage({ series, ratio = NaN, k = NaN, limit = NaN, refused = false, now = true }) {
  const picture = useRef(null);
  const runs = plays.value;
  const shaken = series?.force && k > 0 && limit > 0;
  const moving = useMemo(() => (shaken ? motionOf(series, limit) : null), [series, limit]);
  const inSpace = Boolean(useValue("normal.stiffness").text);
  const frequency = inUnit(useValue("vibration.frequency").text, "Hz");
  const { place, direction, dragged, grasped } = useHandle(k);
  useMotion(picture, moving, runs);
  useLayoutEffect(() => {
    if (moving) moves.set(picture.current, { module: NAME, of: { series, limit } });
  }, [moving]);
  const touch = useTouch(({ target }) => (moment.value = target.value / STEPS));
  if (!moving) return null;
  const { side } = moving;
  const path = moving.pulls.map((pull, row) => `${row ? "L" : "M"}${(-REACH * pull).toFixed(1)} ${
    side ? 0 : (REACH * moving.asides[row]).toFixed(1)}`).join("");
  const words = why(moving, ratio);
  const marks = [];
  for (let px = -TILE; px <= WIDTH + TILE; px += TILE) {
    for (let py = side ? Y + HALF_Y + 40 : -TILE; py <= HEIGHT + TILE; py += TILE) {
      marks.push(`M${px - 4} ${py}h8M${px} ${py - 4}v8`);
    }
  }
  const from = side ? "from the side" : "from above";
  return html`<section class="panel stage" aria-label="the body on its plate">
    <svg ref=${picture} viewBox=${`${seen()[0]} 0 ${seen()[1]} ${HEIGHT}`} role="img"
      aria-label=${`A body that is pulled to the right over a shaken plate, ${from}. ${words}`}>
      <clipPath id="ground"><rect x="0" y=${side ? Y + HALF_Y - 10 : 0} width=${WIDTH} height=${HEIGHT} /></clipPath>
      <g clip-path="url(#ground)"><g data-of="plate">
        <rect class="plate" x=${-2 * TILE} y=${side ? Y + HALF_Y + 22 : -2 * TILE} width=${WIDTH + 4 * TILE}
          height=${HEIGHT + 4 * TILE} />
        <path class="marks" d=${marks.join("")} /></g></g>
      <g transform=${`translate(${X} ${Y})`}>
        <g data-of="body">
          <rect class="body" x=${-HALF_X} y=${-HALF_Y} width=${2 * HALF_X} height=${2 * HALF_Y} rx="8" />
          <path class="pull" d=${`M${HALF_X} 0l10 0l6 -8l10 16l10 -16l10 16l10 -16l6 8h60`} />
          <path class="pull" d=${arrow(36, 0)} transform=${`translate(${HALF_X + 128} 0)`} />
          <text class="of" x=${HALF_X + 74} y="-16">pulled</text></g>
        <path data-of="bristles" class="bristles" /><path data-of="tips" class="tips" />
        <circle class="bound" r=${REACH} visibility=${side ? "hidden" : "visible"} />
        <path class="way" d=${path} />
        <path data-of="now" class="now" /><circle data-of="dot" class="dot" r="5" />
        <path class="mean" d=${arrow(-REACH * ratio, 0, 12)} transform=${`translate(0 ${side ? 30 : 0})`} />
        <path data-of="load" class="load" transform=${`translate(0 ${-HALF_Y - 48})`} />
        ${side ? html`<text class="of" x=${-REACH - 12} y="5" text-anchor="end">friction now</text>`
          : html`<text class="of" x=${REACH + 8} y="-84">friction now</text>
            <path class="lead" d=${`M${REACH + 4} -86L${REACH - 26} -62`} />`}
        <text class="strong" x="-90" y="124" text-anchor="middle">its mean: ${digits(100 * ratio, 3)} %</text>
        <path class="lead" d=${`M-90 106L${-Math.max(12, REACH * ratio * 0.6)} ${side ? 36 : 6}`} />
        ${side ? null : html`<path class="shaken" d=${`M${-place[0]} ${-place[1]}L${place[0]} ${place[1]}`} />
          <circle class="grip" cx=${place[0]} cy=${place[1]} r="13"
            onPointerDown=${grasped} ...${anyWay}
            onPointerMove=${dragged}><title>drag: which way it is shaken, and how strongly</title></circle>
          <text class="strong" x=${place[0] - 20} y=${place[1] + 5} text-anchor="end">
            ${digits(direction, 3)}°, k ${digits(k, 3)}</text>`}
      </g>
    </svg>
    <div class=${inSpace ? "told in-space" : "told"}>${inSpace
      ? html`<${Later} load=${ball} part="Ball" refused=${refused} now=${now} />` : null}
      <p class="why">${words}</p></div>
    <div class="row">
      <${Play} />
      ${runs ? null : html`<label class="row">moment of the cycle <input type="range" min="0" max=${STEPS} step="1"
        value=${Math.round(STEPS * (moment.peek() % 1))}
        ...${touch} /></label>`}
      <span class="says">${slower(frequency)}seen ${from}. ${side && !inSpace ? null
          : html`<span class="to-press">Drag the round handle.</span>`}
        <span class="sign-of"><span class="key holds"></span> bristles hold</span>
        <span class="sign-of"><span class="key slips"></span> they slip</span></span>
    </div>
  </section>`;
}
