// A student's assignments: what is due when, how many attempts are left, and the mark.

import { client } from "../classroom/client.js";
import { badge, points, pointsOf, showError } from "../classroom/parts.js";
import { momentElement } from "../classroom/times.js";
import { element } from "../dom.js";
import { localized, texts } from "../strings/classroom.js";

const own = texts.list;
const root = document.documentElement;

export class ListView {
  node = element("div", { class: "class-view" });
  #failure = element("div", { class: "failure" });
  #items = element("ul", { class: "assignment-list" });
  #stopped = false;

  constructor() {
    this.node.append(element("h1", { tabindex: "-1" }, own.title), this.#failure, this.#items);
  }

  async start() {
    try {
      const { assignments } = await client.get("assignments");
      if (this.#stopped) {
        return;
      }
      this.#items.replaceChildren(...assignments.map(item));
      if (assignments.length === 0) {
        this.#items.replaceWith(element("p", { class: "empty" }, own.empty));
      }
      root.dataset.state = "ready";
    } catch (error) {
      if (!this.#stopped) {
        root.dataset.state = "failed";
        showError(this.#failure, error, () => this.start());
      }
    }
  }

  stop() {
    this.#stopped = true;
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
