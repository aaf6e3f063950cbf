/** What moves of a screen as a script for a file: the modules that play it, made into functions, and what they play. */
import { moving } from "./frames.js";

const PLAYER = "playfile.js";
const IMPORT = /^import \{([^}]*)\} from "\.\/([\w.]+)";\n/gm;
const EXPORT = /^export (?:const|function) (?:\[([^\]]*)\]|(\w+))/gm;

/** A module and those it takes from, each behind what it needs, by name. */
async function gathered(name, found = new Map()) {
  if (found.has(name)) return found;
  const text = await (await fetch(`js/${name}`)).text();
  for (const [, , other] of text.matchAll(IMPORT)) await gathered(other, found);
  return found.set(name, text);
}

/** A module as a call that returns what it exports. */
function called(text) {
  const given = [...text.matchAll(EXPORT)].flatMap(([, several, one]) => several?.split(",") ?? [one]);
  const taken = (_, names, name) => `const {${names.replaceAll(" as ", ": ")}} = modules["${name}"];\n`;
  return `(() => {\n${text.replace(IMPORT, taken).replace(/^export /gm, "")}\nreturn { ${given.join(", ")} };\n})()`;
}

/** Numbers as they lie in memory take the least room. */
function packed(_, value) {
  if (!ArrayBuffer.isView(value)) return value;
  const bytes = Array.from(new Uint8Array(value.buffer, value.byteOffset, value.byteLength));
  return { kind: value.constructor.name, base64: btoa(bytes.map((each) => String.fromCharCode(each)).join("")) };
}

/**
 * What moves in an element of the page; each is marked with its number until `unmark` is called.
 * @param {Element} body
 * @returns {Promise<{moves: {at: number, module: string, text: string}[], unmark: () => void}>} `text`: what is played
 */
export async function movesOf(body) {
  const all = [...body.querySelectorAll("*")].filter((each) => moving.has(each));
  const moves = [];
  for (const [at, element] of all.entries()) {
    const { module, of } = /** @type {{module: string, of: any}} */ (moving.get(element));
    element.setAttribute("data-moves", String(at));
    const played = typeof of === "function" ? await of() : of;
    moves.push({ at, module, text: JSON.stringify(played, packed) });
  }
  return { moves, unmark: () => all.forEach((each) => each.removeAttribute("data-moves")) };
}

/** The script that plays them, and what it reads. @param {{at: number, module: string, text: string}[]} moves */
export async function scriptOf(moves) {
  const found = new Map();
  for (const name of [...new Set(moves.map(({ module }) => module)), PLAYER]) await gathered(name, found);
  const made = [...found].map(([name, text]) => `modules["${name}"] = ${called(text)};`).join("\n");
  return {
    told: `[${moves.map(({ at, module, text }) => `{"at":${at},"module":"${module}","of":${text}}`).join()}]`,
    script: `const modules = {};\n${made}
modules["${PLAYER}"].playAll(modules, document.getElementById("moves").textContent, document.getElementById("play"));`,
  };
}
