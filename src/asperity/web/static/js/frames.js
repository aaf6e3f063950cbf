/** What moves while it is seen, unless the reader wants nothing to move. */
import { html, useLayoutEffect, useRef, useState } from "../vendor/preact.js";

export const still = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
/** A picture that was long away does not jump, ms. */
const MOST = 100;

/**
 * Call a drawing with the time it has run, s, while its element is in the window and it plays.
 * @param {{current: Element | null}} element @param {(seconds: number) => void} draw
 * @param {unknown[]} of what makes the drawing another
 */
export function usePlayed(element, draw, of) {
  const [plays, setPlays] = useState(!still());
  const time = useRef(0);
  // By layout: an effect waits for the next picture, and what is stopped would still move in it.
  useLayoutEffect(() => {
    if (!element.current) return;
    draw(time.current);
    if (!plays) return;
    let [frame, before] = [0, 0];
    const next = (now) => {
      time.current += Math.min(now - (before || now), MOST) / 1000;
      before = now;
      draw(time.current);
      frame = requestAnimationFrame(next);
    };
    const stop = () => (cancelAnimationFrame(frame), (frame = 0));
    const start = () => frame || ((before = 0), (frame = requestAnimationFrame(next)));
    const seen = new IntersectionObserver(([entry]) => (entry.isIntersecting ? start() : stop()));
    seen.observe(element.current);
    return () => (seen.disconnect(), stop());
  }, [plays, ...of]);
  return { plays, setPlays };
}

export const Play = ({ plays, setPlays }) => html`<button type="button" onClick=${() => setPlays(!plays)}>
  ${plays ? "stop the motion" : "let it move"}</button>`;
