// The choice of a run for figures that show one at a time.

import { choose, element } from "../dom.js";
import { strings } from "../strings/index.js";

/** Puts the choice among a card's `tools`; returns what to call when runs come and go. */
export function addFocusChoice(tools, figures) {
  const choice = element("select", { "aria-label": strings.figures.focus });
  choice.addEventListener("change", () => figures.chooseFocus(choice.value));
  tools.append(choice);
  let listed = "";
  return () => {
    const { runs } = figures;
    const key = JSON.stringify(runs.map(({ id, name }) => [id, name]));
    if (key !== listed) {
      listed = key;
      choice.replaceChildren(...runs.map(({ id, name }) => element("option", { value: id }, name)));
    }
    choose(choice, runs.some(({ id }) => id === figures.focus) ? figures.focus : (runs[0]?.id ?? ""));
    choice.disabled = runs.length === 0;
  };
}
