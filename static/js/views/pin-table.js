// The table of pinned runs: one scheme's numbers now and pinned, the differences, and what differs in the settings.
//
// Filled at most once a frame, and only while it is in view.

import { element } from "../dom.js";
import { formatNumber } from "../format.js";
import { strings } from "../strings/index.js";

const texts = strings.compare;
const METRICS = ["index_e_deg", "index_de_deg_s", "e_peak_deg", "z_peak_deg", "tau_peak_nm", "settling_e_s", "settling_de_s", "theta_error_end"];

/** Returns `{box, show}`. */
export function buildPinTable(app) {
  const { pins, state, description, laboratory, words } = app;
  const choice = element(
    "select",
    { id: "compare-scheme", onchange: () => fill() },
    description.schemes.map(({ id, name }) => element("option", { value: id }, name)),
  );
  choice.value = state.tab;
  const table = element("table", { class: "pin-table", id: "pin-table" });
  const scroller = element("div", { class: "scroller", tabindex: 0, role: "region", "aria-label": texts.title }, table);
  const settings = element("div", { class: "pin-settings", id: "pin-settings" });
  const box = element(
    "div",
    { class: "pin-tables", hidden: true },
    element("div", { class: "study-row" }, element("label", { for: choice.id }, texts.tableScheme), choice),
    scroller,
    element("p", { class: "help" }, texts.tableNote),
    element("h3", {}, texts.settings),
    settings,
  );
  let inView = false;
  let stale = true;
  let frame = null;
  new IntersectionObserver(([entry]) => {
    inView = entry.isIntersecting;
    ask();
  }).observe(box);

  function show() {
    stale = true;
    box.hidden = pins.list.length === 0;
    ask();
  }

  function ask() {
    if (inView && stale) {
      frame ??= requestAnimationFrame(() => {
        frame = null;
        fill();
      });
    }
  }

  function fill() {
    stale = false;
    const scheme = choice.value;
    const current = laboratory.results[scheme]?.report;
    const reports = pins.list.map((pin) => pin.reports[scheme]);
    const head = [
      element("th", { scope: "col" }, texts.metric),
      element("th", { scope: "col", class: "number" }, texts.current),
      ...pins.list.map((pin) => pinHead(pin)),
    ];
    table.replaceChildren(
      element("caption", {}, texts.tableCaption(words.scheme(scheme))),
      element("thead", {}, element("tr", {}, head)),
      ...METRICS.map((metric) => metricRows(metric, current, reports)).filter((body) => body !== null),
    );
    settings.replaceChildren(...pins.list.map((pin) => settingsOf(pin, app)));
  }

  return { box, show };
}

function pinHead(pin) {
  const mark = element("span", { class: "pin-mark", "aria-hidden": "true" }, String(pin.slot));
  const head = element("th", { scope: "col", class: "number" }, mark, " ", pin.name);
  head.style.setProperty("--pin", `var(--pin-${pin.slot})`);
  return head;
}

/** A metric's values: one per joint, or one. */
function valuesOf(report, metric) {
  if (metric === "theta_error_end" && report) {
    const { theta_true, theta_hat_end } = report;
    return [Math.hypot(...theta_hat_end.map((estimate, n) => estimate - theta_true[n]))];
  }
  return report?.[metric] ?? [];
}

/** The rows of a metric, or null where nobody has it. */
function metricRows(metric, current, reports) {
  const now = valuesOf(current, metric);
  const pinned = reports.map((report) => valuesOf(report, metric));
  const count = Math.max(now.length, ...pinned.map(({ length }) => length));
  if (count === 0) {
    return null;
  }
  const single = count === 1;
  const head = element("th", { scope: "rowgroup", colspan: reports.length + 2 }, texts.metrics[metric]);
  const rows = Array.from({ length: count }, (_, n) =>
    element(
      "tr",
      { "data-metric": `${metric}/${n}` },
      element("th", { scope: "row", class: single ? null : "joint" }, single ? texts.metrics[metric] : strings.jointShort(n + 1)),
      element("td", { class: "number" }, element("span", { class: "ours" }, valueText(current, now[n]))),
      pinned.map((values, at) => pinnedCell({ report: current, value: now[n] }, { report: reports[at], value: values[n] })),
    ),
  );
  return element("tbody", {}, single ? null : element("tr", { class: "metric" }, head), rows);
}

function pinnedCell(now, pinned) {
  const cell = element("td", { class: "number" }, element("span", { class: "pinned-value" }, valueText(pinned.report, pinned.value)));
  const verdict = compare(now, pinned);
  if (verdict) {
    cell.dataset.verdict = verdict.kind;
    const mark = element("span", { class: `verdict ${verdict.kind}` }, `${SIGNS[verdict.kind]}\u00a0${texts[verdict.kind]}`);
    cell.append(element("span", { class: "difference" }, verdict.text, " ", mark));
  }
  return cell;
}

const SIGNS = { better: "✓", worse: "✗", same: "=", near: "≈" };
/** Differences below this are nothing to choose by, %. */
const NEAR_PERCENT = 0.01;

function valueText(report, value) {
  if (!report || value === undefined) {
    return "—";
  }
  return value === null ? texts.never : formatNumber(value);
}

/** How the present value stands to the pinned one: `{kind, text}`; null where they cannot be compared. Less is better. */
function compare(now, pinned) {
  if (!now.report || !pinned.report || now.value === undefined || pinned.value === undefined) {
    return null;
  }
  const ended = [now, pinned].map(({ report }) => report.outcome === "completed");
  if (!ended[0] || !ended[1]) {
    // Numbers of a run that was given up are those of its first part.
    return ended[0] === ended[1] ? null : { kind: ended[0] ? "better" : "worse", text: texts.diverged };
  }
  if (now.value === pinned.value) {
    return { kind: "same", text: "" };
  }
  if (now.value === null || pinned.value === null) {
    return { kind: now.value === null ? "worse" : "better", text: "" };
  }
  const absolute = now.value - pinned.value;
  const signed = (number, digits) => (number > 0 ? "+" : "") + formatNumber(number, digits);
  const percent = (100 * absolute) / pinned.value;
  if (Math.abs(percent) < NEAR_PERCENT) {
    return { kind: "near", text: signed(absolute, 2) };
  }
  return {
    kind: absolute < 0 ? "better" : "worse",
    text: Number.isFinite(percent) ? texts.difference(signed(absolute, 3), signed(percent, 3)) : texts.differenceOnly(signed(absolute, 3)),
  };
}

function settingsOf(pin, { state, words }) {
  const changes = words.changes(pin.documents, state.documents);
  if (changes.length === 0) {
    return element("p", { class: "help", "data-pin": pin.slot }, texts.settingsSame(pin.name));
  }
  const rows = changes.map(({ pointer, before, after, schemes }) =>
    element(
      "tr",
      { "data-pointer": pointer },
      element("th", { scope: "row" }, words.rich(words.name(pointer)), words.suffix(schemes)),
      element("td", { class: "number" }, words.quantity(pointer, after)),
      element("td", { class: "number" }, words.quantity(pointer, before)),
    ),
  );
  const columns = texts.settingColumns.map((text, n) => element("th", { scope: "col", class: n > 0 ? "number" : null }, text));
  return element(
    "table",
    { "data-pin": pin.slot },
    element("caption", {}, texts.settingsOf(pin.name)),
    element("thead", {}, element("tr", {}, columns)),
    element("tbody", {}, rows),
  );
}
