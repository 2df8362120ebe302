// Pinned runs: settings that stay to be compared with, with the reports and samples of their runs.
//
// Only settings and trajectory hashes are kept across visits; the runs are computed again, one at a time and after the
// page's own, and their hashes compared with those kept; a run under way makes room for the page's. Samples go to `runs` as
// `pin1:proposed` and so on.

import { load, save } from "./storage.js";

const KEY = "pins";
const VERSION = 1;
/** As many as can be told apart in a figure. */
export const MAX_PINS = 6;

/** Identifier of a pinned run among the page's runs. */
export const runId = (pin, scheme) => `pin${pin.slot}:${scheme}`;

/**
 * Emits "changed" when there are other pins or one has got results. A pin: `{slot, name, shown, documents, hashes,
 * reports, failures, differs}`; `slot` is 1 to MAX_PINS, `reports` by scheme as they come, `differs` lists the schemes whose
 * runs have another hash than when they were pinned.
 */
export class Pins extends EventTarget {
  #state;
  #laboratory;
  #runs;
  #queue = [];
  #working = false;
  /** The run under way: `{pin, abort}`. */
  #job = null;
  list = [];
  /** How many remembered pins could not be used. */
  dropped = 0;

  /** `check` throws on a document that the core does not allow. */
  constructor({ state, laboratory, runs, bindings }) {
    super();
    this.#state = state;
    this.#laboratory = laboratory;
    this.#runs = runs;
    laboratory.addEventListener("asked", () => this.#job?.abort());
    this.#restore((document) => bindings.check(JSON.stringify(document)));
  }

  get isFull() {
    return this.list.length >= MAX_PINS;
  }

  /** Whether every pinned run has ended. */
  get isReady() {
    return this.list.every(({ documents, reports, failures }) => Object.keys(documents).every((id) => reports[id] || failures[id]));
  }

  /** Keeps the present settings under a name; returns the pin, or null if there are too many. */
  add(name) {
    if (this.isFull) {
      return null;
    }
    const { documents } = this.#state;
    // The hash on the page counts only if it is of these settings, not of a run that a newer one is about to replace.
    const current = Object.keys(documents).filter((id) => this.#laboratory.isCurrent(id) && this.#laboratory.results[id].report);
    const hashes = Object.fromEntries(current.map((id) => [id, this.#laboratory.results[id].report.trajectory_hash]));
    const pin = this.#take({ slot: this.#freeSlot(), name, shown: true, documents: { ...documents }, hashes });
    this.#changed();
    this.#compute(pin);
    return pin;
  }

  /** Changes a pin's `name` or whether it is `shown`. */
  update(pin, change) {
    Object.assign(pin, change);
    this.#changed();
  }

  remove(pin) {
    this.list = this.list.filter((other) => other !== pin);
    this.#queue = this.#queue.filter((job) => job.pin !== pin);
    if (this.#job?.pin === pin) {
      this.#job.abort();
    }
    for (const id of Object.keys(pin.documents)) {
      this.#runs.remove(runId(pin, id));
    }
    this.#changed();
  }

  /** Computes what was remembered; to be called once the laboratory runs. */
  begin() {
    this.list.forEach((pin) => this.#compute(pin));
  }

  #freeSlot() {
    const taken = new Set(this.list.map(({ slot }) => slot));
    return Array.from({ length: MAX_PINS }, (_, n) => n + 1).find((slot) => !taken.has(slot));
  }

  #take(kept) {
    const pin = { ...kept, reports: {}, failures: {}, differs: [] };
    this.list.push(pin);
    this.list.sort((a, b) => a.slot - b.slot);
    return pin;
  }

  #compute(pin) {
    this.#queue.push(...Object.keys(pin.documents).map((scheme) => ({ pin, scheme })));
    this.#work();
  }

  /** One at a time, and only while nothing else runs: a slider must never wait for a pin. */
  async #work() {
    if (this.#working) {
      return;
    }
    this.#working = true;
    while (this.#queue.length > 0) {
      await this.#laboratory.idle();
      const job = this.#queue.shift();
      if (job) {
        await this.#run(job);
      }
    }
    this.#working = false;
  }

  async #run({ pin, scheme }) {
    const scenario = JSON.stringify(pin.documents[scheme]);
    const controller = new AbortController();
    this.#job = { pin, abort: () => controller.abort() };
    let result = null;
    let failure = null;
    try {
      result = await this.#laboratory.compute(scenario, controller.signal);
    } catch (error) {
      failure = String(error?.message ?? error);
    }
    this.#job = null;
    if (!this.list.includes(pin)) {
      return;
    }
    if (result) {
      this.#runs.set(runId(pin, scheme), scenario, result.rows, result.report.outcome === "completed");
      this.#keep(pin, scheme, result.report);
    } else if (failure !== null) {
      pin.failures[scheme] = failure;
    } else {
      this.#queue.unshift({ pin, scheme });
    }
    this.#changed();
  }

  #keep(pin, scheme, report) {
    pin.reports[scheme] = report;
    pin.hashes[scheme] ??= report.trajectory_hash;
    if (pin.hashes[scheme] !== report.trajectory_hash) {
      pin.differs.push(scheme);
    }
  }

  #changed() {
    const pins = this.list.map(({ slot, name, shown, documents, hashes }) => ({ slot, name, shown, documents, hashes }));
    save(KEY, { version: VERSION, pins });
    this.dispatchEvent(new Event("changed"));
  }

  #restore(check) {
    const saved = load(KEY);
    const kept = saved?.version === VERSION && Array.isArray(saved.pins) ? saved.pins : [];
    this.dropped = saved && saved.version !== VERSION ? 1 : 0;
    const schemes = Object.keys(this.#state.documents);
    for (const pin of kept) {
      try {
        if (!(pin.slot >= 1 && pin.slot <= MAX_PINS) || this.list.some(({ slot }) => slot === pin.slot)) {
          throw new Error("no such slot");
        }
        const documents = Object.fromEntries(schemes.map((id) => [id, pin.documents[id]]));
        for (const [id, document] of Object.entries(documents)) {
          check(document);
          if (document.scheme.kind !== id) {
            throw new Error("another scheme");
          }
        }
        this.#take({ slot: pin.slot, name: String(pin.name), shown: pin.shown !== false, documents, hashes: { ...pin.hashes } });
      } catch {
        this.dropped += 1;
      }
    }
  }
}
