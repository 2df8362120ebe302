// The tables: both performance indices with the paper's values and their ratio, then peaks and settling times.

import { element, swatch } from "../dom.js";
import { formatNumber, formatPrinted, formatSeconds } from "../format.js";
import { strings } from "../strings/index.js";

const INDICES = [
  ["index_e_deg", strings.table1],
  ["index_de_deg_s", strings.table2],
];
const OTHERS = ["e_peak_deg", "z_peak_deg", "tau_peak_nm", "voltage_peak_v", "settling_e_s", "settling_de_s"];

/** Builds the tables into `container`; returns a function that shows reports by scheme. */
export function buildTables(container, description) {
  const joints = description.robots[0].joints.map((_, n) => n);
  const indexTables = INDICES.map(([field, caption]) => buildIndexTable(field, caption, joints, description));
  const other = buildOtherTable(joints, description);
  const { e_deg, de_deg_s } = description.settling_bands;
  container.append(
    element("div", { class: "table-pair" }, indexTables.map(({ table }) => table)),
    element("p", { class: "help" }, strings.tableNote),
    other.table,
    element("p", { class: "help" }, strings.settlingNote(e_deg, de_deg_s)),
  );
  return function show(results) {
    for (const table of [...indexTables, other]) {
      table.show(results);
    }
  };
}

function rowHeader(scheme) {
  return element("th", { scope: "row" }, swatch(scheme), element("span", {}, scheme.name));
}

function buildIndexTable(field, caption, joints, description) {
  const body = element("tbody");
  const table = element(
    "table",
    { "data-table": field },
    element("caption", {}, caption),
    element(
      "thead",
      {},
      element(
        "tr",
        {},
        element("th", { scope: "col" }, strings.scheme),
        joints.map((n) => element("th", { scope: "col", class: "number" }, strings.jointShort(n + 1))),
      ),
    ),
    body,
  );
  const show = (results) => {
    const rows = description.schemes.map((scheme) => {
      const report = results[scheme.id]?.report;
      const paper = description.paper[field][scheme.id];
      return element("tr", { "data-scheme": scheme.id }, rowHeader(scheme), indexCells(report, field, paper, joints));
    });
    body.replaceChildren(...rows);
  };
  return { table, show };
}

function indexCells(report, field, paper, joints) {
  if (report?.outcome === "diverged") {
    return divergedCell(report, joints.length);
  }
  return joints.map((n) => {
    const ours = report?.[field]?.[n];
    const ratio = formatNumber(ours / paper[n], 3);
    return element(
      "td",
      { class: "number" },
      element("span", { class: "ours" }, formatNumber(ours)),
      " ",
      element("span", { class: "of-paper" }, strings.paperValue(formatPrinted(paper[n]))),
      " ",
      element("span", { class: "of-paper" }, strings.ratio(ratio)),
    );
  });
}

function divergedCell(report, columns) {
  const text = strings.diverged(formatSeconds(report.at_s), report.reason);
  return element("td", { colspan: columns, class: "diverged" }, text);
}

function buildOtherTable(joints, description) {
  const body = element("tbody");
  const table = element(
    "table",
    { "data-table": "other", class: "other" },
    element("caption", {}, strings.tableOther),
    element(
      "thead",
      {},
      element(
        "tr",
        {},
        element("th", { scope: "col" }, strings.quantity),
        description.schemes.map((scheme) => element("th", { scope: "col", class: "number" }, swatch(scheme), scheme.name)),
      ),
    ),
    body,
  );
  const show = (results) => {
    const rows = OTHERS.map((field) =>
      element(
        "tr",
        {},
        element("th", { scope: "row" }, strings.rows[field]),
        description.schemes.map(({ id }) => otherCell(results[id]?.report, field, joints)),
      ),
    );
    body.replaceChildren(...rows);
  };
  return { table, show };
}

function otherCell(report, field, joints) {
  if (report?.outcome === "diverged" && field.startsWith("settling")) {
    return element("td", { class: "number diverged" }, strings.divergedShort(formatSeconds(report.at_s)));
  }
  const values = report?.[field];
  const numbers = values ? joints.map((n) => element("span", {}, formatNumber(values[n], 3))) : "—";
  return element("td", { class: "number" }, element("span", { class: "triple" }, numbers));
}
