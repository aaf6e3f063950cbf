/** Fingers: what scrolls moves nothing, and what moves scrolls nothing. */
import { useRef } from "../vendor/preact.js";

/** So far a finger goes along a slider before it drags it; what goes more up or down scrolls, px. */
const SURE = 8;

/**
 * What keeps a slider where it is while a finger that scrolls passes over it.
 * @param {(event: any) => void} moved what a slider that is dragged does
 */
export function useTouch(moved) {
  const finger = useRef(null);
  const back = ({ currentTarget }) => finger.current && (currentTarget.value = finger.current.value);
  const over = () => (finger.current = null);
  return {
    onPointerDown: ({ pointerType, clientX, clientY, currentTarget }) =>
      (finger.current = pointerType === "touch"
        ? { x: clientX, y: clientY, value: currentTarget.value, sure: false } : null),
    onPointerMove: (event) => {
      const { x, y, sure } = finger.current ?? { sure: true };
      if (sure) return;
      const [along, aside] = [event.clientX - x, event.clientY - y].map(Math.abs);
      if (along > SURE && along > aside) finger.current.sure = true;
    },
    // The browser takes the finger for its own: it scrolls.
    onPointerCancel: (event) => (back(event), over()),
    onPointerUp: (event) => (finger.current?.sure === false && back(event), over()),
    onInput: (event) => (finger.current?.sure === false ? back(event) : moved(event)),
  };
}

/** Where a finger began. */
let start = null;
/** For a handle in a drawing that is moved along: a finger that goes up or down scrolls the page as before. */
export const along = {
  onTouchStart: ({ touches: [{ clientX, clientY }] }) => (start = { x: clientX, y: clientY }),
  onTouchMove: (event) => {
    const [{ clientX, clientY }] = event.touches;
    if (start && Math.abs(clientX - start.x) >= Math.abs(clientY - start.y)) event.preventDefault();
  },
};
/** For a handle that is moved any way. */
export const anyWay = { onTouchStart: (event) => event.preventDefault() };
