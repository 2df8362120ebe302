// A worker: advances one run at a time in slices, so that between slices it can hear that the run is stale.
//
// In:  {type: "start", module} | {type: "run", job, scenario, spare} | {type: "abandon", job, now}
// Out: {type: "ready"} | {type: "progress", job, progress, rows} | {type: "abandoned", job, progress}
//      {type: "done", job, report, rows, elapsed_ms} | {type: "failed", job, message}

import init, { Run } from "../generated/adaptarm_web.js";

/** Length of a slice: as soon as this a run hears that it is stale. Half as long cost two or three milliseconds of a study's sixty. */
const SLICE_MS = 12;
/** A stale run that ends this soon is finished: while a slider is dragged, something must get to the screen. Any run
 * that does is drawn on its way later than others. */
const NEARLY_DONE_MS = 80;
const PROGRESS_EVERY_MS = 100;
/** What is drawn of a run under way: a picture is no wider than this. */
const PARTIAL_ROWS = 1500;

/** Steps of a slice: what the last ones took says how many the next may have. */
let steps = 1000;
/** The run to give up, and whether at once. */
let abandoned = { job: null, now: false };

// A macrotask without the delay that nested timeouts get: lets waiting messages in.
const channel = new MessageChannel();
let wake = null;
channel.port1.onmessage = () => wake();
const breathe = () =>
  new Promise((resolve) => {
    wake = resolve;
    channel.port2.postMessage(null);
  });

/** `spare` is undefined or an array that the rows may be written to. */
async function compute(job, scenario, spare) {
  const start = performance.now();
  const run = new Run(scenario);
  try {
    let reported = start;
    for (;;) {
      const before = performance.now();
      if (run.advance(steps)) {
        break;
      }
      await breathe();
      const now = performance.now();
      // At most twofold a time: one slow slice says little about the next.
      steps = Math.max(1, Math.round(steps * Math.min(2, Math.max(0.5, SLICE_MS / (now - before || 1)))));
      const progress = run.progress();
      const left = ((now - start) / progress) * (1 - progress);
      if (abandoned.job === job && (abandoned.now || left > NEARLY_DONE_MS)) {
        postMessage({ type: "abandoned", job, progress });
        return;
      }
      // What is nearly done is seen soon enough; but who is silent for long counts as dead, and what is left may take longer.
      const patience = left > NEARLY_DONE_MS ? PROGRESS_EVERY_MS : PROGRESS_EVERY_MS + NEARLY_DONE_MS;
      if (now - reported > patience) {
        reported = now;
        const rows = run.partial_rows(PARTIAL_ROWS);
        postMessage({ type: "progress", job, progress, rows }, [rows.buffer]);
      }
    }
    const rows = run.rows(spare);
    const report = JSON.parse(run.report());
    postMessage({ type: "done", job, report, rows, elapsed_ms: performance.now() - start }, [rows.buffer]);
  } finally {
    run.free();
  }
}

onmessage = async ({ data }) => {
  if (data.type === "start") {
    await init({ module_or_path: data.module });
    postMessage({ type: "ready" });
  } else if (data.type === "abandon") {
    abandoned = { job: data.job, now: data.now };
  } else if (data.type === "run") {
    try {
      await compute(data.job, data.scenario, data.spare);
    } catch (error) {
      // The module may be in any state now; whoever started this worker replaces it.
      postMessage({ type: "failed", job: data.job, message: String(error?.message ?? error) });
    }
  }
};
