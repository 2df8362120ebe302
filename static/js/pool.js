// A pool of workers with at most one waiting run per scheme: a newer run replaces an older one, so nothing queues up.
//
// A run that is stale but under way is asked to stop; its worker stops unless it is nearly done. A worker that dies or
// falls silent is replaced and its run started again, a few times.

const SILENCE_MS = 10_000;
const ATTEMPTS = 2;
/** Arrays that are kept for further runs: those of one change to all schemes. */
const SPARES = 3;

export class RunPool {
  #module;
  #handlers;
  #workers = [];
  /** Scheme to waiting job; a replaced job keeps its place in the line. */
  #waiting = new Map();
  #jobs = 0;
  /** Arrays that nobody reads any more, for the rows of further runs: a megabyte anew for each keeps the page's memory busy. */
  #spares = [];
  #gaveUp = false;
  #watching;

  /**
   * `handlers`: `done({scheme, generation, scenario, report, rows, elapsed_ms})`,
   * `progress({scheme, generation, scenario, progress, rows})`, `stopped({scheme, generation, progress})` after `stop`,
   * `failed({scheme, generation, message})`, `restarted()`, `gaveUp(message)` when workers keep dying.
   */
  constructor(module, size, handlers) {
    this.#module = module;
    this.#handlers = handlers;
    for (let n = 0; n < size; n += 1) {
      this.#workers.push(this.#start({ job: null }));
    }
    this.#watching = setInterval(() => this.#watch(), SILENCE_MS / 4);
  }

  /** Ends all workers; the pool can do nothing more. */
  end() {
    clearInterval(this.#watching);
    this.#waiting.clear();
    for (const { worker } of this.#workers) {
      worker.terminate();
    }
  }

  /** Runs a scenario (JSON text) for a scheme instead of whatever the scheme waited for. */
  submit(scheme, generation, scenario) {
    this.#waiting.set(scheme, { id: (this.#jobs += 1), scheme, generation, scenario, attempts: 0 });
    for (const { job, worker } of this.#workers) {
      if (job?.scheme === scheme) {
        worker.postMessage({ type: "abandon", job: job.id, now: false });
      }
    }
    this.#dispatch();
  }

  /** Takes back the rows of a run that nobody reads any more. */
  takeBack(rows) {
    if (this.#spares.length < SPARES) {
      this.#spares.push(rows);
    }
  }

  /** Stops a scheme's run, waiting or under way. */
  stop(scheme) {
    const waiting = this.#waiting.get(scheme);
    if (waiting) {
      this.#waiting.delete(scheme);
      this.#handlers.stopped({ scheme, generation: waiting.generation, progress: 0 });
    }
    for (const { job, worker } of this.#workers) {
      if (job?.scheme === scheme) {
        job.stop = true;
        worker.postMessage({ type: "abandon", job: job.id, now: true });
      }
    }
  }

  #dispatch() {
    for (const slot of this.#workers) {
      // One scheme never runs twice at a time: the second would only be stale sooner.
      const next = [...this.#waiting.values()].find(({ scheme }) => !this.#workers.some((w) => w.job?.scheme === scheme));
      if (!next) {
        return;
      }
      if (slot.ready && !slot.job) {
        this.#waiting.delete(next.scheme);
        slot.job = next;
        slot.heard = performance.now();
        const spare = this.#spares.pop();
        slot.worker.postMessage({ type: "run", job: next.id, scenario: next.scenario, spare }, spare ? [spare.buffer] : []);
      }
    }
  }

  #start(slot) {
    slot.worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    slot.ready = false;
    slot.heard = performance.now();
    slot.worker.onmessage = ({ data }) => this.#hear(slot, data);
    slot.worker.onerror = (event) => {
      event.preventDefault();
      this.#replace(slot, event.message);
    };
    slot.worker.postMessage({ type: "start", module: this.#module });
    return slot;
  }

  #hear(slot, data) {
    slot.heard = performance.now();
    if (data.type === "ready") {
      slot.ready = true;
      slot.failures = 0;
    } else if (data.job === slot.job?.id) {
      const { scheme, generation, scenario, stop } = slot.job;
      if (data.type === "progress") {
        this.#handlers.progress({ scheme, generation, scenario, progress: data.progress, rows: data.rows });
        return;
      }
      if (data.type === "failed") {
        this.#replace(slot, data.message);
        return;
      }
      slot.job = null;
      // Before the result is dealt with: the free worker need not wait for that.
      this.#dispatch();
      if (data.type === "done") {
        const { report, rows, elapsed_ms } = data;
        this.#handlers.done({ scheme, generation, scenario, report, rows, elapsed_ms });
      } else if (stop) {
        this.#handlers.stopped({ scheme, generation, progress: data.progress });
      }
      return;
    }
    this.#dispatch();
  }

  #watch() {
    for (const slot of this.#workers) {
      if ((slot.job || !slot.ready) && performance.now() - slot.heard > SILENCE_MS) {
        this.#replace(slot, "no answer");
      }
    }
  }

  /** Replaces a worker; its run waits again unless a newer one does or it has been tried too often. */
  #replace(slot, message) {
    slot.worker.terminate();
    const { job } = slot;
    slot.job = null;
    slot.failures = (slot.failures ?? 0) + 1;
    if (job && !this.#waiting.has(job.scheme)) {
      job.attempts += 1;
      if (job.attempts < ATTEMPTS) {
        this.#waiting.set(job.scheme, job);
      } else {
        this.#handlers.failed({ scheme: job.scheme, generation: job.generation, message });
      }
    }
    if (slot.failures > ATTEMPTS) {
      if (!this.#gaveUp) {
        this.#gaveUp = true;
        this.#handlers.gaveUp(message);
      }
      return;
    }
    this.#handlers.restarted();
    this.#start(slot);
  }
}
