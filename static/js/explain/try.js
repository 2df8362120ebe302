// "Try it": sets a gain small, large or back, and shows at once what became of the tracking index.
//
// Goes through laboratory.edit like a slider, so that each press is one change that can be undone.

import { element } from "../dom.js";
import { formatNumber, formatSeconds } from "../format.js";
import { strings } from "../strings/index.js";
import { GAINS } from "./gains.js";

/** Buttons and outcome for a gain of a scheme; returns `{nodes, closed}`. */
export function tryIt(gain, scheme, { laboratory, state }) {
  const facts = GAINS[scheme.id][gain.name];
  const pointer = facts.pointer ?? gain.pointer;
  const original = structuredClone(state.valueAt(scheme.id, pointer));
  const before = indices(laboratory.results[scheme.id]?.report);
  const outcome = element("p", { class: "try-outcome", role: "status" });
  const texts = strings.explain;

  const set = (value) => {
    const failure = laboratory.edit([scheme.id], pointer, value);
    outcome.textContent = failure ? failure.message : texts.computing;
    if (!failure) {
      show();
    }
  };
  const scaled = (factor) => {
    const at = (number) => Number((number * factor).toPrecision(12));
    if (facts.scales) {
      const paper = (name) => scheme.gains.find((other) => other.name === name).default[0];
      const bounds = facts.scales.map((name) => [name, at(paper(name))]);
      return { ...original, ...Object.fromEntries(bounds) };
    }
    const values = gain.default.map(at);
    return gain.shape === "scalar" ? values[0] : values;
  };
  const show = () => {
    const now = laboratory.isCurrent(scheme.id) ? indices(laboratory.results[scheme.id].report) : null;
    if (now) {
      outcome.replaceChildren(texts.now(now), element("span", { class: "note" }, before ? texts.before(before) : ""));
    }
  };
  const button = (text, label, press) => element("button", { type: "button", "aria-label": label, onclick: press }, text);
  const [small, large] = facts.tries;
  const onResult = ({ detail }) => detail.scheme === scheme.id && show();
  laboratory.addEventListener("result", onResult);
  const nodes = [
    element(
      "div",
      { class: "try", role: "group", "aria-label": texts.tryIt },
      element("strong", {}, texts.tryIt),
      button(texts.trySmall(small), texts.trySmallLabel(gain.symbol, small), () => set(scaled(small))),
      button(texts.tryLarge(large), texts.trySmallLabel(gain.symbol, large), () => set(scaled(large))),
      button(texts.tryBack, texts.tryBackLabel(gain.symbol), () => set(original)),
    ),
    outcome,
  ];
  return { nodes, closed: () => laboratory.removeEventListener("result", onResult) };
}

function indices(report) {
  if (!report) {
    return null;
  }
  return report.outcome === "diverged"
    ? strings.explain.diverged(formatSeconds(report.at_s))
    : strings.explain.indices(report.index_e_deg.map((index) => formatNumber(index, 3)).join(", "));
}
