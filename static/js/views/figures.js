// The figures: which there are, when they are drawn, and what they say to those who cannot see them.
//
// However many results arrive, each card in view is drawn at most once per animation frame.

import "../elements/figure-card.js";
import { element } from "../dom.js";
import { formatNumber, formatSeconds } from "../format.js";
import { strings } from "../strings/index.js";

/** In the order of the page; the signals come before the tables. */
const SIGNALS = ["tracking_errors", "velocity_errors", "torques", "observer_errors"];
const ESTIMATES = ["estimates_1", "estimates_2", "estimates_3"];

/** What the text alternative of a figure takes from a report. */
const SUMMARY = {
  tracking_errors: [strings.altIndices, "index_e_deg", "°"],
  velocity_errors: [strings.altIndices, "index_de_deg_s", "°/s"],
  observer_errors: [strings.altPeaks, "z_peak_deg", "°"],
  torques: [strings.altPeaks, "tau_peak_nm", "N·m"],
};
const ESTIMATES_PER_FIGURE = 6;

/** Identifiers of all figures. */
export const FIGURES = [...SIGNALS, ...ESTIMATES];

export class Figures {
  #bindings;
  #runs;
  #description;
  #cards = [];
  /** The latest reports by scheme, and the duration. */
  #reports = {};
  #seconds = 0;
  #frame = null;
  #after = [];
  /** Identifiers of the schemes to draw. */
  shown = [];
  dark = false;

  /** Draws `runs` with the module's `bindings`; `containers` take the signals' figures and the estimates'. */
  constructor({ bindings, runs, description }, containers) {
    this.#bindings = bindings;
    this.#runs = runs;
    this.#description = description;
    containers.signals.append(...SIGNALS.map((id) => this.add(id)));
    containers.estimates.append(...ESTIMATES.map((id) => this.add(id)));
  }

  /** Makes another card of a figure and keeps it drawn; the caller places it. */
  add(id, zoom) {
    const { natural_size, paper_number } = this.#description.figures.find((figure) => figure.id === id);
    const card = element("figure-card");
    const note = paper_number ? strings.paperFigure(paper_number) : null;
    const aspect = natural_size[0] / natural_size[1];
    card.configure({ id, title: strings.figure[id], note, aspect, zoom }, () => this.#schedule());
    this.#cards.push(card);
    return card;
  }

  /** Makes a card show another figure. */
  change(card, id) {
    card.show({ id, title: strings.figure[id] });
    this.#describe(card);
  }

  /** Everything in view is drawn in the next frame; then `after` is called. */
  redraw(after) {
    for (const card of this.#cards) {
      card.stale = true;
    }
    if (after) {
      this.#after.push(after);
    }
    this.#schedule();
  }

  /** Text alternatives from the latest reports, by scheme. */
  describe(reports, seconds) {
    this.#reports = reports;
    this.#seconds = seconds;
    for (const card of this.#cards) {
      this.#describe(card);
    }
  }

  #describe(card) {
    const id = card.dataset.figure;
    const parts = this.#description.schemes
      .filter((scheme) => this.shown.includes(scheme.id) && this.#reports[scheme.id])
      .map((scheme) => summarise(id, scheme, this.#reports[scheme.id]))
      .filter((part) => part !== null);
    const summary = parts.length === 0 && id === "observer_errors" ? strings.noObserver : parts.join(" ");
    card.description = strings.figureAlt(strings.figure[id], formatSeconds(this.#seconds), summary);
  }

  #schedule() {
    this.#frame ??= requestAnimationFrame(() => this.#draw());
  }

  #draw() {
    this.#frame = null;
    for (const card of this.#cards.filter(({ inView, stale }) => inView && stale)) {
      const scale = card.prepare();
      if (scale > 0) {
        const view = { shown: this.shown.map((id) => ({ id })), dark: this.dark, scale };
        this.#bindings.draw_figure(this.#runs, card.canvas, card.dataset.figure, JSON.stringify(view));
        card.stale = false;
      }
    }
    for (const after of this.#after.splice(0)) {
      after();
    }
  }
}

function summarise(figure, scheme, report) {
  const list = (numbers) => numbers.map((number) => formatNumber(number, 3)).join(", ");
  const ended = report.outcome === "diverged" ? ` ${strings.divergedShort(formatSeconds(report.at_s))}.` : "";
  if (figure in SUMMARY) {
    const [sentence, field, unit] = SUMMARY[figure];
    return report[field] ? sentence(scheme.name, unit, list(report[field])) + ended : null;
  }
  const first = ESTIMATES_PER_FIGURE * (Number(figure.split("_")[1]) - 1);
  return strings.altEnd(scheme.name, list(report.theta_hat_end.slice(first, first + ESTIMATES_PER_FIGURE))) + ended;
}
