// Says things to screen readers.

import { byId } from "./dom.js";

const AFTER_MS = 1000;
let waiting = null;

/** Says something once things have been quiet for a moment. */
export function announce(text) {
  clearTimeout(waiting);
  waiting = setTimeout(() => {
    byId("announcements").textContent = text;
  }, AFTER_MS);
}
