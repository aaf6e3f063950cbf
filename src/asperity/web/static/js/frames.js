/** What moves while it is seen, if the reader wants that; and what of it a shared file takes along. */
import { html, signal, useLayoutEffect, useRef } from "../vendor/preact.js";

export const still = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
/** Whether what moves does: one switch for all of it. */
export const plays = signal(!still());
/** A picture that was long away does not jump, ms. */
const MOST = 100;

/**
 * What moves each element that is shown: a module that needs nothing of the page, and what it plays.
 * @type {WeakMap<Element, {module: string, of: any}>} `of` may be a function that makes it, at once or later
 */
export const moving = new WeakMap();

/**
 * Play a module in an element while that is in the window.
 * @param {{current: Element | null}} element
 * @param {{playing: (element: Element, of: any) => (seconds: number) => void, NAME: string}} module
 * @param {any} of what it plays @param {unknown[]} when what makes that another
 */
export function usePlayed(element, module, of, when) {
  const runs = plays.value;
  const time = useRef(0);
  // By layout: an effect waits for the next picture, and what is stopped would still move in it.
  useLayoutEffect(() => {
    if (!element.current) return;
    moving.set(element.current, { module: module.NAME, of });
    const draw = module.playing(element.current, of);
    draw(time.current);
    if (!runs) return;
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
  }, [runs, ...when]);
}

export const Play = () => html`<button type="button" onClick=${() => (plays.value = !plays.peek())}>
  ${plays.value ? "stop the motion" : "let it move"}</button>`;
