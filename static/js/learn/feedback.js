// Criterion by criterion: what is asked for, what the visible variants give now, and what the latest attempt got.

import { meter, points, pointsOf, table } from "../classroom/parts.js";
import { element } from "../dom.js";
import { localized, texts } from "../strings/classroom.js";
import { quantity } from "./preview.js";

const own = texts.feedback;

/** The table; `grade` is the preview or null while it is computed, `attempt` the latest graded one or null. */
export function feedbackTable(criteria, grade, attempt) {
  const rows = criteria.map((criterion, n) => {
    const { id, label, metric, full, zero, weight } = criterion;
    const now = grade?.criteria[n];
    const values = grade?.variants.map(({ criteria: of }) => quantity(metric, of[n].value)).join(", ");
    const got = attempt?.criteria.find((one) => one.id === id);
    const name = [
      element("span", { class: "criterion-name" }, localized(label)),
      element("span", { class: "help" }, own.bounds(quantity(metric, full), quantity(metric, zero))),
    ];
    const preview = now
      ? [meter(now.points / now.of, localized(label)), element("span", {}, pointsOf(now.points, now.of)), element("span", { class: "help" }, values)]
      : [element("span", { class: "help" }, own.computing)];
    const graded = got
      ? [meter(got.points / got.of, localized(label)), element("span", {}, pointsOf(got.points, got.of))]
      : [element("span", { class: "help" }, points(null))];
    return { "data-criterion": id, "data-weight": weight, cells: [name, preview, graded] };
  });
  const heads = [own.criterion, own.preview, attempt ? own.latest(attempt.number) : own.noAttempt];
  return table({ caption: own.caption, heads, rows, className: "feedback" });
}
