// One job: how it stands, live, what each scenario gave, and what can be done with it.

import { isFinal, readJob, readResult } from "../api.js";
import { announce } from "../announce.js";
import { element } from "../dom.js";
import { strings } from "../strings/index.js";
import { follow } from "./follow.js";
import { explain, showError } from "./message.js";
import { openStudy } from "./open.js";
import { ExperimentView } from "./experiment-view.js";
import { ScenarioTable } from "./reports.js";
import { jobActions, nameOf, workOf } from "./row.js";
import { ScenarioView } from "./scenario-view.js";
import { whenNamed } from "./schemes.js";
import { stateBadge } from "./state-badge.js";
import { exactTime, formatDuration, formatShare } from "./times.js";
import { forgetButton } from "./token-form.js";

const texts = strings.server;

export class JobDetails {
  id;
  node;
  heading = element("h1", { tabindex: "-1" }, texts.loading);
  #job = null;
  #reports = [];
  #chosen;
  #following = new AbortController();
  #frame = null;
  #badge = element("p", { class: "job-state", role: "status" });
  #bar = element("progress", { max: 1, value: 0, hidden: true });
  #facts = element("dl", { class: "job-facts" });
  #trouble = element("p", { class: "trouble", role: "status" });
  #failure = element("div", { class: "failure" });
  #note = element("p", { class: "note", hidden: true }, texts.partial);
  #actions = null;
  #toolbar = element("div", { class: "job-actions" });
  #table;
  #view;
  /** What a study is not; there once the kind is known. */
  #experiment = null;

  /** The job `id` with the scenario number `chosen` open. */
  constructor(id, chosen) {
    this.id = id;
    this.#chosen = chosen;
    this.#table = new ScenarioTable(id);
    this.#view = new ScenarioView(id, this.#failure);
    this.node = element(
      "div",
      { class: "job-view" },
      element("p", {}, element("a", { class: "back", href: "#" }, `← ${texts.back}`)),
      this.heading,
      this.#badge,
      this.#bar,
      this.#trouble,
      this.#failure,
      this.#facts,
      this.#toolbar,
      this.#note,
      this.#table.node,
      this.#view.node,
    );
  }

  /** Loads it and follows it to its end. */
  async start() {
    const { signal } = this.#following;
    whenNamed(() => signal.aborted || this.#draw());
    try {
      this.#hear(await readJob(this.id));
      const handlers = {
        hear: (news) => this.#hear(news),
        trouble: (error) => {
          this.#trouble.textContent = error ? texts.trouble(explain(error)) : "";
        },
      };
      if (!isFinal(this.#job.state)) {
        await follow(this.id, handlers, signal);
      }
      // What the stream left out of the reports is in the result.
      if (this.#experiment) {
        await this.#experiment.load(this.#job);
      } else {
        this.#reports = (await readResult(this.id)).reports;
      }
      signal.throwIfAborted();
      this.#draw();
      document.documentElement.dataset.state = "ready";
    } catch (error) {
      if (!signal.aborted) {
        this.#failed(error);
      }
    }
  }

  /** Ends following it; the page shows something else. */
  stop() {
    this.#following.abort();
    cancelAnimationFrame(this.#frame);
    this.#view.stop();
    this.#experiment?.stop();
  }

  /** Opens another scenario. */
  choose(n) {
    this.#chosen = n;
    this.#draw();
    this.#view.reveal();
  }

  #failed(error) {
    document.documentElement.dataset.state = "failed";
    if (!this.#job) {
      this.heading.textContent = texts.title;
      this.#table.node.hidden = true;
    }
    showError(this.#failure, error, { retry: () => this.start() });
  }

  #hear({ summary, partial, ...news }) {
    const before = this.#job?.state;
    if (partial) {
      this.#experiment?.hear(this.#job);
    }
    if (summary) {
      this.#reports[summary.scenario] = summary.report;
    }
    this.#job = { ...this.#job, ...news };
    this.#buildExperiment();
    if (before && before !== this.#job.state) {
      announce(texts.nowState(nameOf(this.#job), texts.states[this.#job.state]));
    }
    // A large study tells of many scenarios at once.
    this.#frame ??= requestAnimationFrame(() => {
      this.#frame = null;
      this.#draw();
    });
  }

  #draw() {
    const job = this.#job;
    if (!job) {
      return;
    }
    const ended = isFinal(job.state);
    if (this.heading.textContent !== nameOf(job)) {
      this.heading.textContent = nameOf(job);
      document.title = `${nameOf(job)} · adaptarm`;
      this.#bar.setAttribute("aria-label", texts.progressOf(nameOf(job)));
    }
    this.#table.node.hidden = false;
    this.node.dataset.job = job.id;
    this.node.dataset.state = job.state;
    if (this.#badge.dataset.state !== job.state) {
      this.#badge.dataset.state = job.state;
      this.#badge.replaceChildren(stateBadge(job.state));
    }
    this.#bar.hidden = ended;
    this.#bar.value = job.progress;
    this.#bar.textContent = formatShare(job.progress);
    this.#drawFacts(job);
    this.#drawActions(job);
    this.#note.hidden = !ended || job.state === "succeeded";
    if (this.#experiment) {
      return;
    }
    this.#table.show(this.#reports, job, this.#chosen);
    this.#view.show(this.#chosen, this.#reports[this.#chosen] ?? null);
  }

  /** An experiment is shown in place of the scenarios of a study. */
  #buildExperiment() {
    if (this.#experiment || !this.#job.kind || this.#job.kind === "study") {
      return;
    }
    this.#experiment = new ExperimentView(this.id, this.#failure);
    this.#view.node.remove();
    this.#table.node.replaceWith(this.#experiment.node);
    if (!isFinal(this.#job.state)) {
      this.#experiment.hear(this.#job);
    }
  }

  #drawFacts(job) {
    const span = job.started_at && job.finished_at ? Date.parse(job.finished_at) - Date.parse(job.started_at) : null;
    const facts = [
      [texts.filterKind, texts.kinds[job.kind] ?? job.kind],
      [texts.results, workOf(job)],
      [texts.created, exactTime(job.created_at)],
      [texts.started, job.started_at && exactTime(job.started_at)],
      [texts.finished, job.finished_at && exactTime(job.finished_at)],
      [texts.took, job.cached ? texts.cached : span !== null && formatDuration(span)],
      [texts.attempts, String(job.attempts)],
      [texts.priority, job.priority ? String(job.priority) : null],
      [texts.reason, job.reason],
      [texts.identifier, element("code", {}, job.id)],
    ];
    const shown = facts.filter(([, value]) => value);
    this.#facts.replaceChildren(...shown.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))));
  }

  #drawActions(job) {
    if (this.#actions === null) {
      this.#actions = jobActions(job, this.#failure, {
        changed: (now) => this.#hear(now),
        removed: () => {
          announce(texts.removed(nameOf(this.#job)));
          location.hash = "";
        },
      });
      const open = element("button", { type: "button", class: "primary", id: "open-study", title: texts.openStudyHelp }, texts.openStudy);
      open.addEventListener("click", async () => {
        open.disabled = true;
        try {
          await openStudy(this.id, this.#job.scenarios, this.#reports);
        } catch (error) {
          showError(this.#failure, error);
        }
        open.disabled = false;
      });
      open.hidden = job.kind !== "study";
      this.#toolbar.append(open, ...this.#actions.nodes, forgetButton(() => location.reload()).button);
    }
    this.#actions.show(job);
  }
}
