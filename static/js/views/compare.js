// Comparing: undo and history in the toolbar, pinned runs in a section of their own, their curves in the figures.

import { announce } from "../announce.js";
import { byId, element } from "../dom.js";
import { notice } from "../notice.js";
import { MAX_PINS, Pins, runId } from "../pins.js";
import { strings } from "../strings/index.js";
import { onTheme } from "../theme.js";
import { buildHistory } from "./history.js";
import { buildPinList } from "./pin-list.js";
import { buildPinTable } from "./pin-table.js";

const texts = strings.compare;

/** Builds it; returns the pins. */
export function buildCompare(place, app) {
  const pins = new Pins(app);
  app.pins = pins;
  if (pins.dropped > 0) {
    notice(texts.pinsDropped(pins.dropped), "warning");
  }
  buildHistory(byId("history"), app);
  byId("history").append(pinButton("pin-runs"));
  const showList = buildPinList(app);
  const table = buildPinTable(app);
  place.setAttribute("aria-label", texts.title);
  place.append(
    element(
      "div",
      { class: "compare-head" },
      element("h2", {}, texts.title),
      element("p", { class: "help" }, texts.pinHelp),
      pinButton("pin-runs-here"),
    ),
    showList.list,
    table.box,
  );

  function pinButton(id) {
    return element("button", { type: "button", id, onclick: pin }, texts.pinThese);
  }

  function pin() {
    // The lowest number that no pin has by slot or name, so that two pins are never called the same by the page.
    const names = new Set(pins.list.map(({ name }) => name));
    const number = Array.from({ length: 2 * MAX_PINS + 1 }, (_, n) => n + 1).find((n) => !names.has(texts.pinName(n)));
    const added = pins.add(texts.pinName(number));
    if (added) {
      announce(texts.pinnedNow(added.name));
    } else {
      notice(texts.full(MAX_PINS), "warning");
    }
  }

  function overlay() {
    const { figures, state, words, description } = app;
    const style = getComputedStyle(document.documentElement);
    const runs = pins.list
      .filter(({ shown }) => shown)
      .flatMap((pinned) =>
        description.schemes
          .filter(({ id }) => state.visible.has(id) && pinned.reports[id])
          .map(({ id }) => ({
            id: runId(pinned, id),
            label: texts.overlay(pinned.name, words.scheme(id)),
            color: style.getPropertyValue(`--pin-${pinned.slot}`).trim(),
          })),
      );
    figures.overlays = runs;
    figures.redraw();
  }

  function show() {
    showList.show();
    table.show();
    place.toggleAttribute("data-empty", pins.list.length === 0);
    place.dataset.state = pins.isReady ? "ready" : "running";
    overlay();
  }

  pins.addEventListener("changed", show);
  app.state.addEventListener("shown", overlay);
  onTheme(overlay);
  const showTable = () => table.show();
  app.laboratory.addEventListener("result", () => app.calm.ask(showTable));
  app.state.addEventListener("changed", showTable);
  show();
  return pins;
}
