/** A server that does not answer is asked until it does; what waits for it is asked again then. */
import { signal } from "../vendor/preact.js";

/** How often it is asked, ms. */
const EVERY = 1000;
/** How often it has come back; read in a component, it is drawn again when that happens. */
export const returned = signal(0);
let waiting = false;

/** Wait until the server answers, once for all who do. */
export function awaitServer() {
  if (waiting) return;
  waiting = true;
  const look = () => setTimeout(() => fetch("icon.svg", { cache: "no-store" }).then(() => {
    waiting = false;
    returned.value += 1;
  }, look), EVERY);
  look();
}
