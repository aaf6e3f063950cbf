/** What else is asked of a loaded gearset, by jobs that their commands tell: mounting, wear, relief, control. */
import { html } from "../vendor/preact.js";
import { useCaseFile } from "./api.js";
import { Unfolded } from "./form.js";
import { Told } from "./told.js";
import { useJob, WorkPanel } from "./work.js";

/** By command: what stands above it, on its button, what is said of it, and the table that it needs. */
const STUDIES = [
  ["misalign", "Wherever its mounting may bring it", "misalign it",
    "At corners, sides and middle of the tolerances: pressures, edges and error; minutes.", "tolerances"],
  ["relief", "Which relief takes the load off its edges", "try reliefs",
    "Tip reliefs from 0 to 40 µm at the load, a third of it and the corners of its tolerances; minutes.", ""],
  ["wear", "How it beds in", "let it wear",
    "Until 20 µm are worn off, by Archard's law or ISO/TR 14521; minutes.", ""],
  ["control", "Vibration that is switched in a stroke", "run strokes",
    "By a sensor or a clutch, and with each part failing in turn; minutes.", "control"],
];

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

/** @param {{name: string, settings: Record<string, string>}} props */
export const Further = ({ name, settings }) => html`<${Unfolded} says="further: mounting, relief, wear, control"
  made=${() => STUDIES.map(([command, title, label, says, needs]) => html`<${Study} key=${command}
    command=${command} title=${title} label=${label} says=${says} needs=${needs} name=${name}
    settings=${settings} />`)} />`;
