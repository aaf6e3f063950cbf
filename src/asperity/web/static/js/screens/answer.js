/** The answer of any job, as its command tells it: of commands that have no screen of their own. */
import { html } from "../../vendor/preact.js";
import { AllNumbers } from "../number.js";
import { Report } from "../report.js";
import { Screen } from "../shell.js";
import { address, go } from "../state.js";
import { ANY, Told } from "../told.js";
import { ENDED, Files, left, useJob, useTicking } from "../work.js";

export function view() {
  const work = useJob(ANY, null);
  const { job, data, error } = work;
  useTicking(job && !ENDED.includes(job.state));
  const link = html`<a href=${address({ screen: "jobs", params: {} })}
    onClick=${(event) => (event.preventDefault(), go("jobs"))}>list of jobs</a>`;
  return html`<${Screen} title=${job ? `${job.command} ${job.case}`.trim() : "Answer"} error=${error}
      answer=${data && { ...data, notes: [] }} actions=${job ? html`<${Report} work=${work} />` : null}
      lead="What a job has found, as its command tells it on a terminal.">
    ${job ? html`<p class="says" role="status">${left(job)}: <code>${job.line}</code></p>`
      : work.id ? html`<p class="wait">One moment.</p>` : html`<p>No job is named here; the ${link} has all.</p>`}
    ${data ? html`<section class="panel" aria-label="what was found"><${Told} work=${work} /></section>` : null}
    ${data?.entries.length ? html`<${AllNumbers} entries=${data.entries} />` : null}
    <${Files} job=${job} />
  <//>`;
}
