// One job in the list: state, name, progress, times, and what can be done with it.

import { cancelJob, deleteJob, isFinal } from "../api.js";
import { element } from "../dom.js";
import { strings } from "../strings/index.js";
import { confirmButton } from "./confirm.js";
import { texts as experiments } from "./experiment-texts.js";
import { showError } from "./message.js";
import { stateBadge } from "./state-badge.js";
import { formatDuration, formatShare, timeElement } from "./times.js";

const texts = strings.server;

/** What people call a job. */
export function nameOf(job) {
  return job.label || `${texts.kinds[job.kind] ?? job.kind} ${job.id.slice(0, 13)}`;
}

/** Buttons that cancel and delete a job: `show(job)` shows those that make sense now. */
export function jobActions(job, failure, { changed, removed }) {
  const attempt = async (action) => {
    try {
      await action();
    } catch (error) {
      showError(failure, error);
    }
  };
  const name = nameOf(job);
  const cancel = confirmButton(texts.cancel(name), () => attempt(async () => changed(await cancelJob(job.id))));
  cancel.classList.add("cancel-job");
  const remove = confirmButton(texts.remove(name), () =>
    attempt(async () => {
      await deleteJob(job.id);
      removed();
    }),
  );
  remove.classList.add("delete-job");
  const show = ({ state }) => {
    cancel.hidden = isFinal(state);
  };
  show(job);
  return { nodes: [cancel, remove], show };
}

export class JobRow {
  node = element("li", { class: "job-row" });
  link = null;
  job = null;
  #actions = null;
  #facts = element("p", { class: "facts" });
  #badge = element("span", { class: "job-state" });
  #bar = element("progress", { max: 1 });
  #drawn = "";
  #failure;
  #removed;

  /** Errors go to `failure`; `removed` is called once the job is deleted. */
  constructor(failure, removed) {
    this.#failure = failure;
    this.#removed = removed;
  }

  get name() {
    return nameOf(this.job);
  }

  /** Shows a job: always the same one, as it stands now. */
  show(job) {
    this.job = job;
    if (this.#actions === null) {
      this.#build(job);
    }
    const drawn = JSON.stringify(job);
    if (drawn === this.#drawn) {
      return;
    }
    this.#drawn = drawn;
    this.node.dataset.state = job.state;
    this.#badge.replaceChildren(stateBadge(job.state));
    this.#bar.hidden = isFinal(job.state);
    this.#bar.value = job.progress;
    this.#bar.textContent = formatShare(job.progress);
    this.#facts.replaceChildren(...factsOf(job));
    this.#actions.show(job);
  }

  #build(job) {
    this.node.dataset.job = job.id;
    this.link = element("a", { class: "job-name", href: `#${job.id}` }, this.name);
    this.#bar.setAttribute("aria-label", texts.progressOf(this.name));
    this.#actions = jobActions(job, this.#failure, { changed: (now) => this.show(now), removed: this.#removed });
    this.node.append(
      this.#badge,
      this.link,
      this.#facts,
      element("div", { class: "job-actions" }, this.#actions.nodes),
      this.#bar,
    );
  }
}

/** How much of its work is done. */
export function workOf({ kind, state, scenarios, scenarios_done: done }) {
  if (kind === "study") {
    return isFinal(state) && done === scenarios ? texts.scenarios(scenarios) : texts.scenariosDone(done, scenarios);
  }
  return kind === "tuning" ? experiments.candidatesDone(done, scenarios) : experiments.runsDone(done, scenarios);
}

/** What a row tells beside name and state, as separate pieces. */
function factsOf(job) {
  const facts = [
    texts.kinds[job.kind] ?? job.kind,
    workOf(job),
    job.state === "running" ? formatShare(job.progress) : null,
    timeElement(job.created_at),
    job.started_at && job.finished_at ? formatDuration(Date.parse(job.finished_at) - Date.parse(job.started_at)) : null,
    job.attempts > 1 ? texts.attemptsOf(job.attempts) : null,
    job.cached ? texts.cached : null,
    job.reason ?? null,
  ];
  return facts.filter(Boolean).map((fact) => element("span", {}, fact));
}
