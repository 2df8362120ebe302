// Info buttons: a small round button beside what it explains, and the one popover that they share.
//
// The popover is the browser's own: it closes by Escape and by a press outside, and only one is open. It takes the focus
// when it opens, and the button has it back when it closes.

import { element } from "../dom.js";
import { strings } from "../strings/index.js";
import { CONTENT } from "./content.js";

const GAP = 6;
let app = null;
let popover = null;
let opener = null;
let closed = null;

/** From here on buttons can open. */
export function prepareInfo(laboratoryApp) {
  app = laboratoryApp;
}

/** A button that opens the text about `kind` ("gain", "signal", "figure", "scheme") and `id`; null if there is no such text. */
export function infoButton(kind, id) {
  const name = CONTENT[kind]?.name(id);
  if (!name) {
    return null;
  }
  const button = element(
    "button",
    {
      type: "button",
      class: "info",
      "data-info": `${kind}/${id}`,
      "aria-label": strings.explain.about(name),
      "aria-haspopup": "dialog",
      "aria-expanded": "false",
      onpointerdown: () => {
        // A press on the open one's button closes the popover by itself, before the click.
        button.dataset.wasOpen = String(opener === button);
      },
      onclick: (event) => {
        const wasOpen = event.detail > 0 ? button.dataset.wasOpen === "true" : opener === button;
        if (wasOpen) {
          popover?.hidePopover();
        } else {
          open(button, kind, id, name);
        }
      },
    },
    element("span", { "aria-hidden": "true" }, "i"),
  );
  return button;
}

function open(button, kind, id, name) {
  popover ??= build();
  popover.hidePopover();
  const made = CONTENT[kind].content(id, app);
  closed = made.closed ?? null;
  popover.setAttribute("aria-label", name);
  popover.replaceChildren(
    element("button", { type: "button", class: "info-close", "aria-label": strings.explain.close, onclick: () => popover.hidePopover() }, "×"),
    ...made.nodes,
  );
  opener = button;
  button.setAttribute("aria-expanded", "true");
  popover.showPopover({ source: button });
  place(button);
  popover.focus();
}

function build() {
  const node = element("div", { popover: "auto", class: "info-popover", role: "dialog", tabindex: "-1", id: "info" });
  node.addEventListener("beforetoggle", ({ newState }) => newState === "closed" && settle());
  document.body.append(node);
  const follow = ({ target }) => opener && target !== node && place(opener);
  addEventListener("resize", follow);
  addEventListener("scroll", follow, { capture: true, passive: true });
  return node;
}

/** The button is told; it has the focus back unless the visitor went elsewhere. */
function settle() {
  const button = opener;
  opener = null;
  closed?.();
  closed = null;
  if (button) {
    button.setAttribute("aria-expanded", "false");
    if (popover.contains(document.activeElement)) {
      button.focus({ preventScroll: true });
    }
  }
}

/** Below the button where it fits, else above, else wherever it fits; inside the window, and off the figures if it can be. */
function place(button) {
  const at = button.getBoundingClientRect();
  const { width, height } = popover.getBoundingClientRect();
  const right = button.closest(".controls")?.getBoundingClientRect().right ?? innerWidth - GAP;
  const left = Math.max(GAP, Math.min(at.left, right - width));
  const below = at.bottom + GAP;
  const above = at.top - GAP - height;
  const lowest = innerHeight - height - GAP;
  const top = Math.max(GAP, Math.min(below <= lowest || above < 0 ? below : above, lowest));
  popover.style.setProperty("left", `${left}px`);
  popover.style.setProperty("top", `${top}px`);
}
