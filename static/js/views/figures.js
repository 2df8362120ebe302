// The figures: which there are, what they are drawn with and when, and what they say to those who cannot see them.
//
// However many results arrive, each card in view is drawn at most once per frame (figures/queue.js). All figures share the
// timeline's stretch and instant; the instant is drawn over them (figures/cursors.js), never into them.

import "../elements/figure-card.js";
import { element } from "../dom.js";
import { available, GROUPS, traits } from "../figures/catalogue.js";
import { Cursors } from "../figures/cursors.js";
import { describeFigure } from "../figures/describe.js";
import { addExportMenu } from "../figures/export-menu.js";
import { addFocusChoice } from "../figures/focus-choice.js";
import { readPanels } from "../figures/panels.js";
import { DrawQueue } from "../figures/queue.js";
import { buildToolbar } from "../figures/toolbar.js";
import { load, save } from "../storage.js";
import { strings } from "../strings/index.js";

const texts = strings.figures;
const AXIS_KEY = "axis";
/** Layout pixels that three panels need. */
const LEAST_HEIGHT = 352;

export class Figures {
  #app;
  #cards = [];
  #queue = new DrawQueue(this.#cards, (card) => this.#draw(card));
  #cursors;
  /** The latest reports by scheme, and the duration. */
  #reports = {};
  #seconds = 0;
  /** Called when runs come and go. */
  #onRuns = [];
  /** Identifiers of the schemes whose live runs are drawn. */
  shown = [];
  /** Other runs to draw, faded: `{id, label, color}`. */
  overlays = [];
  dark = false;
  /** "linear" or "symlog", for figures that can be either. */
  axis = load(AXIS_KEY) === "symlog" ? "symlog" : "linear";
  /** The run that figures of one run show, or null for the first. */
  focus = null;
  /** Identifiers of all figures on the page, in its order. */
  ids;
  /** The groups that have one of them. */
  groups;

  /** `app` has bindings, runs, description and timeline; `container` takes toolbar and figures. */
  constructor(app, container) {
    this.#app = app;
    this.ids = available(app.description);
    this.groups = GROUPS.filter(({ figures }) => figures.some((id) => this.ids.includes(id)));
    this.#cursors = new Cursors(app.timeline, {
      read: ({ dataset: { figure } }, time) =>
        JSON.parse(app.bindings.read_figure(app.runs, figure, this.viewOf(figure, 1), time)),
      lines: ({ dataset: { figure } }) => (traits(figure).focus ? this.#parts() : this.runs),
    });
    container.append(buildToolbar(this, app.timeline), ...this.groups.map((group) => this.#section(group)));
    app.timeline.addEventListener("window", () => this.redraw());
  }

  /** Makes another card of a figure and keeps it drawn; the caller places it. */
  add(id, zoom) {
    const { paper_number } = this.#described(id);
    const card = element("figure-card");
    const note = paper_number ? texts.paperFigure(paper_number) : null;
    const height = (figure, width) => this.#height(figure, width);
    card.configure({ id, ...captions(id), note, height, zoom }, () => this.#queue.ask());
    card.toggleAttribute("data-wide", traits(id).wide === true);
    this.#cards.push(card);
    this.#cursors.add(card);
    if (traits(id).focus) {
      this.#onRuns.push(addFocusChoice(card.tools, this));
    }
    addExportMenu(card, this, this.#app);
    return card;
  }

  /** Makes a card show another figure. */
  change(card, id) {
    card.show({ id, ...captions(id) });
    this.#cursors.rename(card);
    this.#describe(card);
  }

  /** Scrolls to a figure. */
  reveal(id) {
    const card = this.#cards.find(({ dataset, isConnected }) => dataset.figure === id && isConnected);
    card?.scrollIntoView({ block: "nearest" });
    card?.overlay.focus({ preventScroll: true });
  }

  /** Chooses the kind of axis for all figures that have the choice. */
  chooseAxis(axis) {
    this.axis = axis;
    save(AXIS_KEY, axis);
    this.#redrawOnly((id) => this.hasSymlog(id));
  }

  /** Chooses the run that figures of one run show. */
  chooseFocus(id) {
    this.focus = id;
    this.#redrawOnly((figure) => traits(figure).focus === true);
  }

  /**
   * Everything in view is drawn: in the next frame, or `atOnce`, when nothing newer can be expected before it. Then `after`
   * is called.
   */
  redraw(after, { atOnce = false } = {}) {
    for (const changed of this.#onRuns) {
      changed();
    }
    for (const card of this.#cards) {
      card.stale = true;
    }
    this.#queue.ask(after, atOnce);
  }

  #redrawOnly(concerned) {
    for (const card of this.#cards) {
      card.stale ||= concerned(card.dataset.figure);
    }
    this.#queue.ask();
  }

  /** Text alternatives from the latest reports, by scheme. */
  describe(reports, seconds) {
    this.#reports = reports;
    this.#seconds = seconds;
    for (const card of this.#cards) {
      this.#describe(card);
    }
  }

  /** Every run that is drawn: `{id, name, color, dash}`, those of schemes first. */
  get runs() {
    const theme = this.dark ? "dark" : "light";
    const live = this.#schemes().map(({ id, name, color, dash }) => ({ id, name, color: color[theme], dash }));
    return [...live, ...this.overlays.map(({ id, label, color }) => ({ id, name: label, color, dash: null }))];
  }

  /** How a figure is to be drawn, as the core reads it. */
  viewOf(figure, scale) {
    const { timeline } = this.#app;
    const [from_s, to_s] = timeline.isZoomed ? timeline.window : [null, null];
    const live = this.#schemes().map(({ id, name, paint }) => ({ id, label: name, faded: false, color: paint?.() ?? null }));
    const faded = this.overlays.map(({ id, label, color }) => ({ id, label, faded: true, color }));
    const focus = this.runs.some(({ id }) => id === this.focus) ? this.focus : (this.runs[0]?.id ?? null);
    return JSON.stringify({
      shown: [...live, ...faded],
      dark: this.dark,
      scale,
      from_s,
      to_s,
      axis: this.axis,
      focus,
      true_value: figure === "positions" ? texts.desired : texts.trueValue,
      limit: figure === "voltages" ? texts.supplyLimit : texts.effortLimit,
      parts: texts.parts,
      time_axis: texts.timeAxis,
    });
  }

  /** Whether a figure's axis may be symmetric-logarithmic. */
  hasSymlog(id) {
    return this.#described(id).has_symlog;
  }

  /** Whether the core draws a figure, on the page or not. */
  draws(id) {
    return this.#described(id) !== undefined;
  }

  #described(id) {
    return this.#app.description.figures.find((figure) => figure.id === id);
  }

  #schemes() {
    return this.#app.description.schemes.filter(({ id }) => this.shown.includes(id));
  }

  #section({ id, figures }) {
    const cards = figures.filter((figure) => this.ids.includes(figure)).map((figure) => this.add(figure));
    const title = element("h2", { id: `figures-${id}-title` }, texts.groups[id]);
    return element(
      "section",
      { class: "figure-group", id: `figures-${id}`, "aria-labelledby": title.id, tabindex: -1 },
      title,
      element("div", { class: "figures" }, cards),
    );
  }

  #describe(card) {
    card.description = describeFigure(card.dataset.figure, this.#schemes(), this.#reports, this.#seconds);
  }

  /** As wide as it is, a figure of joints keeps a picture's shape; the height of one with many panels is the core's to say. */
  #height(id, width) {
    const [wide, high] = this.#described(id).natural_size;
    const most = this.#app.bindings.figure_height(id, width);
    return traits(id).grid ? most : Math.min(most, Math.max(LEAST_HEIGHT, (width * high) / wide));
  }

  /** What the lines of a torque's decomposition stand for. */
  #parts() {
    const theme = this.dark ? "dark" : "light";
    const { torque_lines } = this.#app.description;
    return torque_lines.map(({ id, color, dash }) => ({ id, name: texts.parts[id], color: color[theme], dash }));
  }

  #draw(card) {
    const scale = card.prepare();
    if (scale > 0) {
      const { bindings, runs } = this.#app;
      const { figure } = card.dataset;
      const places = bindings.draw_figure(runs, card.canvas, figure, this.viewOf(figure, scale));
      card.panels = readPanels(places, this.axis === "symlog" && this.hasSymlog(figure));
      card.stale = false;
      card.drawnAt = performance.now();
      this.#cursors.update();
    }
  }
}

function captions(id) {
  return { title: texts.titles[id], caption: texts.captions[id] };
}
