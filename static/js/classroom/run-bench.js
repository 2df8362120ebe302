// Runs of an exercise, side by side: scenarios of any robot and scheme go to the playground's workers, its figures show them.
//
// `show` takes scenarios by name; "result" is said when all the newest are computed. Knows nothing of grades.

import { element } from "../dom.js";
import { gather } from "../gather.js";
import { Laboratory } from "../laboratory.js";
import { notice } from "../notice.js";
import { RunPool } from "../pool.js";
import { strings } from "../strings/index.js";
import { isDark, onTheme } from "../theme.js";
import { Timeline } from "../timeline.js";
import { Figures } from "../views/figures.js";
import { failureOf } from "../wasm.js";

/** Colours of pins, which are no scheme's: as many as there may be visible variants, or nearly. */
const COLORS = 6;
/** What schemes without an observer, and schemes that learn nothing, have nothing to show in. */
const OBSERVER_FIGURES = ["observer_errors"];
const LEARNING_FIGURES = ["estimates", "parameter_error_norm", "sliding_variables"];
const YARDSTICKS = ["pd", "pd_gravity", "computed_torque"];

/** Which scenarios are shown, for a laboratory. */
class Scenarios {
  documents = {};

  replace(documents) {
    const changed = Object.keys(documents).filter((id) => JSON.stringify(documents[id]) !== JSON.stringify(this.documents[id]));
    Object.assign(this.documents, documents);
    return changed;
  }
}

export class RunBench extends EventTarget {
  #laboratory;
  #names;
  #pool;
  timeline = new Timeline();
  figures;

  /** `core` is the loaded module with its description; `variants` are `[{id, name, document}]`; `container` takes the figures. */
  constructor(core, variants, container) {
    super();
    const { bindings, module, description } = core;
    this.#names = variants.map(({ id }) => id);
    const scenarios = new Scenarios();
    scenarios.replace(Object.fromEntries(variants.map(({ id, document }) => [id, document])));
    const runs = new bindings.Runs();
    this.#laboratory = new Laboratory(scenarios, runs);
    const shown = figuresFor(variants.map(({ document }) => document), description);
    const paint = (n) => () => getComputedStyle(document.documentElement).getPropertyValue(`--pin-${(n % COLORS) + 1}`).trim();
    const schemes = variants.map(({ id, name }, n) => ({
      id,
      name,
      paint: paint(n),
      dash: n < COLORS ? null : [6, 3],
      get color() {
        const now = paint(n)();
        return { light: now, dark: now };
      },
    }));
    this.figures = new Figures({ bindings, runs, timeline: this.timeline, description: { ...description, figures: shown, schemes } }, container);
    this.figures.shown = this.#names;
    this.figures.dark = isDark();
    onTheme(() => {
      this.figures.dark = isDark();
      this.figures.redraw();
    });
    this.timeline.duration = Math.max(...variants.map(({ document }) => document.integration.duration_s));
    this.#listen();
    this.#begin(module);
  }

  #listen() {
    gather(this.#laboratory, (isComplete) => {
      this.figures.redraw(null, { atOnce: isComplete });
      if (isComplete) {
        const { results } = this.#laboratory;
        this.figures.describe(Object.fromEntries(this.#names.map((id) => [id, results[id].report])), this.timeline.duration);
        this.dispatchEvent(new Event("result"));
      }
    });
    this.#laboratory.addEventListener("progress", () => this.figures.redraw());
  }

  #begin(module) {
    const laboratory = this.#laboratory;
    const size = Math.max(1, Math.min(this.#names.length, navigator.hardwareConcurrency || 1));
    this.#pool = new RunPool(module, size, {
      done: (result) => laboratory.done(result),
      failed: (failure) => laboratory.failed(failure),
      progress: (progress) => laboratory.advanced(progress),
      stopped: (stop) => laboratory.stopped(stop),
      restarted: () => notice(strings.workerRestarted, "warning"),
      gaveUp: (message) => notice(strings.failed(`${strings.workerGone}: ${message}`), "error"),
    });
    laboratory.begin(this.#pool);
  }

  /** Runs other scenarios, in the order of the variants. */
  show(documents) {
    const failure = this.#laboratory.replace(Object.fromEntries(documents.map((document, n) => [this.#names[n], document])));
    if (failure) {
      notice(failureOf(failure).message, "error");
    }
  }

  /** Ends its workers. */
  stop() {
    this.#pool.end();
  }

  /** Whether everything shown is that of the newest scenarios. */
  get isReady() {
    return this.#laboratory.isReady;
  }

  /** The newest reports in the order of the variants; null where a run failed. */
  get reports() {
    const reports = this.#names.map((id) => this.#laboratory.results[id]?.report);
    return reports.every(Boolean) ? reports : null;
  }
}

/** The figures that have something to show of these scenarios; their numbers in the paper mean nothing here. */
function figuresFor(documents, { figures }) {
  const hasObserver = documents.some(({ scheme, velocity }) => scheme.kind === "proposed" || velocity !== undefined);
  const learns = documents.some(({ scheme }) => !YARDSTICKS.includes(scheme.kind));
  const empty = [...(hasObserver ? [] : OBSERVER_FIGURES), ...(learns ? [] : LEARNING_FIGURES)];
  return figures.filter(({ id }) => !empty.includes(id)).map((figure) => ({ ...figure, paper_number: null }));
}

/** A place for figures, with a heading that only screen readers need. */
export function figurePlace(title) {
  return element("section", { class: "figure-area", "aria-label": title });
}
