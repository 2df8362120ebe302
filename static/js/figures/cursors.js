// The cursor that all figures share: a line at the timeline's instant in every figure in view, values beside it.
//
// Moves at most once a frame. Values are written while someone reads (points, touches, uses keys); while the run plays only
// line and dots move. What is read with keys is also said.

import { announce } from "../announce.js";
import { formatSeconds } from "../format.js";
import { strings } from "../strings/index.js";
import { traits } from "./catalogue.js";
import { CursorLayer } from "./cursor-layer.js";
import { describeReading } from "./describe.js";
import { Gestures } from "./gestures.js";
import { bindKeys } from "./keys.js";

export class Cursors {
  #timeline;
  #source;
  #layers = new Map();
  #frame = null;
  #reading = false;
  #selection = null;
  #palette = {};

  /** `source`: `read(card, time)` gives what `read_figure` does, `lines(card)` what stands for what. */
  constructor(timeline, source) {
    this.#timeline = timeline;
    this.#source = source;
    timeline.addEventListener("time", () => this.update());
    timeline.addEventListener("playing", () => this.#read(this.#reading && !timeline.isPlaying));
    // Where there is no pointer that leaves, touching something else ends the reading.
    document.addEventListener("pointerdown", ({ target }) => target.closest("figure-card") ?? this.#read(false));
  }

  /** Makes a card take pointers and keys. */
  add(card) {
    const { overlay } = card;
    this.#layers.set(card, new CursorLayer(card));
    overlay.tabIndex = 0;
    overlay.setAttribute("role", "slider");
    overlay.setAttribute("aria-describedby", "figure-keys");
    new Gestures(card, this.#timeline, {
      reading: (shown) => this.#read(shown),
      selection: (from, to) => this.#select(from === null ? null : { card, ends: [from, to] }),
    });
    bindKeys(card, this.#timeline, () => {
      this.#read(true);
      this.#say(card);
    });
    overlay.addEventListener("focus", () => {
      card.active = true;
      this.update();
    });
    overlay.addEventListener("blur", () => {
      card.active = false;
      this.#read(false);
    });
    overlay.addEventListener("keydown", ({ key }) => key === "Escape" && this.#read(false));
    this.rename(card);
  }

  /** After a card became another figure's. */
  rename(card) {
    const id = card.dataset.figure;
    card.plane = traits(id).plane === true;
    card.overlay.setAttribute("aria-label", strings.figures.cursorOf(strings.figures.titles[id]));
    this.update();
  }

  /** Moves the cursor in the next frame: time, panels or runs have changed. */
  update() {
    this.#frame ??= requestAnimationFrame(() => this.#show());
  }

  #read(shown) {
    if (shown !== this.#reading) {
      this.#reading = shown;
      this.update();
    }
  }

  #select(selection) {
    this.#selection = selection;
    this.update();
  }

  #show() {
    this.#frame = null;
    const { time, isPlaying } = this.#timeline;
    // At the start of a page that nobody has touched there is nothing to point at.
    const pointed = this.#reading || isPlaying || time > 0;
    const palette = this.#colors();
    for (const [card, layer] of this.#layers) {
      if (card.inView && card.panels.length > 0) {
        layer.show({
          reading: pointed ? this.#source.read(card, time) : null,
          lines: this.#source.lines(card),
          texts: this.#reading,
          selection: this.#selection?.card === card ? this.#selection.ends : null,
          palette,
        });
      } else {
        layer.clear();
      }
      this.#state(card);
    }
  }

  /** Colours of the theme, asked for once: asking makes the browser lay out the page. */
  #colors() {
    const { theme } = document.documentElement.dataset;
    if (theme !== this.#palette.theme) {
      const style = getComputedStyle(document.documentElement);
      const color = (name) => style.getPropertyValue(name).trim();
      const [cursor, selection, background] = ["--muted", "--selection", "--plot-background"].map(color);
      this.#palette = { theme, cursor, selection, background };
    }
    return this.#palette;
  }

  /** What a reader of the screen is told of the slider; only where it has the focus, to spare the rest the work. */
  #state({ overlay }) {
    const focused = document.activeElement === overlay;
    if (focused || !overlay.hasAttribute("aria-valuenow")) {
      overlay.setAttribute("aria-valuemin", "0");
      overlay.setAttribute("aria-valuemax", this.#timeline.duration.toFixed(3));
      overlay.setAttribute("aria-valuenow", this.#timeline.position.toFixed(3));
      overlay.setAttribute("aria-valuetext", formatSeconds(this.#timeline.position));
    }
  }

  #say(card) {
    announce(describeReading(this.#source.read(card, this.#timeline.position), this.#source.lines(card)));
  }
}
