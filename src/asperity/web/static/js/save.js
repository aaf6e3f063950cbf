/** Save the case with what is set as a file of the folder, and open it. */
import { html, useEffect, useRef, useState } from "../vendor/preact.js";
import { about, forgetCase, loadAbout, post, THERE } from "./api.js";
import { tell } from "./shell.js";
import { useCase } from "./state.js";

/** @param {{toml: string, wanted: number}} props `wanted`: how often it was asked for; each time it opens */
export function Saving({ toml, wanted }) {
  const box = useRef(null);
  const [wrong, setWrong] = useState(null);
  const { name, reset } = useCase();
  useEffect(() => box.current.showModal(), [wanted]);
  const close = () => (setWrong(null), box.current.close());
  const save = async (event) => {
    event.preventDefault();
    const wanted = String(new FormData(event.target).get("name")).trim();
    try {
      const saved = await post("/api/save", { name: wanted, toml, ...(wrong?.status === THERE && { replace: true }) });
      forgetCase(saved.name);
      close();
      await loadAbout();
      reset(saved.name);
      tell(`saved as ${about.value.folder}/${saved.name}`);
    } catch (error) {
      setWrong(error);
    }
  };
  return html`<dialog ref=${box} aria-labelledby="save-title">
      <form method="dialog" onSubmit=${save}>
        <h2 id="save-title">Save the case</h2>
        <p class="says">A file of ${about.value?.folder}; asperity on the command line takes it.</p>
        <label>name <input name="name" required defaultValue=${`my-${name.replace(/\.toml$/, "")}`}
          onInput=${() => setWrong(null)}
          pattern="[A-Za-z0-9][A-Za-z0-9 _.+\\-]*" title="letters, digits, - _ ." /></label>
        <output role="alert">${wrong?.message}</output>
        <p class="row"><button type="submit" class="main">${wrong?.status === THERE ? "replace it" : "save"}</button>
          <button type="button" onClick=${close}>cancel</button></p>
      </form>
    </dialog>`;
}
