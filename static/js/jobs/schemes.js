// What schemes are called: the server's own names, asked for once; until they are there, their identifiers.

import { ask } from "../api.js";

const names = new Map();
const waiting = [];

ask("schemes").then(
  (schemes) => {
    for (const { id, name } of schemes) {
      names.set(id, name);
    }
    for (const tell of waiting) {
      tell();
    }
  },
  // The identifiers do as well, and whatever else fails is told where it matters.
  () => {},
);

/** A scheme's name. */
export const schemeName = (id) => names.get(id) ?? id;

/** Calls `tell` once the names are there, if they are not. */
export function whenNamed(tell) {
  if (names.size === 0) {
    waiting.push(tell);
  }
}
