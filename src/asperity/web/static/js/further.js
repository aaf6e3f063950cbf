/** What else is asked of a body, a gearset or a drive, by jobs that their commands tell. */
import { html } from "../vendor/preact.js";
import { useCaseFile } from "./api.js";
import { Unfolded } from "./form.js";
import { Told } from "./told.js";
import { useJob, WorkPanel } from "./work.js";

/** By screen: in short; by command what stands above it, on its button, is said of it, and its table. */
const STUDIES = {
  slide: ["a pull at rest", [
    ["static", "How hard it may be pulled and stay", "pull it at rest",
      "The largest steady pull under which the shaken body does not creep; seconds.", ""],
  ]],
  gear: ["shafts and bearings, ways to save, exchange", [
    ["shafts", "Shafts and bearings", "judge them",
      "Reactions, deflection, strength by DIN 743, lives by ISO 281; a moment.", "worm_shaft"],
    ["methods", "What makes it more efficient", "compare ways",
      "Oils, additives, coatings and vibration beside each other; a moment.", ""],
    ["rexs", "For other programs", "write REXS",
      "The gearset in the exchange format of gearbox programs, REXS 1.5; a moment.", ""],
  ]],
  drive: ["mounting, roots, relief, wear, control", [
    ["misalign", "Wherever its mounting may bring it", "misalign it",
      "At corners, sides and middle of the tolerances: pressures, edges and error; minutes.", "tolerances"],
    ["roots", "Stresses at the fillets", "find the stresses",
      "Of a loaded wheel's teeth over a pitch, beside the nominal one; a minute.", ""],
    ["relief", "Which relief takes the load off its edges", "try reliefs",
      "Tip reliefs from 0 to 40 µm at the load, a third of it and the corners of its tolerances; minutes.", ""],
    ["wear", "How it beds in", "let it wear",
      "Until 20 µm are worn off, by Archard's law or ISO/TR 14521; minutes.", ""],
    ["control", "Vibration that is switched in a stroke", "run strokes",
      "By a sensor or a clutch, and with each part failing in turn; minutes.", "control"],
  ]],
};

function Study({ command, title, label, says, needs, name, settings }) {
  const file = useCaseFile(name);
  const can = !needs || needs in (file?.tables ?? {}) || Object.keys(settings).some((path) =>
    path.startsWith(`${needs}.`));
  const work = useJob(command, can ? { case: name, settings } : null);
  return html`<${WorkPanel} title=${title} name=${command} label=${label} work=${work}
      says=${can ? says : `${says} It needs [${needs}], which the case does not have.`}>
    ${work.error ? html`<p class="bad" role="alert">✗ ${work.error.message}</p>` : null}
    <${Told} work=${work} /><//>`;
}

/** @param {{of: string, name: string, settings: Record<string, string>}} props `of`: the screen */
export const Further = ({ of, name, settings }) => html`<${Unfolded} says=${`further: ${STUDIES[of][0]}`}
  made=${() => STUDIES[of][1].map(([command, title, label, says, needs]) => html`<${Study} key=${command}
    command=${command} title=${title} label=${label} says=${says} needs=${needs} name=${name}
    settings=${settings} />`)} />`;
