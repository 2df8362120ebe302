// The loop of the page: an edit makes a generation, its runs go to the pool, results come back, listeners draw.
//
// Keeps the latest result of each scheme. A result of an older generation is shown while a newer one is computed, and the
// page counts as running until every scheme's newest result is there.

import { failureOf } from "./wasm.js";

export class Laboratory extends EventTarget {
  #state;
  #runs;
  #pool = null;
  /** Scheme to the generation of its newest run. */
  #wanted = {};
  /** Runs that are no scheme's, by the key that the pool has for them: `{resolve, reject}`. */
  #asides = new Map();
  #asideCount = 0;
  /** Scheme to `{generation, scenario, report, elapsed_ms}`, `scenario` as the text that ran, `{generation, stoppedAt}` with the
   *  share that was simulated, or `{generation, failure}`. */
  results = {};
  /** Scheme to progress of the run under way, 0 to 1. */
  progress = {};
  generation = 0;
  /** When the newest generation was asked for, on the clock of `performance.now`. */
  askedAt = 0;

  /** `runs` receives the samples of each scheme's latest run, under the scheme's name. */
  constructor(state, runs) {
    super();
    this.#state = state;
    this.#runs = runs;
  }

  /** Uses a pool, whose handlers are this object's methods, and runs everything. */
  begin(pool) {
    this.#pool = pool;
    this.#submit(Object.keys(this.#state.documents));
  }

  /** Schemes whose newest run has not ended. */
  get pending() {
    return Object.keys(this.#wanted).filter((scheme) => !this.isCurrent(scheme));
  }

  /** Whether every scheme's newest run has ended. */
  get isReady() {
    return this.pending.length === 0;
  }

  /** Whether a scheme's result is that of its newest run. */
  isCurrent(scheme) {
    return this.results[scheme]?.generation === this.#wanted[scheme];
  }

  /** Sets a value in the documents of `schemes`; returns null, or `{pointer, message}` and changes nothing. */
  edit(schemes, pointer, value) {
    return this.#change(() => this.#state.edit(schemes, pointer, value));
  }

  /** Replaces documents; returns null, or `{pointer, message}` and changes nothing. */
  replace(documents) {
    const failure = this.#change(() => this.#state.replace(documents));
    this.dispatchEvent(new Event("replaced"));
    return failure;
  }

  /** Resolves once every scheme's newest run has ended. */
  idle() {
    return new Promise((resolve) => {
      const look = () => {
        if (this.isReady) {
          this.removeEventListener("result", look);
          resolve();
        }
      };
      this.addEventListener("result", look);
      look();
    });
  }

  /** Runs a scenario's text beside the schemes' runs; resolves to `{report, rows}`, or to null if `signal` was given first. */
  compute(scenario, signal) {
    const key = `aside:${(this.#asideCount += 1)}`;
    return new Promise((resolve, reject) => {
      this.#asides.set(key, { resolve, reject });
      signal.addEventListener("abort", () => this.#pool.stop(key));
      this.#pool.submit(key, this.generation, scenario);
    });
  }

  /** Whether a message of the pool was about a run beside the schemes'; then it has been dealt with. */
  #settleAside(key, settle) {
    const aside = this.#asides.get(key);
    if (aside) {
      this.#asides.delete(key);
      settle(aside);
    }
    return aside !== undefined;
  }

  #change(apply) {
    try {
      const changed = apply();
      if (changed.length > 0) {
        this.#submit(changed);
      }
      return null;
    } catch (error) {
      return failureOf(error);
    }
  }

  #submit(schemes) {
    if (!this.#pool) {
      // `begin` runs everything.
      return;
    }
    this.generation += 1;
    this.askedAt = performance.now();
    for (const scheme of schemes) {
      this.#wanted[scheme] = this.generation;
      this.progress[scheme] = 0;
      this.#pool.submit(scheme, this.generation, JSON.stringify(this.#state.documents[scheme]));
    }
    this.dispatchEvent(new Event("asked"));
  }

  done({ scheme, generation, scenario, report, rows, elapsed_ms }) {
    if (this.#settleAside(scheme, ({ resolve }) => resolve({ report, rows }))) {
      return;
    }
    if (this.#isPast(scheme, generation)) {
      return;
    }
    this.results[scheme] = { generation, scenario, report, elapsed_ms };
    this.#runs.set(scheme, scenario, rows, report.outcome === "completed");
    // The simulation's module has a copy.
    this.#pool.takeBack(rows);
    this.dispatchEvent(new CustomEvent("result", { detail: { scheme } }));
  }

  /** Whether a newer run of the scheme has ended: it was stopped while it waited, and the older one did not hear of that in time. */
  #isPast(scheme, generation) {
    return generation < this.results[scheme]?.generation;
  }

  failed({ scheme, generation, message }) {
    if (this.#settleAside(scheme, ({ reject }) => reject(new Error(message)))) {
      return;
    }
    if (this.#isPast(scheme, generation)) {
      return;
    }
    this.results[scheme] = { generation, failure: message };
    this.#runs.remove(scheme);
    this.dispatchEvent(new CustomEvent("result", { detail: { scheme } }));
  }

  /** A run under way: what it has recorded so far is shown, unless a newer run waits already. */
  advanced({ scheme, generation, scenario, progress, rows }) {
    if (generation !== this.#wanted[scheme]) {
      return;
    }
    this.progress[scheme] = progress;
    this.#runs.set(scheme, scenario, rows, true);
    this.dispatchEvent(new CustomEvent("progress", { detail: { scheme } }));
  }

  stopped({ scheme, generation, progress }) {
    if (this.#settleAside(scheme, ({ resolve }) => resolve(null))) {
      return;
    }
    if (generation === this.#wanted[scheme]) {
      this.results[scheme] = { generation, stoppedAt: progress };
      this.dispatchEvent(new CustomEvent("result", { detail: { scheme } }));
    }
  }

  /** Stops a scheme's run where it is. */
  stop(scheme) {
    this.#pool.stop(scheme);
  }

  /** Runs a scheme's document again, though nothing changed: after it was stopped. */
  again(scheme) {
    this.#submit([scheme]);
  }
}
