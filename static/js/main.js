// Puts the playground together: loads the module, restores the state, builds the views, starts the workers, wires results
// to views. Each feature is one module that gets `app` and a place on the page.

import "./elements/scheme-card.js";
import { Address } from "./address.js";
import { announce } from "./announce.js";
import { Calm } from "./calm.js";
import { translated } from "./core-text.js";
import { byId, element } from "./dom.js";
import { formatSeconds } from "./format.js";
import { LATE_AFTER_MS, gather } from "./gather.js";
import { History } from "./history.js";
import { takeHandover } from "./handover.js";
import { Laboratory } from "./laboratory.js";
import { buildMasthead, comeAlive } from "./masthead.js";
import { notice } from "./notice.js";
import { RunPool } from "./pool.js";
import { learnNames } from "./refusal.js";
import { State } from "./state.js";
import { strings } from "./strings/index.js";
import { isDark, onTheme } from "./theme.js";
import { Timeline } from "./timeline.js";
import { buildCompare } from "./views/compare.js";
import { buildExplain } from "./views/explain.js";
import { Figures } from "./views/figures.js";
import { buildGains } from "./views/gains.js";
import { buildPinned } from "./views/pinned.js";
import { buildServerRun } from "./views/server-run.js";
import { buildSetup } from "./views/setup.js";
import { buildShare } from "./views/share.js";
import { buildStage } from "./views/stage.js";
import { buildTables } from "./views/tables.js";
import { buildTour } from "./views/tour.js";
import { failureOf, loadModule } from "./wasm.js";
import { Words } from "./words.js";

const root = document.documentElement;

async function main() {
  buildMasthead("playground");
  let loaded;
  try {
    loaded = await loadModule();
  } catch (error) {
    root.dataset.state = "failed";
    notice(strings.moduleMissing(failureOf(error).message), "error");
    return;
  } finally {
    comeAlive();
  }
  const { bindings, module } = loaded;
  const description = translated(JSON.parse(bindings.describe()));
  learnNames(description);
  const [own, ...others] = description.robots;
  const check = (scenario) => {
    // The core takes any robot; sliders, tables and the drawn arm are the first one's.
    const other = others.find(({ id }) => id === scenario.robot);
    if (other) {
      throw new Error(strings.errors.otherRobot(other.name, own.name));
    }
    return bindings.check(JSON.stringify(scenario));
  };
  for (const study of description.studies) {
    study.hashes = Object.fromEntries(Object.entries(study.documents).map(([id, scenario]) => [id, check(scenario)]));
  }
  const paper = description.studies[0].documents;
  const state = new State(check, paper);
  if (state.dropped) {
    notice(strings.stateDropped, "warning");
  }
  const runs = new bindings.Runs();
  const laboratory = new Laboratory(state, runs);
  const app = { bindings, module, description, state, paper, runs, timeline: new Timeline(), laboratory };
  app.calm = new Calm(laboratory);
  app.words = new Words(description);
  app.history = new History(app);
  app.address = new Address(app);
  await app.address.start();
  build(app);
}

/** `app` is what every feature gets: module, description, state, its history and address, laboratory, calm, runs, timeline and,
 * from here on, figures. */
function build(app) {
  const { module, description, state, paper, laboratory, timeline } = app;
  const figures = new Figures(app, byId("figures"));
  app.figures = figures;
  app.resetAll = () => laboratory.replace(structuredClone(paper));
  const showSetup = buildSetup(byId("setup-fields"), app);
  const showGains = buildGains(byId("scheme-tabs"), app);
  const showTables = buildTables(byId("tables-body"), description);
  const cards = buildCards(app);
  buildPinned(byId("pinned"), figures);
  const redrawArms = buildStage(byId("stage"), app);
  const pins = buildCompare(byId("compare"), app);
  buildShare(byId("share"), app);
  buildServerRun(byId("server-run"), app);
  buildExplain(app);
  buildTour(app);
  paintTheme(description, figures);
  onTheme(() => {
    paintTheme(description, figures);
    figures.redraw();
  });
  showSchemes(app);
  state.addEventListener("shown", () => {
    for (const [id, card] of Object.entries(cards)) {
      card.shown = state.visible.has(id);
    }
    showSchemes(app);
  });
  byId("colophon").textContent = strings.colophon(description.core_version);

  let computing = null;
  // What changes back within a blink would only cost a frame.
  const sayComputing = () => {
    if (!laboratory.isReady) {
      byId("run-state").textContent = strings.stateRunning;
    }
  };
  laboratory.addEventListener("asked", () => {
    root.dataset.state = "running";
    root.dataset.generation = laboratory.generation;
    clearTimeout(computing);
    computing = setTimeout(sayComputing, LATE_AFTER_MS);
    timeline.duration = state.valueAt(description.schemes[0].id, "/integration/duration_s");
    showSetup();
    showGains();
  });
  laboratory.addEventListener("replaced", () => {
    showSetup(true);
    showGains(true);
  });
  laboratory.addEventListener("progress", ({ detail: { scheme } }) => {
    cards[scheme].progress = laboratory.progress[scheme];
    figures.redraw(() => app.calm.ask(redrawArms));
  });
  showResults(app, cards, showTables, redrawArms);

  const size = Math.max(1, Math.min(description.schemes.length, navigator.hardwareConcurrency || 1));
  const pool = new RunPool(module, size, {
    done: (result) => laboratory.done(result),
    failed: (failure) => laboratory.failed(failure),
    progress: (progress) => laboratory.advanced(progress),
    stopped: (stop) => laboratory.stopped(stop),
    restarted: () => notice(strings.workerRestarted, "warning"),
    gaveUp: (message) => notice(strings.failed(`${strings.workerGone}: ${message}`), "error"),
  });
  laboratory.begin(pool);
  pins.begin();
  takeHandover(app);
}

/** Shows results: first figures, then, in calm, texts and arms. */
function showResults({ laboratory, calm, figures, timeline, description }, cards, showTables, redrawArms) {
  const changed = new Set();
  const texts = () => {
    for (const scheme of changed) {
      cards[scheme].result = laboratory.results[scheme];
    }
    changed.clear();
    showTables(laboratory.results);
    figures.describe(reportsOf(laboratory.results), timeline.duration);
    sayReady();
  };
  // Everything on the page is that of the newest settings once both pixels and texts are.
  const sayReady = () => {
    if (laboratory.isReady && changed.size === 0 && root.dataset.drawnGeneration === String(laboratory.generation)) {
      root.dataset.state = "ready";
      byId("run-state").textContent = strings.stateReady(root.dataset.lastLatencyMs);
      const parts = description.schemes.map(({ id, name }) => `${name}: ${endOf(laboratory.results[id])}.`);
      announce(strings.announceReady(parts.join(" ")));
    }
  };
  laboratory.addEventListener("result", ({ detail: { scheme } }) => changed.add(scheme));
  gather(laboratory, (isComplete) => {
    const { generation } = laboratory;
    calm.ask(texts);
    const drawn = () => {
      noteLatency(laboratory, generation);
      sayReady();
      calm.ask(redrawArms);
    };
    figures.redraw(drawn, { atOnce: isComplete });
  });
}

function buildCards(app) {
  const { description, state, laboratory } = app;
  const cards = {};
  for (const scheme of description.schemes) {
    const card = element("scheme-card");
    card.configure(scheme, state.visible.has(scheme.id));
    card.addEventListener("toggle", ({ detail }) => {
      const others = [...state.visible].filter((id) => id !== scheme.id);
      state.show(detail.shown ? [...others, scheme.id] : others);
    });
    card.addEventListener("stop", () => laboratory.stop(scheme.id));
    card.addEventListener("again", () => laboratory.again(scheme.id));
    card.addEventListener("copied", () => announce(strings.copied));
    cards[scheme.id] = card;
    byId("scheme-cards").append(card);
  }
  return cards;
}

/** Shows the visible schemes, in the core's order. */
function showSchemes({ description, state, figures, laboratory }) {
  figures.shown = description.schemes.map(({ id }) => id).filter((id) => state.visible.has(id));
  figures.redraw();
  laboratory.dispatchEvent(new Event("shown"));
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

/** Called when the figures of a generation's results are on their canvases. */
function noteLatency(laboratory, generation) {
  if (generation === laboratory.generation && laboratory.isReady) {
    root.dataset.drawnGeneration = generation;
    root.dataset.lastLatencyMs = Math.round(performance.now() - laboratory.askedAt);
  }
}

/** How a run ended, in words. */
function endOf({ report, stoppedAt, failure }) {
  if (!report) {
    return failure ? strings.failed(failure) : strings.stoppedAt(Math.floor(100 * stoppedAt));
  }
  return report.outcome === "diverged" ? strings.diverged(formatSeconds(report.at_s), report.reason) : strings.ended;
}

function reportsOf(results) {
  return Object.fromEntries(Object.entries(results).map(([scheme, { report }]) => [scheme, report]));
}

main();
