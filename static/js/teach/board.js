// The live board of an assignment: who has handed in what, how the points are spread, what most people fail at.
//
// Asks again every few seconds while somebody looks; what is being typed into stays.

import { announce } from "../announce.js";
import { client } from "../classroom/client.js";
import { badge, byName, card, facts, meter, points, pointsOf, table } from "../classroom/parts.js";
import { momentElement } from "../classroom/times.js";
import { View } from "../classroom/view.js";
import { element } from "../dom.js";
import { formatNumber } from "../format.js";
import { confirmButton } from "../jobs/confirm.js";
import { formatShare, timeElement } from "../jobs/times.js";
import { leaderboardTable } from "../learn/leaderboard.js";
import { localized, texts } from "../strings/classroom.js";
import { conditionsCard } from "./assign.js";
import { histogram } from "./histogram.js";
import { passbackCard } from "./platform.js";

const own = texts.board;
const REFRESH_MS = 3000;

export class BoardView extends View {
  #id;
  #timer = null;
  #graded = null;
  #live = element("div", { class: "board-live" });
  #places = element("div", {});
  #passback = element("div", {});
  #stale = element("p", { class: "trouble", role: "status" });

  constructor(id) {
    super();
    this.#id = id;
  }

  load() {
    return client.get(`assignments/${this.#id}/board`);
  }

  draw(board) {
    const { assignment } = board;
    document.title = `${localized(assignment.title)} · adaptarm`;
    const remove = confirmButton({ ...own.remove, name: own.remove.label }, async () => {
      await client.change("DELETE", `assignments/${this.#id}`);
      location.hash = `#class/${assignment.class}`;
    });
    this.node.replaceChildren(
      element("p", {}, element("a", { class: "back", href: `#class/${assignment.class}` }, `← ${own.back}`)),
      element("h1", { tabindex: "-1" }, localized(assignment.title)),
      this.failure,
      this.#stale,
      this.#live,
      this.#places,
      this.#passback,
      conditionsCard(assignment, (body) => this.act(() => client.ask("PATCH", `assignments/${this.#id}`, body))),
      element("div", { class: "actions" }, remove),
    );
    this.#show(board);
    this.#schedule();
  }

  stop() {
    super.stop();
    clearTimeout(this.#timer);
  }

  #schedule() {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#refresh(), REFRESH_MS);
  }

  async #refresh() {
    if (!document.hidden) {
      try {
        const board = await this.load();
        if (this.isStopped) {
          return;
        }
        this.#show(board);
        this.#stale.textContent = "";
      } catch {
        // What is shown stays; the next time tells more.
        this.#stale.textContent = own.stale;
      }
    }
    if (!this.isStopped) {
      this.#schedule();
    }
  }

  #show(board) {
    const { assignment, started, graded, mean_points, distribution, students } = board;
    if (this.#graded !== null && graded > this.#graded) {
      announce(own.gradedNow(graded, students.length));
    }
    this.#graded = graded;
    // Drawn anew, a link that had the focus must not lose it.
    const focused = document.activeElement?.closest?.("[data-student]")?.dataset.student;
    const { deadline } = assignment;
    this.#live.replaceChildren(
      card(
        own.standing,
        facts([
          [texts.list.due, deadline ? momentElement(deadline) : texts.list.noDeadline],
          [own.students, String(students.length)],
          [own.started, element("span", { id: "board-started" }, String(started))],
          [own.graded, element("span", { id: "board-graded" }, String(graded))],
          [own.mean, element("span", { id: "board-mean", "data-points": mean_points ?? "" }, mean_points === null ? points(null) : pointsOf(mean_points, assignment.points))],
        ]),
        element("div", { class: "board-charts" }, histogram(distribution), criteriaTable(board)),
      ),
      studentsTable(board),
    );
    if (focused) {
      this.#live.querySelector(`[data-student="${focused}"] a`)?.focus({ preventScroll: true });
    }
    if (assignment.leaderboard) {
      this.#leaderboard();
    }
    this.#showPassback();
  }

  async #showPassback() {
    try {
      this.#passback.replaceChildren(passbackCard(await client.get(`assignments/${this.#id}/lti`)));
    } catch {
      // As with the leaderboard.
    }
  }

  async #leaderboard() {
    try {
      const { entries } = await client.get(`assignments/${this.#id}/leaderboard`);
      this.#places.replaceChildren(card(texts.leaderboard.title, leaderboardTable(entries)));
    } catch {
      // Without it the board is still true; it is asked for again with the board.
    }
  }
}

function criteriaTable({ criteria, commonest_failure }) {
  const rows = criteria.map(({ id, label, failing, mean_share }) => {
    const name = localized(label);
    const isCommonest = id === commonest_failure && failing > 0;
    return {
      "data-criterion": id,
      "data-failing": failing,
      cells: [
        [name, isCommonest ? badge("commonest", own.commonest) : ""],
        String(failing),
        [meter(mean_share ?? 0, name), element("span", {}, mean_share === null ? formatNumber(null) : formatShare(mean_share))],
      ],
    };
  });
  return table({ caption: own.criteria, heads: [texts.feedback.criterion, own.failing, own.meanShare], rows, className: "criteria" });
}

function studentsTable({ assignment, students }) {
  const extended = new Set(assignment.extensions.map(({ student }) => student));
  const rows = byName(students).map(({ id, name, attempts, grading, returned, mark, last_at }) => {
    const marks = [
      mark ? pointsOf(mark.points, mark.of) : points(null),
      mark?.overridden ? badge("overridden", own.overridden) : "",
      mark?.late_percent > 0 ? badge("late", texts.attempts.late(points(mark.late_percent))) : "",
    ];
    const tried = [String(attempts), grading > 0 ? badge("grading", own.grading(grading)) : "", returned > 0 ? badge("returned", own.returned(returned)) : ""];
    return {
      "data-student": id,
      "data-points": mark?.points ?? "",
      cells: [
        [element("a", { href: `#assignment/${assignment.id}/${id}` }, name), extended.has(id) ? badge("extended", own.extended) : ""],
        tried,
        marks,
        last_at ? timeElement(last_at) : points(null),
      ],
    };
  });
  const box = card(own.everyone, table({ caption: own.everyoneCaption, heads: [texts.name, own.attempts, own.mark, own.last], rows, className: "roster" }));
  return students.length > 0 ? box : card(own.everyone, element("p", {}, texts.students.empty));
}
