// Messages on top of the page that stay until they are dismissed.

import { byId, element } from "./dom.js";
import { strings } from "./strings/index.js";

/** Shows a message of a kind: "info", "warning" or "error"; `actions` are buttons to put beside it. */
export function notice(text, kind, ...actions) {
  const box = element(
    "p",
    { class: `notice ${kind}` },
    element("span", {}, text),
    actions,
    element("button", { type: "button", class: "quiet", onclick: () => box.remove() }, strings.dismiss),
  );
  // One of a kind is enough, however often it happens.
  byId("notices").querySelector(`.${kind}`)?.remove();
  byId("notices").append(box);
  return box;
}
