// Handing in: one attempt at a time, under a key that makes sending it again safe, and followed until it is graded.
//
// What is on its way is remembered, so that neither a lost connection nor a closed page loses it or hands it in twice. Says
// "change". Knows nothing of elements.

import { newKey } from "../api.js";
import { client } from "../classroom/client.js";
import { followAttempt } from "../classroom/follow.js";
import { load, save } from "../storage.js";

export class Submission extends EventTarget {
  #id;
  /** Where what is on its way is remembered: other people may use this browser, too. */
  #storage;
  /** The attempt that is followed. */
  #attempt = null;
  #following = new AbortController();
  /** "idle", "sending", "unsent" (with `error`), "grading", "stuck" (its grade cannot be had, with `error`). */
  phase = "idle";
  error = null;
  /** What is in the way while an attempt is graded, or null. */
  trouble = null;
  progress = 0;
  /** The gains on their way, or null. */
  gains = null;

  /** Of the assignment `id`; says "graded" with the attempt when one is. */
  constructor(id) {
    super();
    this.#id = id;
    this.#storage = `classroom.pending.${client.session.id}.${id}`;
  }

  /** Takes up what an earlier visit left: sent or not, nobody knows, and the key makes sending it again safe. */
  resume(attempts) {
    const pending = load(this.#storage);
    const grading = attempts.find(({ state }) => state === "grading");
    if (pending?.key) {
      this.#send(pending);
    } else if (grading) {
      this.#follow(grading);
    }
  }

  /** Hands gains in. */
  submit(gains) {
    const pending = { key: newKey(), gains };
    save(this.#storage, pending);
    return this.#send(pending);
  }

  /** Sends again what could not be sent. */
  retry() {
    return this.#send(load(this.#storage) ?? { key: newKey(), gains: this.gains });
  }

  /** Whether what could not be sent is kept, to be sent again. */
  get isKept() {
    return this.phase === "unsent" && (this.error.isPassing || this.error.kind === "session");
  }

  /** Goes on for whoever's session had ended and who is back. */
  goOn() {
    if (this.error?.kind === "session") {
      return this.phase === "stuck" ? this.#follow(this.#attempt) : this.retry();
    }
    return null;
  }

  /** Gives up what was not sent. */
  forget() {
    save(this.#storage, null);
    this.#enter("idle");
  }

  stop() {
    this.#following.abort();
  }

  async #send(pending) {
    this.gains = pending.gains;
    this.#enter("sending");
    let attempt;
    try {
      const headers = { "Idempotency-Key": pending.key };
      attempt = await client.ask("POST", `assignments/${this.#id}/attempts`, { gains: pending.gains }, headers);
    } catch (error) {
      this.#enter("unsent", error);
      if (!this.isKept) {
        // Refused: sent again it would be refused again.
        save(this.#storage, null);
      }
      return;
    }
    save(this.#storage, null);
    await this.#follow(attempt);
  }

  async #follow(attempt) {
    this.progress = 0;
    this.#attempt = attempt;
    this.#enter("grading");
    const handlers = {
      progress: (share) => {
        this.progress = share;
        this.#changed();
      },
      trouble: (error) => {
        this.trouble = error;
        this.#changed();
      },
    };
    try {
      const graded = await followAttempt(attempt.id, handlers, this.#following.signal);
      this.#enter("idle");
      this.dispatchEvent(new CustomEvent("graded", { detail: graded }));
    } catch (error) {
      if (!this.#following.signal.aborted) {
        this.#enter("stuck", error);
      }
    }
  }

  #enter(phase, error = null) {
    Object.assign(this, { phase, error, trouble: null });
    this.#changed();
  }

  #changed() {
    this.dispatchEvent(new Event("change"));
  }
}
