// Puts the page together: loads the module, restores the state, builds the views, starts the workers, wires results to views.

import "./elements/scheme-card.js";
import { element, fillTexts } from "./dom.js";
import { formatSeconds } from "./format.js";
import { Laboratory } from "./laboratory.js";
import { RunPool } from "./pool.js";
import { State } from "./state.js";
import { strings } from "./strings.js";
import { initTheme, isDark } from "./theme.js";
import { Figures } from "./views/figures.js";
import { buildGains } from "./views/gains.js";
import { buildPinned } from "./views/pinned.js";
import { buildSetup } from "./views/setup.js";
import { buildTables } from "./views/tables.js";
import { failureOf, loadModule } from "./wasm.js";

const ANNOUNCE_AFTER_MS = 1000;
const root = document.documentElement;
const byId = (id) => document.getElementById(id);

function notice(text, kind) {
  const box = element(
    "p",
    { class: `notice ${kind}` },
    element("span", {}, text),
    element("button", { type: "button", class: "quiet", onclick: () => box.remove() }, strings.dismiss),
  );
  // One of a kind is enough, however often it happens.
  byId("notices").querySelector(`.${kind}`)?.remove();
  byId("notices").append(box);
}

async function main() {
  fillTexts(strings);
  let loaded;
  try {
    loaded = await loadModule();
  } catch (error) {
    root.dataset.state = "failed";
    notice(strings.moduleMissing(failureOf(error).message), "error");
    initTheme(byId("theme-toggle"), () => {});
    return;
  }
  const { bindings, module } = loaded;
  const description = JSON.parse(bindings.describe());
  const check = (scenario) => bindings.check(JSON.stringify(scenario));
  for (const study of description.studies) {
    study.hashes = Object.fromEntries(Object.entries(study.documents).map(([id, scenario]) => [id, check(scenario)]));
  }
  const paper = description.studies[0].documents;
  const state = new State(check, paper);
  if (state.dropped) {
    notice(strings.stateDropped, "warning");
  }
  build({ bindings, module, description, state, paper });
}

function build({ bindings, module, description, state, paper }) {
  const laboratory = new Laboratory(state);
  const figures = new Figures(new bindings.Plotter(), description, { signals: byId("figures"), estimates: byId("estimates") });
  const resetAll = () => laboratory.replace(structuredClone(paper));
  const showSetup = buildSetup(byId("setup-fields"), { description, state, laboratory, resetAll });
  const showGains = buildGains(byId("scheme-tabs"), { description, state, laboratory });
  buildPinned(byId("pinned"), figures);
  const showTables = buildTables(byId("tables-body"), description);
  const cards = buildCards({ description, state, figures });
  const paint = () => paintTheme(description, figures);
  paint();
  initTheme(byId("theme-toggle"), () => {
    paint();
    figures.redraw();
  });
  figures.shown = [...state.visible];
  byId("colophon").textContent = strings.colophon(description.core_version);

  laboratory.addEventListener("asked", () => {
    root.dataset.state = "running";
    root.dataset.generation = laboratory.generation;
    byId("run-state").textContent = strings.stateRunning;
    showSetup();
    showGains();
  });
  laboratory.addEventListener("replaced", () => {
    showSetup(true);
    showGains(true);
  });
  laboratory.addEventListener("progress", ({ detail: { scheme } }) => {
    cards[scheme].progress = laboratory.progress[scheme];
  });
  let pendingText = null;
  laboratory.addEventListener("result", ({ detail: { scheme, rows, report } }) => {
    const { results } = laboratory;
    cards[scheme].result = results[scheme];
    figures.setRun(scheme, rows, report);
    const { generation } = laboratory;
    const texts = () => {
      pendingText = null;
      showTables(results);
      figures.describe(reportsOf(results), state.valueAt(description.schemes[0].id, "/integration/duration_s"));
    };
    // Once a frame, like the figures, however many results arrive in it.
    pendingText ??= requestAnimationFrame(texts);
    if (laboratory.isReady) {
      figures.redraw(() => finished(laboratory, generation, description));
    }
  });

  const size = Math.max(1, Math.min(description.schemes.length, navigator.hardwareConcurrency || 1));
  const pool = new RunPool(module, size, {
    done: (result) => laboratory.done(result),
    failed: (failure) => laboratory.failed(failure),
    progress: (progress) => laboratory.advanced(progress),
    restarted: () => notice(strings.workerRestarted, "warning"),
    stopped: (message) => notice(strings.failed(`${strings.workerGone}: ${message}`), "error"),
  });
  laboratory.begin(pool);
}

function buildCards({ description, state, figures }) {
  const cards = {};
  for (const scheme of description.schemes) {
    const card = element("scheme-card");
    card.configure(scheme, state.visible.has(scheme.id));
    card.addEventListener("toggle", ({ detail }) => {
      state.visible[detail.shown ? "add" : "delete"](scheme.id);
      state.remember();
      figures.shown = [...state.visible];
      figures.redraw();
    });
    card.addEventListener("copied", () => announce(strings.copied));
    cards[scheme.id] = card;
    byId("scheme-cards").append(card);
  }
  return cards;
}

/** Colours come from the core, so that page and figures cannot disagree. */
function paintTheme(description, figures) {
  const theme = isDark() ? "dark" : "light";
  for (const { id, color } of description.schemes) {
    root.style.setProperty(`--scheme-${id}`, color[theme]);
  }
  root.style.setProperty("--plot-background", description.plot_background[theme]);
  figures.dark = isDark();
}

/** Called when the figures of the newest results are on their canvases. */
function finished(laboratory, generation, description) {
  if (generation !== laboratory.generation || !laboratory.isReady) {
    return;
  }
  const latency = Math.round(performance.now() - laboratory.askedAt);
  root.dataset.drawnGeneration = generation;
  root.dataset.lastLatencyMs = latency;
  root.dataset.state = "ready";
  byId("run-state").textContent = strings.stateReady(latency);
  const parts = description.schemes.map(({ id, name }) => {
    const { report, failure } = laboratory.results[id];
    const ended =
      report?.outcome === "diverged" ? strings.diverged(formatSeconds(report.at_s), report.reason) : (report?.outcome ?? failure);
    return `${name}: ${ended}.`;
  });
  announce(strings.announceReady(parts.join(" ")));
}

let announcing = null;

/** Says something to screen readers, once things have been quiet for a moment. */
function announce(text) {
  clearTimeout(announcing);
  announcing = setTimeout(() => {
    byId("announcements").textContent = text;
  }, ANNOUNCE_AFTER_MS);
}

function reportsOf(results) {
  return Object.fromEntries(Object.entries(results).map(([scheme, { report }]) => [scheme, report]));
}

main();
