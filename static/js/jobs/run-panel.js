// The panel below the toolbar: how the run on the server stands, and the server's bits beside the browser's.

import { element, swatch } from "../dom.js";
import { formatSeconds } from "../format.js";
import { strings } from "../strings/index.js";
import { confirmButton } from "./confirm.js";
import { explain, showError } from "./message.js";
import { stateBadge } from "./state-badge.js";
import { formatDuration, formatShare } from "./times.js";
import { forgetButton } from "./token-form.js";
import { verdict } from "./verdict.js";

const texts = strings.server;
const HASH_DIGITS = 12;
const SAME = ["same", "same-diverged"];
const DIFFERENT = ["different", "version", "misread"];

/** Builds the panel for a `ServerRun`; `actions` are `{returnTo, submitAgain}`. Returns `{panel, show}`. */
export function buildRunPanel(run, { description, state, laboratory }, { returnTo, submitAgain }) {
  const standing = element("p", { class: "standing", role: "status" });
  const badge = element("span", { class: "standing-badge" });
  const bar = element("progress", { max: 1, value: 0, "aria-label": texts.progressOf(texts.onServer) });
  const trouble = element("p", { class: "trouble", role: "status" });
  const failure = element("div", { class: "failure" });
  const body = element("tbody");
  const table = element("table", { class: "comparison" }, element("caption", {}, texts.comparison), head(), body);
  const notes = element("ul", { class: "verdict-notes" });
  const back = element("button", { type: "button", id: "server-return", onclick: returnTo }, texts.returnTo);
  const again = element("button", { type: "button", id: "server-again", onclick: submitAgain }, texts.submitAgain);
  const changed = element("div", { class: "changed", hidden: true }, element("p", {}, texts.changedSince), back, again);
  const details = element("a", { class: "details-link" }, texts.details);
  const forget = forgetButton();
  const cancel = confirmButton(texts.cancelRun, async () => {
    try {
      await run.cancel();
    } catch (error) {
      showError(failure, error);
    }
  });
  const close = () => {
    failure.replaceChildren();
    run.forget();
  };
  const panel = element(
    "section",
    { class: "server-panel", id: "server-panel", "aria-label": texts.onServer, hidden: true },
    element(
      "div",
      { class: "server-head" },
      element("h2", {}, texts.onServer),
      badge,
      standing,
      cancel,
      details,
      forget.button,
      element("button", { type: "button", class: "quiet", id: "server-dismiss", onclick: close }, strings.dismiss),
    ),
    bar,
    trouble,
    failure,
    changed,
    table,
    notes,
  );
  let shownError = null;
  let drawn = "";

  function show() {
    panel.hidden = run.record === null;
    if (panel.hidden) {
      shownError = null;
      return;
    }
    const { phase, job } = run;
    const share = job.progress ?? 0;
    panel.dataset.phase = phase;
    panel.dataset.job = run.record.id ?? "";
    badge.replaceChildren(...(job.state ? [stateBadge(job.state)] : []));
    setText(standing, standingText(run));
    bar.hidden = phase === "ended" || phase === "stuck";
    bar.value = share;
    bar.textContent = formatShare(share);
    cancel.hidden = phase !== "following" || run.hasEnded || !run.record.id;
    details.hidden = run.record.id === null;
    details.href = `jobs.html#${run.record.id}`;
    setText(trouble, run.trouble ? texts.trouble(explain(run.trouble)) : "");
    forget.show();
    if (run.error !== shownError) {
      shownError = run.error;
      failure.replaceChildren();
      if (run.error) {
        showError(failure, run.error, { retry: () => run.retry(), dismissed: () => run.record?.id === null && run.forget() });
      }
    }
    compare();
  }

  /** Redraws the comparison where it has changed: a dragged slider asks for this often. */
  function compare() {
    const rows = description.schemes.map(({ id }) => row(id));
    const key = JSON.stringify(rows);
    if (key === drawn) {
      return;
    }
    drawn = key;
    body.replaceChildren(...rows.map(tableRow));
    const names = new Set(rows.map(({ verdict: name }) => name));
    const explained = [...names].filter((name) => texts.explanations[name]);
    notes.replaceChildren(...explained.map((name) => element("li", { "data-verdict": name }, texts.explanations[name])));
    changed.hidden = !names.has("changed");
    // Before there is anything to compare, rows of dashes would only take room.
    table.hidden = rows.every(({ server }) => server === null);
  }

  function row(scheme) {
    const submitted = run.record.submitted.find((one) => one.scheme === scheme)?.hash ?? null;
    const report = run.reports[scheme] ?? null;
    const local = laboratory.isCurrent(scheme) ? laboratory.results[scheme] : null;
    const shown = state.hashes[scheme];
    const name = verdict({ submitted, report, ended: run.hasEnded, shown, local });
    // The browser's bits stand beside the server's only where they are of the same scenario.
    const compared = submitted !== null && shown === submitted ? local : null;
    return { scheme, verdict: name, server: side(report), browser: side(compared?.report), milliseconds: compared?.elapsed_ms };
  }

  function tableRow({ scheme: id, verdict: name, server, browser, milliseconds }) {
    const scheme = description.schemes.find((one) => one.id === id);
    const kind = SAME.includes(name) ? "same" : DIFFERENT.includes(name) ? "different" : "open";
    const time = browser && milliseconds !== undefined ? element("span", { class: "took" }, formatDuration(milliseconds)) : null;
    return element(
      "tr",
      { "data-scheme": id, "data-verdict": name },
      element("th", { scope: "row" }, swatch(scheme), element("span", {}, scheme.name)),
      element("td", { "data-column": texts.columnBrowser }, hash(browser), time),
      element("td", { "data-column": texts.columnServer }, hash(server)),
      element("td", {}, element("span", { class: `verdict ${kind}` }, mark(kind), texts.verdicts[name])),
    );
  }

  return { panel, show };
}

function head() {
  const columns = [strings.scheme, texts.columnBrowser, texts.columnServer, texts.columnVerdict];
  return element("thead", {}, element("tr", {}, columns.map((text) => element("th", { scope: "col" }, text))));
}

function side(report) {
  return report
    ? { hash: report.trajectory_hash, version: report.core_version, diverged: report.outcome === "diverged" ? report.at_s : null }
    : null;
}

function hash(side) {
  if (!side) {
    return "—";
  }
  return [
    element("code", { class: "bits", title: texts.wholeHash(side.hash), "data-hash": side.hash }, `${side.hash.slice(0, HASH_DIGITS)}…`),
    element("span", { class: "core-version" }, texts.coreVersion(side.version)),
    side.diverged === null ? null : element("span", { class: "diverged" }, strings.divergedShort(formatSeconds(side.diverged))),
  ];
}

function mark(kind) {
  return element("span", { "aria-hidden": "true" }, { same: "✓ ", different: "≠ ", open: "" }[kind]);
}

function standingText({ phase, job }) {
  if (phase === "sending") {
    return texts.sending;
  }
  if (phase === "stuck" || !job.state) {
    return "";
  }
  if (job.state === "running") {
    return formatShare(job.progress ?? 0);
  }
  if (job.state === "succeeded" && job.finished_at) {
    const took = formatDuration(Date.parse(job.finished_at) - Date.parse(job.started_at ?? job.created_at));
    return job.cached ? texts.answeredFromStore : texts.tookOnServer(took);
  }
  return job.reason ?? "";
}

/** A status is read out when it changes, so it is only set when it does. */
function setText(node, text) {
  if (node.textContent !== text) {
    node.textContent = text;
  }
}
