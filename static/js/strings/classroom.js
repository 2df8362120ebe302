// The classroom's texts in the reader's language. Apart from the others: the playground does not load them.

import { classroom as en } from "./en/classroom/index.js";
import { language, laidOver } from "./index.js";

const others = {
  es: async () => (await import("./es/classroom/index.js")).classroom,
};

/** The texts. */
export const texts = language in others ? laidOver(en, await others[language]()) : en;

/** A text that the server has in all languages, in the reader's. */
export const localized = (text) => text?.[language] ?? text?.en ?? "";
