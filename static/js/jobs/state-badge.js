// A job's state as a sign, a word and a colour: any one of them is enough.

import { element } from "../dom.js";
import { strings } from "../strings/index.js";

const SIGNS = { queued: "○", running: "◐", succeeded: "✓", failed: "✕", canceled: "–" };

/** The badge of a state. */
export function stateBadge(state) {
  return element(
    "span",
    { class: "state-badge", "data-state": state },
    element("span", { "aria-hidden": "true" }, SIGNS[state] ?? "?"),
    element("span", {}, strings.server.states[state] ?? state),
  );
}
