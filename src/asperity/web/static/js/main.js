/** The list of screens, and the one that is open. */
import { html, render, signal, useEffect } from "../vendor/preact.js";
import { returned } from "./again.js";
import { about, loadAbout, loadForms } from "./api.js";
import { App, HIDDEN } from "./shell.js";
import { handed, route, whenHanded } from "./state.js";

/** In the order in which they are offered. @type {import("./shell.js").Listed[]} */
const SCREENS = [
  { name: "home", title: "Start", kind: "", group: "" },
  { name: "slide", title: "Sliding body", kind: "slide", group: "A body, shaken" },
  { name: "sweep", title: "Sweep", kind: "slide", group: "A body, shaken" },
  { name: "block", title: "Elastic block", kind: "block", group: "A body, shaken" },
  { name: "gear", title: "Gearset", kind: "gear", group: "A worm gear" },
  { name: "size", title: "Size and trade-off", kind: "gear", group: "A worm gear" },
  { name: "flanks", title: "Flanks", kind: "gear", group: "A worm gear" },
  { name: "drive", title: "Drive, shaken", kind: "drive", group: "A worm gear" },
  { name: "rig", title: "Rig", kind: "rig", group: "Measured and published" },
  { name: "thesis", title: "Thesis", kind: "", group: "Measured and published" },
  { name: "jobs", title: "Jobs", kind: "", group: "What runs" },
  // Opened from the list of jobs.
  { name: "answer", title: "Answer", kind: "", group: HIDDEN },
].map((screen) => ({ ...screen, load: () => import(`./screens/${screen.name}.js`) }));

// The screen that stands in the address is on its way before anything is known.
SCREENS.find(({ name }) => name === route.peek().screen)?.load().catch(() => {});

/** Screens that were opened, by name. */
const loaded = signal({});
const trouble = signal(null);

function Page() {
  const { screen } = route.value;
  const listed = SCREENS.find(({ name }) => name === screen);
  useEffect(() => {
    if (!listed || loaded.peek()[screen]) return;
    listed.load()
      .then(({ view }) => (loaded.value = { ...loaded.peek(), [screen]: view }))
      .catch((error) => (trouble.value = error));
  }, [screen, returned.value]);
  const View = loaded.value[screen];
  return html`<${App} screens=${SCREENS}>
    ${trouble.value ? html`<p class="fault" role="alert">✗ ${trouble.value.message}</p>` : null}
    ${!listed ? html`<h1>There is no screen ${screen}</h1>` : View ? html`<${View} key=${screen} />`
      : trouble.value ? null : html`<p class="wait">One moment.</p>`}
  <//>`;
}

let timer = 0;
/** Ask again until what computes is there. */
async function wait() {
  clearTimeout(timer);
  try {
    await loadAbout();
    trouble.value = null;
  } catch (error) {
    trouble.value = error;
    // A tab that is opened at the printed address hands its token on.
    if (error.status === 403) return whenHanded(() => location.reload());
  }
  if (!about.value?.ready) timer = setTimeout(wait, 1000);
}

handed.then(() => {
  render(html`<${Page} />`, document.body);
  returned.subscribe(() => {
    wait();
    loadForms().catch((error) => (trouble.value = error));
  });
});
