// Follows a job to its end over whatever connection there is.
//
// A stream of events is best. Where it breaks off it is resumed after the last event that was heard; where it cannot be
// had, the job is asked about every other second, and the stream is tried again after a while.

import { ApiError, isFinal, readJob, send } from "../api.js";
import { readEvents } from "./events.js";

/** The server gives a sign of life every 15 s; after this long a connection is dead or something holds it back. */
const SILENCE_MS = 22_000;
const FIRST_PAUSE_MS = 500;
const LONGEST_PAUSE_MS = 15_000;
/** Broken streams in a row before polling. */
const BROKEN = 2;
const POLL_MS = 2000;
const POLLS = 15;

/**
 * Follows the job `id` until it has ended, and returns the job. `hear` is called with what is known anew: parts of a job
 * such as `{state}` or `{progress, scenarios_done}`, `summary`, `{scenario, report}`, and `partial`, what an experiment says so far. `trouble` is called with the error
 * while the server cannot be reached, and with null when it can again. Throws `ApiError` where trying again is of no use,
 * and what `signal` says when it is aborted.
 */
export async function follow(id, { hear, trouble = () => {} }, signal) {
  const heard = { last: null, resumed: false };
  let broken = 0;
  let pause = FIRST_PAUSE_MS;
  for (;;) {
    try {
      const before = heard.last;
      const ended = broken < BROKEN ? await stream(id, heard, hear, trouble, signal) : await poll(id, hear, trouble, signal);
      const job = await readJob(id);
      trouble(null);
      hear(job);
      if (isFinal(job.state)) {
        return job;
      }
      // A stream that ends before the job does: the server was told to stop, or something between us cuts it off.
      broken = ended ? 0 : heard.last === before ? broken + 1 : 1;
      pause = FIRST_PAUSE_MS;
      heard.resumed = true;
    } catch (error) {
      signal?.throwIfAborted();
      if (!(error instanceof ApiError) || !error.isPassing) {
        throw error;
      }
      trouble(error);
      heard.resumed = true;
      broken = 0;
      await rest(error.retryAfter ? error.retryAfter * 1000 : pause * (0.75 + 0.5 * Math.random()), signal);
      pause = Math.min(2 * pause, LONGEST_PAUSE_MS);
    }
  }
}

/** Reads the stream until it ends; returns whether it told the job's end. */
async function stream(id, heard, hear, trouble, signal) {
  const silence = new AbortController();
  let timer = null;
  const alive = () => {
    clearTimeout(timer);
    timer = setTimeout(() => silence.abort(), SILENCE_MS);
  };
  alive();
  let ended = false;
  try {
    const headers = { Accept: "text/event-stream", ...(heard.last === null ? {} : { "Last-Event-ID": heard.last }) };
    const response = await send(`jobs/${id}/events`, { headers, signal: either(signal, silence.signal) });
    trouble(null);
    if (response.status === 204) {
      return true;
    }
    const onEvent = (event) => {
      heard.last = event.id ?? heard.last;
      if (heard.resumed) {
        // Events tell what is done; who had to begin again meanwhile, the job tells.
        heard.resumed = false;
        readJob(id).then((job) => signal?.aborted || hear(job), () => {});
      }
      const data = JSON.parse(event.data);
      if (event.type === "state") {
        ended = isFinal(data.state);
        hear({ state: data.state, reason: data.reason });
      } else {
        const whole = event.type === "summary" || event.type === "partial";
        hear(whole ? { [event.type]: data } : data);
      }
    };
    await readEvents(response.body, onEvent, alive);
  } catch (error) {
    signal?.throwIfAborted();
    if (error instanceof ApiError && !error.isPassing) {
      throw error;
    }
    // Could not be had, broke off in the middle, or was silent for too long. Whether the server is there, the caller asks.
  } finally {
    clearTimeout(timer);
  }
  return ended;
}

/** Asks for a while; ends early when the job has. */
async function poll(id, hear, trouble, signal) {
  for (let n = 0; n < POLLS; n += 1) {
    const job = await readJob(id);
    trouble(null);
    hear(job);
    if (isFinal(job.state)) {
      return true;
    }
    await rest(POLL_MS, signal);
  }
  return true;
}

/** Aborts when either does. */
function either(...signals) {
  const both = new AbortController();
  for (const signal of signals.filter(Boolean)) {
    if (signal.aborted) {
      both.abort(signal.reason);
    }
    signal.addEventListener("abort", () => both.abort(signal.reason), { once: true });
  }
  return both.signal;
}

/** Waits; a network that comes back ends it early. */
export function rest(milliseconds, signal) {
  return new Promise((resolve, reject) => {
    const settle = (end) => {
      clearTimeout(timer);
      removeEventListener("online", done);
      signal?.removeEventListener("abort", stop);
      end();
    };
    const done = () => settle(resolve);
    const stop = () => settle(() => reject(signal.reason));
    const timer = setTimeout(done, milliseconds);
    addEventListener("online", done);
    signal?.addEventListener("abort", stop);
  });
}
