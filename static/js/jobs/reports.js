// A job's scenarios as a table: which scheme, how it ended, how well it tracked; each leads to its details.

import { isFinal } from "../api.js";
import { element } from "../dom.js";
import { formatSeconds } from "../format.js";
import { strings } from "../strings/index.js";
import { formatLocal } from "./numbers.js";
import { schemeName } from "./schemes.js";

const texts = strings.server;
const AT_ONCE = 25;

export class ScenarioTable {
  node;
  #id;
  #limit = AT_ONCE;
  #drawn = "";
  #title = element("h2", {}, texts.results);
  #body = element("tbody");
  #more = element("button", { type: "button", class: "more", hidden: true });
  #again = () => {};

  constructor(id) {
    this.#id = id;
    this.#more.addEventListener("click", () => {
      const next = this.#limit;
      this.#limit *= 4;
      this.#again();
      this.#body.querySelectorAll("a")[next]?.focus();
    });
    const columns = [texts.number, strings.scheme, texts.outcome];
    this.node = element(
      "section",
      { class: "card scenarios" },
      this.#title,
      element(
        "table",
        { class: "scenario-table", "aria-label": texts.results },
        element(
          "thead",
          {},
          element(
            "tr",
            {},
            columns.map((text) => element("th", { scope: "col" }, text)),
            element("th", { scope: "col", class: "number" }, texts.indexColumn),
          ),
        ),
        this.#body,
      ),
      this.#more,
    );
  }

  /** Shows the reports of a job, as far as there are any, with the scenario `chosen` marked. */
  show(reports, job, chosen) {
    this.#again = () => this.show(reports, job, chosen);
    const shown = Math.min(job.scenarios, Math.max(this.#limit, chosen + 1 > job.scenarios ? 0 : chosen + 1));
    const ended = isFinal(job.state);
    const rows = Array.from({ length: shown }, (_, n) => summary(reports[n] ?? null, n, n === chosen, ended));
    const drawn = JSON.stringify(rows);
    if (drawn === this.#drawn) {
      return;
    }
    this.#drawn = drawn;
    this.#title.textContent = ended ? texts.results : texts.resultsSoFar;
    const focused = this.#body.contains(document.activeElement) ? document.activeElement.getAttribute("href") : null;
    this.#body.replaceChildren(...rows.map((row) => this.#row(row)));
    if (focused) {
      this.#body.querySelector(`a[href="${CSS.escape(focused)}"]`)?.focus();
    }
    const left = job.scenarios - shown;
    this.#more.hidden = left === 0;
    this.#more.textContent = texts.moreScenarios(left);
  }

  #row({ n, scheme, outcome, diverged, index, chosen }) {
    const link = element(
      "a",
      { href: `#${this.#id}/${n}`, "aria-label": texts.showScenario(n + 1), "aria-current": chosen ? "true" : null },
      String(n + 1),
    );
    return element(
      "tr",
      { "data-scenario": n, "aria-current": chosen ? "true" : null },
      element("th", { scope: "row" }, link),
      element("td", {}, scheme ?? "—"),
      element("td", { class: diverged ? "diverged" : null }, outcome),
      element("td", { class: "number" }, element("span", { class: "triple" }, index.map((value) => element("span", {}, value)))),
    );
  }
}

function summary(report, n, chosen, ended) {
  if (!report) {
    return { n, scheme: null, outcome: ended ? texts.missing : texts.waiting, diverged: false, index: ["—"], chosen };
  }
  const diverged = report.outcome === "diverged";
  const outcome = diverged ? strings.diverged(formatSeconds(report.at_s), report.reason) : texts.completed;
  const index = (report.index_e_deg ?? [null]).map((value) => formatLocal(value));
  return { n, scheme: schemeName(report.scheme), outcome, diverged, index, chosen };
}
