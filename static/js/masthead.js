// The head that all pages share: title, the way to the other pages, theme. Also fills the page's static texts.

import { byId, element, fillTexts } from "./dom.js";
import { strings } from "./strings/index.js";
import { initTheme } from "./theme.js";

const PAGES = [
  ["playground", "./"],
  ["jobs", "jobs.html"],
  ["api", "api/docs"],
];

/** Builds the masthead of the page called `current`. */
export function buildMasthead(current) {
  fillTexts(strings);
  byId("pages").append(
    ...PAGES.map(([id, href]) => element("a", { href, "aria-current": id === current ? "page" : null }, strings.pages[id])),
  );
  initTheme(byId("theme-toggle"));
}
