/** Lines over an axis, with their legend, which tells the numbers where the pointer is. */
import { html, useLayoutEffect, useRef, useState } from "../vendor/preact.js";
import { Figure } from "./figure.js";
import { between } from "./motion.js";
import { printed } from "./symbols.js";
import { named } from "./table.js";
import { digits } from "./units.js";
import { asKept, back, column, headed, shown } from "./us.js";

/**
 * @typedef {{label: string, unit?: string, values: (number | null)[], x?: number[], dash?: number[],
 *   colour?: number, faint?: boolean, points?: "round" | "square", bare?: boolean,
 *   ends?: [(number | null)[], (number | null)[]]}} Line `x` where it has places of its own;
 *   `colour` the number of one of the page's colours; `bare` points without a line; `ends` of the
 *   interval about each of them
 * @typedef {{title: string, x: {label: string, unit?: string, values: number[], whole?: boolean}, series: Line[],
 *   bands?: {from: number, to: number}[], marks?: {x: number, y?: number}[],
 *   y?: string, height?: number, log?: boolean, xlog?: boolean, range?: [number, number],
 *   onPick?: (x: number) => void, running?: any}} Shown `running`: a signal of when, in cycles, of
 *   marks that run along the lines
 */

export const [LEFT, RIGHT, TOP, BOTTOM] = [66, 14, 8, 42];
/** Between two ticks at least, along and up. */
const [APART, ABOVE] = [75, 42];
const CAP = 5;
const MARGIN = 0.06;

const number = (value) => typeof value === "number" && Number.isFinite(value);
const colourOf = (line, place) => ((line.colour ?? place) % 7) + 1;

/** Round numbers in a range. */
export function ticks(low, high, log, count) {
  if (log) {
    const [from, to] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
    if (to > from) return Array.from({ length: to - from + 1 }, (_, place) => 10 ** (from + place));
  }
  const raw = (high - low || 1) / count;
  const unit = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((each) => each * unit).find((each) => each >= raw) ?? raw;
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, place) => Number(((first + place) * step).toPrecision(12)));
}

/**
 * Where values lie between two places; `margin` is free beyond the least and the greatest.
 * @param {any[]} lists @param {{log?: boolean, range?: number[], margin?: number}} options
 * @param {number} from @param {number} to
 */
export function scale(lists, { log, range, margin = 0 }, from, to) {
  const known = lists.flat().filter((value) => number(value) && (!log || value > 0));
  let [low, high] = range ?? (known.length ? [Math.min(...known), Math.max(...known)] : [0, 1]);
  if (low === high) [low, high] = log ? [low / 2, high * 2]
    : [-1, 1].map((side) => low + side * (Math.abs(low) / 10 || 1));
  else if (!range && !log) [low, high] = [low - margin * (high - low), high + margin * (high - low)];
  const share = (value) => (log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));
  const at = (value) => from + share(value) * (to - from);
  const value = (place) => {
    const part = (place - from) / (to - from);
    return log ? low * (high / low) ** part : low + part * (high - low);
  };
  return { at, value, ticks: ticks(low, high, log, Math.abs(to - from) / (from < to ? APART : ABOVE)) };
}

/** A path through places and values, broken where there is none. */
export function path(xs, ys, across, up) {
  let open = false;
  return xs.map((value, row) => {
    const here = number(ys[row]) ? [across.at(value), up.at(ys[row])] : [NaN];
    const known = here.every(Number.isFinite);
    const move = known ? `${open ? "L" : "M"}${here.map((each) => each.toFixed(1)).join(" ")}` : "";
    open = known;
    return move;
  }).join("");
}

/** The places of all lines. */
const placesOf = ({ x, series }) => [...new Set([x.values, ...series.map((line) => line.x ?? [])].flat())];

/** All lines at the places of all of them. */
function joined({ x, series }) {
  const own = series.some((line) => line.x);
  const all = own ? placesOf({ x, series }).sort((a, b) => a - b) : x.values;
  const at = (line, values) => {
    if (!own) return values;
    const known = new Map((line.x ?? x.values).map((place, row) => [place, values[row]]));
    return all.map((place) => known.get(place) ?? null);
  };
  return [{ ...x, values: all }, ...series.flatMap((line) => [
    { label: line.label, unit: line.unit, values: at(line, line.values) },
    ...(line.ends ?? []).map((values, end) => (
      { label: `${line.label}, ${end ? "upper" : "lower"} end`, unit: line.unit, values: at(line, values) })),
  ])];
}

/** A mark of a point and the bar of its interval. */
const pointAt = (line, x, y) => (line.points === "square"
  ? html`<rect class="point" x=${x - 4} y=${y - 4} width="8" height="8" />`
  : html`<circle class="point" cx=${x} cy=${y} r="3.5" />`);
const interval = (x, low, high) => html`<path class="line"
  d=${`M${x - CAP} ${low}h${2 * CAP}M${x} ${low}V${high}M${x - CAP} ${high}h${2 * CAP}`} />`;

function Drawn({ line, colour, places, across, up }) {
  const known = line.values.map((value, row) => ({ x: across.at(places[row]), value, row }))
    .filter(({ value }) => number(value));
  const ended = known.filter(({ row }) => line.ends?.every((ends) => number(ends[row])));
  return html`<g class=${`stroke${colour} ${line.faint ? "faint" : ""}`}>
    ${line.bare ? null : html`<path class="line" d=${path(places, line.values, across, up)}
      stroke-dasharray=${line.dash?.join(" ")} />`}
    ${ended.map(({ x, row }) => interval(x, ...line.ends.map((ends) => up.at(ends[row]))))}
    ${line.points ? known.map(({ x, value }) => pointAt(line, x, up.at(value))) : null}
  </g>`;
}

/** How wide a box is, as it is seen. */
export function useWidth() {
  const box = useRef(null);
  const [width, setWidth] = useState(0);
  useLayoutEffect(() => {
    const look = () => setWidth(Math.round(box.current.clientWidth));
    const resized = new ResizeObserver(look);
    resized.observe(box.current);
    look();
    return () => resized.disconnect();
  }, []);
  return [box, Math.max(width, 200)];
}

/** Grid, ticks and names of an axis along and of one or two up. */
export const Axes = ({ across, ups, right, bottom, along, upward, whole }) => html`
  ${across.ticks.filter((tick) => !whole || Number.isInteger(tick)).map((tick) => html`
    <path class="grid-line" d=${`M${across.at(tick)} ${TOP}V${bottom}`} />
    <text x=${across.at(tick)} y=${bottom + 16} text-anchor="middle">${digits(tick, 6)}</text>`)}
  ${ups.slice(0, 2).map((up, side) => up.ticks.map((tick) => html`
    ${side ? null : html`<path class="grid-line" d=${`M${LEFT} ${up.at(tick)}H${right}`} />`}
    <text x=${side ? right + 6 : LEFT - 6} y=${up.at(tick) + 4} text-anchor=${side ? "start" : "end"}>
      ${digits(tick, 6)}</text>`))}
  ${upward.slice(0, 2).map((said, side) => html`<text text-anchor="middle"
    transform=${`translate(${side ? right + LEFT - 10 : 14} ${(TOP + bottom) / 2}) rotate(-90)`}>
      ${printed(said)}</text>`)}
  <text x=${(LEFT + right) / 2} y=${bottom + BOTTOM - 8} text-anchor="middle">${printed(along)}</text>`;

/**
 * Marks that run along the lines with what moves beside them.
 * @param {{part: any, places: number[], dots: any[], bottom: number}} props
 */
function Running({ part, places, dots, bottom }) {
  const drawn = useRef(null);
  // At once with the lines: as many marks as there are.
  useLayoutEffect(() => part.subscribe((time) => {
    const now = time % 1;
    const [line, ...marks] = drawn.current.children;
    const x = between(places, now);
    line.setAttribute("d", `M${x} ${TOP}V${bottom}`);
    marks.forEach((mark, row) => {
      mark.setAttribute("cx", x);
      mark.setAttribute("cy", between(dots[row].values, now));
    });
  }), [part, places, dots, bottom]);
  return html`<g ref=${drawn} class="passing"><path class="passing" />
    ${dots.map(({ colour }) => html`<circle class=${`runs fill${colour}`} r="4.5" />`)}</g>`;
}

/** The same in the units that the reader is shown. @param {Shown} props @returns {Shown} */
function inUnits(props) {
  if (asKept()) return props;
  const { x, series, marks, bands, y, onPick } = props;
  const along = (place) => shown(place, x.unit)[0];
  // Who picks is told in the unit that was given.
  return { ...props, x: column(x), y: y && headed(y).head, onPick: onPick && ((place) => onPick(back(place, x.unit))),
    bands: bands?.map(({ from, to }) => ({ from: along(from), to: along(to) })),
    marks: marks?.map((each) => ({ x: along(each.x), y: shown(each.y, series[0]?.unit)[0] })),
    series: series.map((line) => ({ ...column(line), x: line.x?.map(along), ends: /** @type {any} */ (
      line.ends?.map((values) => values.map((each) => shown(each, line.unit)[0]))) })) };
}

/** @param {Shown} given */
export function Plot(given) {
  const { title, x, bands = [], marks = [], y, height = 260, log, xlog, range, onPick, running,
    series } = inUnits(given);
  const [box, width] = useWidth();
  const [pointed, setPointed] = useState(null);
  // Of what there is no number of, nothing is drawn and nothing said.
  const lines = series.map((line, place) => ({ ...line, colour: colourOf(line, place) }))
    .filter(({ values }) => values.some(number));
  const units = [...new Set(lines.map(({ unit }) => unit ?? ""))];
  const of = (unit) => lines.filter((line) => (line.unit ?? "") === unit);
  const [right, bottom] = [width - (units.length > 1 ? LEFT : RIGHT), height - BOTTOM];
  const across = scale([x.values, ...lines.map((line) => line.x ?? [])], { log: xlog }, LEFT, right);
  const ups = units.map((unit, side) => {
    const lists = of(unit).flatMap((line) => [line.values, ...(line.ends ?? [])]);
    return scale(lists, { log, range: side ? undefined : range, margin: MARGIN }, bottom, TOP);
  });
  const upOf = (line) => ups[units.indexOf(line.unit ?? "")];
  const axis = units.map((unit) => y ?? (of(unit).length === 1 ? named(of(unit)[0]) : unit));
  const places = placesOf({ x, series: lines });
  const placeOf = (event) => across.value(event.clientX - event.currentTarget.getBoundingClientRect().left + LEFT);
  const point = (event) => {
    const wanted = across.at(placeOf(event));
    const far = (place) => Math.abs(across.at(place) - wanted);
    setPointed(places.reduce((best, place) => (far(place) < far(best) ? place : best), places[0]));
  };
  const there = (line) => line.values[(line.x ?? x.values).indexOf(pointed)];
  return html`<${Figure} title=${title} columns=${() => joined({ x, series: lines })}>
    <div class=${onPick ? "canvas pick" : "canvas"} ref=${box}>
      <svg class="drawn" width=${width} height=${height} viewBox=${`0 0 ${width} ${height}`} role="img"
        data-along=${`${LEFT} ${right}`}
        aria-label=${`${title}: ${lines.map(({ label }) => label).join(", ")} over ${x.label}; the numbers are in the
          table beneath`}>
        ${bands.map(({ from, to }) => html`<rect class="band" x=${across.at(from)} y=${TOP}
          width=${across.at(to) - across.at(from)} height=${bottom - TOP} />`)}
        <${Axes} ...${{ across, ups, right, bottom }} along=${named(x)} upward=${axis} whole=${x.whole} />
        ${lines.map((line) => html`<${Drawn} key=${line.label} line=${line} colour=${line.colour} across=${across}
          places=${line.x ?? x.values} up=${upOf(line)} />`)}
        ${marks.filter((mark) => number(mark.x)).map((mark) => (number(mark.y)
          ? html`<circle class="here" cx=${across.at(mark.x)} cy=${ups[0].at(mark.y)} r="5" />`
          : html`<path class="here" stroke-dasharray="4 4" d=${`M${across.at(mark.x)} ${TOP}V${bottom}`} />`))}
        ${running ? html`<${Running} part=${running} bottom=${bottom} places=${x.values.map((each) => across.at(each))}
          dots=${lines.filter((line) => !line.x && line.values.every(number)).map((line) => ({
            colour: line.colour, values: line.values.map((value) => upOf(line).at(value)) }))} />` : null}
        ${pointed === null ? null : html`<path class="passing" d=${`M${across.at(pointed)} ${TOP}V${bottom}`} />`}
        <rect class="over" x=${LEFT} y=${TOP} width=${right - LEFT} height=${bottom - TOP}
          onPointerMove=${point} onPointerLeave=${() => setPointed(null)}
          onClick=${(event) => onPick?.(placeOf(event))} />
      </svg>
    </div>
    <ul class="legend" aria-hidden="true">
      ${lines.map((line) => html`<li key=${line.label}>
        <svg width="26" height="12" class=${`stroke${line.colour}`}>
          ${line.bare ? null : html`<path d="M0 6H26" stroke-dasharray=${line.dash?.join(" ")} />`}
          ${line.ends ? interval(13, 1, 11) : null}${line.points ? pointAt(line, 13, 6) : null}</svg>
        ${line.ends ? `${line.label}, with its interval` : line.label}
        ${pointed === null ? null : html` <b class="passing">${digits(there(line) ?? NaN, 4)}</b>`}</li>`)}
      ${pointed === null ? null : html`<li class="passing">at ${digits(pointed, 4)} ${x.unit ?? ""}</li>`}
    </ul>
  <//>`;
}
