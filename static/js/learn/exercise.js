// One exercise: the task, sliders with their live runs and preview, handing in, and what came of it.
//
// The gains of the sliders are kept in this browser, so that neither a lost connection nor a reload loses them.

import { announce } from "../announce.js";
import { client } from "../classroom/client.js";
import { loadCore, loadExercises } from "../classroom/core.js";
import { figurePlace, RunBench } from "../classroom/run-bench.js";
import { card, facts, points, pointsOf, showError } from "../classroom/parts.js";
import { momentElement } from "../classroom/times.js";
import { element } from "../dom.js";
import { parseTyped } from "../format.js";
import { refusal } from "../refusal.js";
import { load, save } from "../storage.js";
import { localized, texts } from "../strings/classroom.js";
import { strings } from "../strings/index.js";
import { buildPinned } from "../views/pinned.js";
import { failureOf } from "../wasm.js";
import { Attempts } from "./attempts.js";
import { feedbackTable } from "./feedback.js";
import { leaderboardCard } from "./leaderboard.js";
import { stateBadge } from "./list.js";
import { Moves } from "./moves.js";
import { Preview } from "./preview.js";
import { Submission } from "./submission.js";
import { SubmitPanel } from "./submit-panel.js";
import { showTask } from "./task.js";

const own = texts.exercise;
const root = document.documentElement;

export class ExerciseView {
  node = element("div", { class: "class-view exercise-view" });
  #id;
  /** Where the gains are kept: other people may use this browser, too. */
  #storage;
  #assignment;
  #attempts = [];
  #preview;
  #bench;
  #moves;
  /** What runs, or ran last, and what it is worth where that is known. */
  #gains;
  #grade = null;
  #submission;
  #panel;
  #history;
  #board;
  #stopped = false;
  #head = element("div", { class: "exercise-head" });
  #failure = element("div", { class: "failure" });
  #task = element("section", { class: "card task", "aria-label": own.task });
  #total = element("p", { class: "preview-total", role: "status" });
  #feedback = element("div", { class: "feedback-place" });

  constructor(id) {
    this.#id = id;
    this.#storage = `classroom.gains.${client.session.id}.${id}`;
    this.#submission = new Submission(id);
    this.node.append(element("p", {}, element("a", { class: "back", href: "#" }, `← ${texts.list.title}`)), this.#head, this.#failure);
  }

  async start() {
    this.#failure.replaceChildren();
    try {
      const [assignment, { attempts }, core, exercises] = await Promise.all([
        client.get(`assignments/${this.#id}`),
        client.get(`assignments/${this.#id}/attempts`),
        loadCore(),
        loadExercises(),
      ]);
      if (this.#stopped) {
        return;
      }
      this.#assignment = assignment;
      this.#attempts = attempts;
      this.#preview = new Preview(exercises, assignment.exercise, assignment.seed);
      this.#build(core);
      this.#submission.resume(attempts);
    } catch (error) {
      if (!this.#stopped) {
        root.dataset.state = "failed";
        showError(this.#failure, error, () => this.start());
      }
    }
  }

  stop() {
    this.#stopped = true;
    this.#submission.stop();
    this.#bench?.stop();
  }

  /** The student had been signed out, or without a connection, and is back. */
  resume() {
    if (root.dataset.state === "failed") {
      this.start();
    } else {
      this.#submission.goOn();
    }
  }

  #build(core) {
    const { exercise } = this.#assignment;
    const gains = this.#remembered();
    this.#gains = gains;
    this.#moves = new Moves(exercise.moves, gains, (wanted, move) => this.#change(wanted, move));
    this.#panel = new SubmitPanel(this.#submission, this.#moves);
    this.#history = new Attempts(this.#assignment.points, exercise.moves, (earlier) => this.#takeBack(earlier));
    this.#board = leaderboardCard(this.#assignment);
    const pinned = element("section", { class: "pinned", "aria-label": strings.pinnedFigure });
    const controls = element(
      "aside",
      { class: "controls", "aria-label": own.controls },
      pinned,
      card(own.gains, this.#moves.node, this.#resetButton(exercise), this.#total, this.#panel.node),
      card(own.worth, this.#feedback),
      card(own.attempts, this.#history.node),
    );
    const figures = figurePlace(own.figures);
    this.node.append(element("div", { class: "exercise" }, this.#task, controls, figures, this.#board?.node ?? ""));
    const documents = this.#preview.documents(gains);
    const variants = documents.map((document, n) => ({ id: `variant-${n + 1}`, name: own.variant(n + 1), document }));
    this.#bench = new RunBench(core, variants, figures);
    buildPinned(pinned, this.#bench.figures);
    this.#bench.addEventListener("result", () => this.#judge());
    this.#submission.addEventListener("graded", ({ detail }) => this.#graded(detail));
    this.#showStanding();
    this.#showFeedback();
  }

  /** The gains of an earlier visit, if the exercise still takes them; else where it starts. */
  #remembered() {
    const { exercise } = this.#assignment;
    const start = Object.fromEntries(exercise.moves.map(({ name, start: value }) => [name, value]));
    const kept = load(this.#storage);
    try {
      this.#preview.documents(kept ?? start);
      return kept ?? start;
    } catch {
      return start;
    }
  }

  /** Tries gains; returns null, or what the core says against them. */
  #change(gains, move) {
    const value = gains[move.name];
    if (typeof value !== "number") {
      return strings.errors.notANumber(localized(move.label), String(parseTyped(value)));
    }
    try {
      this.#run(gains, this.#preview.documents(gains));
      return null;
    } catch (error) {
      const failure = failureOf(error);
      return failure.pointer.endsWith(`/${move.name}`) ? refusal(failure, localized(move.label)) : failure.message;
    }
  }

  #set(gains) {
    this.#moves.show(gains);
    this.#run(gains, this.#preview.documents(gains));
  }

  #run(gains, documents) {
    this.#gains = gains;
    save(this.#storage, gains);
    root.dataset.preview = "running";
    this.#bench.show(documents);
    if (this.#bench.isReady) {
      // The same as before: nothing runs.
      this.#judge();
    }
  }

  #takeBack(gains) {
    this.#set(gains);
    announce(own.takenBack);
    this.#moves.node.querySelector("input")?.focus();
  }

  #resetButton({ moves }) {
    const start = () => this.#set(Object.fromEntries(moves.map(({ name, start: value }) => [name, value])));
    return element("button", { type: "button", class: "quiet", onclick: start }, own.reset);
  }

  /** The newest runs are done: what they are worth. */
  #judge() {
    const { reports } = this.#bench;
    this.#grade = reports ? this.#preview.grade(this.#gains, reports) : null;
    this.#showFeedback();
    root.dataset.preview = "ready";
    root.dataset.state = "ready";
  }

  #showFeedback() {
    const { exercise } = this.#assignment;
    const latest = this.#attempts.findLast(({ state }) => state === "graded") ?? null;
    this.#feedback.replaceChildren(feedbackTable(exercise.criteria, this.#grade, latest));
    this.#total.dataset.points = this.#grade?.points ?? "";
    this.#total.dataset.score = this.#grade?.score ?? "";
    const { length } = this.#assignment.visible;
    this.#total.textContent = this.#grade ? own.previewTotal(points(100 * this.#grade.score), length) : own.computing;
  }

  /** Everything that says how the assignment stands. */
  #showStanding() {
    const { title, deadline, closes_at, late, counts, attempts_left, attempts_allowed, mark, exercise } = this.#assignment;
    const lateText = late ? own.late(points(late.percent_per_day), points(late.cap_percent)) : null;
    this.#head.replaceChildren(
      element("h1", { tabindex: "-1" }, localized(title)),
      stateBadge(this.#assignment),
      facts([
        [own.due, deadline ? momentElement(deadline) : texts.list.noDeadline],
        [own.closes, closes_at && closes_at !== deadline ? [momentElement(closes_at), " ", lateText ?? ""] : null],
        [own.attemptsLeft, attempts_left === null ? texts.list.attemptsFree : own.leftOf(attempts_left, attempts_allowed)],
        [own.counts, own.countsWhich[counts]],
        [own.time, own.minutes(exercise.minutes)],
        [own.mark, mark ? element("span", { id: "mark", "data-points": mark.points }, pointsOf(mark.points, mark.of), mark.overridden ? ` (${own.overridden})` : "") : points(null)],
        [own.comment, mark?.comment],
      ]),
    );
    showTask(this.#task, this.#assignment);
    this.#history.show(this.#attempts);
    this.#panel.show(this.#assignment);
  }

  /** An attempt has its grade, or was given back: everything is asked for anew, hints included. */
  async #graded(attempt) {
    announce(attempt.state === "graded" ? own.gradedNow(points(attempt.points)) : own.returnedNow);
    try {
      const [assignment, { attempts }] = await Promise.all([
        client.get(`assignments/${this.#id}`),
        client.get(`assignments/${this.#id}/attempts`),
      ]);
      if (this.#stopped) {
        return;
      }
      this.#assignment = assignment;
      this.#attempts = attempts;
      this.#showStanding();
      this.#showFeedback();
      this.#board?.refresh();
      root.dataset.attempts = attempts.filter(({ state }) => state !== "grading").length;
    } catch (error) {
      showError(this.#failure, error, () => this.#graded(attempt));
    }
  }
}
