/** Axes of a grid: as they stand in the address, and as `--over` takes them. */
import { fieldOf } from "./form.js";
import { digits, inUnit, split } from "./units.js";

/** The most points of an axis. */
export const MOST = 500;

/** An axis as it stands in the address; its count is NaN where what stands there is refused. */
export function axisOf(text) {
  const [path, from, to, points = "2", spacing] = text.split("~");
  const typed = points.trim() ? Number(points) : NaN;
  const count = Number.isInteger(typed) && typed >= 1 && typed <= MOST ? typed : NaN;
  return path.includes(".") ? { path, from, to, points, count, spacing } : null;
}

/** Why an end of an axis is refused; "" where it is not. @param {any} axis @param {string} end */
export function refusedEnd(axis, end) {
  const { path, spacing } = axis;
  const [number, unit] = split(axis[end]);
  const field = fieldOf(path);
  const usual = field?.unit || split(field?.example)[1];
  const must = !Number.isFinite(number) ? `a number${usual ? ` with its unit, such as ${field.example}` : ""}`
    : unit && field && field.kind !== "quantity" ? "a number without a unit"
    : unit && Number.isNaN(inUnit(axis[end], usual || unit)) ? `in a unit such as ${usual}`
    : spacing === "log" && !(number > 0) ? "above 0 where steps are even ratios" : "";
  return must && `${JSON.stringify(axis[end])}; it must be ${must}`;
}

export const textOf = ({ path, from, to, points, spacing }) => [path, from, to, points, spacing].join("~");

/** The values of an axis as `--over` takes them. */
export function over({ path, from, to, count, spacing }) {
  const [low, unit] = split(from);
  const [high, other] = split(to);
  const usual = other || unit || fieldOf(path)?.unit || "";
  const first = unit && unit !== usual ? inUnit(from, usual) : low;
  const at = (place) => {
    const share = count > 1 ? place / (count - 1) : 0;
    return spacing === "log" ? first * (high / first) ** share : first + (high - first) * share;
  };
  const step = digits((high - first) / (count - 1), 6);
  const even = spacing !== "log" && count > 1 && first + (count - 1) * Number(step) === high && Number(step) > 0;
  const values = even ? [`${digits(first, 12)}:${digits(high, 12)}:${step}`]
    : Array.from({ length: count }, (_, place) => digits(at(place), 6));
  return `${path}=${values.join(",")}${usual ? ` ${usual}` : ""}`;
}

/** What stands in the address for what `--over` was given, as near as an axis comes to it. @param {string} text */
export function axisFrom(text) {
  const [path, list] = text.split(/=(.*)/);
  const [, values, unit = ""] = /^([^ ]*)( .*)?$/.exec(list) ?? ["", list, ""];
  const range = values.split(":").map(Number);
  const points = range.length === 3 ? Math.round((range[1] - range[0]) / range[2]) + 1 : values.split(",").length;
  const [from, to] = range.length === 3 ? range : [values.split(",")[0], values.split(",").at(-1)];
  const axis = { path, from: `${from}${unit}`, to: `${to}${unit}`, points: String(points), count: points };
  return textOf({ ...axis, spacing: over({ ...axis, spacing: "log" }) === text ? "log" : "even" });
}
