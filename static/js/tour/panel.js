// The tour's panel: docked at the head of the controls, a sheet at the bottom where there is one column. Says one step.

import { element, symbol } from "../dom.js";
import { strings } from "../strings/index.js";

export class TourPanel {
  #words = strings.tour;
  #progress = element("p", { class: "tour-progress" });
  #title = element("h2", { id: "tour-title", tabindex: "-1" });
  #text = element("div", { class: "tour-text" });
  #verdict = element("div", { class: "tour-verdict" });
  #choices = element("div", { class: "tour-choices" });
  #back;
  #next;

  /** `handlers`: `move(by)`, `close()`. */
  constructor(handlers) {
    const words = this.#words;
    this.#back = element("button", { type: "button", id: "tour-back", onclick: () => handlers.move(-1) }, words.back);
    this.#next = element("button", { type: "button", id: "tour-next", class: "primary", onclick: () => handlers.move(1) });
    this.node = element(
      "section",
      { id: "tour", class: "tour", "aria-labelledby": "tour-title", hidden: true },
      element(
        "div",
        { class: "tour-head" },
        this.#progress,
        element("button", { type: "button", class: "info-close", id: "tour-close", "aria-label": words.close, onclick: () => handlers.close() }, "×"),
      ),
      element("div", { class: "tour-body", "aria-live": "polite" }, this.#title, this.#text, this.#verdict),
      element("div", { class: "tour-foot" }, this.#choices, element("div", { class: "tour-nav" }, this.#back, this.#next)),
    );
  }

  /** Says a step; `choices` are buttons. */
  show({ number, count, title, paragraphs, choices }) {
    const words = this.#words;
    this.node.hidden = false;
    this.#progress.textContent = words.progress(number, count);
    this.#title.textContent = title;
    this.#text.replaceChildren(...paragraphs.map((text) => element("p", {}, symbol(text))));
    this.#choices.replaceChildren(...choices);
    this.#verdict.replaceChildren();
    this.#next.textContent = number === count ? words.finish : words.next;
    if (number === 1 && document.activeElement === this.#back) {
      this.#next.focus();
    }
    this.#back.disabled = number === 1;
  }

  /** Shows what became of the step's claim, or other nodes. */
  set verdict(nodes) {
    this.#verdict.replaceChildren(...nodes);
  }

  focus() {
    this.#title.focus({ preventScroll: true });
  }

  hide() {
    this.node.hidden = true;
  }
}
