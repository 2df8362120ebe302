// "Why is joint 2 worst?": the answer for the run that is shown, made of its numbers, so that it holds for other settings.
//
// The tracking error of a joint is about the torque that the estimates do not supply, divided by K Λ. Both are in the run.

import { element } from "../dom.js";
import { formatNumber, formatSeconds } from "../format.js";
import { strings } from "../strings/index.js";

/** Where a scheme keeps the gain of its feedback. */
const FEEDBACK = { proposed: "k_v", tang_arteaga: "k_s", slotine_li: "k_s" };
/** The parameters behind each part of the torque, by joint, counted from 1: docs/physics.md, section 1. */
const BEHIND = {
  inertia: [[8], [9, 2, 5, 7], [10, 2, 5, 7]],
  coriolis: [[1, 3, 4, 5, 6, 7], [1, 3, 4, 5, 6, 7], [1, 5, 6, 7]],
  viscous_friction: [[11], [12], [13]],
  dry_friction: [[14], [15], [16]],
  gravity: [[], [17, 18], [18]],
};
const DEGREES = 180 / Math.PI;
/** As a joint's estimate counts as right in the replication's claims. */
const CLOSE = 0.1;

/** Builds the section's content; returns a function that shows the newest results. */
export function buildWhy(section, { bindings, runs, description, laboratory }) {
  const words = strings.explain.why;
  const title = element("h2", { id: "why-title" }, words.titleNone);
  const choice = element("select", { id: "why-scheme" }, description.schemes.map(({ id, name }) => element("option", { value: id }, name)));
  const body = element("div", { class: "why-body" });
  section.setAttribute("aria-labelledby", title.id);
  section.append(
    element("div", { class: "why-head" }, title, element("label", { for: choice.id }, words.choose), choice),
    body,
  );
  choice.addEventListener("change", show);

  function show() {
    const scheme = description.schemes.find(({ id }) => id === choice.value);
    const result = laboratory.results[scheme.id];
    if (!laboratory.isReady) {
      return;
    }
    if (!result.report) {
      title.textContent = words.titleNone;
      body.replaceChildren();
      return;
    }
    const { report } = result;
    if (report.outcome === "diverged") {
      title.textContent = words.titleNone;
      body.replaceChildren(element("p", {}, words.diverged(scheme.name, formatSeconds(report.at_s))));
      return;
    }
    const facts = gather(scheme, result);
    title.textContent = words.title(facts.worst + 1);
    body.replaceChildren(...sentences(scheme, facts).map((text) => element("p", {}, text)), table(facts));
    if (facts.parts) {
      body.append(element("p", { class: "help" }, words.note));
    }
  }

  /** The numbers of a finished run, each an array by joint. */
  function gather(scheme, { report, scenario }) {
    const { gains } = JSON.parse(scenario).scheme;
    const feedback = gains[FEEDBACK[scheme.id]];
    const index = report.index_e_deg;
    const sliding = bindings.sliding_rms(runs, scheme.id);
    return {
      index,
      worst: index.indexOf(Math.max(...index)),
      stiffness: feedback.map((k, n) => k * gains.lambda[n]),
      missing: feedback.map((k, n) => k * sliding[n]),
      total: report.tau_rms_nm,
      parts: bindings.torque_summary ? JSON.parse(bindings.torque_summary(runs, scheme.id)) : null,
      estimates: description.robots[0].parameters.map(({ symbol }, n) => ({
        symbol,
        value: report.theta_hat_end[n],
        truth: report.theta_true[n],
      })),
    };
  }

  return show;
}

function sentences(scheme, facts) {
  const words = strings.explain.why;
  const { index, worst, stiffness, missing, parts, total } = facts;
  const joint = worst + 1;
  const others = index.flatMap((value, n) => (n === worst ? [] : [words.other(n + 1, formatNumber(value, 3))])).join(words.and);
  const found = [
    words.worst(scheme.name, joint, formatNumber(index[worst], 3), others),
    words.explanation,
    `${words.balance(joint, formatNumber(missing[worst], 3), formatNumber(stiffness[worst], 3))} ${verdict(worst, stiffness, missing)}`,
  ];
  if (parts) {
    const column = parts.rms_nm[worst];
    const largest = parts.parts[column.indexOf(Math.max(...column))];
    const whole = formatNumber(total[worst], 3);
    found.push(`${words.largestPart(joint, largest, formatNumber(Math.max(...column), 3), whole)} ${behind(largest, facts)}`);
  }
  return found;
}

/** Whether the load or the softness explains the worst joint. */
function verdict(worst, stiffness, missing) {
  const words = strings.explain.why;
  const lacksMost = missing[worst] === Math.max(...missing);
  const isSoftest = stiffness[worst] === Math.min(...stiffness);
  if (lacksMost && isSoftest) {
    return words.both;
  }
  return lacksMost ? words.heaviest() : isSoftest ? words.softest() : words.neither;
}

/** What the estimates behind a part have come to; those that are far off first. */
function behind(part, { worst, estimates }) {
  const words = strings.explain.why;
  const relevant = (BEHIND[part]?.[worst] ?? []).map((number) => estimates[number - 1]);
  const off = relevant.filter(({ value, truth }) => Math.abs(value - truth) > CLOSE * truth);
  const say = (list) =>
    list.map(({ symbol, value, truth }) => words.estimate(symbol, formatNumber(value, 3), formatNumber(truth, 3))).join(", ");
  if (relevant.length === 0) {
    return "";
  }
  return off.length > 0 ? words.wrong(say(off)) : words.right(relevant.map(({ symbol }) => symbol).join(", "));
}

function table({ index, stiffness, missing, total, parts, worst }) {
  const words = strings.explain.why;
  const row = (text, numbers, kind) =>
    element(
      "tr",
      { class: kind ?? null },
      element("th", { scope: "row" }, text),
      numbers.map((number, n) => element("td", { class: n === worst ? "number worst" : "number" }, formatNumber(number, 3))),
    );
  const heads = index.map((_, n) => element("th", { scope: "col", class: "number" }, strings.jointShort(n + 1)));
  return element(
    "table",
    { "data-table": "why" },
    element("caption", {}, words.caption),
    element("thead", {}, element("tr", {}, element("th", { scope: "col" }, words.quantity), heads)),
    element(
      "tbody",
      {},
      row(words.rows.index, index),
      row(words.rows.missing, missing),
      row(words.rows.stiffness, stiffness),
      row(words.rows.quotient, missing.map((torque, n) => (torque / stiffness[n]) * DEGREES)),
      row(words.rows.total, total),
      parts?.parts.map((name, n) => row(words.part(name), parts.rms_nm.map((joint) => joint[n]), "part")),
    ),
  );
}
