// <arm-view>: the canvas that shows arms, and what happens when its graphics fail.
//
// Draws with the module's WebGL2 view, or flat where there is none. Draws at most once a frame and only what has changed and
// is in view, and asks for no drawing while another is still being made. Where a processor has to do the graphics card's
// work, it draws coarsely while things move and finely once they rest, and lets new results wait until they stop coming: the
// simulations need the processor more. Knows nothing of time or schemes: the owner says what to show.

import { element } from "../dom.js";
import { strings } from "../strings/index.js";
import { failureOf } from "../wasm.js";
import { drawFlat } from "./arm-flat.js";
import { Orbit } from "./orbit.js";

/** More device pixels than this per layout pixel cost time and are not seen. */
const FINEST = 2;
/** Where a processor draws without multisampling, more pixels smooth edges a little, and each takes time. */
const FINEST_BY_PROCESSOR = 1.4;
/** A context that has not come back by then does not come back. */
const PATIENCE_MS = 5000;
/** What has not changed for so long rests. */
const REST_MS = 350;

export class ArmView extends HTMLElement {
  #bindings;
  #runs;
  #wanted;
  #size = { width: 0, height: 0 };
  #inView = false;
  #frame = null;
  #resting = null;
  #fine = false;
  #gl = null;
  #flat = false;
  #lost = null;
  #box = element("div", { class: "arm-canvas" });
  #message = element("p", { class: "arm-message", role: "status" });
  orbit = new Orbit();
  /** Of the latest drawing, ms, and how many there were. */
  drawMs = 0;
  drawings = 0;

  /** Draws `runs`; `wanted` returns what to show, `{arms, time_s, dark, exaggeration}`. Emits "drawn" with what was, and "flat". */
  configure({ bindings, runs }, wanted) {
    this.#bindings = bindings;
    this.#runs = runs;
    this.#wanted = wanted;
    this.replaceChildren(this.#box, this.#message);
    this.#begin();
    this.orbit.addEventListener("change", () => this.redraw());
    new ResizeObserver(([entry]) => this.#resize(entry.contentRect)).observe(this.#box);
    new IntersectionObserver(([entry]) => this.#move(entry.isIntersecting)).observe(this);
  }

  /** Whether it is drawn without WebGL. */
  get isFlat() {
    return this.#flat;
  }

  /** What the canvas shows, in words. */
  set description(text) {
    if (this.canvas.getAttribute("aria-label") !== text) {
      this.canvas.setAttribute("aria-label", text);
    }
  }

  /** Something has changed: draws in the next frame in which it can be seen. */
  redraw() {
    this.#fine = false;
    this.#schedule();
  }

  /** The runs have changed, and may change again soon. */
  redrawRuns() {
    if (this.#gl?.is_slow) {
      this.#refine();
    } else {
      this.redraw();
    }
  }

  /** Newer runs are under way: what waits for rest waits anew. */
  runsAsked() {
    if (this.#resting !== null) {
      this.#refine();
    }
  }

  /** Draws finely once things rest. */
  #refine() {
    clearTimeout(this.#resting);
    this.#resting = setTimeout(() => {
      this.#resting = null;
      this.#fine = true;
      this.#schedule();
    }, REST_MS);
  }

  #schedule() {
    if (this.#inView && this.#frame === null) {
      this.#frame = requestAnimationFrame(() => this.#draw());
    }
  }

  #begin() {
    try {
      this.#gl = this.#newView(true);
      if (this.#gl.is_slow && this.#gl.is_smooth) {
        // Multisampling takes a processor longer; who draws is known only from a context, which keeps its attributes.
        const smooth = this.#gl;
        this.#gl = this.#newView(false);
        smooth.free();
      }
    } catch (error) {
      this.#fallBack(failureOf(error).message);
      return;
    }
    this.canvas.addEventListener("webglcontextlost", (event) => this.#loseContext(event));
    this.canvas.addEventListener("webglcontextrestored", () => this.#restoreContext());
    this.orbit.attach(this.canvas);
  }

  #newView(smooth) {
    this.#newCanvas("application", strings.stage.kind);
    return new this.#bindings.ArmView(this.canvas, smooth);
  }

  /** A canvas that has had a context of one kind never gives one of another. */
  #newCanvas(role, kind) {
    const description = this.canvas?.getAttribute("aria-label") ?? strings.stage.title;
    const interactive = role === "application";
    this.canvas = element("canvas", {
      role,
      tabindex: interactive ? 0 : null,
      "aria-label": description,
      "aria-roledescription": interactive ? kind : null,
      "aria-describedby": interactive ? "stage-hint" : null,
    });
    this.#box.replaceChildren(this.canvas);
  }

  #fallBack(reason) {
    this.#gl = null;
    this.#flat = true;
    this.#newCanvas("img", strings.stage.kindFlat);
    this.toggleAttribute("data-flat", true);
    this.#message.textContent = strings.stage.flat(reason);
    this.dispatchEvent(new Event("flat"));
    this.redraw();
  }

  #loseContext(event) {
    // Without this the browser does not restore it.
    event.preventDefault();
    this.#gl?.free();
    this.#gl = null;
    this.#message.textContent = strings.stage.lost;
    this.#lost = setTimeout(() => this.#fallBack(strings.stage.notRestored), PATIENCE_MS);
  }

  #restoreContext() {
    if (this.#flat) {
      return;
    }
    clearTimeout(this.#lost);
    try {
      // With the attributes that the canvas' first context had.
      this.#gl = new this.#bindings.ArmView(this.canvas, true);
      this.#message.textContent = "";
      this.redraw();
    } catch (error) {
      this.#fallBack(failureOf(error).message);
    }
  }

  #draw() {
    this.#frame = null;
    if (this.#gl?.is_busy) {
      this.#schedule();
      return;
    }
    const slow = this.#gl?.is_slow === true;
    const scale = this.#scale(slow);
    const width = Math.round(this.#size.width * scale);
    const height = Math.round(this.#size.height * scale);
    if (width < 1 || height < 1 || (!this.#gl && !this.#flat)) {
      return;
    }
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    const start = performance.now();
    const view = { ...this.#wanted(), camera: this.orbit.camera, width, height, scale };
    if (this.#flat) {
      drawFlat(this.#bindings, this.#runs, this.canvas, view);
    } else {
      this.#gl.draw(this.#runs, JSON.stringify(view));
    }
    this.drawMs = performance.now() - start;
    this.drawings += 1;
    if (slow && !this.#fine) {
      this.#refine();
    }
    this.dispatchEvent(new CustomEvent("drawn", { detail: view }));
  }

  /** Device pixels per layout pixel. */
  #scale(slow) {
    if (slow && !this.#fine) {
      return 1;
    }
    // Where nothing else smooths edges, more pixels do.
    return slow && !this.#gl.is_smooth ? FINEST_BY_PROCESSOR : Math.min(devicePixelRatio || 1, FINEST);
  }

  #resize({ width, height }) {
    this.#size = { width, height };
    this.redraw();
  }

  #move(inView) {
    this.#inView = inView;
    this.#schedule();
  }
}

customElements.define("arm-view", ArmView);
