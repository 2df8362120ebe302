// Sharing and keeping: a link to copy or hand on; scenarios to export and import.

import { announce } from "../announce.js";
import { element } from "../dom.js";
import { download } from "../download.js";
import { documentText, studyText } from "../files.js";
import { popover } from "../popover.js";
import { strings } from "../strings/index.js";
import { buildImport } from "./import.js";

const texts = strings.compare;
const HASH_DIGITS = 8;

/** Builds it into the toolbar. */
export function buildShare(place, app) {
  place.append(...linkButtons(app), ...exportMenu(app), ...buildImport(app));
}

function linkButtons({ address }) {
  const byHand = element("input", { type: "text", readonly: true, id: "link-text", "aria-label": texts.linkField, hidden: true });
  const copy = element("button", { type: "button", id: "copy-link" }, texts.copyLink);
  copy.addEventListener("click", async () => {
    const link = await address.link();
    try {
      await navigator.clipboard.writeText(link);
      copy.textContent = texts.linkCopied;
      setTimeout(() => (copy.textContent = texts.copyLink), 2000);
      announce(texts.linkCopied);
    } catch {
      // No clipboard without a secure connection or permission: the link, selected, for the visitor to copy.
      byHand.hidden = false;
      byHand.value = link;
      byHand.select();
      announce(texts.linkByHand);
    }
  });
  if (!navigator.share) {
    return [copy, byHand];
  }
  const share = element("button", { type: "button", id: "share-link" }, texts.shareLink);
  share.addEventListener("click", async () => {
    try {
      await navigator.share({ title: texts.shareTitle, url: await address.link() });
    } catch {
      // Thought better of it.
    }
  });
  return [copy, share, byHand];
}

function exportMenu({ state, description }) {
  const menu = popover({ id: "export-menu", label: texts.exportMenu, text: texts.exportMenu, fill });

  function save(name, text) {
    download(name, text, "application/json");
    announce(texts.exported(name));
    menu.close();
  }

  function fill(box) {
    const one = ({ id, name }) => {
      const file = `adaptarm-${id}-${state.hashes[id].slice(0, HASH_DIGITS)}.json`;
      return element("button", { type: "button", "data-export": id, onclick: () => save(file, documentText(state.documents[id])) }, name);
    };
    const inOrder = Object.fromEntries(description.schemes.map(({ id }) => [id, state.documents[id]]));
    const all = element(
      "button",
      { type: "button", "data-export": "all", onclick: () => save("adaptarm-study.json", studyText(inOrder)) },
      texts.exportAll,
    );
    box.replaceChildren(element("p", { class: "help" }, texts.exportHelp), element("div", { class: "menu" }, description.schemes.map(one), all));
  }
  return [menu.button, menu.box];
}
