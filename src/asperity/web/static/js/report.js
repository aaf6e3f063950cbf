/** Reports: one file that prints, of a screen's own job, of a job for it, or of what is answered at once. */
import { html, useEffect, useRef, useState } from "../vendor/preact.js";
import { download, fileOf } from "./figure.js";
import { called } from "./state.js";
import { ENDED, Files, REPORT, take, useJob } from "./work.js";

/** What a report is called once it is handed over: one tells another gearset's from it. */
const own = () => (called() ? `${fileOf(called())}-${REPORT}` : REPORT);
const TITLE = "a file to read and to print, with what was set";

/**
 * The report of a screen's own job; where what is set is not solved yet, it is solved first, in sight.
 * @param {{work: import("./work.js").Job, files?: boolean}} props `files`: whether its other files stand beneath
 */
export function Report({ work, files = false }) {
  const wanted = useRef(false);
  const { id, job, asking, can, stale, error, start } = work;
  const there = job?.state === "done" && !job.shipped && !stale && job.files.includes(REPORT);
  const running = asking || (job && !ENDED.includes(job.state));
  useEffect(() => {
    if (error) wanted.current = false;
    if (!there || !wanted.current) return;
    wanted.current = false;
    take(id, REPORT, own());
  }, [there, id, error]);
  const ask = () => {
    if (there) return take(id, REPORT, own());
    wanted.current = true;
    start();
  };
  return html`<button type="button" disabled=${running || !(can || there)} onClick=${ask}
      title=${there ? TITLE : can ? `${TITLE}; it is solved first` : `${TITLE}; there is nothing to solve yet`}>
      ${running && wanted.current ? "report is being written" : "report"}</button>
    ${there && files ? html`<${Files} job=${job} />` : null}`;
}

/** The report of a command that is answered at once elsewhere: by a job, whose files stand beneath. */
export function ReportOf({ command, body }) {
  const work = useJob(command, body, "-report");
  return html`<${Report} work=${work} files />
    ${work.error ? html`<span class="bad" role="alert">✗ ${work.error.message}</span>` : null}`;
}

/**
 * A report that the server writes at once.
 * @param {{ask: (() => Promise<{html: string}>) | null}} props null: there is nothing to ask yet
 */
export function ReportNow({ ask }) {
  const [error, setError] = useState("");
  const [busy, setBusy] = useState(false);
  const fetched = async () => {
    if (!ask) return;
    setBusy(true);
    try {
      const { html: text } = await ask();
      setError("");
      download(own(), new Blob([text], { type: "text/html" }));
    } catch (found) {
      setError(found.message);
    } finally {
      setBusy(false);
    }
  };
  return html`<button type="button" disabled=${busy || !ask} onClick=${fetched} title=${TITLE}>
      ${busy ? "report is being written" : "report"}</button>
    ${error ? html`<span class="bad" role="alert">✗ ${error}</span>` : null}`;
}
