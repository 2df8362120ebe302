// What views of the classroom are built on: loaded when shown, again when asked, silent after they were left.

import { element } from "../dom.js";
import { texts } from "../strings/classroom.js";
import { showError } from "./parts.js";

const root = document.documentElement;

export class View {
  node = element("div", { class: "class-view" });
  failure = element("div", { class: "failure" });
  #stopped = false;

  /** Whether another view has taken its place. */
  get isStopped() {
    return this.#stopped;
  }

  /** What the view asks the server for; `draw` gets it. */
  async load() {}

  /** Shows what was loaded. */
  draw() {}

  async start() {
    this.failure.replaceChildren();
    try {
      const loaded = await this.load();
      if (this.#stopped) {
        return;
      }
      this.draw(loaded);
      root.dataset.state = "ready";
    } catch (error) {
      if (this.#stopped) {
        return;
      }
      root.dataset.state = "failed";
      if (!this.failure.isConnected) {
        this.node.append(this.failure);
      }
      const isGone = error.status === 404;
      showError(this.failure, error, isGone ? null : () => this.start());
      if (isGone) {
        // Asking again would not help; the start of the page does.
        this.failure.append(element("p", {}, element("a", { class: "back", href: "#" }, `← ${texts.toStart}`)));
      }
    }
  }

  stop() {
    this.#stopped = true;
  }

  /** Whoever it is for had been signed out, or without a connection, and is back: what was typed is still here, what could not be had is asked for anew. */
  resume() {
    if (root.dataset.state === "failed") {
      this.start();
    }
  }

  /** Does something and shows everything anew; what is wrong is said on top. */
  async act(change) {
    this.failure.replaceChildren();
    const { id } = document.activeElement;
    try {
      await change();
      await this.start();
      // What had the focus was drawn anew.
      ((id && document.getElementById(id)) || this.node.querySelector("h1"))?.focus({ preventScroll: true });
    } catch (error) {
      showError(this.failure, error);
      this.failure.scrollIntoView({ block: "nearest" });
    }
  }
}
