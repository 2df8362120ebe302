// The guided tour of the paper: its set-up, its claims one by one with the verdict on the runs that are shown, what next.
//
// Every claim is judged by the core on the current runs, so that what the panel says is what the page shows. The visitor's
// own settings are kept aside and brought back on request.

import { byId, element } from "../dom.js";
import { notice } from "../notice.js";
import { strings } from "../strings/index.js";
import { TourPanel } from "../tour/panel.js";
import { Settings } from "../tour/settings.js";
import { DURATIONS, STEPS } from "../tour/steps.js";

/** Builds it. */
export function buildTour(app) {
  const words = strings.tour;
  const { laboratory, bindings, runs } = app;
  const settings = new Settings(app);
  const panel = new TourPanel({ move, close });
  const start = element("button", { type: "button", id: "tour-open", class: "primary", onclick: open }, words.start);
  byId("tour-start").prepend(start);
  document.querySelector(".controls").prepend(panel.node);
  /** Index of the step that is shown; null while the tour is closed. */
  let at = null;
  let seconds = DURATIONS[0];
  let highlighted = null;

  if (settings.differ) {
    offer();
    settings.keep();
  } else {
    settings.forget();
  }
  laboratory.addEventListener("result", judge);
  laboratory.addEventListener("asked", () => at !== null && judge());
  document.addEventListener("keydown", (event) => {
    const elsewhere = document.querySelector(":popover-open, dialog[open]") || event.target.closest?.("input, select");
    if (event.key === "Escape" && at !== null && !event.defaultPrevented && !elsewhere) {
      close();
    }
  });

  function open() {
    settings.keep();
    document.documentElement.dataset.tour = "open";
    go(0);
    panel.focus();
  }

  function move(by) {
    if (at + by >= STEPS.length) {
      close();
    } else if (at + by >= 0) {
      go(at + by);
    }
  }

  function close() {
    at = null;
    highlight(null);
    panel.hide();
    delete document.documentElement.dataset.tour;
    start.focus();
    if (settings.differ) {
      offer();
    } else {
      settings.forget();
    }
  }

  /** Offers the visitor's settings after the tour, or after a reload in the midst of it. */
  function offer() {
    const back = element("button", { type: "button", id: "tour-restore" }, words.restore);
    const box = notice(words.restoreOffer, "info", back);
    back.addEventListener("click", () => {
      box.remove();
      bringBack();
      start.focus();
    });
  }

  function bringBack() {
    const failure = settings.bringBack();
    if (failure) {
      notice(words.restoreFailed(failure.message), "error");
    }
  }

  function go(step) {
    at = step;
    const { id, claim, targets } = STEPS[step];
    seconds = DURATIONS[0];
    if (id !== "now") {
      settings.showStudy(seconds);
    }
    const { title, text } = words.steps[id];
    panel.show({
      number: step + 1,
      count: STEPS.length,
      title,
      paragraphs: claim ? [] : text,
      choices: claim ? durationButtons() : id === "now" ? lastButtons() : [],
    });
    highlight(targets.map((selector) => document.querySelector(selector)).find((node) => node?.getClientRects().length > 0));
    judge();
  }

  function highlight(target) {
    highlighted?.classList.remove("tour-target");
    highlighted = target ?? null;
    if (highlighted) {
      highlighted.classList.add("tour-target");
      highlighted.scrollIntoView({ block: "start" });
    }
  }

  function durationButtons() {
    const buttons = DURATIONS.map((duration) =>
      element(
        "button",
        {
          type: "button",
          "aria-pressed": String(duration === seconds),
          "data-seconds": duration,
          onclick: ({ currentTarget }) => {
            seconds = duration;
            buttons.forEach((button) => button.setAttribute("aria-pressed", String(button === currentTarget)));
            settings.showStudy(duration);
          },
        },
        words.seconds(duration),
      ),
    );
    return [element("span", { class: "note" }, words.over), ...buttons];
  }

  function lastButtons() {
    if (!settings.differ) {
      return [];
    }
    return [
      element(
        "button",
        {
          type: "button",
          id: "tour-return",
          onclick: ({ currentTarget }) => {
            bringBack();
            currentTarget.remove();
            byId("tour-next").focus();
          },
        },
        words.restore,
      ),
    ];
  }

  /** The verdict on the current runs, once all are there. */
  function judge() {
    const step = STEPS[at];
    if (!step || (!step.claim && step.id !== "now")) {
      return;
    }
    if (!laboratory.isReady) {
      panel.verdict = [element("p", { class: "note" }, words.computing)];
      return;
    }
    const reports = Object.fromEntries(Object.entries(laboratory.results).map(([id, { report }]) => [id, report]));
    if (Object.values(reports).includes(undefined)) {
      panel.verdict = [element("p", { class: "note" }, words.unfinished)];
      return;
    }
    const claims = JSON.parse(bindings.claims(runs, JSON.stringify(reports)));
    panel.verdict = step.claim ? verdictOf(claims.find(({ id }) => id === step.id)) : summary(claims);
  }

  function verdictOf(claim) {
    const own = words.claims[claim.id];
    return [
      element("p", { class: "tour-claim" }, own.claim),
      element(
        "p",
        { class: "badge", "data-verdict": claim.verdict, "data-claim": claim.id },
        words.verdicts[claim.verdict],
      ),
      element("p", {}, words.found(words.evidence(claim.evidence))),
      element("p", { class: "note" }, words.criterion(own.criterion)),
      element("p", {}, own.why),
    ];
  }

  /** How many claims hold, and the way back to each. */
  function summary(claims) {
    const holding = claims.filter(({ verdict }) => verdict === "holds").length;
    const items = STEPS.map((step, n) => [step, n])
      .filter(([step]) => step.claim)
      .map(([step, n]) => {
        const { verdict } = claims.find(({ id }) => id === step.id);
        const button = element("button", { type: "button", class: "link", onclick: () => (go(n), panel.focus()) }, words.steps[step.id].title);
        return element("li", { "data-verdict": verdict }, button, element("span", { class: "note" }, words.verdicts[verdict]));
      });
    return [element("p", { class: "tour-sum" }, words.sum(holding, claims.length)), element("ol", { class: "tour-list" }, items)];
  }
}
