// Undo and redo: every setting that the page has had in this tab, in order, and the way back to each.
//
// Listens to the state, so nothing that changes it has to know. What one gesture changes at one place is one step, and so
// is what typing or arrow keys change there without a pause. Kept as differences from the paper's documents, per tab.

import { differences, patchBetween, patched } from "./diff.js";
import { loadSession, saveSession } from "./storage.js";

const KEY = "history";
const VERSION = 1;
/** Steps that are kept. */
export const LIMIT = 200;
/** A pause that ends a step. */
const PAUSE_MS = 1500;
const SAVE_AFTER_MS = 300;

/** Emits "changed" when there is something else to undo or redo. */
export class History extends EventTarget {
  #state;
  #laboratory;
  #paper;
  /** Why the state is changing, while this module or its caller changes it. */
  #origin = null;
  #moving = false;
  /** Where and when the latest step changed something, to tell whether the next change belongs to it. */
  #latest = null;
  #gesture = 0;
  #pressed = false;
  #saving = null;
  /** Document to its patch: documents are never changed, only replaced. */
  #patches = new WeakMap();
  /** `{documents, visible, origin}` in order; `origin` is null or `{kind, name}`. */
  entries = [];
  /** Which entry is shown. */
  index = 0;

  constructor({ state, laboratory, paper }) {
    super();
    this.#state = state;
    this.#laboratory = laboratory;
    this.#paper = paper;
    const saved = this.#restored();
    if (saved) {
      this.entries = saved.entries;
      this.index = saved.index;
    } else {
      this.entries = [this.#snapshot()];
    }
    state.addEventListener("changed", () => this.#record());
    addEventListener("pointerdown", () => this.#press(true), true);
    for (const type of ["pointerup", "pointercancel"]) {
      addEventListener(type, () => this.#press(false), true);
    }
    addEventListener("pagehide", () => this.#save());
  }

  get current() {
    return this.entries[this.index];
  }

  get canUndo() {
    return this.index > 0;
  }

  get canRedo() {
    return this.index < this.entries.length - 1;
  }

  undo() {
    return this.canUndo ? this.moveTo(this.index - 1) : null;
  }

  redo() {
    return this.canRedo ? this.moveTo(this.index + 1) : null;
  }

  /** Goes to an entry; returns null, or `{pointer, message}` and changes nothing. */
  moveTo(index) {
    const { documents, visible } = this.entries[index];
    const others = Object.entries(documents).filter(([id, document]) => differences(this.#state.documents[id], document).length > 0);
    this.#moving = true;
    try {
      const failure = this.#laboratory.replace(Object.fromEntries(others));
      if (failure) {
        return failure;
      }
      this.#state.show(visible);
      this.index = index;
    } finally {
      this.#moving = false;
    }
    this.#latest = null;
    this.#changed();
    return null;
  }

  /** Calls `change`; what it does to the state is one step with this origin. */
  as(origin, change) {
    this.#origin = origin;
    this.#latest = null;
    try {
      return change();
    } finally {
      this.#origin = null;
      this.#latest = null;
    }
  }

  /** Takes note of a state that came about otherwise, such as in another tab. */
  catchUp() {
    this.#record();
  }

  #press(pressed) {
    this.#gesture += pressed ? 1 : 0;
    this.#pressed = pressed;
  }

  #snapshot() {
    return { documents: this.#state.documents, visible: [...this.#state.visible], origin: this.#origin };
  }

  #record() {
    if (this.#moving) {
      return;
    }
    const entry = this.#snapshot();
    const places = changedPlaces(this.current, entry);
    if (places.length === 0) {
      return;
    }
    const step = { places: places.join(), gesture: this.#pressed ? this.#gesture : null, origin: this.#origin, at: performance.now() };
    const continued = this.#continues(step, places);
    this.#latest = step;
    this.entries.length = this.index + 1;
    if (continued) {
      this.entries[this.index] = { ...entry, origin: this.current.origin };
      // Back to where the gesture began: nothing happened.
      if (changedPlaces(this.entries[this.index - 1], entry).length === 0) {
        this.entries.pop();
        this.#latest = null;
      }
    } else {
      this.entries.push(entry);
      this.entries.splice(0, this.entries.length - LIMIT - 1);
    }
    this.index = this.entries.length - 1;
    this.#changed();
  }

  #continues(step, places) {
    const { places: before, gesture, origin, at } = this.#latest ?? {};
    if (step.origin !== null) {
      return origin === step.origin;
    }
    if (before !== step.places || origin !== null || gesture !== step.gesture || places.includes(VISIBLE)) {
      return false;
    }
    return gesture !== null || step.at - at < PAUSE_MS;
  }

  #changed() {
    clearTimeout(this.#saving);
    this.#saving = setTimeout(() => this.#save(), SAVE_AFTER_MS);
    this.dispatchEvent(new Event("changed"));
  }

  #save() {
    const entries = this.entries.map(({ documents, visible, origin }) => ({
      patches: Object.fromEntries(Object.entries(documents).map(([id, document]) => [id, this.#patch(id, document)])),
      visible,
      origin,
    }));
    saveSession(KEY, { version: VERSION, index: this.index, entries });
  }

  #patch(id, document) {
    if (!this.#patches.has(document)) {
      this.#patches.set(document, patchBetween(this.#paper[id], document));
    }
    return this.#patches.get(document);
  }

  /** What this tab had before a reload, or null. The core checks an entry when it is gone to. */
  #restored() {
    const saved = loadSession(KEY);
    try {
      if (saved?.version !== VERSION || !saved.entries[saved.index]) {
        return null;
      }
      const schemes = Object.keys(this.#paper);
      const entries = saved.entries.map(({ patches, visible, origin }) => ({
        documents: Object.fromEntries(schemes.map((id) => [id, patched(this.#paper[id], patches[id])])),
        visible: schemes.filter((id) => visible.includes(id)),
        origin,
      }));
      return { entries, index: saved.index };
    } catch {
      return null;
    }
  }
}

const VISIBLE = "visible";

/** Where two entries differ: `scheme pointer` each, and `visible`. */
function changedPlaces(before, after) {
  const places = Object.keys(after.documents).flatMap((id) =>
    before.documents[id] === after.documents[id]
      ? []
      : differences(before.documents[id], after.documents[id]).map(({ pointer }) => `${id} ${pointer}`),
  );
  const same = before.visible.length === after.visible.length && after.visible.every((id) => before.visible.includes(id));
  return same ? places : [...places, VISIBLE];
}
