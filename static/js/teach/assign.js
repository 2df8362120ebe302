// Giving an exercise out, and changing under which conditions: choice of the exercise, deadline, attempts, late policy.

import { check, choice, field, form, momentField, numberField, valuesOf } from "../classroom/form.js";
import { facts, rendered } from "../classroom/parts.js";
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
  const isNew = before.length > 0;
  const late = now.late ?? LATE;
  const number = (name, label, value, limits) =>
    numberField({ name, label, value: value ?? "", pointer: name.startsWith("late_") ? `/late/${name.slice(5)}` : `/${name}`, ...limits });
  const accepts = check({ name: "accept_late", label: own.acceptLate, checked: now.late !== null });
  const policy = [
    number("late_percent_per_day", own.latePerDay, late.percent_per_day, { min: 0, max: 100, needed: true }),
    number("late_cap_percent", own.lateCap, late.cap_percent, { min: 0, max: 100, needed: true }),
    number("late_days", own.lateDays, late.days, { min: 1, max: 365, whole: true, needed: true }),
  ];
  const opens = momentField({ name: "opens_at", label: own.opens, help: own.opensHelp, value: now.opens_at });
  const conditions = [
    field({ name: "title", label: own.ownTitle, help: own.ownTitleHelp, value: now.title ?? "", maxlength: 120, read: (input) => input.value.trim() || null }),
    opens,
    momentField({ name: "deadline", label: own.deadline, help: own.deadlineHelp, value: now.deadline, check: (at) => wrongDeadline(at, opens, isNew) }),
    number("attempts", own.attempts, now.attempts, { help: own.attemptsHelp, min: 1, max: 1000, whole: true }),
    choice({ name: "counts", label: own.counts, value: now.counts, options: Object.entries(own.countsWhich) }),
    number("points", own.points, now.points, { min: 1, max: 1000, needed: true }),
    accepts,
    ...policy,
    choice({ name: "explanation", label: own.explanation, value: now.explanation, options: Object.entries(own.explanationWhen) }),
    check({ name: "hints", label: own.hints, checked: now.hints }),
    check({ name: "leaderboard", label: own.leaderboard, help: own.leaderboardHelp, checked: now.leaderboard }),
  ];
  const shown = isNew ? {} : bodyOf(valuesOf(conditions));
  // What stands as it was shown is not sent: another page may have changed it since.
  const isChanged = ([name, value]) => JSON.stringify(value) !== JSON.stringify(shown[name]);
  const node = form({
    id,
    groups: [...before, ...conditions],
    submit,
    act: (values) => send(Object.fromEntries(Object.entries(bodyOf(values)).filter(isChanged))),
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

/** The values of the form as a request has them. */
function bodyOf({ accept_late, late_percent_per_day, late_cap_percent, late_days, ...values }) {
  const late = { percent_per_day: late_percent_per_day, cap_percent: late_cap_percent, days: late_days };
  return { ...values, late: accept_late ? late : null };
}

/** Why a deadline cannot be, or null. One in the past closes what was given out, and makes nothing new. */
function wrongDeadline(at, opens, isNew) {
  const opensAt = opens.read(opens.input);
  if (at === null) {
    return null;
  }
  if (isNew && Date.parse(at) <= Date.now()) {
    return texts.fields.deadlines.past;
  }
  return opensAt !== null && Date.parse(at) <= Date.parse(opensAt) ? texts.fields.deadlines.opens : null;
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
