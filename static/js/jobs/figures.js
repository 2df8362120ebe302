// A figure of a scenario as the server draws it, with a choice of which.

import { element } from "../dom.js";
import { strings } from "../strings/index.js";
import { ServerPicture } from "./picture.js";
import { schemeName } from "./schemes.js";

const texts = strings.server;
/** Natural size of the server's figures, so that nothing jumps when one arrives. */
const SIZE = { width: 900, height: 620 };

export class FigurePicture {
  node = element("figure", { class: "server-figure" });
  /** The chosen figure's name. */
  figure = Object.keys(texts.figures)[0];
  #id;
  #n = 0;
  #report = null;
  #choice = element("select", { id: "figure-choice" });
  #picture = new ServerPicture({ ...SIZE }, () => {
    this.#missing.textContent = texts.figureMissing;
  });
  #missing = element("p", { class: "field-error", role: "status" });

  /** Figures of the job `id`; `chosen` is called when another one is chosen. */
  constructor(id, chosen) {
    this.#id = id;
    this.#choice.addEventListener("change", () => {
      this.figure = this.#choice.value;
      this.#load();
      chosen();
    });
    const label = element("label", { class: "filter", for: this.#choice.id }, element("span", {}, texts.figure), this.#choice);
    // Narrower than it can be read at, it scrolls within its own box.
    const box = element("div", { class: "picture-box", tabindex: "0", role: "group", "aria-label": texts.figure }, this.#picture.node);
    this.node.append(element("figcaption", {}, label), this.#missing, box);
  }

  /** Shows the chosen figure of the scenario number `n`. */
  show(n, report) {
    this.#n = n;
    this.#report = report;
    const names = Object.keys(texts.figures).filter((name) => isThere(name, report));
    this.figure = names.includes(this.figure) ? this.figure : names[0];
    this.#choice.replaceChildren(...names.map((name) => element("option", { value: name }, texts.figures[name])));
    this.#choice.value = this.figure;
    this.#load();
  }

  /** Lets go of the picture. */
  stop() {
    this.#picture.stop();
  }

  #load() {
    const { scheme, trajectory_hash } = this.#report;
    const path = figurePath(this.#id, this.#n, this.figure, "svg");
    this.#missing.textContent = "";
    const alt = texts.figureAlt(texts.figures[this.figure], this.#n + 1, schemeName(scheme));
    this.#picture.load(path, `${path} ${trajectory_hash}`, alt);
  }
}

/** Path of a figure below the API's root. */
export function figurePath(id, n, figure, format) {
  return `jobs/${id}/result/figures/${figure}.${format}?scenario=${n}`;
}

/** First parameter of the figures of estimates that not every robot has. */
const FIRST_ESTIMATE = { estimates_2: 7, estimates_3: 13 };

/** Whether a run has what a figure shows: only a scheme with an observer has its errors, and small robots have few parameters. */
function isThere(figure, { z_peak_deg, theta_true }) {
  return figure === "observer_errors" ? Boolean(z_peak_deg) : theta_true.length >= (FIRST_ESTIMATE[figure] ?? 1);
}
