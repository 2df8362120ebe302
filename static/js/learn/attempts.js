// Everything that was handed in: gains to take back, points, and receipts.

import { client } from "../classroom/client.js";
import { badge, gainsLine, points, pointsOf, showError } from "../classroom/parts.js";
import { moment } from "../classroom/times.js";
import { element } from "../dom.js";
import { download, fileName } from "../download.js";
import { texts } from "../strings/classroom.js";

const own = texts.attempts;

/** The list, newest first, of an exercise with these moves; `takeBack(gains)` is called when gains are wanted again. */
export class Attempts {
  node = element("ol", { class: "attempt-list", reversed: true });
  #of;
  #moves;
  #takeBack;

  constructor(of, moves, takeBack) {
    this.#of = of;
    this.#moves = moves;
    this.#takeBack = takeBack;
  }

  /** Shows attempts, oldest first as the server gives them. */
  show(attempts) {
    if (attempts.length === 0) {
      this.node.replaceChildren(element("li", { class: "help" }, own.none));
      return;
    }
    this.node.replaceChildren(...attempts.toReversed().map((attempt) => this.#item(attempt)));
  }

  #item(attempt) {
    const { id, number, state, submitted_at, gains, reason, late_percent, counts } = attempt;
    const failure = element("div", { class: "failure" });
    const take = element("button", { type: "button", class: "take-back", "aria-label": own.takeBackOf(number), onclick: () => this.#takeBack(gains) }, own.takeBack);
    const receipt = element("button", { type: "button", class: "receipt", "aria-label": own.receiptOf(number), onclick: () => save() }, own.receipt);
    async function save() {
      failure.replaceChildren();
      try {
        const blob = await (await client.fetch(`attempts/${id}/receipt`)).blob();
        download(fileName(["receipt", String(number), id.slice(0, 8)], "json"), blob);
      } catch (error) {
        showError(failure, error, save);
      }
    }
    const result = state === "graded" ? pointsOf(attempt.points, this.#of) : own.states[state];
    return element(
      "li",
      { class: "attempt", "data-attempt": id, "data-number": number, "data-state": state, "data-points": attempt.points ?? "" },
      element(
        "div",
        { class: "attempt-row" },
        element("p", { class: "attempt-head" }, element("strong", {}, own.number(number)), ` ${result} `, counts ? badge("counts", own.counts) : null),
        element("div", { class: "actions" }, take, state === "graded" ? receipt : null),
      ),
      element("p", { class: "help" }, moment(submitted_at), late_percent > 0 ? `, ${own.late(points(late_percent))}` : ""),
      gainsLine(this.#moves, gains),
      state === "returned" ? element("p", {}, own.returned(reason ?? "")) : null,
      failure,
    );
  }
}
