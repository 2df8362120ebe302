// Work that follows results and may wait for a moment: figures come first, and while newer runs are under way they need the
// processor more. A finger that never rests does not keep it waiting for ever.

/** Nothing newer has been asked for in this time: then it is calm, ms. */
const REST_MS = 30;
/** Longest that work waits, ms. */
const MOST_MS = 160;

export class Calm {
  #laboratory;
  /** All at once, so that the page is laid out once. */
  #waiting = new Set();
  #since = 0;
  #timer = null;

  constructor(laboratory) {
    this.#laboratory = laboratory;
    laboratory.addEventListener("asked", () => this.#plan());
  }

  /** Calls `work` once it is calm; asked for often, once. */
  ask(work) {
    if (this.#waiting.size === 0) {
      this.#since = performance.now();
    }
    this.#waiting.add(work);
    this.#plan();
  }

  #plan() {
    clearTimeout(this.#timer);
    if (this.#waiting.size > 0) {
      const left = Math.max(0, this.#since + MOST_MS - performance.now());
      this.#timer = setTimeout(() => this.#work(), this.#laboratory.isReady ? Math.min(REST_MS, left) : left);
    }
  }

  #work() {
    // Each by itself: what fails must not take the others with it.
    this.#waiting.forEach(queueMicrotask);
    this.#waiting.clear();
  }
}
