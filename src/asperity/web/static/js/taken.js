/** What is taken along of a screen, and whether what is set can be, where nothing else tells at once. */
import { useMemo, useRef } from "../vendor/preact.js";
import { commandLine, Refused, useLive } from "./api.js";
import { firstError } from "./work.js";

/** How long nothing must change before what is set is looked at, ms. */
const REST = 150;

/**
 * What is wrong with what is set, or the case with it as a file, for screens on which nothing else tells at once.
 * @param {any} body null: nothing is open yet
 */
export function useChecked(body) {
  const { data, late, ...checked } = useLive("check", body && { case: body.case, settings: body.settings }, REST);
  const wrong = late && !checked.now ? null : data?.answer.mistakes[0]?.text;
  const error = useMemo(() => (wrong ? new Refused(wrong, 400) : checked.error), [wrong, checked.error]);
  return { ...checked, late, error, now: checked.now && !error, toml: data?.toml ?? null };
}

/**
 * What is told and taken along of a screen whose answer is a job's, as `Screen` takes it: case and command as they
 * are set, what came of them once it is there, and what is refused, as soon as it is set.
 * @param {string} command @param {any[]} bodies what gives all of the screen
 * @param {import("./work.js").Job[]} works the first one's answer is the screen's
 */
export function useTaken(command, bodies, ...works) {
  const [{ stale, data }] = works;
  const { toml, error, now, ...more } = useChecked(bodies[0]);
  const last = useRef({ toml: null, lines: [""] });
  if (now) last.current = { toml, lines: bodies.map((each) => commandLine(command, each)) };
  const [own, ...others] = last.current.lines;
  const told = stale ? {} : data;
  return {
    ...more, error: error ?? firstError(...works), now: now || (!error && !stale && Boolean(data)),
    answer: { toml: last.current.toml, ...told, command: [told?.command ?? own, ...others].join(" && ") },
  };
}
