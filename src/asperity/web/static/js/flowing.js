/** Marks that run along strips of power, the way it goes; nothing here needs the page. */

export const NAME = "flowing.js";
/** Between two marks, and how far they go in a second. */
const [APART, SPEED] = [18, 24];

/** @param {Element} picture */
export const playing = (picture) => {
  const lines = [...picture.querySelectorAll(".runs-along")];
  return (seconds) => lines.forEach((line) =>
    line.setAttribute("stroke-dashoffset", String((-SPEED * seconds) % APART)));
};
