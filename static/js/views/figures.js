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

  /** `app` has bindings, runs, description and timeline; `container` takes toolbar and figures. */
  constructor(app, container) {
    this.#app = app;
    this.ids = available(app.description);
    this.#cursors = new Cursors(app.timeline, {
      read: (card, figure, time) => this.#read(card, figure, time),
      runs: () => this.runs,
      linear: (card) => this.axis === "linear" || !traits(card.dataset.figure).symlog,
    });
    container.append(buildToolbar(this, app.timeline), ...GROUPS.map((group) => this.#section(group)));
    app.timeline.addEventListener("window", () => this.redraw());
  }

  /** Makes another card of a figure and keeps it drawn; the caller places it. */
  add(id, zoom) {
    const { natural_size, paper_number } = this.#described(id);
    const card = element("figure-card");
    const note = paper_number ? texts.paperFigure(paper_number) : null;
    const aspect = natural_size[0] / natural_size[1];
    card.configure({ id, ...captions(id), note, aspect, zoom }, () => this.#queue.ask());
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
    this.#redrawOnly((id) => traits(id).symlog);
  }

  /** Chooses the run that figures of one run show. */
  chooseFocus(id) {
    this.focus = id;
    this.#redrawOnly((figure) => traits(figure).focus);
  }

  /** Everything in view is drawn: in the next frame, or with `after` now; `after` is called when it is on the canvases. */
  redraw(after) {
    for (const changed of this.#onRuns) {
      changed();
    }
    for (const card of this.#cards) {
      card.stale = true;
    }
    if (after) {
      this.#queue.hurry(after);
    } else {
      this.#queue.ask();
    }
  }

  #redrawOnly(concerned) {
    for (const card of this.#cards) {
      card.stale ||= concerned(card.dataset.figure) === true;
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

  /** Every run that is drawn: `{id, name, color}`, and `scheme` where it is a scheme's live run. */
  get runs() {
    const theme = this.dark ? "dark" : "light";
    const live = this.#schemes().map((scheme) => ({ id: scheme.id, name: scheme.name, color: scheme.color[theme], scheme }));
    return [...live, ...this.overlays.map(({ id, label, color }) => ({ id, name: label, color }))];
  }

  /** How a figure is to be drawn, as the core reads it. */
  viewOf(figure, scale) {
    const { timeline } = this.#app;
    const [from, to] = timeline.isZoomed ? timeline.window : [null, null];
    const live = this.shown.map((id) => ({ id, label: null, faded: false, color: null }));
    const faded = this.overlays.map(({ id, label, color }) => ({ id, label, faded: true, color }));
    const focus = this.runs.some(({ id }) => id === this.focus) ? this.focus : (this.runs[0]?.id ?? null);
    const axis = traits(figure).symlog ? this.axis : "linear";
    const view = { shown: [...faded, ...live], dark: this.dark, scale, from_s: from, to_s: to, axis, focus };
    return JSON.stringify({ ...view, true_value: texts.trueValue, time_axis: texts.timeAxis });
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

  #draw(card) {
    const scale = card.prepare();
    if (scale > 0) {
      const { bindings, runs } = this.#app;
      const { figure } = card.dataset;
      card.panels = readPanels(bindings.draw_figure(runs, card.canvas, figure, this.viewOf(figure, scale)));
      card.stale = false;
      card.drawnAt = performance.now();
      this.#cursors.update();
    }
  }

  #read(card, figure, time) {
    return JSON.parse(this.#app.bindings.read_figure(this.#app.runs, figure, this.viewOf(figure, card.ratio), time));
  }
}

function captions(id) {
  return { title: texts.titles[id], caption: texts.captions[id] };
}
