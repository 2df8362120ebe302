// Forms: labelled fields, one button, and what the server found wrong said at the field that it is about.

import { element } from "../dom.js";
import { explain } from "./explain.js";
import { showError } from "./parts.js";

let forms = 0;

/** A field for [`form`]: `read` gives its value for the request, and `pointer` is where the request has it. */
export function field({ name, label, help = null, pointer = `/${name}`, read = (input) => input.value, ...attributes }) {
  return { name, label, help, pointer, read, input: element("input", { type: "text", autocomplete: "off", ...attributes }) };
}

/** A field that is a choice: `options` as `[value, text]`. */
export function choice({ name, label, help = null, options, value, pointer = `/${name}`, read = (input) => input.value }) {
  const input = element("select", {}, options.map(([id, text]) => element("option", { value: id, selected: id === value }, text)));
  return { name, label, help, pointer, read, input };
}

/** A field that is on or off. */
export function check({ name, label, help = null, checked = false }) {
  const input = element("input", { type: "checkbox", checked });
  return { name, label, help, pointer: `/${name}`, read: () => input.checked, input };
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
    fields.forEach((one) => refuse(one, null));
    button.disabled = true;
    try {
      await act(Object.fromEntries(fields.map((one) => [one.name, one.read(one.input)])));
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
      refuse(wrong, explain(error));
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
export function numberOf(input) {
  const text = input.value.trim().replace(",", ".");
  return text === "" ? null : Number.isNaN(Number(text)) ? text : Number(text);
}
