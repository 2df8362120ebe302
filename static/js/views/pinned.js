// The pinned figure: where one column is all there is room for, a figure that stays in view while the controls scroll.
//
// One more card of the figures, small, with a choice of figure and a button that hides it. Remembers both. When it is
// shown at all, and where, is for css/narrow.css; hidden, it has no size and is not drawn.

import { element } from "../dom.js";
import { load, save } from "../storage.js";
import { strings } from "../strings/index.js";

const KEY = "pinned";
/** Small letters for a small figure. */
const ZOOM = 0.85;

/** Builds the panel. */
export function buildPinned(panel, figures) {
  const saved = load(KEY);
  const first = figures.ids.includes(saved?.figure) ? saved.figure : figures.ids[0];
  const card = figures.add(first, ZOOM);
  card.id = "pinned-card";
  const choice = element(
    "select",
    { id: "pinned-choice" },
    figures.ids.map((id) => element("option", { value: id }, strings.figures.titles[id])),
  );
  choice.value = first;
  choice.addEventListener("change", () => {
    figures.change(card, choice.value);
    open(true);
  });
  const toggle = element("button", { type: "button", id: "pinned-toggle", "aria-controls": card.id, onclick: () => open(card.hidden) });

  function open(shown) {
    card.hidden = !shown;
    panel.toggleAttribute("data-open", shown);
    toggle.textContent = shown ? strings.figures.pinnedHide : strings.figures.pinnedShow;
    toggle.setAttribute("aria-expanded", String(shown));
    save(KEY, { figure: choice.value, open: shown });
  }

  panel.append(
    element("div", { class: "pinned-head" }, element("label", { for: choice.id }, strings.pinnedFigure), choice, toggle),
    card,
  );
  open(saved?.open !== false);
}
