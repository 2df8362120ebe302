// The button that hands in, and how what was handed in stands.

import { showError } from "../classroom/parts.js";
import { element } from "../dom.js";
import { texts } from "../strings/classroom.js";

const own = texts.submit;

export class SubmitPanel {
  node = element("div", { class: "submit-panel" });
  #submission;
  #moves;
  #assignment = null;
  #button = element("button", { type: "button", class: "primary wide", id: "submit" }, own.submit);
  #standing = element("p", { class: "standing", role: "status" });
  #bar = element("progress", { max: 1, value: 0, hidden: true, "aria-label": own.progress });
  #failure = element("div", { class: "failure" });

  /** What `moves` shows is handed in. */
  constructor(submission, moves) {
    this.#submission = submission;
    this.#moves = moves;
    this.#button.addEventListener("click", () => this.#submit());
    submission.addEventListener("change", () => this.#draw());
    this.node.append(this.#button, this.#standing, this.#bar, this.#failure);
  }

  /** How the assignment stands decides whether anything can be handed in. */
  show(assignment) {
    this.#assignment = assignment;
    this.#draw();
  }

  /** Hands in what is seen, or nothing: a number that was refused is not replaced by the one before it. */
  #submit() {
    const { refused } = this.#moves;
    if (!refused) {
      this.#submission.submit(this.#moves.read());
      return;
    }
    this.#failure.replaceChildren(element("div", { class: "message error", "data-kind": "refused" }, element("p", { role: "alert" }, own.mend)));
    // What was typed is being mended: the message has done its work.
    this.#moves.node.addEventListener("input", () => this.#draw(), { once: true });
    refused.mend();
  }

  #draw() {
    const { phase, error, trouble, progress } = this.#submission;
    const { state, attempts_left } = this.#assignment;
    const closed = state === "closed" ? own.closed : attempts_left === 0 ? own.noneLeft : "";
    const busy = phase === "sending" || phase === "grading";
    this.#button.disabled = busy || closed !== "";
    this.#bar.hidden = phase !== "grading";
    this.#bar.value = progress;
    this.node.dataset.phase = phase;
    const said = { sending: own.sending, grading: trouble ? own.trouble : own.grading(Math.floor(100 * progress)) };
    const standing = said[phase] ?? (closed || (state === "late" ? own.late : own.hidden));
    if (this.#standing.textContent !== standing) {
      this.#standing.textContent = standing;
    }
    if (!error) {
      this.#failure.replaceChildren();
    } else if (this.#submission.isKept) {
      showError(this.#failure, error, () => this.#submission.retry());
      const forget = element("button", { type: "button", class: "quiet", onclick: () => this.#submission.forget() }, own.forget);
      this.#failure.querySelector(".message-actions").append(forget);
      this.#failure.querySelector("p").append(` ${own.kept}`);
    } else {
      showError(this.#failure, error);
    }
  }
}
