/** A friction law as it was fitted: against what was measured, and what the data tell of each of its parameters. */
import { html } from "../vendor/preact.js";
import { Plot } from "./plot.js";
import { Table } from "./table.js";
import { digits } from "./units.js";
import { useData } from "./work.js";

const AGAINST = ["measured", "deviation", "predicted"];
/** Deviations to the ends of 95 %. */
const ENDS = 1.96;
/** Two numbers of the same thing, one of them through percent. */
const SAME = 1e-5;

/** The frequency of each measurement, where these are the segments that were kept; else null. */
function frequencies(measured, segments) {
  const kept = segments.filter(({ quality }) => quality !== "refused");
  const same = kept.length === measured.length && kept.every(({ torque_change_percent: change }, at) =>
    Math.abs(1 + change / 100 - measured[at]) < SAME);
  const found = kept.map(({ commanded_Hz: each }) => each);
  return same && found.every(Number.isFinite) && new Set(found).size === found.length ? found : null;
}

/** What was measured with its interval, and the law beside it. */
function Against({ data, segments }) {
  const [measured, deviation, predicted] = AGAINST.map((key) => data[key].values);
  const own = frequencies(measured, segments);
  const order = measured.map((_, at) => at);
  if (own) order.sort((one, other) => own[one] - own[other]);
  const percent = (values) => order.map((at) => 100 * (values[at] - 1));
  const ends = [-1, 1].map((side) => percent(measured.map((each, at) => each + side * ENDS * deviation[at])));
  const x = own ? { label: "frequency", unit: "Hz", values: order.map((at) => own[at]) }
    : { label: "measurement", whole: true, values: order.map((at) => at + 1) };
  return html`<${Plot} title="The fitted law against what was measured" x=${x} y="change of torque (%)" series=${[
    { label: "measured", unit: "%", values: percent(measured), ends, points: "round", bare: true },
    { label: "fitted law", unit: "%", values: percent(predicted), points: "square", colour: 1, dash: [8, 4],
      bare: order.length === 1 }]} />`;
}

/**
 * @param {{work: any, segments: any[]}} props `work` that fitted it, or whose answer
 *   ships; `segments` that were measured
 */
export function Law({ work, segments }) {
  const found = work.data.answer;
  const data = useData(work, AGAINST);
  const ended = (end) => (end === null ? "open" : digits(end, 4));
  const sure = ({ identifiable, why }) => html`<span class=${identifiable ? "good" : "warn"}>
    ${identifiable ? "✓ both ends" : "~ an end is open"}</span> ${why}`;
  const most = Math.max(...found.residuals.map(Math.abs));
  return html`<p class="big">The law <b>${found.law}</b> misses what was measured by at most${" "}
      <b>${digits(most, 2)}</b> of its standard deviations.</p>
    ${data ? html`<${Against} data=${data} segments=${segments} />
      <p class="says">Bars are of 95 %, and count how uncertain the conditions are as well, such as the amplitude, where
        the measurements tell: so they are wider than those of the change by itself.</p>` : null}
    <${Table} region="parameters" wide="whole cards law" rows=${found.parameters} columns=${[
      ["parameter", ({ key }) => key, "row"],
      ["value", ({ value, units }) => `${digits(value, 4)} ${units}`, "right"],
      ["95 % interval", ({ ci95 }) => ci95.map(ended).join(" to "), "right"],
      ["what the data tell", sure]]} />
    <p class="says">χ² ${digits(found.chi2, 4)}, ${found.points} ${
      found.points === 1 ? "measurement" : "measurements"}, ${
      found.dof > 0 ? `${found.dof} ${found.dof === 1 ? "degree" : "degrees"} of freedom.`
      : "no degree of freedom: as many parameters as measurements tell nothing of how well the law fits."}</p>`;
}
