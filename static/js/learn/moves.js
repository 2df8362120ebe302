// The numbers that a student may move, as sliders; each edit is shown to `change`, which says what is wrong with it or nothing.

import "../elements/number-field.js";
import { element, symbol } from "../dom.js";
import { linear } from "../scale.js";
import { localized } from "../strings/classroom.js";

const STEPS = 200;
const MOST_STEPS = 1000;

/** A panel of sliders; `show(gains)` sets them, `read()` has what they show. */
export class Moves {
  node = element("div", { class: "moves" });
  #fields = new Map();
  #gains = {};

  /** `moves` of the exercise; `change(gains)` returns null, or a message against them. */
  constructor(moves, gains, change) {
    for (const move of moves) {
      const field = element("number-field", { "data-move": move.name });
      const label = localized(move.label);
      field.configure({ caption: "", label, unit: move.unit ?? "", scale: scaleOf(move), defaultValue: move.start });
      field.addEventListener("edit", ({ detail: { value } }) => {
        const wanted = { ...this.#gains, [move.name]: value };
        const wrong = change(wanted, move);
        if (wrong === null) {
          this.#gains = wanted;
          field.accept(value);
        } else {
          field.error = wrong;
        }
      });
      this.#fields.set(move.name, field);
      this.node.append(element("div", { class: "gain move", role: "group", "aria-label": label }, element("p", { class: "gain-meaning" }, symbol(label)), field));
    }
    this.show(gains);
  }

  /** Sets all of them. */
  show(gains) {
    this.#gains = { ...gains };
    for (const [name, field] of this.#fields) {
      field.accept(gains[name]);
    }
  }

  /** The first field whose text was refused, or null: what it shows is not what `read()` has. */
  get refused() {
    return [...this.#fields.values()].find(({ isRefused }) => isRefused) ?? null;
  }

  /** What was last accepted, by name. */
  read() {
    return { ...this.#gains };
  }
}

/** Over a move's whole range, in its steps or evenly; in the logarithm where the move says so. */
function scaleOf({ min, max, log, step }) {
  if (log && min > 0) {
    const decades = Math.log10(max / min) / STEPS;
    return {
      min: 0,
      max: STEPS,
      position: (value) => Math.round(Math.log10(Math.min(Math.max(value, min), max) / min) / decades),
      value: (at) => (at === STEPS ? max : Number((min * 10 ** (at * decades)).toPrecision(3))),
    };
  }
  const steps = step ? Math.min(MOST_STEPS, Math.round((max - min) / step)) : STEPS;
  return linear(min, max, Math.max(1, steps));
}
