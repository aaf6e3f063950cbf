/** Pictures one after the other, of what is drawn in space; nothing here needs the page. */

export const NAME = "pictures.js";

/**
 * @param {HTMLImageElement} image
 * @param {{pictures: string[], seconds: number}} of their addresses, and how long all of them take, s
 */
export function playing(image, { pictures, seconds }) {
  let shown = -1;
  return (time) => {
    const at = Math.floor(((time / seconds) % 1) * pictures.length);
    if (at !== shown) image.src = pictures[at];
    shown = at;
  };
}
