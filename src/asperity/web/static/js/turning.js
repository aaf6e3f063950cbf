/** How the picture of a gearset moves: threads, wheel, and where teeth touch; nothing here needs the page. */
import { shade } from "./colours.js";
import { poseOf, pressedBy, sectionOf, sliding, touching } from "./mesh.js";

export const NAME = "turning.js";
/** Marks on the worm's core, by which its turning is seen: their angles, and how many along it. */
const MARKS = [0, 1, 2, 3, 4, 5].map((k) => (k * Math.PI) / 3);
const DOTS = 4;

/** What has a colour at a point of the section, by speed and pressure as of Gears. */
export const valueIn = (section, { speed, pressed }) =>
  (pressed ? pressedBy(pressed) : (point) => sliding(section, point, speed));

/**
 * What draws a gearset at a time, s, into its picture.
 * @param {Element} picture @param {{geometry: any, mode: string, speed: number, pressed?: any, range: number[]}} of
 *   as of Gears; `range` of what has the colours
 */
export function playing(picture, { geometry, mode, speed, pressed, range }) {
  const section = sectionOf(geometry);
  const valueAt = valueIn(section, { speed, pressed });
  const places = Array.from({ length: 2 * DOTS + 1 }, (_, n) => (n - DOTS + 0.5) * section.pitch);
  const core = section.apart - section.root;
  const put = (name, key, value) => picture.querySelector(`[data-of=${name}]`)?.setAttribute(key, value);
  return (seconds) => {
    const { gone, threads, along, angle, wheel, aside } = poseOf(section, mode, seconds);
    put("threads", "transform", `translate(${threads.toFixed(3)} 0)`);
    put("core", "transform", `translate(${along.toFixed(3)} 0)`);
    // The wheel turns as the threads push it.
    put("wheel", "transform", `translate(${aside.map((each) => each.toFixed(3)).join(" ")})
      rotate(${((-wheel * 180) / Math.PI).toFixed(4)})`);
    const marks = MARKS.map((each) => [Math.cos(each + angle), Math.sin(each + angle)])
      .filter(([seen]) => seen > 0).map(([, place]) => section.apart + core * place);
    put("marks", "d", marks.flatMap((y) => places.map((x) => `M${x.toFixed(2)} ${y.toFixed(3)}h.01`)).join(""));
    const now = touching(section, gone);
    picture.querySelectorAll("circle.touches").forEach((each, n) => {
      const at = now[n];
      each.setAttribute("visibility", at ? "visible" : "hidden");
      if (!at) return;
      each.setAttribute("cx", at.x.toFixed(3));
      each.setAttribute("cy", at.y.toFixed(3));
      each.setAttribute("fill", shade((valueAt(at) - range[0]) / (range[1] - range[0])));
    });
  };
}
