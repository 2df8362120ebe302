// <number-field>: one number as a slider and a text field beside it, with a reset and a place for what is wrong.
//
// Emits `edit` with `{value}`: a number, or the text typed where it is none. The owner answers with `accept`
// or by setting `error` (refused; the text stays for the visitor to mend). The text field takes values beyond the slider's ends.

import { element, symbol } from "../dom.js";
import { formatExact, parseTyped } from "../format.js";
import { strings } from "../strings/index.js";

let created = 0;

export class NumberField extends HTMLElement {
  #scale;
  #default;
  #unit;
  #value;
  #slider;
  #text;
  #reset;
  #message;

  /** `{caption, label, unit, scale, defaultValue}`: short caption to see, full label to hear, scale from scale.js. */
  configure({ caption, label, unit, scale, defaultValue }) {
    this.#scale = scale;
    this.#default = defaultValue;
    this.#unit = unit;
    const id = `field-${(created += 1)}`;
    const described = `${id}-error`;
    const { min, max } = scale;
    this.#slider = element("input", { type: "range", id, min, max, step: 1, oninput: () => this.#slide() });
    this.#text = element("input", {
      type: "text",
      inputmode: "decimal",
      autocomplete: "off",
      spellcheck: "false",
      "aria-label": strings.exactly(label),
      "aria-describedby": described,
      oninput: () => this.#type(),
      onblur: () => this.#settle(),
      onkeydown: (event) => event.key === "Escape" && this.#restore(),
    });
    this.#reset = element(
      "button",
      { type: "button", class: "reset", "aria-label": strings.reset(label), title: strings.reset(label), onclick: () => this.#emit(defaultValue) },
      "↺",
    );
    const span = max - min || 1;
    this.#slider.style.setProperty("--default-at", (scale.position(defaultValue) - min) / span);
    this.#message = element("p", { class: "field-error", id: described, "aria-live": "polite", hidden: true });
    this.replaceChildren(
      element("label", { for: id, title: label }, symbol(caption), element("span", { class: "visually-hidden" }, ` ${label}`)),
      this.#slider,
      element("span", { class: "exact" }, this.#text, element("span", { class: "unit" }, unit)),
      this.#reset,
      this.#message,
    );
  }

  get value() {
    return this.#value;
  }

  /** Shows the state's value unless that is shown already; text that was refused then stays to be mended. */
  show(value) {
    if (value !== this.#value) {
      this.accept(value);
    }
  }

  /** Shows an accepted value and forgets what was wrong. */
  accept(value) {
    this.#value = value;
    this.#slider.value = this.#scale.position(value);
    this.#slider.setAttribute("aria-valuetext", `${formatExact(value)} ${this.#unit}`.trim());
    // Not while it is being typed: "0." must be allowed to become "0.5".
    if (document.activeElement !== this.#text || parseTyped(this.#text.value) !== value) {
      this.#text.value = formatExact(value);
    }
    this.#reset.disabled = value === this.#default;
    this.error = null;
  }

  /** Shows why the text typed was refused; null when nothing is wrong. */
  set error(message) {
    this.#message.textContent = message ?? "";
    this.#message.hidden = message === null;
    this.#text.setAttribute("aria-invalid", message === null ? "false" : "true");
    this.classList.toggle("invalid", message !== null);
  }

  /** Whether the text typed was refused: then what it shows is not its value. */
  get isRefused() {
    return this.classList.contains("invalid");
  }

  /** Puts the focus into the text, to mend it. */
  mend() {
    this.#text.focus();
  }

  #slide() {
    this.#emit(this.#scale.value(Number(this.#slider.value)));
  }

  #type() {
    this.#emit(parseTyped(this.#text.value));
  }

  #settle() {
    if (!this.isRefused) {
      this.#text.value = formatExact(this.#value);
    }
  }

  /** Back to the last accepted value. */
  #restore() {
    this.#text.value = formatExact(this.#value);
    this.error = null;
  }

  #emit(value) {
    this.dispatchEvent(new CustomEvent("edit", { detail: { value } }));
  }
}

customElements.define("number-field", NumberField);
