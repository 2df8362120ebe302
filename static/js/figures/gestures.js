// What a pointer on a figure does: point at an instant, select a stretch, move it, zoom.
//
// A wheel alone belongs to the page. With Ctrl or Cmd it zooms, as a pinch on a trackpad does (browsers report it so); two
// fingers sideways on a trackpad move the stretch once there is one. On a touch screen one finger sideways moves the
// cursor, up and down scrolls the page (`touch-action: pan-y`), two fingers zoom and move.

import { abscissaAt, panelAt } from "./panels.js";
import { panTo, zoomAbout, zoomTo } from "./window.js";

/** Layout pixels that a pointer moves before it is a drag. */
const DRAG = 5;
const LINE_HEIGHT = 16;
const WHEEL_MOST = 50;
const WHEEL_RATE = 0.01;

export class Gestures {
  #card;
  #timeline;
  #handlers;
  #drag = null;
  /** Fingers on the figure: identifier to place, in device pixels. */
  #fingers = new Map();
  #pinch = null;

  /** `handlers`: `reading(shown)` when values should be read out or not, `selection(from, to)` while a stretch is selected. */
  constructor(card, timeline, handlers) {
    this.#card = card;
    this.#timeline = timeline;
    this.#handlers = handlers;
    const on = (type, listener, options) => card.overlay.addEventListener(type, listener, options);
    on("pointerdown", (event) => this.#down(event));
    on("pointermove", (event) => this.#move(event));
    on("pointerup", (event) => this.#up(event));
    on("pointercancel", (event) => this.#cancel(event));
    on("pointerleave", (event) => this.#leave(event));
    on("dblclick", () => timeline.zoom(null));
    on("wheel", (event) => this.#wheel(event), { passive: false });
    on("keydown", ({ key }) => key === "Escape" && this.#cancel());
  }

  #down(event) {
    if (event.button !== 0 || this.#card.plane) {
      return;
    }
    const place = this.#place(event);
    const panel = panelAt(this.#card.panels, place.x, place.y) ?? this.#card.panels[0];
    if (!panel) {
      return;
    }
    this.#card.overlay.setPointerCapture(event.pointerId);
    if (event.pointerType === "touch") {
      this.#fingers.set(event.pointerId, place);
      if (this.#fingers.size === 2) {
        this.#drag = null;
        this.#pinch = { panel, window: this.#timeline.window, ...this.#spread() };
        return;
      }
    }
    const kind = event.pointerType === "touch" ? "scrub" : event.shiftKey ? "pan" : "select";
    this.#drag = { kind, panel, start: place, window: this.#timeline.window, moved: false };
  }

  #move(event) {
    const place = this.#place(event);
    if (this.#fingers.has(event.pointerId)) {
      this.#fingers.set(event.pointerId, place);
    }
    if (this.#pinch) {
      this.#pinched();
    } else if (this.#drag) {
      this.#dragged(place);
    } else if (event.pointerType !== "touch") {
      this.#hover(place);
    }
  }

  #up(event) {
    this.#fingers.delete(event.pointerId);
    if (this.#pinch) {
      // The finger that stays must not start to scrub.
      this.#pinch = this.#fingers.size > 0 ? { ...this.#pinch, over: true } : null;
      return;
    }
    const drag = this.#drag;
    this.#drag = null;
    if (!drag) {
      return;
    }
    const place = this.#place(event);
    if (drag.kind === "select" && drag.moved) {
      this.#handlers.selection(null);
      const ends = [drag.start, place].map(({ x }) => abscissaAt(drag.panel, x)).sort((a, b) => a - b);
      zoomTo(this.#timeline, ...ends);
      // What is under the pointer now is another instant; the next move says which.
      this.#timeline.hover(null);
    } else if (!drag.moved) {
      this.#seek(drag.panel, place);
    }
  }

  #cancel(event) {
    if (event) {
      this.#fingers.delete(event.pointerId);
    }
    this.#pinch = null;
    this.#drag = null;
    this.#handlers.selection(null);
  }

  #leave(event) {
    if (event.pointerType !== "touch") {
      this.#card.active = false;
      this.#timeline.hover(null);
      this.#handlers.reading(false);
    }
  }

  #hover(place) {
    const panel = !this.#card.plane ? panelAt(this.#card.panels, place.x, place.y) : null;
    this.#card.active = true;
    this.#timeline.hover(panel ? abscissaAt(panel, place.x) : null);
    this.#handlers.reading(panel !== null);
  }

  #dragged(place) {
    const drag = this.#drag;
    drag.moved ||= Math.abs(place.x - drag.start.x) > DRAG * this.#card.ratio;
    if (!drag.moved) {
      return;
    }
    const time = abscissaAt(drag.panel, place.x);
    if (drag.kind === "scrub") {
      this.#seek(drag.panel, place);
    } else if (drag.kind === "pan") {
      const [from, to] = drag.window;
      const moved = ((place.x - drag.start.x) / (drag.panel.right - drag.panel.left)) * (to - from);
      panTo(this.#timeline, from - moved, to - from);
    } else {
      this.#handlers.selection(abscissaAt(drag.panel, drag.start.x), time);
      this.#timeline.hover(time);
    }
  }

  #seek(panel, { x }) {
    this.#timeline.pause();
    this.#timeline.seek(abscissaAt(panel, x));
    this.#handlers.reading(true);
  }

  /** Two fingers: what was between them stays between them. */
  #pinched() {
    const { panel, window, middle, distance, over } = this.#pinch;
    if (over || this.#fingers.size < 2) {
      return;
    }
    const [from, to] = window;
    const now = this.#spread();
    const width = panel.right - panel.left;
    const held = from + ((middle - panel.left) / width) * (to - from);
    const span = Math.min((to - from) * (distance / now.distance), this.#timeline.duration);
    const start = held - ((now.middle - panel.left) / width) * span;
    zoomTo(this.#timeline, start, start + span);
  }

  #spread() {
    const [a, b] = [...this.#fingers.values()];
    return { middle: (a.x + b.x) / 2, distance: Math.max(Math.hypot(a.x - b.x, a.y - b.y), 20) };
  }

  #wheel(event) {
    const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE_HEIGHT : 1;
    const [dx, dy] = [event.deltaX * unit, event.deltaY * unit];
    if (event.ctrlKey || event.metaKey) {
      event.preventDefault();
      const place = this.#place(event);
      const panel = !this.#card.plane ? panelAt(this.#card.panels, place.x, place.y) : null;
      const time = panel ? abscissaAt(panel, place.x) : this.#timeline.time;
      zoomAbout(this.#timeline, time, Math.exp(Math.min(Math.max(dy, -WHEEL_MOST), WHEEL_MOST) * WHEEL_RATE));
    } else if (this.#timeline.isZoomed && Math.abs(dx) > Math.abs(dy)) {
      event.preventDefault();
      const [from, to] = this.#timeline.window;
      panTo(this.#timeline, from + (dx / this.#card.overlay.clientWidth) * (to - from), to - from);
    }
  }

  #place({ offsetX, offsetY }) {
    return { x: offsetX * this.#card.ratio, y: offsetY * this.#card.ratio };
  }
}
