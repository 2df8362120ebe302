// What was done in a class, newest first: when, what, and with which values, in words. The server knows people and assignments
// by identifiers alone; who or what is gone stays without a name.

import { client } from "../classroom/client.js";
import { actionButton } from "../classroom/form.js";
import { card, points, table } from "../classroom/parts.js";
import { moment } from "../classroom/times.js";
import { element } from "../dom.js";
import { localized, texts } from "../strings/classroom.js";

const own = texts.class_;
const words = texts.audit;

/** A card that asks for the list when it is wanted. */
export function auditCard(id, group) {
  const place = element("div", {});
  const load = async () => {
    const { entries } = await client.get(`classes/${id}/audit`);
    const rows = entries.map((entry, n) => ({ cells: [moment(entry.at), own.audited[entry.what] ?? entry.what, said(entry, entries.slice(n + 1), group)] }));
    place.replaceChildren(
      rows.length > 0
        ? table({ caption: own.auditCaption, heads: [own.when, own.what, own.data], rows, className: "audit" })
        : element("p", { class: "help" }, own.auditEmpty),
    );
  };
  const show = actionButton(own.auditShow, place, load, { id: "show-audit" });
  return card(own.audit, element("p", {}, own.auditHelp), element("div", { class: "actions" }, show), place);
}

/** An entry's values; of conditions those that the assignment did not have before. */
function said({ what, data }, earlier, { students, assignments }) {
  const { student, assignment, settings, joining } = data;
  const parts = [];
  if (assignment) {
    const known = assignments.find(({ id }) => id === assignment);
    parts.push(known ? localized(known.title) : words.goneAssignment);
  }
  if (student) {
    parts.push(students.find(({ id }) => id === student)?.name ?? words.goneStudent);
  }
  if (what === "mark.override") {
    parts.push(data.points === null ? words.takenBack : words.points(points(data.points)));
  }
  if (what === "extension.set") {
    parts.push(data.deadline ? words.until(moment(data.deadline)) : null, data.attempts > 0 ? texts.work.moreAttempts(data.attempts) : null);
  }
  if (settings) {
    const before = earlier.find((other) => other.data.assignment === assignment && other.data.settings)?.data.settings ?? {};
    const changed = Object.entries(settings).filter(([name, value]) => JSON.stringify(value) !== JSON.stringify(before[name]));
    parts.push(...changed.map(([name, value]) => condition(name, value)));
  }
  if (what === "class.change" && typeof joining === "boolean") {
    parts.push(joining ? words.joiningOpen : texts.classes.codeClosed);
  }
  return parts.filter(Boolean).join("; ");
}

/** A condition of an assignment by its name in the form, or null where it says nothing. */
function condition(name, value) {
  const { assign } = texts;
  const yes = value ? words.yes : words.no;
  const shown = {
    title: () => (value ? [assign.ownTitle, value] : null),
    opens_at: () => (value ? [assign.opens, moment(value)] : null),
    deadline: () => [assign.deadline, value ? moment(value) : words.none],
    attempts: () => [assign.attempts, value === null ? words.unlimited : points(value)],
    counts: () => [assign.counts, assign.countsWhich[value]],
    points: () => [assign.points, points(value)],
    late: () => [assign.acceptLate, value ? words.late(points(value.percent_per_day), points(value.cap_percent), points(value.days)) : words.no],
    explanation: () => [assign.explanation, assign.explanationWhen[value]],
    hints: () => [assign.hints, yes],
    leaderboard: () => [assign.leaderboard, yes],
  };
  return shown[name]?.()?.join(": ") ?? null;
}
