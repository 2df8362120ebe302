// Building elements without markup in strings.

/** The element of the page with this id. */
export const byId = (id) => document.getElementById(id);

/** An element with attributes (`on…` functions become listeners, false and null are left out) and children. */
export function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") {
      node.addEventListener(name.slice(2), value);
    } else if (value !== false && value !== null && value !== undefined) {
      node.setAttribute(name, value === true ? "" : value);
    }
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return node;
}

/**
 * Chooses a select's option unless it is chosen: whenever a script chooses, be it the same again, Chromium goes over all
 * fields of the select's form (without one, of the page) to see what it could fill in, which takes as long as a run.
 */
export function choose(select, value) {
  if (select.value !== value) {
    select.value = value;
  }
}

/** Text with `K_s` and the like written with subscripts. */
export function symbol(text) {
  return text.split(/_(\w+)/u).map((part, n) => (n % 2 ? element("sub", {}, part) : part));
}

/** A short line as a scheme's curves are drawn: colour and dash. */
export function swatch(scheme) {
  const SVG = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(SVG, "svg");
  const line = document.createElementNS(SVG, "line");
  for (const [node, attributes] of [
    [svg, { viewBox: "0 0 30 8", width: 30, height: 8, "aria-hidden": "true", class: "swatch" }],
    [line, { x1: 1, y1: 4, x2: 29, y2: 4, "stroke-width": 2.5, "stroke-dasharray": scheme.dash?.join(" ") ?? "none" }],
  ]) {
    for (const [name, value] of Object.entries(attributes)) {
      node.setAttribute(name, value);
    }
  }
  line.style.stroke = `var(--scheme-${scheme.id})`;
  svg.append(line);
  return svg;
}

/** Fills the static page: `data-text` with text and `data-label` with an accessible name, from the strings. */
export function fillTexts(strings) {
  for (const node of document.querySelectorAll("[data-text]")) {
    node.textContent = strings[node.dataset.text];
  }
  for (const node of document.querySelectorAll("[data-label]")) {
    node.setAttribute("aria-label", strings[node.dataset.label]);
  }
}
