/** How the picture of a shaken body moves: from a cycle of an answer to what is drawn at a moment of it. */

export const NAME = "motion.js";
/** How long a cycle is shown, s. */
export const SHOWN = 3;
/** The drawing: its size, the middle of the body, half of the body, how far a bristle bends and friction reaches. */
export const [WIDTH, HEIGHT] = [720, 300];
export const [X, Y] = [330, 150];
export const [HALF_X, HALF_Y] = [72, 46];
export const [BEND, REACH, TILE] = [20, 92, 36];
/** Below which width of the window only the middle is seen, px; from where, and how wide that is. */
export const NARROW = 600;
/** @type {[number, number]} */
export const MIDDLE = [92, 490];
/** From above and from the side: the places of bristles, from the middle of the body. */
const PLACES = [-54, -27, 0, 27, 54].flatMap((x) => [-28, 0, 28].map((y) => [x, y]));
const FEET = [-60, -40, -20, 0, 20, 40, 60].map((x) => [x, 0]);
/** Of what is carried at most; beyond it a bristle slips. */
const SLIPS = 0.97;

/** A value between those that are known, by the part of all of them. */
export function between(values, part) {
  const place = part * (values.length - 1);
  const low = Math.min(Math.floor(place), values.length - 2);
  return values[low] + (place - low) * (values[low + 1] - values[low]);
}

/** How far something has gone, from its velocity over the cycle: mean free, of unit swing. */
function travelled(velocity) {
  const gone = velocity.reduce((sums, each) => [...sums, sums.at(-1) + each], [0]).slice(0, -1);
  const drift = (gone.at(-1) + velocity.at(-1)) / velocity.length;
  return gone.map((each, row) => each - drift * row);
}

export const arrow = (dx, dy, head = 9) => {
  const size = Math.hypot(dx, dy);
  if (size < 2) return "";
  const [ux, uy] = [dx / size, dy / size];
  const back = Math.min(head, size);
  const wing = (side) => `${dx - back * ux + side * 0.45 * back * uy} ${dy - back * uy - side * 0.45 * back * ux}`;
  return `M0 0L${dx} ${dy}M${wing(1)}L${dx} ${dy}L${wing(-1)}`;
};

/**
 * What moves in the picture, made from an answer.
 * @param {Record<string, number[]>} series of a cycle, SI @param {number} limit mu F_N, N
 */
export function motionOf(series, limit) {
  // What is nothing over all of the cycle is not sent.
  const none = series.force.map(() => 0);
  const { base_velocity: along = none, base_velocity_across: across = none, base_velocity_up: up = none } = series;
  const { force, force_across: aside = none, normal_force: load = none, sliding_velocity: slides = none } = series;
  const side = up.some((each) => Math.abs(each) > 1e-12);
  const places = [along, side ? up : across].map(travelled);
  const swing = Math.max(...places.flat().map(Math.abs)) || 1;
  // To scale, the body goes on by so much of the swing in a cycle; more than a tile could not be followed.
  const onward = Math.min(slides.reduce((sum, each) => sum + each, 0) / swing, 3);
  const mean = load.reduce((sum, each) => sum + each, 0) / load.length;
  const holds = load.map((each) => Math.max(limit * (each / mean), 0));
  const loss = (values) => values.map((value) => value / limit);
  return { side, swing, onward, places, load, mean, pulls: loss(force), asides: loss(aside), holds: loss(holds) };
}

/** Draw a moment into the picture. @param {number} time in cycles */
export function draw(picture, moving, time) {
  const part = time % 1;
  const at = (values) => between(values, part);
  const put = (name, attributes) => picture.querySelectorAll(`[data-of=${name}]`).forEach((each) => {
    for (const [key, value] of Object.entries(attributes)) each.setAttribute(key, value);
  });
  const { side, swing, places, onward } = moving;
  const size = 0.62 * TILE;
  const [x, y] = places.map((values) => (size * at(values)) / swing);
  const gone = (size * onward * time) % TILE;
  put("plate", { transform: `translate(${(x - gone) % TILE} ${side ? -y : -y % TILE})` });
  const [pull, aside, held] = [at(moving.pulls), at(moving.asides), at(moving.holds)];
  const load = at(moving.load) / moving.mean;
  const [dx, dy] = [-BEND * pull, side ? 0 : BEND * aside];
  const slips = Math.hypot(pull, aside) >= SLIPS * held;
  const sunk = side ? Math.max(-7, Math.min(7, 7 * (load - 1))) - y : 0;
  put("body", { transform: `translate(0 ${sunk})` });
  const open = side && load <= 1e-6;
  const bristle = side
    ? FEET.map(([px]) => `M${px} ${HALF_Y + sunk}Q${px} ${HALF_Y + 12 + sunk / 2 - y / 2} ${px + dx} ${
      open ? HALF_Y + sunk + 18 : HALF_Y + 22 - y}`)
    : PLACES.map(([px, py]) => `M${px} ${py}l${dx} ${dy}`);
  put("bristles", { d: bristle.join(""), class: `bristles ${open ? "free" : slips ? "slips" : "holds"}` });
  if (!side) {
    const tips = PLACES.map(([px, py]) => `M${px + dx - 2.5} ${py + dy}h5`).join("");
    put("tips", { d: tips, class: slips ? "slips" : "holds" });
  }
  put("now", { d: arrow(-REACH * pull, side ? 0 : REACH * aside) });
  put("dot", { cx: -REACH * pull, cy: side ? 0 : REACH * aside });
  put("load", { d: side ? arrow(0, 42 * load) : "" });
}

/**
 * What draws a body at a time, s, into its picture.
 * @param {Element} picture @param {{series: Record<string, number[]>, limit: number}} of as of `motionOf`
 */
export function playing(picture, { series, limit }) {
  const made = motionOf(series, limit);
  if (innerWidth < NARROW) picture.setAttribute("viewBox", `${MIDDLE[0]} 0 ${MIDDLE[1]} ${HEIGHT}`);
  return (seconds) => draw(picture, made, seconds / SHOWN);
}
