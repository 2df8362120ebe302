// A button that opens a box beneath it: closed by Escape, by a click elsewhere, by the button again. The browser does the
// closing and the order of focus; this places the box and tells screen readers.

import { element } from "./dom.js";

const MARGIN = 8;

/** `{button, box, close}`; `fill(box)` is called when the box opens. `label` names the box. */
export function popover({ id, label, text, fill }) {
  const box = element("div", { id, class: "popover", popover: "auto", role: "dialog", "aria-label": label });
  const button = element("button", { type: "button", popovertarget: id, "aria-expanded": "false", "aria-haspopup": "dialog" }, text);
  box.addEventListener("beforetoggle", ({ newState }) => {
    button.setAttribute("aria-expanded", String(newState === "open"));
    if (newState === "open") {
      fill(box);
    }
  });
  box.addEventListener("toggle", ({ newState }) => {
    if (newState === "open") {
      place(box, button);
    }
  });
  addEventListener("scroll", () => box.matches(":popover-open") && place(box, button), { passive: true });
  addEventListener("resize", () => box.matches(":popover-open") && place(box, button));
  return { button, box, close: () => box.hidePopover() };
}

/** Under the button, inside the window. */
function place(box, button) {
  const { left, bottom } = button.getBoundingClientRect();
  const rightmost = document.documentElement.clientWidth - box.offsetWidth - MARGIN;
  box.style.setProperty("left", `${Math.max(MARGIN, Math.min(left, rightmost))}px`);
  box.style.setProperty("top", `${bottom + MARGIN / 2}px`);
}
