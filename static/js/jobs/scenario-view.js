// One scenario of a job: its numbers, its hashes, a figure of choice, downloads, and the way back into the playground.

import { element } from "../dom.js";
import { strings } from "../strings/index.js";
import { buildDownloads } from "./downloads.js";
import { FigurePicture } from "./figures.js";
import { showError } from "./message.js";
import { formatLocal } from "./numbers.js";
import { openScenarios } from "./open.js";
import { schemeName } from "./schemes.js";

const texts = strings.server;

export class ScenarioView {
  node = element("section", { class: "card scenario", hidden: true });
  #id;
  #failure;
  #title = element("h2", { tabindex: "-1" });
  #numbers = element("div");
  #downloads = element("div");
  #picture;
  #drawn = "";
  #n = 0;

  /** A scenario of the job `id`; errors go to `failure`. */
  constructor(id, failure) {
    this.#id = id;
    this.#failure = failure;
    this.#picture = new FigurePicture(id, () => this.#showDownloads());
    const open = element("button", { type: "button", id: "open-scenario", onclick: () => this.#open() }, texts.openScenario);
    this.node.append(this.#title, this.#numbers, this.#picture.node, this.#downloads, open);
  }

  /** Shows the scenario number `n` with its report; nothing without one. */
  show(n, report) {
    this.node.hidden = !report;
    const drawn = report ? JSON.stringify([n, schemeName(report.scheme), report]) : "";
    if (drawn === this.#drawn) {
      return;
    }
    this.#drawn = drawn;
    this.#n = n;
    if (report) {
      this.node.dataset.scenario = n;
      this.node.dataset.scenarioHash = report.scenario_hash;
      this.node.dataset.trajectoryHash = report.trajectory_hash;
      this.#title.textContent = texts.scenarioTitle(n + 1, schemeName(report.scheme));
      this.#numbers.replaceChildren(numbersTable(report), factsList(report));
      this.#picture.show(n, report);
      this.#showDownloads();
    }
  }

  /** Brings it into view, after it was chosen. */
  reveal() {
    if (!this.node.hidden) {
      this.#title.focus({ preventScroll: true });
      this.node.scrollIntoView({ block: "start" });
    }
  }

  /** Lets go of what it holds. */
  stop() {
    this.#picture.stop();
  }

  #showDownloads() {
    this.#downloads.replaceChildren(buildDownloads(this.#id, this.#n, this.#picture.figure, this.#failure));
  }

  async #open() {
    try {
      await openScenarios(this.#id, [this.#n]);
    } catch (error) {
      showError(this.#failure, error);
    }
  }
}

function numbersTable(report) {
  const fields = Object.keys(texts.rows).filter((field) => report[field]);
  const joints = report[fields[0]]?.map((_, joint) => joint) ?? [];
  const head = [texts.quantity, ...joints.map((joint) => texts.joint(joint + 1))];
  return element(
    "table",
    { class: "numbers" },
    element("caption", {}, texts.numbers),
    element("thead", {}, element("tr", {}, head.map((text, n) => element("th", { scope: "col", class: n ? "number" : null }, text)))),
    element(
      "tbody",
      {},
      fields.map((field) =>
        element(
          "tr",
          {},
          element("th", { scope: "row" }, texts.rows[field]),
          joints.map((joint) => element("td", { class: "number" }, formatLocal(report[field][joint]))),
        ),
      ),
    ),
  );
}

function factsList(report) {
  const code = (text) => element("code", { class: "whole-hash" }, text);
  const facts = [
    [texts.trajectoryHash, code(report.trajectory_hash)],
    [texts.scenarioHash, code(report.scenario_hash)],
    [texts.core, report.core_version],
    [texts.steps, String(report.steps)],
    [texts.samples, String(report.samples)],
  ];
  return element("dl", { class: "job-facts" }, facts.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))));
}
