// Every text of the page, in the reader's language: English, or another language laid over it, so that what is not
// translated yet is English and not missing. Another language is another folder like en/ and an entry here.
//
// Which one: `?lang=` in the address, of this page or of one before it in this tab; else what was chosen on an earlier visit,
// else what the browser asks for.

import { loadSession, loadText, saveSession, saveText } from "../storage.js";
import { en } from "./en/index.js";

/** Languages by code, each by its own name. */
export const LANGUAGES = { en: "English", es: "Español" };
const KEY = "language";
const PARAMETER = "lang";

const others = {
  es: async () => (await import("./es/index.js")).es,
};

/** The code of the language that the page speaks. */
export const language = chosen();
/** The texts. */
export const strings = language in others ? laidOver(en, await others[language]()) : en;

function chosen() {
  const asked = new URL(location.href).searchParams.get(PARAMETER);
  if (Object.hasOwn(LANGUAGES, asked)) {
    saveSession(KEY, asked);
  }
  const wanted = [asked, loadSession(KEY), loadText(KEY), ...navigator.languages.map((tag) => tag.split("-")[0])];
  return wanted.find((code) => code && Object.hasOwn(LANGUAGES, code)) ?? "en";
}

/** Speaks another language from now on: remembers it, and loads the page again, whose state is kept by itself. */
export function speak(code) {
  saveText(KEY, code);
  saveSession(KEY, code);
  const address = new URL(location.href);
  if (address.searchParams.has(PARAMETER)) {
    address.searchParams.set(PARAMETER, code);
    history.replaceState(history.state, "", address);
  }
  location.reload();
}

/** `base` with everything that `over` has instead, at any depth. */
export function laidOver(base, over) {
  const isGroup = (value) => value !== null && typeof value === "object" && !Array.isArray(value);
  const merged = { ...base, ...over };
  for (const [key, value] of Object.entries(base)) {
    if (isGroup(value) && isGroup(over[key])) {
      merged[key] = laidOver(value, over[key]);
    }
  }
  return merged;
}
