// One student's work on an assignment: attempts with every variant, replay, extension, override.

import { client } from "../classroom/client.js";
import { field, form, momentField, numberField } from "../classroom/form.js";
import { badge, card, facts, gainsLine, points, pointsOf, table } from "../classroom/parts.js";
import { moment, momentElement } from "../classroom/times.js";
import { View } from "../classroom/view.js";
import { element } from "../dom.js";
import { confirmButton } from "../jobs/confirm.js";
import { localized, texts } from "../strings/classroom.js";
import { replayPart } from "./replay.js";

const own = texts.work;

export class WorkView extends View {
  #assignment;
  #student;

  constructor(assignment, student) {
    super();
    this.#assignment = assignment;
    this.#student = student;
  }

  async load() {
    const [work, assignment] = await Promise.all([
      client.get(`assignments/${this.#assignment}/students/${this.#student}`),
      client.get(`assignments/${this.#assignment}`),
    ]);
    return { work, assignment };
  }

  draw({ work, assignment }) {
    const { student, mark, extension, overrides } = work;
    document.title = `${student.name} · adaptarm`;
    const shown = mark
      ? [element("span", { id: "work-mark", "data-points": mark.points }, pointsOf(mark.points, mark.of)), mark.overridden ? badge("overridden", texts.board.overridden) : ""]
      : points(null);
    this.node.replaceChildren(
      element("p", {}, element("a", { class: "back", href: `#assignment/${this.#assignment}` }, `← ${localized(assignment.title)}`)),
      element("h1", { tabindex: "-1" }, own.title(student.name)),
      this.failure,
      card(
        own.standing,
        facts([
          [texts.board.mark, shown],
          [texts.exercise.comment, mark?.comment],
          [own.number, student.number],
          [own.extension, extension ? this.#said(extension) : own.noExtension],
        ]),
      ),
      this.#attempts(work, assignment),
      this.#override(mark, overrides, assignment),
      this.#extend(extension, assignment.deadline),
    );
  }

  #said({ deadline, attempts, comment }) {
    const until = deadline ? momentElement(deadline) : own.sameDeadline;
    return [until, attempts > 0 ? `, ${own.moreAttempts(attempts)}` : "", comment ? `: ${comment}` : ""];
  }

  #attempts({ attempts, metrics, moves }, assignment) {
    const items = attempts.toReversed().map((attempt) => attemptItem(attempt, assignment, { metrics, moves }));
    const list = items.length > 0 ? element("ol", { class: "attempt-list", reversed: true }, items) : element("p", { class: "help" }, own.noAttempts);
    return card(texts.exercise.attempts, list);
  }

  #override(mark, overrides, { points: of }) {
    const path = `assignments/${this.#assignment}/students/${this.#student}/override`;
    const comment = () => field({ name: "comment", label: own.comment, help: own.commentHelp, required: true, maxlength: 1000 });
    const set = form({
      id: "override",
      groups: [numberField({ name: "points", label: own.points(points(of)), value: mark?.points ?? "", min: 0, max: 2 * of, needed: true }), comment()],
      submit: own.override,
      primary: false,
      act: async (values) => {
        await client.ask("PUT", path, values);
        await this.start();
      },
    });
    const undo = mark?.overridden
      ? form({
          id: "override-back",
          groups: [comment()],
          submit: own.overrideBack,
          primary: false,
          act: async (values) => {
            await client.ask("PUT", path, { points: null, ...values });
            await this.start();
          },
        })
      : null;
    const rows = overrides.map((one) => ({ cells: [moment(one.at), points(one.points), one.comment] }));
    const history = rows.length > 0 ? table({ caption: own.overrides, heads: [texts.class_.when, texts.board.mark, own.comment], rows }) : null;
    return card(own.overrideTitle, element("p", { class: "help" }, own.overrideHelp), set, undo, history);
  }

  #extend(extension, deadline) {
    const path = `assignments/${this.#assignment}/extensions/${this.#student}`;
    const set = form({
      id: "extension",
      groups: [
        ...(deadline || extension?.deadline
          ? [momentField({ name: "deadline", label: own.newDeadline, help: own.newDeadlineHelp(deadline ? moment(deadline) : null), value: extension?.deadline })]
          : []),
        numberField({ name: "attempts", label: own.extraAttempts, value: extension?.attempts ?? 0, min: 0, max: 1000, whole: true, needed: true }),
        field({ name: "comment", label: own.extensionComment, value: extension?.comment ?? "", maxlength: 1000 }),
      ],
      submit: extension ? own.extendAgain : own.extend,
      primary: false,
      act: async (values) => {
        await client.change("PUT", path, values);
        await this.start();
      },
    });
    const end = extension ? confirmButton({ ...own.endExtension, name: own.endExtension.label }, () => this.act(() => client.change("DELETE", path))) : null;
    return card(own.extension, set, end ? element("div", { class: "actions" }, end) : null);
  }
}

function attemptItem(attempt, assignment, { metrics, moves }) {
  const { id, number, state, submitted_at, gains, criteria, counts, late_percent, reason } = attempt;
  const result = state === "graded" ? pointsOf(attempt.points, assignment.points) : texts.attempts.states[state];
  const rows = criteria.map(({ id: criterion, label, points: got, of }) => ({ "data-criterion": criterion, cells: [localized(label), pointsOf(got, of)] }));
  return element(
    "li",
    { class: "attempt", "data-attempt": id, "data-number": number, "data-state": state, "data-points": attempt.points ?? "" },
    element("p", { class: "attempt-head" }, element("strong", {}, texts.attempts.number(number)), ` ${result} `, counts ? badge("counts", texts.attempts.counts) : null),
    element("p", { class: "help" }, moment(submitted_at), late_percent > 0 ? `, ${texts.attempts.late(points(late_percent))}` : ""),
    gainsLine(moves, gains),
    state === "returned" ? element("p", {}, texts.attempts.returned(reason ?? "")) : null,
    rows.length > 0 ? table({ caption: own.criteria, heads: [texts.feedback.criterion, texts.board.mark], rows }) : null,
    replayPart(attempt, metrics),
  );
}
