// A figure of an experiment as the server draws it, with a choice of which.

import { element } from "../dom.js";
import { strings } from "../strings/index.js";
import { texts } from "./experiment-texts.js";
import { ServerPicture } from "./picture.js";

export class ExperimentFigure {
  node = element("figure", { class: "server-figure", hidden: true });
  #id;
  #metric = null;
  #name = "";
  #version = "";
  #choice = element("select", { id: "figure-choice" });
  #missing = element("p", { class: "field-error", role: "status" });
  #picture = new ServerPicture({ width: 900 }, () => {
    this.#missing.textContent = strings.server.figureMissing;
  });

  /** Figures of the job `id`; `chosen` is called when another one is chosen. */
  constructor(id, chosen) {
    this.#id = id;
    this.#choice.addEventListener("change", () => {
      this.#load();
      chosen();
    });
    const label = element("label", { class: "filter", for: this.#choice.id }, element("span", {}, texts.figure), this.#choice);
    const box = element("div", { class: "picture-box", tabindex: "0", role: "group", "aria-label": texts.figure }, this.#picture.node);
    this.node.append(element("figcaption", {}, label), this.#missing, box);
  }

  /** Shows one of `figures`, of a metric called `name`; anew when `version` changes. */
  show(figures, metric, name, version) {
    const before = this.#choice.value;
    if ([...this.#choice.options].map(({ value }) => value).join() !== figures.join()) {
      this.#choice.replaceChildren(...figures.map((id) => element("option", { value: id }, texts.figures[id] ?? id)));
      this.#choice.value = figures.includes(before) ? before : figures[0];
    }
    [this.#metric, this.#name, this.#version] = [metric, name, version];
    if (figures.length > 0) {
      this.#load();
    }
  }

  /** Path of the figure below the API's root; null where there is none. */
  path(format) {
    const figure = this.#choice.value;
    const query = this.#metric ? `?metric=${this.#metric}` : "";
    return figure ? `jobs/${this.#id}/result/figures/${figure}.${format}${query}` : null;
  }

  /** Name for a file of it. */
  get fileName() {
    return [this.#choice.value, this.#metric].filter(Boolean).join("-");
  }

  /** Lets go of the picture. */
  stop() {
    this.#picture.stop();
  }

  #load() {
    this.#missing.textContent = "";
    const title = texts.figures[this.#choice.value] ?? this.#choice.value;
    // The address of a picture that has changed must be another one for the browser to ask again.
    const path = this.path("svg");
    this.#picture.load(path, `${path} ${this.#version}`, texts.figureAlt(title, this.#metric ? this.#name : texts.search));
  }
}
