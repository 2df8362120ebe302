// The task of an exercise: goal, statement, the hints that are unlocked, and the explanation once it is released.

import { rendered } from "../classroom/parts.js";
import { element } from "../dom.js";
import { localized, texts } from "../strings/classroom.js";

const own = texts.task;

/** Shows the task in `place`; what is unfolded stays so. */
export function showTask(place, { html, hints_total }) {
  const open = new Set([...place.querySelectorAll("details[open]")].map(({ dataset }) => dataset.part));
  const fold = (part, title, content, unfolded = false) =>
    element("details", { class: "fold", "data-part": part, open: unfolded || open.has(part) }, element("summary", {}, title), content);
  const { goal, statement, hints, explanation } = html;
  const locked = hints_total - hints.length;
  place.replaceChildren(
    element("h2", {}, own.title),
    element("div", { class: "goal" }, element("strong", {}, own.goal), rendered(localized(goal), "prose inline")),
    rendered(localized(statement)),
    ...hints.map((hint, n) => fold(`hint-${n}`, own.hint(n + 1, hints_total), rendered(localized(hint)))),
    locked > 0 ? element("p", { class: "help" }, own.locked(locked)) : "",
    explanation ? fold("explanation", own.explanation, rendered(localized(explanation)), true) : "",
  );
}
