// One run of the page's settings on the server: submitted, followed, cancelled, and picked up again after a reload.
//
// Remembers what was submitted, so that results are compared with that and not with what the sliders say by then. Emits
// "change". Knows nothing of elements.

import { ApiError, cancelJob, isFinal, newKey, readResult, submitJob } from "../api.js";
import { load, save } from "../storage.js";
import { follow } from "./follow.js";

const KEY = "server-run";
const VERSION = 1;

export class ServerRun extends EventTarget {
  #following = null;
  /** The run before one that could not be submitted. */
  #previous = null;
  /** `{id, key, label, submitted: [{scheme, hash, document}], at}`, `id` null until the server has said it; or null. */
  record = null;
  /** "idle", "sending", "following", "ended", or "stuck" with an `error`. */
  phase = "idle";
  error = null;
  /** What is in the way while a job is followed, or null. */
  trouble = null;
  /** What is known of the job. */
  job = {};
  /** Scheme to the server's report. */
  reports = {};

  /** Submits documents `[{scheme, hash, document}]` as a new job. */
  submit(label, submitted) {
    this.#previous = this.record?.id ? this.record : this.#previous;
    this.#begin({ version: VERSION, id: null, key: newKey(), label, submitted, at: Date.now() });
    save(KEY, this.record);
    return this.#send();
  }

  /** Takes up what another visit of the page left, if there is something. */
  resume() {
    const record = load(KEY);
    if (record?.version !== VERSION || !Array.isArray(record.submitted)) {
      return null;
    }
    this.#begin(record);
    if (record.id === null) {
      // Sent or not, nobody knows. The key makes sure that sending it again makes no second job.
      return this.#stuck(new ApiError(0));
    }
    return this.#follow();
  }

  /** Goes on where an error stopped it. */
  retry() {
    return this.record.id === null ? this.#send() : this.#follow();
  }

  /** Stops the job. */
  async cancel() {
    this.#hear(await cancelJob(this.record.id));
  }

  /** Forgets it here; the job stays on the server. What was not submitted gives way to the run before it. */
  forget() {
    if (this.record?.id === null && this.#previous) {
      this.#begin(this.#previous);
      this.#previous = null;
      save(KEY, this.record);
      this.#follow();
      return;
    }
    this.#following?.abort();
    this.record = null;
    this.phase = "idle";
    save(KEY, null);
    this.#changed();
  }

  #begin(record) {
    this.#following?.abort();
    this.#following = null;
    Object.assign(this, { record, error: null, trouble: null, job: {}, reports: {} });
  }

  async #send() {
    const { record } = this;
    this.#enter("sending");
    const { label, key, submitted } = record;
    const body = JSON.stringify({ kind: "study", label, spec: { scenarios: submitted.map(({ document }) => document) } });
    try {
      const job = await submitJob(body, key);
      if (this.record !== record) {
        // Dismissed while it was on its way: it runs, and the jobs page lists it.
        return;
      }
      record.id = job.id;
      this.#previous = null;
      save(KEY, record);
      this.#hear(job);
    } catch (error) {
      if (this.record === record) {
        this.#stuck(error);
      }
      return;
    }
    await this.#follow();
  }

  async #follow() {
    const following = new AbortController();
    this.#following?.abort();
    this.#following = following;
    this.#enter("following");
    const handlers = { hear: (news) => this.#hear(news), trouble: (error) => this.#troubled(error) };
    try {
      const job = await follow(this.record.id, handlers, following.signal);
      if (this.record.submitted.some(({ scheme }) => !this.reports[scheme])) {
        const { reports } = await readResult(job.id);
        reports.forEach((report, n) => this.#keep(n, report));
      }
      following.signal.throwIfAborted();
      this.#enter("ended");
    } catch (error) {
      if (!following.signal.aborted) {
        this.#stuck(error);
      }
    }
  }

  #hear({ summary, ...news }) {
    if (summary) {
      this.#keep(summary.scenario, summary.report);
    }
    Object.assign(this.job, news);
    this.#changed();
  }

  #keep(n, report) {
    const scheme = this.record.submitted[n]?.scheme;
    if (scheme && report) {
      this.reports[scheme] = report;
    }
  }

  #troubled(error) {
    if (error !== this.trouble) {
      this.trouble = error;
      this.#changed();
    }
  }

  #stuck(error) {
    this.error = error;
    this.#enter("stuck");
  }

  #enter(phase) {
    this.phase = phase;
    if (phase !== "stuck") {
      this.error = null;
    }
    this.trouble = null;
    this.#changed();
  }

  #changed() {
    this.dispatchEvent(new Event("change"));
  }

  /** Whether the job will tell nothing more. */
  get hasEnded() {
    return this.phase === "ended" || isFinal(this.job.state);
  }
}
