// The class's code as large as the screen allows, for a projector: a dialog, closed by Escape or its button.

import { element } from "../dom.js";
import { texts } from "../strings/classroom.js";

const own = texts.projector;

/** A button that shows code and address large. */
export function projector({ code, link, name }) {
  const close = element("button", { type: "button", onclick: () => dialog.close() }, own.close);
  const address = link.split("#")[0].replace(/^https?:\/\//u, "");
  const dialog = element(
    "dialog",
    { class: "projector", "aria-label": own.title },
    element("p", { class: "projector-name" }, name),
    element("p", { class: "projector-address" }, address),
    element("p", { class: "projector-code" }, code),
    close,
  );
  const open = element("button", { type: "button", id: "project", "aria-haspopup": "dialog", onclick: () => dialog.showModal() }, own.open);
  return element("span", {}, open, dialog);
}
