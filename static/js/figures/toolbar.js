// What concerns all figures: zoom buttons, the stretch that is shown, the kind of error axis, where the groups are.

import { element } from "../dom.js";
import { formatNumber } from "../format.js";
import { strings } from "../strings/index.js";
import { bindPopup } from "./popup.js";
import { zoomAbout } from "./window.js";

const FACTOR = 1.5;
const DIGITS = 3;
const AXES = ["linear", "symlog"];

/** Builds the toolbar. */
export function buildToolbar(figures, timeline) {
  const texts = strings.figures;
  const button = (text, label, onclick) =>
    element("button", { type: "button", "aria-label": label, title: label, onclick }, text);
  // About the cursor where it can be seen, else about the middle.
  const zoom = (factor) => {
    const [from, to] = timeline.window;
    const seen = timeline.position > from && timeline.position < to;
    zoomAbout(timeline, seen ? timeline.position : (from + to) / 2, factor);
  };
  const out = button("−", texts.zoomOut, () => zoom(FACTOR));
  const whole = button("⟲", texts.zoomReset, () => timeline.zoom(null));
  const stretch = element("span", { class: "figure-window" });
  const axes = AXES.map((axis) =>
    element("button", { type: "button", "data-axis": axis, onclick: () => choose(axis) }, texts.axes[axis]),
  );

  function showAxis() {
    for (const node of axes) {
      node.setAttribute("aria-pressed", String(node.dataset.axis === figures.axis));
    }
  }
  function choose(axis) {
    figures.chooseAxis(axis);
    showAxis();
  }
  function showWindow() {
    const [from, to] = timeline.window;
    stretch.textContent = timeline.duration > 0 ? texts.window(formatNumber(from, DIGITS), formatNumber(to, DIGITS)) : "";
    // Not `disabled`: the focus would be lost when the last step out makes it so.
    for (const node of [out, whole]) {
      node.setAttribute("aria-disabled", String(!timeline.isZoomed));
    }
  }
  timeline.addEventListener("window", showWindow);
  showAxis();
  showWindow();

  const links = figures.groups.map(({ id }) => element("a", { href: `#figures-${id}` }, texts.groups[id]));
  const group = (label, ...children) =>
    element("div", { class: "figure-bar-group", role: "group", "aria-label": label }, children.flat());
  const zooms = [out, button("+", texts.zoomIn, () => zoom(1 / FACTOR)), whole, stretch];
  return element(
    "div",
    { class: "figure-bar" },
    element("nav", { class: "figure-bar-group figure-links", "aria-label": texts.groupsLabel }, links),
    buildHelp(),
    group(texts.zoom, zooms),
    group(texts.axis, element("span", { "aria-hidden": "true" }, texts.axis), element("div", { class: "segments" }, axes)),
  );
}

function buildHelp() {
  const texts = strings.figures;
  const hints = [...texts.hints.map((hint) => element("p", {}, hint)), element("p", { id: "figure-keys" }, texts.keys)];
  const panel = element("div", { id: "figure-help" }, hints);
  const opener = element("button", { type: "button" }, texts.help);
  const wrap = element("div", { class: "figure-help" }, opener, panel);
  bindPopup(wrap, opener, panel);
  return wrap;
}
