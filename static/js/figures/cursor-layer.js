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
   * Shows `reading` (what `read_figure` gives; null for nothing). `lines` are what its values stand for, `{id, color, dash}`,
   * in the order of reading; `texts`: whether values are written; `selection`: `[from, to]` or null; `palette`: colours.
   */
  show({ reading, lines, texts, selection, palette }) {
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
    const known = new Map(lines.map((line, order) => [line.id, { ...line, order }]));
    const ordered = reading.panels.map(({ values }) =>
      values.filter(({ id }) => known.has(id)).sort((a, b) => known.get(a.id).order - known.get(b.id).order),
    );
    panels.forEach((panel, n) => this.#mark(panel, reading, ordered[n] ?? [], known));
    const visible = this.#card.plane || pixelOfAbscissa(panels[0], reading.time_s) !== null;
    this.#write(texts && visible ? ordered : null, reading.time_s, known);
  }

  /** The line and the dots of a panel. */
  #mark(panel, { time_s }, values, known) {
    const line = this.#card.plane ? null : pixelOfAbscissa(panel, time_s);
    if (line !== null) {
      this.#line(panel, line);
    }
    for (const { id, value, x } of values) {
      const at = this.#card.plane && x !== null ? pixelOfAbscissa(panel, x) : line;
      const y = value === null ? null : pixelOfOrdinate(panel, value);
      if (at !== null && y !== null) {
        this.#dot(at, y, known.get(id).color);
      }
    }
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

  /** Writes `values` per panel; null hides them. */
  #write(values, time, known) {
    this.#card.readings.hidden = values === null;
    if (values === null) {
      return;
    }
    this.#build(values, known);
    const { panels, plane, ratio } = this.#card;
    const written = panels.slice(0, values.length);
    written.forEach((panel, n) => {
      const readout = this.#readouts[n];
      // In a plane there is no line to stand beside.
      const x = plane ? panel.left - GAP * ratio : pixelOfAbscissa(panel, time);
      const flipped = !plane && x - panel.left > panel.right - x;
      readout.box.classList.toggle("flipped", flipped);
      place(readout.box, x / ratio + (flipped ? -GAP : GAP), panel.top / ratio);
      values[n].forEach(({ value }, run) => setText(readout.values[run], formatNumber(value, DIGITS)));
    });
    // As an axis has it: on the bottom axis, under the line.
    const lowest = panels.reduce((low, panel) => (panel.bottom > low.bottom ? panel : low), panels[0]);
    this.#time.hidden = plane;
    setText(this.#time, strings.figures.instant(formatNumber(time, TIME_DIGITS)));
    place(this.#time, (plane ? 0 : pixelOfAbscissa(lowest, time)) / ratio, lowest.bottom / ratio);
  }

  #build(values, known) {
    const lines = values.map((panel) => panel.map(({ id }) => known.get(id)));
    const key = JSON.stringify(lines);
    if (key === this.#built) {
      return;
    }
    this.#built = key;
    this.#readouts = lines.map((panel) => {
      const nodes = panel.map(() => element("span"));
      const rows = panel.map((line, n) => element("div", { "data-line": line.id }, mark(line), nodes[n]));
      return { values: nodes, box: element("div", { class: "reading", hidden: panel.length === 0 }, rows) };
    });
    this.#card.readings.replaceChildren(...this.#readouts.map(({ box }) => box), this.#time);
  }
}

/** A sample of a line; lines differ in colour and in dash. */
function mark({ color, dash }) {
  const svg = swatch({ dash });
  svg.firstChild.style.stroke = color;
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
