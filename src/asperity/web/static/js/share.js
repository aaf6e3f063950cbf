/** A screen as one file that works without server and network: what is shown, what it was made from, the case. */
import { about } from "./api.js";
import { movesOf, scriptOf } from "./embedded.js";
import { download, fileOf } from "./figure.js";

const STYLES = ["style.css", "gear.css", "stage.css"];
/** What of a screen is of use with a server only. */
const OF_SERVER = ".controls, .asks-for, .work, .actions, .beneath, select, input, dialog, .busy, .over, .hidden, nav,"
  + " .choice, .passing, .to-press, .grip, .drop, .of-server, .on-paper, .taking, label:has(input), label:has(select)";
/** A command that takes longer to read is folded away: what is found comes first. */
const LONG = 160;
const made = (said, command) => (command.length > LONG
  ? `<details class="says"><summary>${said}, by this command</summary><code>${command}</code></details>`
  : `<p class="says">${said}: <code>${command}</code></p>`);

/** What a file has at most, bytes: so much is sent by every means. */
const MOST = 1_950_000;
const POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";

const text = async (path) => (await fetch(path)).text();
const safe = (said) => String(said ?? "").replace(/[&<>"]/g, (sign) =>
  ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[sign]);
/** JSON within a script: nothing in it ends the script. */
const within = (json) => json.replaceAll("<", "\\u003c");
const inScript = (value) => within(JSON.stringify(value));

/** A picture as text, twice as fine as it is seen. @param {HTMLImageElement} image */
function drawn(image) {
  const canvas = document.createElement("canvas");
  const { width, height } = image.getBoundingClientRect();
  [canvas.width, canvas.height] = [2 * width, 2 * height];
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas.toDataURL();
}

/** In a copy, a picture in the place of each drawing in space that moves; others are left out. */
function flattened(copy) {
  copy.querySelectorAll("canvas").forEach((each) => {
    if (!each.dataset.moves) return each.remove();
    const image = copy.ownerDocument.createElement("img");
    Object.assign(image, { className: "space", alt: each.getAttribute("aria-label")?.split(";")[0] ?? "" });
    image.dataset.moves = each.dataset.moves;
    each.replaceWith(image);
  });
}

/** What is seen of a screen, without what is of use with a server only. @param {Element} body */
function seen(body) {
  // In a document of its own, which loads nothing.
  const copy = /** @type {HTMLElement} */ (document.implementation.createHTMLDocument("").importNode(body, true));
  const images = [...body.querySelectorAll("img")];
  copy.querySelectorAll("img").forEach((each, row) => each.setAttribute("src", drawn(images[row])));
  copy.querySelectorAll(OF_SERVER).forEach((each) => each.remove());
  flattened(copy);
  copy.querySelectorAll(".num button, td button, th button, li button").forEach((each) => {
    const plain = copy.ownerDocument.createElement("span");
    plain.append(...each.childNodes);
    Object.assign(plain.dataset, /** @type {HTMLElement} */ (each).dataset);
    each.replaceWith(plain);
  });
  copy.querySelectorAll("button, .all, .stage .row > label").forEach((each) => each.remove());
  copy.querySelectorAll("details:not(.notes)").forEach((each) => each.setAttribute("open", ""));
  copy.querySelectorAll(".fault:empty, section:empty").forEach((each) => each.remove());
  return copy.innerHTML;
}

const rows = (entries) => entries.map(({ key, symbol, value, unit, meaning, equation, source }) =>
  `<tr data-key="${safe(key)}" data-value="${safe(value)}">${[meaning || key, symbol, value, unit, equation, source]
    .map((each) => `<td>${safe(each)}</td>`).join("")}</tr>`).join("");

const again = (file) => `Save it as ${file}, and the command gives all of this again.`;
const frame = () => new Promise(requestAnimationFrame);

/**
 * Do something while a screen is as narrow as on a phone: there words of a picture must still be read, and
 * on a wide window all of it becomes larger.
 */
async function narrow(shown, act) {
  shown.classList.add("narrow");
  try {
    // What is drawn to measure is drawn anew.
    for (let n = 0; n < 4; n += 1) await frame();
    return await act();
  } finally {
    shown.classList.remove("narrow");
  }
}

/** As many of the moves as there is room for, the smallest first. */
function fitting(moves, room) {
  const kept = new Set();
  for (const each of moves.toSorted((one, other) => one.text.length - other.text.length)) {
    room -= each.text.length;
    if (room > 0) kept.add(each);
  }
  return moves.filter((each) => kept.has(each));
}

/**
 * Hand the screen over as a file.
 * @param {string} title @param {any} told the answer as the server gives it, with command and toml; `again`: what is
 *   to be done with the case, saved as a file, where the command does not give all of the screen again by it
 * @param {string} of what the case is called
 */
export async function share(title, told, of) {
  const shown = document.querySelector("main .body");
  if (!shown) return;
  const styles = (await Promise.all(STYLES.map(text))).join("\n");
  const { all, body } = await narrow(shown, async () => {
    const { moves, unmark } = await movesOf(shown);
    const copy = seen(shown);
    unmark();
    return { all: moves, body: copy };
  });
  const answer = inScript(told.answer ?? null);
  const entries = rows(told.entries ?? []);
  const moves = fitting(all, MOST - body.length - answer.length - entries.length - styles.length - 60_000);
  const { script, told: played } = moves.length ? await scriptOf(moves) : { script: "", told: "[]" };
  const day = new Date().toISOString().slice(0, 10);
  const name = of || title;
  const heading = of ? `${title}: ${of}` : title;
  const file = `${fileOf(name)}.toml`;
  const items = (told.notes ?? []).map((each) => `<li>${safe(each)}</li>`).join("");
  const notes = items ? `<h2>Notes</h2><ul>${items}</ul>` : "";
  const whole = `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="${POLICY}"><meta name="color-scheme" content="light dark">
<title>${safe(heading)}</title><style>${styles}
body { display: block; max-width: 46rem; margin: 0 auto; padding: 1rem .75rem; }
main { padding: 0; } .columns { display: block; } td { overflow-wrap: break-word; } pre { overflow: auto; }
.drawn { width: 100%; height: auto; } h1 + .says { margin: .3rem 0 .8rem; }</style></head>
<body><main><h1>${safe(heading)}</h1>
${made(`Made on ${day} by asperity ${safe(about.value?.version)}`, safe(told.command))}
${moves.length ? `<p><button type="button" id="play">let it move</button></p>` : ""}
${moves.length < all.length ? `<p class="says">Some of what moves on the page stands still here: it is too large for one
file.</p>` : ""}
${body}${notes}
${entries ? `<details><summary>all ${told.entries.length} numbers</summary><div class="scroll whole"><table>
<tr><th>what</th><th>symbol</th><th>value</th><th>unit</th><th>equation</th><th>source</th></tr>
${entries}</table></div></details>` : ""}
${told.toml ? `<h2>The case</h2><p>${safe((told.again ?? again)(file))}
<button type="button" id="take">save the case</button></p><pre id="case">${safe(told.toml)}</pre>` : ""}</main>
<script type="application/json" id="answer">${answer}</script>
<script type="application/json" id="moves">${within(played)}</script>
<script>const taken = document.getElementById("take");
if (taken) taken.onclick = () => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([document.getElementById("case").textContent]));
  link.download = ${inScript(file)};
  link.click();
};
${script}</script></body></html>
`;
  download(`${file.replace(/\.toml$/, "")}.html`, new Blob([whole], { type: "text/html" }));
}
