// What an experiment says as tables: a row per base and condition, or the search of a tuning.

import { element } from "../dom.js";
import { formatNumber } from "../format.js";
import { texts } from "./experiment-texts.js";

/** Most rows that are shown; the downloads have all. */
const MOST_ROWS = 100;

const number = (value) => element("td", { class: "number" }, value);
const pair = (list) => (list ? `${formatNumber(list[0])} – ${formatNumber(list[1])}` : "—");

function table(caption, heads, rows) {
  const head = heads.map(([text, numeric]) => element("th", { scope: "col", class: numeric ? "number" : null }, text));
  return element(
    "table",
    { class: "numbers" },
    element("caption", {}, caption),
    element("thead", {}, element("tr", {}, head)),
    element("tbody", {}, rows),
  );
}

/** A metric of every base under every condition. */
export function groupsTable(summary, metric, name) {
  const conditions = new Set(summary.groups.map(({ condition }) => condition)).size > 1;
  const row = (group) => {
    const statistics = group.metrics.find((entry) => entry.metric === metric);
    return element(
      "tr",
      {},
      element("th", { scope: "row" }, group.base),
      conditions ? element("td", {}, group.condition) : null,
      number(formatNumber(statistics?.mean)),
      number(pair(statistics?.mean_interval)),
      number(formatNumber(statistics?.p50)),
      number(pair(statistics && [statistics.p05, statistics.p95])),
      number(String(group.completed)),
      number(String(group.diverged?.count ?? 0)),
      number(String(group.refused)),
    );
  };
  const heads = [
    [texts.base],
    ...(conditions ? [[texts.condition]] : []),
    [texts.mean, true],
    [texts.interval(Math.round(1000 * summary.confidence) / 10), true],
    [texts.median, true],
    [texts.spread, true],
    [texts.completed, true],
    [texts.diverged, true],
    [texts.refused, true],
  ];
  const refusal = summary.first_refusal;
  return [
    table(name, heads, summary.groups.slice(0, MOST_ROWS).map(row)),
    ...(refusal ? [element("p", { class: "note" }, texts.refusal(refusal.run, refusal.why))] : []),
  ];
}

/** What a search has found. */
export function searchTable(summary) {
  const facts = [
    [texts.candidates, String(summary.candidates)],
    [texts.generations, String(summary.history.length)],
    [texts.startObjective, formatNumber(summary.start?.objective)],
    [texts.bestObjective, formatNumber(summary.best?.objective)],
  ];
  const row = (pointer, n) =>
    element(
      "tr",
      {},
      element("th", { scope: "row" }, element("code", {}, pointer)),
      number(formatNumber(summary.start?.values[n])),
      number(formatNumber(summary.best?.values[n])),
    );
  const { validation } = summary;
  const said = validation && [
    texts.validated(formatNumber(validation.start), formatNumber(validation.best)),
    texts.better(validation.better.count, validation.better.of),
  ];
  return [
    element("dl", { class: "job-facts" }, facts.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value)))),
    ...(said ? [element("p", { class: "validation" }, said.join(" "))] : []),
    table(texts.search, [[texts.variable], [texts.startValue, true], [texts.bestValue, true]], summary.variables.map(row)),
  ];
}
