// An experiment: what it says so far or in the end, as a table, a figure of choice, and files to keep.

import { isFinal, readResult } from "../api.js";
import { element } from "../dom.js";
import { buildExperimentDownloads } from "./experiment-downloads.js";
import { ExperimentFigure } from "./experiment-figure.js";
import { groupsTable, searchTable } from "./experiment-tables.js";
import { texts } from "./experiment-texts.js";
import { showError } from "./message.js";
import { openDocument } from "./open.js";

/** Partial summaries are read no more often than this. */
const REST_MS = 2000;

export class ExperimentView {
  node = element("section", { class: "card experiment" });
  #id;
  #failure;
  #job = null;
  #result = null;
  #stopped = false;
  #timer = null;
  #title = element("h2", {}, texts.results);
  #note = element("p", { class: "note" });
  #choice = element("select", { id: "metric-choice" });
  #metric = element("label", { class: "filter", for: "metric-choice", hidden: true }, element("span", {}, texts.metric), this.#choice);
  #numbers = element("div", { class: "experiment-numbers", tabindex: "0", role: "group", "aria-label": texts.results });
  #figure;
  #downloads = element("div");
  #open = element("button", { type: "button", class: "primary", id: "open-best", hidden: true }, texts.openBest);

  /** The experiment of the job `id`; errors go to `failure`. */
  constructor(id, failure) {
    this.#id = id;
    this.#failure = failure;
    this.#figure = new ExperimentFigure(id, () => this.#showDownloads());
    this.#choice.addEventListener("change", () => this.#draw());
    this.#open.addEventListener("click", () => this.#openBest());
    this.node.append(this.#title, this.#note, this.#metric, this.#numbers, this.#figure.node, this.#open, this.#downloads);
    this.#draw();
  }

  /** There is something new to read, sooner or later. */
  hear(job) {
    this.#job = job;
    this.#timer ??= setTimeout(() => {
      this.#timer = null;
      this.load(this.#job).catch((error) => this.#stopped || showError(this.#failure, error));
    }, this.#result === null ? 0 : REST_MS);
  }

  /** Reads what is known and shows it. */
  async load(job) {
    this.#job = job;
    const result = await readResult(this.#id);
    if (!this.#stopped && !(this.#result && isFinal(this.#result.state) && !isFinal(result.state))) {
      this.#result = result;
      this.#draw();
    }
  }

  /** Lets go of what it holds. */
  stop() {
    this.#stopped = true;
    clearTimeout(this.#timer);
    this.#figure.stop();
  }

  #draw() {
    const { summary = null, metrics = [], figures = [], complete = false } = this.#result ?? {};
    const isSearch = this.#job?.kind === "tuning";
    const ready = summary !== null;
    this.node.dataset.complete = complete;
    const partly = ready && !complete && !isSearch;
    this.#title.textContent = partly ? texts.sofar(summary.done, summary.runs) : texts.results;
    this.#note.hidden = ready;
    this.#note.textContent = isSearch ? texts.searchNotYet : texts.nothingYet;
    this.#metric.hidden = !ready || isSearch;
    this.#figure.node.hidden = !ready || figures.length === 0;
    this.#open.hidden = !(isSearch && ready && summary.best);
    if (!ready) {
      return;
    }
    this.#offer(metrics.filter((metric) => isSearch || hasNumbers(summary, metric)));
    const metric = this.#choice.value;
    const name = texts.metrics[metric] ?? metric;
    this.#numbers.replaceChildren(...(isSearch ? searchTable(summary) : groupsTable(summary, metric, name)));
    this.#figure.show(figures, isSearch ? null : metric, name, version(summary));
    this.#showDownloads();
  }

  /** The metrics to choose from, the chosen one kept. */
  #offer(metrics) {
    const before = this.#choice.value;
    if ([...this.#choice.options].map(({ value }) => value).join() !== metrics.join()) {
      this.#choice.replaceChildren(...metrics.map((id) => element("option", { value: id }, texts.metrics[id] ?? id)));
      this.#choice.value = metrics.includes(before) ? before : metrics[0];
    }
  }

  #showDownloads() {
    const { files = [] } = this.#result ?? {};
    this.#downloads.replaceChildren(buildExperimentDownloads(this.#id, files, this.#figure, this.#failure));
  }

  async #openBest() {
    try {
      await openDocument(`jobs/${this.#id}/result/files/best.json`);
    } catch (error) {
      showError(this.#failure, error);
    }
  }
}

/** Whether any group has this metric: only schemes with an observer have observer errors. */
function hasNumbers(summary, metric) {
  return summary.groups.some((group) => group.metrics.some((row) => row.metric === metric));
}

/** Changes when what figures show does. */
function version(summary) {
  return `${summary.done ?? summary.candidates} ${summary.experiment_hash}`;
}
