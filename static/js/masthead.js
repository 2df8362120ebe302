// The head that all pages share: title, the way to the other pages, language, theme. Also fills the page's static texts and
// keeps the page for use without a server.

import { byId, element, fillTexts } from "./dom.js";
import { keepOffline } from "./offline.js";
import { LANGUAGES, language, speak, strings } from "./strings/index.js";
import { initTheme } from "./theme.js";

const PAGES = [
  ["playground", "./"],
  ["classroom", "learn.html"],
  ["jobs", "jobs.html"],
  ["api", "api/docs"],
];

/** Builds the masthead of the page called `current`; pages with texts of their own bring title and description. */
export function buildMasthead(current, title = strings.titles[current], description = strings.descriptions[current]) {
  document.documentElement.lang = language;
  document.title = title;
  document.querySelector("meta[name=description]")?.setAttribute("content", description);
  fillTexts(strings);
  byId("pages").append(
    ...PAGES.map(([id, href]) => element("a", { href, "aria-current": id === current ? "page" : null }, strings.pages[id])),
  );
  byId("theme-toggle").before(languageChoice());
  initTheme(byId("theme-toggle"));
  keepOffline();
}

/** The page's scripts are all there: from now on it says by itself what is wrong (see early-watch.js). */
export function comeAlive() {
  document.documentElement.dataset.alive = "";
}

/** Each language by its own name, for whoever does not read the present one. */
function languageChoice() {
  const options = Object.entries(LANGUAGES).map(([code, name]) =>
    element("option", { value: code, lang: code, selected: code === language }, name),
  );
  return element("select", { id: "language", "aria-label": strings.language, onchange: ({ target }) => speak(target.value) }, options);
}
