// The visitor's own settings, kept while the tour shows its own, also through a reload.

import { load, save } from "../storage.js";

const KEY = "tour";

export class Settings {
  #app;
  /** `{documents, visible}` of the visitor; null when there is nothing to go back to. */
  #own;

  /** Takes up what an interrupted tour left behind. */
  constructor(app) {
    this.#app = app;
    this.#own = load(KEY);
  }

  /** Whether the page shows anything but the visitor's own settings. */
  get differ() {
    const { state } = this.#app;
    return this.#own !== null && !(same(this.#own.documents, state.documents) && same(this.#own.visible, visibleOf(state)));
  }

  /** Remembers what is set now, unless an interrupted tour's is still there. */
  keep() {
    const { state } = this.#app;
    this.#own ??= { documents: structuredClone(state.documents), visible: visibleOf(state) };
    save(KEY, this.#own);
  }

  /** Brings them back; returns null, or `{message}`. */
  bringBack() {
    const { documents, visible } = this.#own;
    this.forget();
    showSchemes(visible);
    return this.#app.laboratory.replace(documents);
  }

  forget() {
    this.#own = null;
    save(KEY, null);
  }

  /** Shows all schemes under the paper's settings for so many seconds. */
  showStudy(seconds) {
    const { paper, state, laboratory } = this.#app;
    const documents = structuredClone(paper);
    for (const document of Object.values(documents)) {
      document.integration.duration_s = seconds;
    }
    showSchemes(Object.keys(documents));
    if (!same(documents, state.documents)) {
      laboratory.replace(documents);
    }
  }
}

function visibleOf(state) {
  return Object.keys(state.documents).filter((id) => state.visible.has(id));
}

/** Ticks and unticks the schemes' cards as the visitor would. */
function showSchemes(ids) {
  for (const card of document.querySelectorAll("scheme-card")) {
    const box = card.querySelector("input[type=checkbox]");
    if (box.checked !== ids.includes(card.dataset.scheme)) {
      box.click();
    }
  }
}

/** Equal as values, whatever the order of fields. */
function same(one, other) {
  if (typeof one !== "object" || one === null || typeof other !== "object" || other === null) {
    return one === other;
  }
  const keys = Object.keys(one);
  return keys.length === Object.keys(other).length && keys.every((key) => same(one[key], other[key]));
}
