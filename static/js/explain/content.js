// What an info button's popover says: for a gain, a signal, a figure or a scheme.

import { element, symbol } from "../dom.js";
import { formatExact } from "../format.js";
import { strings } from "../strings/index.js";
import { GAINS } from "./gains.js";
import { math } from "./mathml.js";
import { SCHEMES, SIGNALS, signalOf } from "./signals.js";
import { tryIt } from "./try.js";

/** By kind: `name(id)`, null for what has no text, and `content(id, app)` as `{nodes, closed}`. */
export const CONTENT = {
  gain: {
    name: (id) => gainTexts(id)?.name ?? null,
    content: gainContent,
  },
  signal: {
    name: (id) => strings.explain.signals[id]?.name ?? null,
    content: (id) => ({ nodes: signalNodes(id) }),
  },
  figure: {
    name: (id) => strings.explain.signals[signalOf(id)]?.name ?? null,
    content: (id) => ({ nodes: signalNodes(signalOf(id)) }),
  },
  scheme: {
    name: (id) => strings.explain.schemeNames[id] ?? null,
    content: (id, app) => ({ nodes: schemeNodes(id, app) }),
  },
};

/** Equations on lines of their own, with their place in the paper. */
export function equations(lines, source, isMended) {
  const note = source === null ? strings.explain.noSource : strings.explain.source(source);
  return element(
    "div",
    { class: "equations" },
    lines.map((line) => element("div", {}, math(line, true))),
    element("p", { class: "note" }, isMended ? `${note} ${strings.explain.mended}` : note),
  );
}

/** Texts of the gain `scheme/name`, with its name for people. */
function gainTexts(id) {
  const [scheme, name] = id.split("/");
  const texts = strings.explain.gains[scheme]?.[name];
  return texts ? { ...texts, name: `${GAINS[scheme][name].name}, ${strings.explain.schemeNames[scheme]}` } : null;
}

function gainContent(id, app) {
  const [schemeId, gainName] = id.split("/");
  const scheme = app.description.schemes.find((one) => one.id === schemeId);
  const gain = scheme.gains.find((one) => one.name === gainName);
  const facts = GAINS[schemeId][gainName];
  const texts = gainTexts(id);
  const words = strings.explain;
  const [small, large] = facts.tries;
  const trial = tryIt(gain, scheme, app);
  const nodes = [
    element("h3", {}, symbol(gain.symbol), element("span", { class: "note" }, ` ${scheme.name}`)),
    element("p", {}, texts.what),
    equations(facts.equations, facts.source, facts.mended),
    element(
      "dl",
      {},
      element("dt", {}, words.tooSmall(small)),
      element("dd", {}, texts.small),
      element("dt", {}, words.tooLarge(large)),
      element("dd", {}, texts.large),
    ),
    ...trial.nodes,
    element("p", { class: "note" }, `${words.basis} ${words.tried(...facts.range)}`),
    element("p", { class: "note" }, rangeText(gain)),
  ];
  return { nodes, closed: trial.closed };
}

function rangeText(gain) {
  const unit = gain.unit ? ` ${gain.unit}` : "";
  const numbers = gain.default;
  const paper =
    gain.shape === "parameter"
      ? strings.explain.perParameter(formatExact(Math.min(...numbers)), formatExact(Math.max(...numbers)))
      : numbers.map(formatExact).join(", ");
  return strings.explain.range(unit, paper, formatExact(gain.min), formatExact(gain.max));
}

function signalNodes(id) {
  const { name, what, read } = strings.explain.signals[id];
  const { equations: lines, unit, source } = SIGNALS[id];
  const words = strings.explain;
  return [
    element("h3", {}, name),
    element("p", {}, what),
    equations(lines, source, false),
    element("p", {}, read),
    element("p", { class: "note" }, unit ? words.unit(unit) : words.noUnit),
  ];
}

function schemeNodes(id, { description, state }) {
  const scheme = description.schemes.find((one) => one.id === id);
  const { sources, mended, ...choices } = SCHEMES[id];
  const parts = Object.entries(choices).map(([choice, lines]) => [
    element("h4", {}, strings.explain.choices[choice]),
    element("p", {}, strings.explain.signals.schemes[id][choice]),
    equations(lines, sources[choice], mended.includes(choice)),
  ]);
  const numbers = scheme.gains
    .filter(({ shape }) => shape !== "parameter")
    .map((gain) => [gain, [state.valueAt(id, gain.pointer)].flat().map(formatExact).join(", ")]);
  return [
    element("h3", {}, scheme.name),
    ...parts.flat(),
    element("h4", {}, strings.explain.numbers),
    element(
      "dl",
      { class: "numbers" },
      numbers.flatMap(([gain, values]) => [
        element("dt", {}, symbol(gain.symbol)),
        element("dd", {}, `${values} ${gain.unit}`.trim()),
      ]),
    ),
  ];
}
