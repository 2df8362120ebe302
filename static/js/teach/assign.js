// Giving an exercise out, and changing under which conditions: choice of the exercise, deadline, attempts, late policy.

import { check, choice, field, form, numberOf } from "../classroom/form.js";
import { facts, rendered } from "../classroom/parts.js";
import { fromLocal, toLocal } from "../classroom/times.js";
import { element } from "../dom.js";
import { localized, texts } from "../strings/classroom.js";

const own = texts.assign;
const LATE = { percent_per_day: 10, cap_percent: 50, days: 7 };
const USUAL = { title: null, opens_at: null, deadline: null, attempts: null, counts: "best", points: 100, late: null, explanation: "after_deadline", hints: true, leaderboard: false };

/** A card that gives an exercise out; `send(body)` makes the request. */
export function assignmentCard(exercises, send) {
  const about = element("div", { class: "about-exercise" });
  const options = exercises.map(({ id, title }) => [id, localized(title)]);
  const exercise = choice({ name: "exercise", label: own.exercise, options, value: options[0]?.[0] });
  const show = () => about.replaceChildren(...describe(exercises.find(({ id }) => id === exercise.input.value)));
  exercise.input.addEventListener("change", show);
  show();
  const fold = element("details", { class: "fold", id: "assign" }, element("summary", {}, own.title));
  fold.append(conditionsForm("new-assignment", USUAL, own.submit, send, [exercise, about]));
  return element("section", { class: "card", "aria-label": own.title }, fold);
}

/** A card that changes the conditions of an assignment. */
export function conditionsCard(assignment, send) {
  const own_title = assignment.title.en === assignment.title.es ? assignment.title.en : null;
  const fold = element("details", { class: "fold", id: "conditions" }, element("summary", {}, own.change));
  fold.append(conditionsForm("change-assignment", { ...assignment, title: own_title }, own.save, send));
  return element("section", { class: "card", "aria-label": own.change }, fold);
}

function conditionsForm(id, now, submit, send, before = []) {
  const late = now.late ?? LATE;
  const time = { type: "datetime-local", read: (input) => fromLocal(input.value) };
  const number = (name, label, value, help = null) =>
    field({ name, label, help, value: value ?? "", inputmode: "decimal", pointer: name.startsWith("late_") ? `/late/${name.slice(5)}` : `/${name}`, read: numberOf });
  const accepts = check({ name: "accept_late", label: own.acceptLate, checked: now.late !== null });
  const policy = [
    number("late_percent_per_day", own.latePerDay, late.percent_per_day),
    number("late_cap_percent", own.lateCap, late.cap_percent),
    number("late_days", own.lateDays, late.days),
  ];
  const node = form({
    id,
    groups: [
      ...before,
      field({ name: "title", label: own.ownTitle, help: own.ownTitleHelp, value: now.title ?? "", maxlength: 120, read: (input) => input.value.trim() || null }),
      field({ name: "opens_at", label: own.opens, help: own.opensHelp, value: toLocal(now.opens_at), ...time }),
      field({ name: "deadline", label: own.deadline, help: own.deadlineHelp, value: toLocal(now.deadline), ...time }),
      number("attempts", own.attempts, now.attempts, own.attemptsHelp),
      choice({ name: "counts", label: own.counts, value: now.counts, options: Object.entries(own.countsWhich) }),
      number("points", own.points, now.points),
      accepts,
      ...policy,
      choice({ name: "explanation", label: own.explanation, value: now.explanation, options: Object.entries(own.explanationWhen) }),
      check({ name: "hints", label: own.hints, checked: now.hints }),
      check({ name: "leaderboard", label: own.leaderboard, help: own.leaderboardHelp, checked: now.leaderboard }),
    ],
    submit,
    act: ({ accept_late, late_percent_per_day, late_cap_percent, late_days, ...values }) =>
      send({ ...values, late: accept_late ? { percent_per_day: late_percent_per_day, cap_percent: late_cap_percent, days: late_days } : null }),
  });
  const show = () => {
    for (const { input } of policy) {
      input.closest(".field").hidden = !accepts.input.checked;
    }
  };
  accepts.input.addEventListener("change", show);
  show();
  return node;
}

/** What a teacher wants to know before giving an exercise out. */
function describe(exercise) {
  if (!exercise) {
    return [element("p", {}, own.noExercises)];
  }
  const { level, minutes, criteria, moves, hints, html } = exercise;
  const list = (items) => element("ul", {}, items.map((item) => element("li", {}, localized(item.label))));
  return [
    facts([
      [own.level, own.levels[level]],
      [own.minutes, texts.exercise.minutes(minutes)],
      [own.goal, rendered(localized(html.goal))],
      [own.moves, list(moves)],
      [own.criteria, list(criteria)],
      [own.hintCount, String(hints?.length ?? 0)],
      [own.note, html.teacher_note ? rendered(localized(html.teacher_note)) : null],
    ]),
  ];
}
