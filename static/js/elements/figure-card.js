// <figure-card>: a figure's title and its canvas, with a text that says what the canvas shows.
//
// Sizes the canvas to the device's pixels and asks to be drawn when its size changes or it comes into view; a card out of
// view is never drawn. The owner draws.

import { element } from "../dom.js";

/** Drawn a little before it scrolls into view. */
const MARGIN = "200px";

export class FigureCard extends HTMLElement {
  #size = { width: 0, height: 0 };
  #needed;
  #zoom;
  #title;
  /** In view, or nearly. */
  inView = false;
  /** Not showing the latest. */
  stale = true;

  /**
   * `{id, title, note, aspect, zoom}`: a zoom below 1 draws letters and lines smaller than elsewhere. `needed` is called when
   * the card should be drawn.
   */
  configure({ id, title, note, aspect, zoom = 1 }, needed) {
    this.#needed = needed;
    this.#zoom = zoom;
    this.#title = element("h3");
    this.canvas = element("canvas", { role: "img" });
    const box = element("div", { class: "canvas-box" }, this.canvas);
    box.style.setProperty("--aspect", aspect);
    this.replaceChildren(
      element("div", { class: "figure-head" }, this.#title, note ? element("span", { class: "figure-note" }, note) : null),
      box,
    );
    this.show({ id, title });
    new ResizeObserver(([entry]) => this.#resize(entry.contentRect)).observe(box);
    new IntersectionObserver(([entry]) => this.#move(entry.isIntersecting), { rootMargin: MARGIN }).observe(this);
  }

  /** Becomes the card of a figure. */
  show({ id, title }) {
    this.dataset.figure = id;
    this.#title.textContent = title;
    this.description = title;
    this.#ask();
  }

  /** What the canvas shows, in words. */
  set description(text) {
    this.canvas.setAttribute("aria-label", text);
  }

  /** Prepares the canvas for a drawing and returns device pixels per layout pixel of the drawing; 0 while it has no size. */
  prepare() {
    const scale = devicePixelRatio || 1;
    const width = Math.round(this.#size.width * scale);
    const height = Math.round(this.#size.height * scale);
    if (width < 1 || height < 1) {
      return 0;
    }
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    return scale * this.#zoom;
  }

  #resize({ width, height }) {
    if (width !== this.#size.width || height !== this.#size.height) {
      this.#size = { width, height };
      this.#ask();
    }
  }

  #move(inView) {
    this.inView = inView;
    if (inView && this.stale) {
      this.#needed();
    }
  }

  #ask() {
    this.stale = true;
    this.#needed();
  }
}

customElements.define("figure-card", FigureCard);
