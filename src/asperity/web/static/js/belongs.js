/** Where a job belongs: its screen, and what stands in the address there. */
import { axisFrom } from "./axes.js";
import { ANY } from "./told.js";
import { nameOf } from "./work.js";

/** By command: the screen, and what tells the job from another of the command there. */
const SCREENS = {
  sweep: ["sweep"], optimise: ["size"], flank: ["flanks"], directions: ["drive"], locking: ["drive"],
  rate: ["gear", () => "-report"], slide: ["slide", () => "-report"],
  drive: ["drive", ({ options }) => (options?.static ? "-static" : "")],
  block: ["block", ({ settings }) => `-${settings?.["solve.method"]}`],
  "rig reduce": ["rig"], "rig import": ["rig"], "rig run": ["rig"], fit: ["rig"],
};
/** The case of a rig that a recording without one is seen with. */
const RIG = "disc-on-disc";

/**
 * The screen of a job and its params; null of a command that has none.
 * @param {any} job as it is listed @param {any[]} jobs all that are
 * @returns {{screen: string, params: Record<string, string>} | null}
 */
export function belongsTo({ id, asked, files }, jobs) {
  if (!asked) return null;
  const [screen, slot] = SCREENS[asked.command] ?? [];
  // What has no screen of its own is told as its command tells it.
  if (!screen) return { screen: "answer", params: { [`job-${ANY}`]: `${id}.` } };
  const { command, settings = {}, options = {}, arguments: given = {} } = asked;
  // A block's method is set by its screen.
  const own = Object.entries(settings).filter(([path]) => command !== "block" || path !== "solve.method");
  const params = {
    ...Object.fromEntries(own.map(([path, text]) => [`set.${path}`, text])),
    ...(asked.case && { case: asked.case }), [`job-${command}${slot?.(asked) ?? ""}`]: `${id}.${nameOf(asked)}`,
  };
  if (command === "sweep") {
    const [x, y] = [options.over].flat().map(axisFrom);
    return { screen, params: { ...params, x, y: y ?? "none" } };
  }
  if (screen !== "rig") return { screen, params };
  if (command === "rig reduce") return { screen, params: { case: RIG, ...params, rec: given.recordings[0] } };
  if (command === "fit") {
    const before = jobs.find((each) => given.data === `jobs/${each.id}/measurements.csv`);
    const found = before && belongsTo(before, jobs);
    return found && { screen, params: { ...found.params, ...params, free: options.free } };
  }
  const file = files.find((each) => each.endsWith(".nc") && each !== "run.nc");
  const rec = file && `jobs/${id}/${file}`;
  return rec ? { screen, params: { case: asked.case || RIG, rec, made: rec } } : null;
}
