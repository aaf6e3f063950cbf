/** What plays in a shared file, where there is nothing else of the page. */

const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
/** A picture that was long away does not jump, ms. */
const MOST = 100;

/** Numbers as they lay in memory. @param {string} _ @param {any} value */
const restored = (_, value) => (value?.base64 === undefined ? value
  : new globalThis[value.kind](Uint8Array.from(atob(value.base64), (sign) => sign.charCodeAt(0)).buffer));

/**
 * Play all that moves, while it is seen, at one time, with one button.
 * @param {Record<string, any>} modules by name @param {string} told what each of them plays, as text
 * @param {HTMLElement} button
 */
export function playAll(modules, told, button) {
  const shown = new Set();
  const look = new IntersectionObserver((entries) => entries.forEach(({ target, isIntersecting }) =>
    (isIntersecting ? shown.add(target) : shown.delete(target))));
  const moves = JSON.parse(told, restored).map(({ at, module, of }) => {
    const element = /** @type {Element} */ (document.querySelector(`[data-moves="${at}"]`));
    look.observe(element);
    return { element, draw: modules[module].playing(element, of) };
  });
  let [time, before, plays] = [0, 0, false];
  const next = (now) => {
    if (!plays) return;
    time += Math.min(now - (before || now), MOST) / 1000;
    before = now;
    moves.forEach(({ element, draw }) => shown.has(element) && draw(time));
    requestAnimationFrame(next);
  };
  const turn = (on) => {
    [plays, before] = [on, 0];
    button.textContent = on ? "stop the motion" : "let it move";
    requestAnimationFrame(next);
  };
  moves.forEach(({ draw }) => draw(0));
  button.onclick = () => turn(!plays);
  turn(!still);
}
