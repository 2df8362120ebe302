// "Run on the server": the documents of the shown schemes as a job, and the panel about it.

import { element } from "../dom.js";
import { notice } from "../notice.js";
import { ServerRun } from "../jobs/run.js";
import { buildRunPanel } from "../jobs/run-panel.js";
import { strings } from "../strings/index.js";

const texts = strings.server;

/** Builds the button in `place` and the panel below the toolbar. */
export function buildServerRun(place, app) {
  const { description, state, laboratory } = app;
  const run = new ServerRun();

  function submit() {
    const shown = description.schemes.filter(({ id }) => state.visible.has(id));
    if (shown.length === 0) {
      notice(texts.nothingShown, "warning");
      return;
    }
    const study = description.studies.find(({ hashes }) => shown.every(({ id }) => hashes[id] === state.hashes[id]));
    const label = texts.label(study ? (strings.studies[study.id] ?? study.title ?? study.id) : strings.studyCustom);
    const submitted = shown.map(({ id }) => ({
      scheme: id,
      hash: state.hashes[id],
      document: structuredClone(state.documents[id]),
    }));
    run.submit(label, submitted);
  }

  function returnTo() {
    const documents = run.record.submitted.map(({ scheme, document }) => [scheme, structuredClone(document)]);
    const failure = laboratory.replace(Object.fromEntries(documents));
    if (failure) {
      notice(texts.handoverRefused(failure.message), "error");
    }
  }

  const button = element("button", { type: "button", id: "run-on-server", title: texts.runHelp, onclick: submit }, texts.run);
  const { panel, show } = buildRunPanel(run, app, { returnTo, submitAgain: submit });
  place.append(button);
  document.getElementById("toolbar").after(panel);

  let frame = null;
  const redraw = () => {
    frame ??= requestAnimationFrame(() => {
      frame = null;
      button.disabled = run.phase === "sending";
      show();
    });
  };
  run.addEventListener("change", redraw);
  for (const event of ["asked", "result", "replaced"]) {
    laboratory.addEventListener(event, () => run.record && redraw());
  }
  run.resume();
}
