// Opening scenario files: picked, or dropped anywhere on the page. A refused file changes nothing; an opened one is a step
// that can be undone.

import { announce } from "../announce.js";
import { element } from "../dom.js";
import { FileError, readFiles } from "../files.js";
import { notice } from "../notice.js";
import { strings } from "../strings/index.js";

const texts = strings.compare;

/** Returns the elements for the toolbar. */
export function buildImport({ bindings, state, laboratory, history: steps, words, description }) {
  const picker = element("input", {
    type: "file",
    id: "import-file",
    accept: ".json,application/json",
    multiple: true,
    hidden: true,
    onchange: async () => {
      await open([...picker.files]);
      // So that the same file, mended, can be picked again.
      picker.value = "";
    },
  });
  const button = element("button", { type: "button", id: "import", title: texts.importHelp, onclick: () => picker.click() }, texts.importFiles);

  async function open(files) {
    if (files.length === 0) {
      return;
    }
    const name = files.map((file) => file.name).join(", ");
    let documents;
    try {
      documents = await readFiles(files, bindings.resolve);
    } catch (error) {
      if (!(error instanceof FileError)) {
        throw error;
      }
      notice(texts.importRefused(error.message), "error");
      return;
    }
    const before = { ...state.hashes };
    const failure = steps.as({ kind: "file", name }, () => laboratory.replace(documents));
    if (failure) {
      notice(texts.importRefused(failure.message), "error");
      return;
    }
    const same = Object.keys(documents).every((id) => state.hashes[id] === before[id]);
    const said = same ? texts.importedSame(name) : texts.imported(name, Object.keys(documents).map((id) => words.scheme(id)).join(", "));
    announce(said);
    notice(setupsAgree() ? said : `${said} ${texts.setupDiffers(description.schemes[0].name)}`, "info");
  }

  /** Whether everything outside the schemes is the same for all. */
  function setupsAgree() {
    const setups = Object.values(state.documents).map(({ scheme, ...setup }) => JSON.stringify(setup));
    return new Set(setups).size === 1;
  }

  takeDrops(open);
  return [button, picker];
}

/** Calls `open` with files dropped anywhere on the page, and shows while they hover that they may be. */
function takeDrops(open) {
  const root = document.documentElement;
  const veil = element("div", { class: "drop-veil", "aria-hidden": "true" }, texts.drop);
  document.body.append(veil);
  const hasFiles = ({ dataTransfer }) => dataTransfer?.types.includes("Files");
  addEventListener("dragover", (event) => {
    if (hasFiles(event)) {
      event.preventDefault();
      root.toggleAttribute("data-dropping", true);
    }
  });
  addEventListener("dragleave", (event) => {
    // Left the window, not just one element of it.
    if (event.relatedTarget === null) {
      root.toggleAttribute("data-dropping", false);
    }
  });
  addEventListener("drop", (event) => {
    root.toggleAttribute("data-dropping", false);
    if (hasFiles(event)) {
      event.preventDefault();
      open([...event.dataTransfer.files]);
    }
  });
}
