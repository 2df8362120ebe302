// A button for what cannot be undone: asks once more in its own place.

import { element } from "../dom.js";

/**
 * A button that asks `question` and calls `act` after a yes. Texts: `{label, name, question, yes, no}`, where `name` is what
 * screen readers say instead of the label.
 */
export function confirmButton({ label, name, question, yes, no }, act) {
  const box = element("span", { class: "confirm" });
  const start = element("button", { type: "button", class: "quiet", "aria-label": name, onclick: () => open() }, label);
  const agree = element("button", { type: "button", class: "danger", onclick: () => agreed() }, yes);
  const decline = element("button", { type: "button", class: "quiet", onclick: () => close() }, no);
  const asked = element("span", { class: "confirm-box", role: "group", "aria-label": question, hidden: true });
  asked.append(element("span", { class: "confirm-question" }, question), agree, decline);
  asked.addEventListener("keydown", (event) => {
    if (event.key === "Escape") {
      close();
    }
  });
  box.append(start, asked);

  function open() {
    start.hidden = true;
    asked.hidden = false;
    decline.focus();
  }

  function close() {
    start.hidden = false;
    asked.hidden = true;
    start.focus();
  }

  async function agreed() {
    agree.disabled = true;
    try {
      await act();
    } finally {
      agree.disabled = false;
      if (asked.isConnected && !asked.hidden) {
        close();
      }
    }
  }

  return box;
}
