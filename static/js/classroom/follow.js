// Follows an attempt until it is graded: by its events, and where they cannot be had by asking.

import { readEvents } from "../jobs/events.js";
import { rest } from "../jobs/follow.js";
import { client } from "./client.js";

const PAUSE_MS = 1000;
const LONGEST_PAUSE_MS = 15_000;
const GRADING = "grading";

/**
 * Resolves to the attempt once it is graded or returned. `progress` gets 0 to 1; `trouble` the error while the server cannot be
 * reached, and null when it can again. Throws where trying again is of no use, and what `signal` says when it is aborted.
 */
export async function followAttempt(id, { progress, trouble }, signal) {
  let pause = PAUSE_MS;
  for (;;) {
    try {
      await listen(id, progress, signal);
      const attempt = await client.get(`attempts/${id}`);
      trouble(null);
      if (attempt.state !== GRADING) {
        return attempt;
      }
      pause = PAUSE_MS;
    } catch (error) {
      signal.throwIfAborted();
      if (!error.isPassing) {
        throw error;
      }
      trouble(error);
      pause = Math.min(2 * pause, LONGEST_PAUSE_MS);
    }
    await rest(pause, signal);
  }
}

/** Hears what the stream tells until it ends; that it cannot be had or breaks off is no error: the caller asks. */
async function listen(id, progress, signal) {
  try {
    const response = await client.fetch(`attempts/${id}/events`, { headers: { Accept: "text/event-stream" }, signal });
    await readEvents(response.body, ({ type, data }) => type === "progress" && progress(JSON.parse(data).progress));
  } catch (error) {
    signal.throwIfAborted();
    if (error.isPassing === false) {
      throw error;
    }
  }
}
