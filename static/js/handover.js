// Scenarios that another page of this tab hands to the playground, such as those of a job: taken once, checked by the core.

import { notice } from "./notice.js";
import { strings } from "./strings/index.js";

const KEY = "adaptarm.handover";
const texts = strings.server;

/** Hands scenario documents over; the next playground that opens in this tab takes them. Returns whether that worked. */
export function handOver(scenarios) {
  try {
    sessionStorage.setItem(KEY, JSON.stringify({ scenarios }));
    return true;
  } catch {
    return false;
  }
}

/** Takes what was handed over, if there is something, as one change of the documents; says what it did. */
export function takeHandover({ description, state, laboratory }) {
  const text = take();
  if (text === null) {
    return;
  }
  try {
    const { scenarios } = JSON.parse(text);
    const documents = {};
    for (const scenario of scenarios) {
      const scheme = description.schemes.find(({ id }) => id === scenario.scheme?.kind);
      if (!scheme) {
        throw new Error(texts.schemeUnknown(String(scenario.scheme?.kind)));
      }
      documents[scheme.id] = scenario;
    }
    const failure = laboratory.replace(documents);
    if (failure) {
      throw new Error(failure.message);
    }
    reveal(Object.keys(documents), state);
    notice(texts.handoverDone(description.schemes.filter(({ id }) => documents[id]).map(({ name }) => name)), "info");
  } catch (error) {
    notice(texts.handoverRefused(error.message), "error");
  }
}

/** The text, which is gone from the storage then: what cannot be used must not come back at every reload. */
function take() {
  try {
    const text = sessionStorage.getItem(KEY);
    sessionStorage.removeItem(KEY);
    return text;
  } catch {
    return null;
  }
}

/** What was asked for must be seen. */
function reveal(schemes, state) {
  for (const scheme of schemes.filter((id) => !state.visible.has(id))) {
    document.querySelector(`scheme-card[data-scheme="${scheme}"] input[type="checkbox"]`)?.click();
  }
}
