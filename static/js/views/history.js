// Undo, redo and the list of steps, in the toolbar and on the keyboard.

import { announce } from "../announce.js";
import { element } from "../dom.js";
import { notice } from "../notice.js";
import { popover } from "../popover.js";
import { strings } from "../strings/index.js";

const texts = strings.compare;

/** Builds it into the toolbar. */
export function buildHistory(place, app) {
  const { history: steps, words } = app;
  const undo = element("button", { type: "button", id: "undo", onclick: () => go(steps.index - 1) }, icon("↶"), element("span", {}, texts.undo));
  const redo = element("button", { type: "button", id: "redo", onclick: () => go(steps.index + 1) }, icon("↷"), element("span", {}, texts.redo));
  const list = popover({ id: "history-list", label: texts.history, text: texts.history, fill });
  place.append(undo, redo, list.button, list.box);

  /** What a step did, in words. */
  function label(index) {
    const entry = steps.entries[index];
    if (index === 0) {
      return texts.startWith(words.study(entry.documents) ?? texts.ownSettings);
    }
    const what = words.step(steps.entries[index - 1], entry);
    return entry.origin ? texts.origin[entry.origin.kind](what, entry.origin.name) : what;
  }

  function go(index) {
    if (!steps.entries[index]) {
      return;
    }
    const by = index - steps.index;
    const said = { "-1": () => texts.undone(label(index + 1)), 1: () => texts.redone(label(index)) }[by] ?? (() => texts.wentTo(label(index)));
    const text = said();
    const failure = steps.moveTo(index);
    if (failure) {
      notice(failure.message, "error");
    } else {
      announce(text);
    }
  }

  function fill(box) {
    const items = steps.entries.map((_, index) => {
      const current = index === steps.index;
      const button = element(
        "button",
        {
          type: "button",
          class: index > steps.index ? "step undone" : "step",
          "aria-current": current ? "step" : null,
          onclick: () => {
            go(index);
            fill(box);
            box.querySelector("[aria-current]").focus();
          },
        },
        element("span", {}, words.rich(label(index))),
        current ? element("span", { class: "now" }, texts.now) : null,
      );
      return element("li", {}, button);
    });
    box.replaceChildren(
      element("p", { class: "help" }, texts.historyHelp),
      // Numbered as they happened, shown newest first.
      element("ol", { reversed: true, class: "steps" }, items.reverse()),
    );
  }

  function show() {
    name(undo, steps.canUndo, texts.undo, () => texts.undoThis(label(steps.index)));
    name(redo, steps.canRedo, texts.redo, () => texts.redoThis(label(steps.index + 1)));
  }

  addEventListener("keydown", (event) => {
    const by = shortcut(event);
    if (by !== 0) {
      event.preventDefault();
      go(steps.index + by);
    }
  });
  let frame = null;
  steps.addEventListener("changed", () => {
    // Once a frame: a dragged slider changes the step's words with every pixel.
    frame ??= requestAnimationFrame(() => {
      frame = null;
      show();
    });
  });
  show();
}

function icon(character) {
  return element("span", { "aria-hidden": "true" }, character);
}

/** A button that keeps the focus when there is nothing left to do: disabled ones lose it. */
function name(button, enabled, idle, text) {
  const title = enabled ? text() : idle;
  button.setAttribute("aria-disabled", String(!enabled));
  button.setAttribute("aria-label", title);
  button.title = title;
}

/** -1 to undo, 1 to redo, 0 for other keys and where text is typed, which has an undo of its own. */
function shortcut({ key, ctrlKey, metaKey, altKey, shiftKey, target }) {
  const typing = target.closest?.("input:not([type=range], [type=checkbox], [type=radio]), textarea, [contenteditable]");
  if (typing || altKey || !(ctrlKey || metaKey)) {
    return 0;
  }
  const letter = key.toLowerCase();
  if (letter === "z") {
    return shiftKey ? 1 : -1;
  }
  return letter === "y" && !shiftKey ? 1 : 0;
}
