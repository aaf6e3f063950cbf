/** The thesis, claim by claim: what it says, what comes of it here, and what of that was made. */
import { html, useState } from "../../vendor/preact.js";
import { fetchRaw, get, useAddress, useAsked } from "../api.js";
import { Beneath } from "../figure.js";
import { ReportNow } from "../report.js";
import { Screen } from "../shell.js";
import { route, setParam } from "../state.js";
import { quoted } from "../symbols.js";
import { Table } from "../table.js";
import { useShipped } from "../work.js";

/** By verdict: sign, word, colour. */
const VERDICTS = {
  reproduced: ["✓", "reproduced", "good"],
  fitted: ["≈", "fitted", "warn"],
  differs: ["✗", "differs", "bad"],
  arithmetic: ["=", "arithmetic", ""],
  "not testable": ["?", "not testable", ""],
  "": ["–", "not made here", ""],
};
const CHOICES = { all: "all", ...Object.fromEntries(Object.entries(VERDICTS).map(([key, [, word]]) => [key, word])) };

export function view() {
  const { found: own, error } = useAsked("thesis", (leave) => get("/api/thesis", leave));
  const ships = useShipped("thesis", true)?.data.answer;
  const ledger = own ?? (ships && unmadeOf(ships));
  const { q = "", verdict = "all" } = route.value.params;
  const wanted = verdict === "none" ? "" : verdict;
  const words = q.toLowerCase().split(/\s+/).filter(Boolean);
  const says = (one) => {
    const text = Object.values(one).join(" ").toLowerCase();
    return words.every((word) => text.includes(word));
  };
  const claims = (ledger?.claims ?? []).filter((one) => says(one) && (verdict === "all" || is(one, wanted)));
  const figures = (ledger?.figures ?? []).filter((one) => says(one) && verdict === "all");
  const chapters = (ledger?.chapters ?? []).map((chapter) => ({
    ...chapter,
    claims: claims.filter((one) => one.chapter === chapter.number),
    figures: figures.filter((one) => one.chapter === chapter.number),
  })).filter((chapter) => chapter.claims.length + chapter.figures.length);
  return html`<${Screen} title="Thesis" error=${error} busy=${!own && !error}
      answer=${ledger && { answer: ledger, command: "asperity thesis", toml: "" }}
      actions=${html`<${ReportNow} ask=${() => get("/api/thesis?report=yes")} />`}
      lead="On friction under imposed vibration and in worm gears: what it says, and what comes of it when it is
        computed anew.">
    ${ledger ? html`
      <p class="big"><b>${count(ledger.claims, "reproduced")}</b> of ${ledger.claims.length} claims are reproduced,
        ${" "}<b>${count(ledger.claims, "differs")}</b> differ.</p>
      <section class="panel" aria-label="what is looked for">
        <div class="row">
          <label>search <input type="search" value=${q} aria-label="search claims and figures"
            onInput=${(event) => setParam("q", event.target.value)} /></label>
          <fieldset class="row choice"><legend class="hidden">verdict</legend>
            ${Object.entries(CHOICES).map(([key, said]) => html`<label key=${key}>
              <input type="radio" name="verdict" checked=${(key || "none") === verdict}
                onChange=${() => setParam("verdict", key === "all" ? "" : key || "none")} />
              ${" "}${said} ${key === "all" ? ledger.claims.length : count(ledger.claims, key)}</label>`)}
          </fieldset>
        </div>
        <details class="says"><summary>what was read</summary><p>${ledger.read}</p></details>
        <p class="says" role="status">${claims.length} of ${ledger.claims.length} claims,
          ${" "}${figures.length} of ${ledger.figures.length} figures.${" "}
          <span class="of-server">${unmade(ledger)}</span></p>
      </section>
      ${chapters.map((chapter) => html`<${Chapter} key=${chapter.number} ...${chapter} />`)}`
      : html`<p class="wait">One moment.</p>`}
  <//>`;
}

/** What ships, before it is known what was made here. */
const unmadeOf = (shipped) => ({ ...shipped, claims: shipped.claims.map((one) => ({ ...one, kept: false })) });

/** Whether a claim has a verdict; "" means that it was not made here. */
const is = (claim, verdict) => (verdict ? claim.verdict === verdict : !claim.kept);
const count = (claims, verdict) => claims.filter((one) => is(one, verdict)).length;

function unmade({ claims, figures, folder }) {
  const missing = [...claims, ...figures].filter(({ kept }) => !kept).length;
  return missing
    ? `${missing} of all were not made here, or by another version: what stands here of claims ships with the page; `
      + `asperity thesis makes them${folder && `, into ${folder}`}.`
    : `All were made here, in ${folder}.`;
}

const COLUMNS = [
  ["claim", ({ id }) => id, "row"],
  ["what it says", ({ text, section, said }) => html`${quoted(text)} <span class="says">Section ${section}.</span>
    ${said.map((words) => html`<p class="says" key=${words}>${words}</p>`)}`],
  ["thesis", ({ theirs }) => quoted(theirs)],
  ["here", ({ id, ours, why, how, line, kept }) => html`${quoted(ours || "–")}
    ${kept ? null : html`<p class="says">${ours ? "as it ships, " : ""}not made here</p>`}
    <details><summary aria-label=${`claim ${id}: ${kept || why ? "why" : "how"}`}>${
      kept || why ? "why" : "how"}</summary>
    ${why ? html`<p>${quoted(why)}</p>` : null}<${How} lines=${kept ? how : [line]} /></details>`],
  ["verdict", ({ verdict }) => {
    const [sign, word, colour] = VERDICTS[verdict];
    return html`<span class=${`verdict ${colour}`}>${sign} ${word}</span>`;
  }],
];

const How = ({ lines }) => lines.map((each) => html`<p class="says"><code>${each}</code></p>`);

function Chapter({ number, title, text, claims, figures }) {
  const columns = () => [
    ["claim", "id"], ["says", "text"], ["thesis", "theirs"], ["here", "ours"], ["verdict", "verdict"], ["why", "why"],
  ].map(([label, key]) => ({ label, values: claims.map((one) => one[key]) }));
  const made = figures.filter(({ kept }) => kept).length;
  return html`<section class="panel" aria-label=${`chapter ${number}`}>
    <h2>${number} ${title}</h2><p class="says">${quoted(text)}</p>
    ${claims.length ? html`<${Table} region=${`claims of chapter ${number}`} wide="cards claims"
        rows=${claims.map((one) => ({ ...one, key: one.id }))} columns=${COLUMNS} />
      <${Beneath} title=${`Claims of chapter ${number}`} columns=${columns} />` : null}
    ${figures.length ? html`<details>
      <summary>${figures.length} ${figures.length === 1 ? "figure" : "figures"}, ${made} made here</summary>
      <div class="grid">${figures.map((one) => html`<${Figure} key=${one.number} ...${one} />`)}</div>
      </details>` : null}
  </section>`;
}

/** A picture that a run left; what was not made says what makes it. */
function Figure({ number, title, caption, picture, how, line }) {
  const [open, setOpen] = useState(false);
  const { found } = useAsked(open && picture ? picture : "", async (leave) =>
    (await fetchRaw(`/api/thesis/${encodeURIComponent(picture)}`, leave)).blob());
  const source = useAddress(found);
  return html`<figure class="plot">
    <figcaption>Figure ${number}: ${title}</figcaption>
    ${picture ? html`<details onToggle=${(event) => setOpen(event.target.open)}>
        <summary aria-label=${`show figure ${number}`}>show</summary>
        ${source ? html`<img class="whole" src=${source} alt=${`${title}. ${caption}`} />` : null}
        <${How} lines=${how} />
      </details>` : html`<p class="says">– not made here: <code>${line}</code></p>`}
    <p class="says">${caption}</p>
  </figure>`;
}
