// What an experiment says as tables: a row per base and condition, the search of a tuning, or the readings of a replication.

import { element } from "../dom.js";
import { texts } from "./experiment-texts.js";
import { formatLocal } from "./numbers.js";

/** Most rows that are shown; the downloads have all. */
const MOST_ROWS = 100;

const number = (value) => element("td", { class: "number" }, value);
const pair = (list) => (list ? `${formatLocal(list[0])} – ${formatLocal(list[1])}` : "—");

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

/** Facts by their names. */
function list(facts) {
  const fact = ([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value));
  return element("dl", { class: "job-facts" }, facts.map(fact));
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
      number(formatLocal(statistics?.mean)),
      number(pair(statistics?.mean_interval)),
      number(formatLocal(statistics?.p50)),
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
    [texts.startObjective, formatLocal(summary.start?.objective)],
    [texts.bestObjective, formatLocal(summary.best?.objective)],
  ];
  const row = (pointer, n) =>
    element(
      "tr",
      {},
      element("th", { scope: "row" }, element("code", {}, pointer)),
      number(formatLocal(summary.start?.values[n])),
      number(formatLocal(summary.best?.values[n])),
    );
  const { validation } = summary;
  const said = validation && [
    texts.validated(formatLocal(validation.start), formatLocal(validation.best)),
    texts.better(validation.better.count, validation.better.of),
  ];
  return [
    list(facts),
    ...(said ? [element("p", { class: "validation" }, said.join(" "))] : []),
    table(texts.search, [[texts.variable], [texts.startValue, true], [texts.bestValue, true]], summary.variables.map(row)),
  ];
}

/** The readings that a replication found: the best beside the usual one, and what they make of the paper's claims. */
export function readingsTable(summary) {
  const facts = [
    [texts.simulations, `${summary.done} / ${summary.runs}`],
    [texts.readings, String(summary.readings)],
    [texts.readingsComplete, String(summary.complete)],
    [texts.plausible, String(summary.plausible)],
  ];
  const [best] = summary.best;
  const both = [best, summary.first];
  const row = (name, cell) => element("tr", {}, element("th", { scope: "row" }, name), both.map((reading) => number(reading ? cell(reading) : "—")));
  const rows = [
    row(texts.distance, (reading) => formatLocal(reading.distance)),
    row(texts.reached(summary.entries.length), (reading) => String(reading.reached)),
    ...summary.unknowns.map(({ name }, n) => row(name, (reading) => reading.options[n])),
  ];
  const verdict = (holds) => (holds ? texts.yes : texts.no);
  const claim = ({ claim: said, at_best: atBest, plausible }) =>
    element(
      "tr",
      {},
      element("th", { scope: "row" }, said),
      element("td", {}, typeof atBest === "boolean" ? verdict(atBest) : "—"),
      number(`${plausible.holds} / ${summary.plausible}`),
    );
  return [
    list(facts),
    table(texts.nearest, [[texts.unknown], [texts.bestReading, true], [texts.usualReading, true]], rows),
    table(texts.claims, [[texts.claim], [texts.holdsAtBest], [texts.holdsIn, true]], summary.claims.map(claim)),
  ];
}
