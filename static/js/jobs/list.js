// The list of jobs, newest first: filters, pages, and refreshing itself while something on it is not at its end.

import { isFinal, listJobs } from "../api.js";
import { announce } from "../announce.js";
import { element } from "../dom.js";
import { strings } from "../strings/index.js";
import { showError } from "./message.js";
import { JobRow } from "./row.js";
import { buildSubmitForm } from "./submit-form.js";
import { forgetButton } from "./token-form.js";

const texts = strings.server;
const PAGE = 20;
const MOST_A_PAGE = 200;
const REFRESH_MS = 1500;
/** While nothing on the list moves, somebody else may still submit. */
const IDLE_MS = 15_000;

export class JobList {
  node;
  #filter = { state: "", kind: "" };
  #rows = new Map();
  #cursor = null;
  #timer = null;
  #active = false;
  /** Counts the loads, so that what an older one brings is dropped. */
  #load = 0;
  #items = element("ol", { class: "job-list", "aria-label": texts.list });
  #count = element("p", { class: "count", role: "status" });
  #more = element("button", { type: "button", class: "more", hidden: true, onclick: () => this.#loadMore() }, texts.showMore);
  #empty = element("div", { class: "empty", hidden: true });
  #failure = element("div", { class: "failure" });
  #forget = forgetButton(() => this.#reload());

  constructor() {
    const submitForm = buildSubmitForm((job) => {
      this.#reload();
      location.hash = `#${job.id}`;
    });
    this.node = element(
      "div",
      { class: "jobs-view" },
      element("h1", { tabindex: "-1" }, texts.title),
      element("p", { class: "help" }, texts.intro),
      this.#buildFilters(),
      this.#failure,
      this.#items,
      this.#empty,
      element("div", { class: "list-end" }, this.#count, this.#more),
      submitForm,
    );
    document.addEventListener("visibilitychange", () => this.#active && !document.hidden && this.#refresh());
  }

  /** Shows and refreshes it; the job `from` is where the reader comes from. */
  start(from) {
    this.#active = true;
    this.#reload().then(() => {
      const link = from && this.#rows.get(from)?.link;
      if (link && (document.activeElement === document.body || document.activeElement === null)) {
        link.focus();
      }
    });
  }

  stop() {
    this.#active = false;
    clearTimeout(this.#timer);
  }

  #buildFilters() {
    const filter = (name, label, names) => {
      const options = ["", ...Object.keys(names)].map((id) => element("option", { value: id }, id ? names[id] : texts.any));
      const select = element("select", { id: `filter-${name}`, onchange: () => this.#filterBy(name, select.value) }, options);
      return element("label", { class: "filter" }, element("span", {}, label), select);
    };
    return element(
      "div",
      { class: "filters", role: "group", "aria-label": texts.filters },
      filter("state", texts.filterState, texts.states),
      filter("kind", texts.filterKind, texts.kinds),
      element("button", { type: "button", id: "refresh", onclick: () => this.#reload() }, texts.refresh),
      this.#forget.button,
    );
  }

  #filterBy(name, value) {
    this.#filter[name] = value;
    this.#reload(PAGE);
  }

  #query(limit, cursor) {
    const filter = Object.entries(this.#filter).filter(([, value]) => value !== "");
    return Object.fromEntries([...filter, ["limit", limit], ...(cursor ? [["cursor", cursor]] : [])]);
  }

  /** Loads the list anew, as long as it is. */
  async #reload(length = Math.max(PAGE, this.#rows.size)) {
    clearTimeout(this.#timer);
    const load = (this.#load += 1);
    this.#forget.show();
    try {
      const jobs = [];
      let cursor = null;
      do {
        const page = await listJobs(this.#query(Math.min(MOST_A_PAGE, length - jobs.length), cursor));
        jobs.push(...page.jobs);
        cursor = page.next_cursor ?? null;
      } while (cursor && jobs.length < length);
      if (load === this.#load) {
        this.#failure.replaceChildren();
        this.#cursor = cursor;
        this.#show(jobs);
      }
    } catch (error) {
      if (load === this.#load) {
        this.#failed(error);
      }
    }
    this.#schedule();
  }

  async #loadMore() {
    const load = (this.#load += 1);
    this.#more.disabled = true;
    try {
      const page = await listJobs(this.#query(PAGE, this.#cursor));
      if (load === this.#load) {
        this.#cursor = page.next_cursor ?? null;
        this.#show([...[...this.#rows.values()].map(({ job }) => job), ...page.jobs]);
        this.#rows.get(page.jobs[0]?.id)?.link.focus();
      }
    } catch (error) {
      this.#failed(error);
    }
    this.#more.disabled = false;
    this.#schedule();
  }

  #failed(error) {
    document.documentElement.dataset.state = "failed";
    this.#empty.hidden = true;
    // What is on the page stays, so that nothing is lost; a message that is there already is not read out again.
    if (this.#failure.firstElementChild?.dataset.status !== String(error.status)) {
      showError(this.#failure, error, { retry: () => this.#reload() });
    }
  }

  #show(jobs) {
    const unique = new Map(jobs.map((job) => [job.id, job]));
    for (const [id, row] of this.#rows) {
      if (!unique.has(id)) {
        row.node.remove();
        this.#rows.delete(id);
      }
    }
    const rows = new Map();
    let place = this.#items.firstElementChild;
    for (const [id, job] of unique) {
      const row = this.#rows.get(id) ?? new JobRow(this.#failure, () => this.#removed(id));
      const before = row.job?.state;
      row.show(job);
      if (before && before !== job.state) {
        announce(texts.nowState(row.name, texts.states[job.state]));
      }
      rows.set(id, row);
      // Rows are moved only where they must: a moved one would lose the focus.
      if (row.node === place) {
        place = place.nextElementSibling;
      } else {
        this.#items.insertBefore(row.node, place);
      }
    }
    this.#rows = rows;
    this.#more.hidden = this.#cursor === null;
    this.#tell();
    document.documentElement.dataset.state = "ready";
  }

  #tell() {
    const count = this.#rows.size;
    const text = count > 0 ? texts.shown(count, this.#cursor !== null) : "";
    if (this.#count.textContent !== text) {
      this.#count.textContent = text;
    }
    this.#empty.hidden = count > 0;
    if (count === 0) {
      const filtered = Object.values(this.#filter).some(Boolean);
      const way = filtered ? null : element("a", { href: "./", class: "button" }, texts.toPlayground);
      this.#empty.replaceChildren(element("p", {}, filtered ? texts.emptyFiltered : texts.empty), ...(way ? [way] : []));
    }
  }

  #removed(id) {
    const row = this.#rows.get(id);
    const next = row?.node.nextElementSibling ?? row?.node.previousElementSibling;
    row?.node.remove();
    this.#rows.delete(id);
    this.#tell();
    (next?.querySelector("a") ?? this.node.querySelector("h1")).focus();
    announce(texts.removed(row?.name ?? id));
    this.#reload();
  }

  #schedule() {
    clearTimeout(this.#timer);
    const moving = [...this.#rows.values()].some(({ job }) => !isFinal(job.state));
    this.#timer = setTimeout(() => this.#refresh(), moving ? REFRESH_MS : IDLE_MS);
  }

  /** Loads it again if anybody can see it; a hidden tab asks nothing. */
  #refresh() {
    clearTimeout(this.#timer);
    // A message with a form in it waits for its reader.
    const waits = this.#failure.firstElementChild?.dataset.status === "401";
    if (this.#active && !document.hidden && !waits) {
      this.#reload();
    }
  }
}
