// A student's assignments: what is due when, how many attempts are left, and the mark.

import { client } from "../classroom/client.js";
import { badge, points, pointsOf } from "../classroom/parts.js";
import { momentElement } from "../classroom/times.js";
import { View } from "../classroom/view.js";
import { element } from "../dom.js";
import { localized, texts } from "../strings/classroom.js";

const own = texts.list;

export class ListView extends View {
  #items = element("ul", { class: "assignment-list" });

  constructor() {
    super();
    this.node.append(element("h1", { tabindex: "-1" }, own.title), this.failure, this.#items);
  }

  load() {
    return client.get("assignments");
  }

  draw({ assignments }) {
    this.#items.replaceChildren(...assignments.map(item));
    if (assignments.length === 0) {
      this.#items.replaceWith(element("p", { class: "empty" }, own.empty));
    }
  }
}

function item(assignment) {
  const { id, title, deadline, state, mark, attempts_left } = assignment;
  const due = deadline ? [own.due, " ", momentElement(deadline)] : [own.noDeadline];
  return element(
    "li",
    { class: "card assignment-item", "data-assignment": id },
    element("a", { class: "assignment-title", href: `#${id}` }, localized(title)),
    stateBadge(assignment),
    element("p", { class: "class-line" }, ...due),
    element("p", { class: "class-line" }, attempts_left === null ? own.attemptsFree : own.attemptsLeft(attempts_left)),
    element("p", { class: "assignment-mark", "data-points": mark?.points ?? "" }, mark ? pointsOf(mark.points, mark.of) : own.noMark(points(assignment.points))),
  );
}

/** How an assignment stands for this student. */
export function stateBadge({ state, extended, attempts_left }) {
  const standing = state !== "closed" && attempts_left === 0 ? "used" : state;
  return element(
    "span",
    { class: "badges" },
    badge(standing, own.states[standing]),
    extended ? badge("extended", own.extended) : null,
  );
}
