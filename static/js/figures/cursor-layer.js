// What lies over one figure: the line at the instant, a dot on each curve, the stretch being selected, and the read-outs.
//
// Lines and dots are drawn on the card's upper canvas; the figure below is not touched. Each panel's read-out stands beside
// the line, on the side with more room, so that it is never under the pointer, which is on the line.

import { element, swatch } from "../dom.js";
import { formatNumber } from "../format.js";
import { strings } from "../strings/index.js";
import { pixelOfAbscissa, pixelOfOrdinate } from "./panels.js";

const GAP = 10;
const DOT = 3.5;
const DIGITS = 4;
const TIME_DIGITS = 4;

export class CursorLayer {
  #card;
  #context;
  #built = "";
  /** Per panel: its box and its values' nodes. */
  #readouts = [];
  #time = element("span", { class: "reading-time" });
  #drawn = false;
  #palette;

  constructor(card) {
    this.#card = card;
    this.#context = card.overlay.getContext("2d");
  }

  /**
   * Shows `reading` (what `read_figure` gives; null for nothing) at the panels' instant. `abscissas` are places on the
   * horizontal axes per panel and value where that is not time. `runs`: `{id, color, scheme}`; `texts`: whether values are
   * written; `linear`: whether the vertical axis is; `selection`: `[from, to]` or null; `palette`: colours.
   */
  show({ reading, abscissas, runs, texts, linear, selection, palette }) {
    this.#palette = palette;
    this.clear();
    const { panels } = this.#card;
    if (selection) {
      this.#select(panels, selection);
    }
    if (!reading || panels.length === 0) {
      this.#write(null);
      return;
    }
    this.#drawn = true;
    const colors = new Map(runs.map(({ id, color }) => [id, color]));
    panels.forEach((panel, n) => {
      const x = abscissas ? null : pixelOfAbscissa(panel, reading.time_s);
      if (x !== null) {
        this.#line(panel, x);
      }
      reading.panels[n]?.values.forEach(({ id, value }, run) => {
        const at = abscissas ? pixelOfAbscissa(panel, abscissas[n]?.values[run]?.value ?? NaN) : x;
        if (at !== null && linear && value !== null) {
          this.#dot(at, pixelOfOrdinate(panel, value), colors.get(id));
        }
      });
    });
    const visible = abscissas || pixelOfAbscissa(panels[0], reading.time_s) !== null;
    this.#write(texts && visible ? reading : null, runs, abscissas !== null);
  }

  /** Takes lines and dots away. */
  clear() {
    if (this.#drawn) {
      this.#context.clearRect(0, 0, this.#card.overlay.width, this.#card.overlay.height);
      this.#drawn = false;
    }
  }

  #line(panel, x) {
    const context = this.#context;
    context.strokeStyle = this.#palette.cursor;
    context.lineWidth = Math.max(1, Math.round(this.#card.ratio));
    context.beginPath();
    context.moveTo(Math.round(x) + 0.5, panel.top);
    context.lineTo(Math.round(x) + 0.5, panel.bottom);
    context.stroke();
  }

  #dot(x, y, color) {
    if (y === null) {
      return;
    }
    const context = this.#context;
    context.beginPath();
    context.arc(x, y, DOT * this.#card.ratio, 0, 2 * Math.PI);
    context.fillStyle = color;
    context.fill();
    context.lineWidth = this.#card.ratio;
    context.strokeStyle = this.#palette.background;
    context.stroke();
  }

  #select(panels, [from, to]) {
    this.#drawn = true;
    const context = this.#context;
    context.fillStyle = this.#palette.selection;
    for (const panel of panels) {
      const [left, right] = [from, to].map((time) => pixelOfAbscissa(panel, time) ?? panel.left).sort((a, b) => a - b);
      context.fillRect(left, panel.top, right - left, panel.bottom - panel.top);
    }
  }

  #write(reading, runs, plane) {
    this.#card.readings.hidden = reading === null;
    if (reading === null) {
      return;
    }
    this.#build(reading, runs);
    const { panels, ratio } = this.#card;
    reading.panels.forEach(({ values }, n) => {
      const readout = this.#readouts[n];
      const panel = panels[n];
      if (!panel) {
        return;
      }
      // In a plane there is no line to stand beside: the corner is free of the pointer's instant.
      const x = plane ? panel.left - GAP * ratio : pixelOfAbscissa(panel, reading.time_s);
      const flipped = x - panel.left > panel.right - x;
      readout.box.classList.toggle("flipped", flipped);
      place(readout.box, x / ratio + (flipped ? -GAP : GAP), panel.top / ratio);
      values.forEach(({ value }, run) => setText(readout.values[run], formatNumber(value, DIGITS)));
    });
    // As an axis has it: on the bottom axis, under the line.
    const lowest = panels.reduce((low, panel) => (panel.bottom > low.bottom ? panel : low), panels[0]);
    const at = plane ? (lowest.left + lowest.right) / 2 : pixelOfAbscissa(lowest, reading.time_s);
    setText(this.#time, strings.figures.instant(formatNumber(reading.time_s, TIME_DIGITS)));
    this.#time.hidden = plane;
    place(this.#time, at / ratio, lowest.bottom / ratio);
  }

  #build({ panels }, runs) {
    const key = JSON.stringify([panels.map(({ values }) => values.map(({ id }) => id)), runs]);
    if (key === this.#built) {
      return;
    }
    this.#built = key;
    const known = new Map(runs.map((run) => [run.id, run]));
    this.#readouts = panels.map((panel) => {
      const values = panel.values.map(() => element("span"));
      const rows = panel.values.map(({ id }, n) => element("div", { "data-run": id }, mark(known.get(id)), values[n]));
      return { values, box: element("div", { class: "reading" }, rows) };
    });
    this.#card.readings.replaceChildren(...this.#readouts.map(({ box }) => box), this.#time);
  }
}

/** A sample of a run's line; runs of one scheme differ in colour, schemes also in dash. */
function mark(run) {
  const svg = swatch(run?.scheme ?? {});
  if (run) {
    svg.firstChild.style.stroke = run.color;
  }
  return svg;
}

function place(node, x, y) {
  node.style.setProperty("--x", `${x.toFixed(1)}px`);
  node.style.setProperty("--y", `${y.toFixed(1)}px`);
}

function setText(node, text) {
  if (node && node.textContent !== text) {
    node.textContent = text;
  }
}
