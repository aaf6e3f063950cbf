/** A grid of values as a map: what is not there yet is left free. */
import { html } from "../vendor/preact.js";
import { Figure } from "./figure.js";
import { shade, span } from "./colours.js";
import { Legend } from "./map.js";
import { Axes, BOTTOM, LEFT, RIGHT, scale, TOP, useWidth } from "./plot.js";
import { named } from "./table.js";
import { digits } from "./units.js";
import { column } from "./us.js";

const HEIGHT = 420;

/** An axis of cells: whether it goes by ratios, and where each cell of it ends. */
function cellsOf(values) {
  const [first, second] = values;
  const last = values.length - 1;
  const even = (at) => Math.abs(at(1) / at(last) - 1);
  const log = last > 1 && Math.min(...values) > 0
    && even((n) => values[n] / values[n - 1]) < even((n) => values[n] - values[n - 1]);
  const middle = (a, b) => (log ? Math.sqrt(a * b) : (a + b) / 2);
  const beyond = (a, b) => (log ? a * Math.sqrt(a / b) : a + (a - b) / 2);
  const ends = last ? [beyond(first, second), ...values.slice(1).map((value, n) => middle(values[n], value)),
    beyond(values[last], values[last - 1])] : [first - 0.5, first + 0.5];
  return { log, ends, range: [Math.min(...ends), Math.max(...ends)] };
}

/** @param {{title: string, unit: string, down: any, across: any, values: (number | null)[]}} props */
export function Heat({ title, down: lines, across: columnsOf, ...told }) {
  const [down, across, { unit, values }] = [lines, columnsOf, told].map(column);
  const [box, width] = useWidth();
  const known = values.filter((value) => value !== null);
  const range = span(known);
  const count = across.values.length;
  const [right, bottom] = [width - RIGHT, HEIGHT - BOTTOM];
  const [x, y] = [cellsOf(across.values), cellsOf(down.values)];
  const [along, up] = [scale([], x, LEFT, right), scale([], y, bottom, TOP)];
  const places = values.map((value, cell) => ({ value, x: cell % count, y: Math.floor(cell / count) }));
  const rectangle = (one) => {
    const [left, end] = [0, 1].map((side) => along.at(x.ends[one.x + side])).sort((a, b) => a - b);
    const [top, foot] = [0, 1].map((side) => up.at(y.ends[one.y + side])).sort((a, b) => a - b);
    const fill = shade((one.value - range[0]) / (range[1] - range[0]));
    return html`<rect key=${`${one.x} ${one.y}`} x=${left} y=${top} width=${end - left + 0.5} height=${foot - top + 0.5}
      fill=${fill}><title>${digits(one.value, 4)} ${unit} at ${digits(down.values[one.y], 4)},
        ${digits(across.values[one.x], 4)}</title></rect>`;
  };
  const columns = () => [{ ...down, values: places.map((one) => down.values[one.y]) },
    { ...across, values: places.map((one) => across.values[one.x]) }, { label: title, unit, values }];
  return html`<${Figure} title=${`${title}: ${known.length} of ${values.length} points`} kind="heat" columns=${columns}>
    <div class="canvas" ref=${box}><svg class="drawn" width=${width} height=${HEIGHT} role="img"
        viewBox=${`0 0 ${width} ${HEIGHT}`} aria-label=${`${title} over ${named(across)} and ${named(down)}, from
          ${digits(range[0], 3)} to ${digits(range[1], 3)} ${unit}; the numbers are in the table beneath`}>
      <${Axes} across=${along} ups=${[up]} right=${right} bottom=${bottom} along=${named(across)}
        upward=${[named(down)]} />
      ${places.filter(({ value }) => value !== null).map(rectangle)}</svg></div>
    <${Legend} range=${range} unit=${unit} label=${title} />
  <//>`;
}
