// <figure-card>: a figure's title, caption, canvas and, over the canvas, a layer for the cursor that takes pointers and keys.
//
// Keeps the canvas at the device's pixels, whatever their ratio becomes, and asks to be drawn when its size changes or it
// comes into view; a card out of view is never drawn. The owner draws and says what pointers and keys do.

import { element } from "../dom.js";
import { onPixelRatio } from "../figures/pixel-ratio.js";

/** Drawn a little before it scrolls into view. */
const MARGIN = "200px";
let cards = 0;

export class FigureCard extends HTMLElement {
  /** Device pixels of the canvas, and its width in layout pixels. */
  #size = { width: 0, height: 0, layout: 0 };
  #needed;
  #zoom;
  #height;
  #title;
  #caption;
  /** In view, or nearly. */
  inView = false;
  /** Whether the browser has said if it is in view. */
  placed = false;
  /** Being pointed at or holding the focus. */
  active = false;
  /** Not showing the latest. */
  stale = true;
  /** When it was drawn, on the clock of `performance.now`. */
  drawnAt = 0;
  /** Where its panels are on the canvas: what the last drawing said. */
  panels = [];

  /**
   * `{id, title, caption, note, height, zoom}`: `height(id, width)` in layout pixels; a zoom below 1 draws letters and lines
   * smaller than elsewhere. `needed` is called when the card should be drawn.
   */
  configure({ id, title, caption, note, height, zoom = 1 }, needed) {
    this.#needed = needed;
    this.#zoom = zoom;
    this.#title = element("h3", { id: `figure-title-${(cards += 1)}` });
    this.#caption = element("p", { class: "figure-caption" });
    this.canvas = element("canvas", { role: "img" });
    this.overlay = element("canvas", { class: "figure-overlay" });
    this.readings = element("div", { class: "figure-readings", "aria-hidden": "true" });
    /** For controls of this figure. */
    this.tools = element("div", { class: "figure-tools" });
    this.box = element("div", { class: "canvas-box" }, this.canvas, this.overlay, this.readings);
    this.#height = height;
    const head = [this.#title, note ? element("span", { class: "figure-note" }, note) : null, this.tools];
    this.replaceChildren(element("div", { class: "figure-head" }, head), this.#caption, this.box);
    this.show({ id, title, caption });
    this.#observe();
  }

  /** Becomes the card of a figure. */
  show({ id, title, caption }) {
    this.dataset.figure = id;
    this.#title.textContent = title;
    this.#caption.textContent = caption ?? "";
    this.description = title;
    this.panels = [];
    this.#ask();
  }

  /** Identifier of its title, to name controls by. */
  get titleId() {
    return this.#title.id;
  }

  /** What the canvas shows, in words. */
  set description(text) {
    this.canvas.setAttribute("aria-label", text);
  }

  /** Device pixels per layout pixel of the page. */
  get ratio() {
    return this.#size.layout > 0 ? this.#size.width / this.#size.layout : 1;
  }

  /** Prepares the canvases for a drawing and returns device pixels per layout pixel of the drawing; 0 while without size. */
  prepare() {
    const { width, height } = this.#size;
    if (width < 1 || height < 1) {
      return 0;
    }
    for (const canvas of [this.canvas, this.overlay]) {
      if (canvas.width !== width || canvas.height !== height) {
        canvas.width = width;
        canvas.height = height;
      }
    }
    return (devicePixelRatio || 1) * this.#zoom;
  }

  #observe() {
    new ResizeObserver(([entry]) => this.#resize(entry.contentRect)).observe(this.box);
    onPixelRatio(() => this.#resize({ width: this.box.clientWidth, height: this.box.clientHeight }));
    new IntersectionObserver(([entry]) => this.#move(entry.isIntersecting), { rootMargin: MARGIN }).observe(this);
  }

  #resize({ width: layout, height: high }) {
    if (layout > 0) {
      this.box.style.setProperty("--height", `${Math.round(this.#height(this.dataset.figure, layout))}px`);
    }
    const scale = devicePixelRatio || 1;
    const [width, height] = [Math.round(layout * scale), Math.round(high * scale)];
    if (width !== this.#size.width || height !== this.#size.height) {
      this.#size = { width, height, layout };
      this.#ask();
    }
  }

  #move(inView) {
    this.inView = inView;
    const first = !this.placed;
    this.placed = true;
    if (first || (inView && this.stale)) {
      this.#needed();
    }
  }

  #ask() {
    this.stale = true;
    this.#needed();
  }
}

customElements.define("figure-card", FigureCard);
