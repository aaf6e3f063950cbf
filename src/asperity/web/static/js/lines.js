/** How lines of contact move over the map of a flank, and a mark beside them; nothing here needs the page. */

export const NAME = "lines.js";

/**
 * @param {Element} box of the map and of plots over the same angle
 * @param {{lines: string[], seconds: number}} of paths at angles that go over a pitch, and how long it takes, s
 */
export function playing(box, { lines, seconds }) {
  const path = box.querySelector(".touching");
  const marks = [...box.querySelectorAll("path.here")].map((mark) => {
    const [from, to] = String(mark.closest("svg")?.dataset.along).split(" ").map(Number);
    return { mark, from, to, up: String(mark.getAttribute("d")).replace(/^M[^V]*?(?= )/, "") };
  });
  return (time) => {
    const part = (time / seconds) % 1;
    path?.setAttribute("d", lines[Math.floor(part * lines.length)]);
    for (const { mark, from, to, up } of marks) {
      mark.setAttribute("d", `M${(from + part * (to - from)).toFixed(1)}${up}`);
    }
  };
}
