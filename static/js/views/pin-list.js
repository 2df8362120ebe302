// The pinned runs as a list: name, shown or not, how their runs stand, use and remove.

import { announce } from "../announce.js";
import { element } from "../dom.js";
import { notice } from "../notice.js";
import { strings } from "../strings/index.js";

const texts = strings.compare;
const NAME_LENGTH = 40;

/** Returns `{list, show}`. Rows stay the same elements, so that nothing takes the focus from a name being typed. */
export function buildPinList({ pins, words, laboratory, history: steps, description }) {
  const rows = new Map();
  const list = element("ul", { class: "pins", "aria-label": texts.list });

  function row(pin) {
    const name = element("input", {
      type: "text",
      class: "pin-name",
      maxlength: NAME_LENGTH,
      "aria-label": texts.nameLabel(pin.slot),
      autocomplete: "off",
      onchange: () => rename(pin, name),
      onkeydown: (event) => event.key === "Enter" && rename(pin, name),
    });
    const toggle = element("input", { type: "checkbox", onchange: () => pins.update(pin, { shown: toggle.checked }) });
    const use = element("button", { type: "button", class: "pin-use", onclick: () => restore(pin) }, texts.usePin);
    const remove = element("button", { type: "button", class: "pin-remove", onclick: () => drop(pin) }, texts.removePin);
    const standing = element("p", { class: "pin-standing" });
    const node = element(
      "li",
      { class: "pin", "data-pin": pin.slot },
      element("label", { class: "pin-toggle" }, toggle, element("span", { class: "pin-mark", "aria-hidden": "true" }, String(pin.slot))),
      name,
      use,
      remove,
      standing,
    );
    node.style.setProperty("--pin", `var(--pin-${pin.slot})`);
    return { node, name, toggle, use, remove, standing };
  }

  function rename(pin, field) {
    const name = field.value.trim();
    pins.update(pin, { name: name === "" ? pin.name : name });
    field.value = pin.name;
  }

  function restore(pin) {
    const failure = steps.as({ kind: "pin", name: pin.name }, () => laboratory.replace(pin.documents));
    if (failure) {
      notice(failure.message, "error");
    }
  }

  function drop(pin) {
    const next = rows.get(pin).node.nextElementSibling ?? rows.get(pin).node.previousElementSibling;
    pins.remove(pin);
    announce(texts.removed(pin.name));
    (next?.querySelector(".pin-name") ?? document.getElementById("pin-runs-here")).focus();
  }

  function standing(pin) {
    const failures = Object.entries(pin.failures).map(([id, message]) => `${words.scheme(id)}: ${texts.pinFailed(message)}`);
    if (failures.length > 0) {
      return failures.join(" ");
    }
    if (pin.differs.length > 0) {
      return texts.otherBits(pin.differs.map((id) => words.scheme(id)).join(", "));
    }
    return Object.keys(pin.reports).length < description.schemes.length ? texts.computing : texts.sameBits;
  }

  function show() {
    for (const [pin, { node }] of rows) {
      if (!pins.list.includes(pin)) {
        node.remove();
        rows.delete(pin);
      }
    }
    pins.list.forEach((pin, n) => {
      if (!rows.has(pin)) {
        rows.set(pin, row(pin));
        rows.get(pin).name.value = pin.name;
      }
      const { node, name, toggle, use, remove, standing: text } = rows.get(pin);
      if (list.children[n] !== node) {
        list.insertBefore(node, list.children[n] ?? null);
      }
      if (document.activeElement !== name) {
        name.value = pin.name;
      }
      toggle.checked = pin.shown;
      toggle.setAttribute("aria-label", texts.showPin(pin.name));
      use.setAttribute("aria-label", texts.useThis(pin.name));
      remove.setAttribute("aria-label", texts.removeThis(pin.name));
      const said = standing(pin);
      if (text.textContent !== said) {
        text.textContent = said;
      }
      node.classList.toggle("differs", pin.differs.length > 0 || Object.keys(pin.failures).length > 0);
    });
  }
  return { list, show };
}
