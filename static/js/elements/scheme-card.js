// <scheme-card>: one control scheme's standing: shown or not, how its run ended, how long it took, its trajectory hash.

import { element, swatch } from "../dom.js";
import { infoButton } from "../explain/info.js";
import { formatNumber, formatSeconds } from "../format.js";
import { strings } from "../strings/index.js";

const HASH_DIGITS = 8;

export class SchemeCard extends HTMLElement {
  #toggle;
  #outcome;
  #bar;
  #stop;
  #hash;

  /** Emits `toggle` with `{shown}`, `stop` and `again`, and `copied` after the hash went to the clipboard. */
  configure(scheme, shown) {
    this.dataset.scheme = scheme.id;
    this.dataset.outcome = "waiting";
    this.style.setProperty("--scheme", `var(--scheme-${scheme.id})`);
    this.#toggle = element("input", {
      type: "checkbox",
      "aria-label": strings.show(scheme.name),
      onchange: () => this.dispatchEvent(new CustomEvent("toggle", { detail: { shown: this.#toggle.checked } })),
    });
    this.#toggle.checked = shown;
    this.#outcome = element("p", { class: "outcome" }, strings.waiting);
    this.#bar = element("progress", { max: 1, value: 0, hidden: true, "aria-label": scheme.name });
    this.#stop = element("button", {
      type: "button",
      class: "quiet stop",
      hidden: true,
      onclick: () => this.dispatchEvent(new Event(this.dataset.outcome === "running" ? "stop" : "again")),
    });
    this.#hash = element("button", { type: "button", class: "hash", hidden: true, onclick: () => this.#copy() });
    this.replaceChildren(
      element("label", { class: "scheme-name" }, this.#toggle, swatch(scheme), element("span", {}, scheme.name)),
      infoButton("scheme", scheme.id),
      this.#outcome,
      this.#bar,
      this.#stop,
      this.#hash,
    );
  }

  /** Whether its curves are shown. */
  set shown(shown) {
    this.#toggle.checked = shown;
  }

  /** A run under way: only worth a bar when it takes its time. */
  set progress(progress) {
    this.dataset.outcome = "running";
    this.#outcome.textContent = strings.running(Math.floor(100 * progress));
    // The old run's hash is not this one's.
    this.#hash.hidden = true;
    this.#bar.hidden = false;
    this.#bar.value = progress;
    this.#offer(strings.stop);
  }

  /** Shows the button that stops or starts again; hides it without a text. */
  #offer(text) {
    this.#stop.hidden = !text;
    this.#stop.textContent = text ?? "";
  }

  /** How the latest run ended: `{report, elapsed_ms}`, `{stoppedAt}` or `{failure}`. */
  set result({ report, elapsed_ms, stoppedAt, failure }) {
    this.#bar.hidden = true;
    this.#offer(report ? null : strings.runAgain);
    this.dataset.outcome = report?.outcome ?? (failure ? "failed" : "stopped");
    this.dataset.scenarioHash = report?.scenario_hash ?? "";
    this.dataset.trajectoryHash = report?.trajectory_hash ?? "";
    this.#hash.hidden = !report;
    if (!report) {
      this.#outcome.textContent = failure ? strings.failed(failure) : strings.stoppedAt(Math.floor(100 * stoppedAt));
      return;
    }
    this.#outcome.textContent =
      report.outcome === "diverged"
        ? strings.diverged(formatSeconds(report.at_s), report.reason)
        : strings.completed(formatNumber(elapsed_ms, 2));
    const hash = report.trajectory_hash;
    this.#hash.replaceChildren(`${strings.hash} `, element("code", {}, `${hash.slice(0, HASH_DIGITS)}…`));
    this.#hash.title = strings.hashTitle(hash);
  }

  async #copy() {
    const hash = this.dataset.trajectoryHash;
    try {
      await navigator.clipboard.writeText(hash);
      this.dispatchEvent(new Event("copied"));
    } catch {
      // No clipboard without a secure connection: the whole hash, selected, for the visitor to copy.
      const code = this.#hash.querySelector("code");
      code.textContent = hash;
      getSelection().selectAllChildren(code);
    }
  }
}

customElements.define("scheme-card", SchemeCard);
