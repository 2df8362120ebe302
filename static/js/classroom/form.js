// Forms: labelled fields, one button, and what the server found wrong said at the field that it is about.

import { element } from "../dom.js";
import { texts } from "../strings/classroom.js";
import { explainField } from "./explain.js";
import { points, showError } from "./parts.js";
import { fromLocal, toLocal } from "./times.js";

const wrongs = texts.fields;
/** Moments that the server takes. */
const EARLIEST = "2000-01-01T00:00";
const LATEST = "2999-12-31T00:00";

let forms = 0;

/**
 * A field for [`form`]: `read` gives its value for the request, and `pointer` is where the request has it. What its attributes
 * (`required`, `minlength`, `min`, ...) do not allow is said before anything is sent, and so is what `check(value)` returns.
 */
export function field({ name, label, help = null, pointer = `/${name}`, read = (input) => input.value, check = () => null, ...attributes }) {
  return { name, label, help, pointer, read, check, input: element("input", { type: "text", autocomplete: "off", ...attributes }) };
}

/** A field for a number between `min` and `max`, which reads as null where it is empty; `needed` ones may not be. */
export function numberField({ min, max, whole = false, needed = false, ...options }) {
  const wrong = (value) => {
    if (value === null) {
      return null;
    }
    if (typeof value !== "number" || !Number.isFinite(value)) {
      return wrongs.notANumber;
    }
    const outside = value < min || value > max ? wrongs.between(points(min), points(max)) : null;
    return outside ?? (whole && !Number.isInteger(value) ? wrongs.whole : null);
  };
  return field({ inputmode: whole ? "numeric" : "decimal", required: needed, read: numberOf, check: wrong, ...options });
}

/** A field for a moment. It reads as null where it is empty, and as the very moment it showed first where that still stands. */
export function momentField({ value, ...options }) {
  const shown = toLocal(value);
  const read = (input) => (input.value === shown ? (value ?? null) : fromLocal(input.value));
  return field({ type: "datetime-local", min: EARLIEST, max: LATEST, value: shown, read, ...options });
}

/** What fields hold, by name. */
export const valuesOf = (fields) => Object.fromEntries(fields.map((one) => [one.name, one.read(one.input)]));

/** A field that is a choice: `options` as `[value, text]`. */
export function choice({ name, label, help = null, options, value, pointer = `/${name}`, read = (input) => input.value }) {
  const input = element("select", {}, options.map(([id, text]) => element("option", { value: id, selected: id === value }, text)));
  return { name, label, help, pointer, read, check: () => null, input };
}

/** A field that is on or off. */
export function check({ name, label, help = null, checked = false }) {
  const input = element("input", { type: "checkbox", checked });
  return { name, label, help, pointer: `/${name}`, read: () => input.checked, check: () => null, input };
}

/**
 * A form; `act` gets the values by name and throws what is wrong. `groups` are fields, or elements to stand between them.
 */
export function form({ id, groups, submit, act, primary = true }) {
  const name = id ?? `form-${(forms += 1)}`;
  const fields = groups.filter((one) => one.input);
  const failure = element("div", { class: "failure" });
  const button = element("button", { type: "submit", class: primary ? "primary" : "" }, submit);
  const node = element("form", { id: name, class: "class-form", novalidate: true }, groups.map((one) => (one.input ? line(one, name) : one)));
  node.append(failure, button);
  node.addEventListener("submit", (event) => {
    event.preventDefault();
    send();
  });

  async function send() {
    failure.replaceChildren();
    const wrong = fields.map((one) => wrongIn(one));
    fields.forEach((one, n) => refuse(one, wrong[n]));
    const first = fields.find((_, n) => wrong[n] !== null);
    if (first) {
      first.input.focus();
      return;
    }
    button.disabled = true;
    try {
      await act(valuesOf(fields));
    } catch (error) {
      show(error);
    } finally {
      button.disabled = false;
    }
  }

  function show(error) {
    const { pointer } = error.problem ?? {};
    const wrong = pointer ? fields.find((one) => pointer === one.pointer || pointer.startsWith(`${one.pointer}/`)) : null;
    if (wrong) {
      refuse(wrong, explainField(error));
      wrong.input.focus();
    } else {
      showError(failure, error, error.isPassing ? send : null);
    }
  }
  return node;
}

function line(one, form) {
  const { input, label, help } = one;
  input.id = `${form}-${one.name}`;
  one.wrong = element("p", { class: "field-error", id: `${input.id}-error`, "aria-live": "polite" });
  const helpId = help ? `${input.id}-help` : null;
  input.setAttribute("aria-describedby", [helpId, one.wrong.id].filter(Boolean).join(" "));
  const isCheck = input.type === "checkbox";
  return element(
    "div",
    { class: isCheck ? "field field-check" : "field" },
    element("label", { for: input.id }, label),
    input,
    help ? element("p", { class: "help", id: helpId }, help) : null,
    one.wrong,
  );
}

/** What a field must not hold, in a sentence, or null; hidden ones hold what they may. */
function wrongIn({ input, read, check: wrong }) {
  const { validity, value, minLength } = input;
  if (input.closest("[hidden]")) {
    return null;
  }
  if (validity.badInput) {
    return wrongs.incomplete;
  }
  if (input.required && value.trim() === "") {
    return wrongs.needed;
  }
  if (minLength > 0 && value !== "" && value.length < minLength) {
    return wrongs.characters(minLength, input.maxLength);
  }
  return validity.rangeUnderflow || validity.rangeOverflow ? wrongs.moment : wrong(read(input));
}

function refuse(one, message) {
  one.wrong.textContent = message ?? "";
  one.input.setAttribute("aria-invalid", String(message !== null));
}

/** A button that does something which may fail; what is wrong is said in `place`. */
export function actionButton(label, place, act, attributes = {}) {
  const button = element("button", { type: "button", ...attributes, onclick: () => run() }, label);
  async function run() {
    place.replaceChildren();
    button.disabled = true;
    try {
      await act();
    } catch (error) {
      showError(place, error, error.isPassing ? run : null);
    } finally {
      button.disabled = false;
    }
  }
  return button;
}

/** A number from a field, or null where it is empty; what is no number stays text, for the server to refuse. */
function numberOf(input) {
  const text = input.value.trim().replace(",", ".");
  return text === "" ? null : Number.isNaN(Number(text)) ? text : Number(text);
}
