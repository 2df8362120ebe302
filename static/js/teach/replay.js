// An attempt's runs, computed again here: every variant's figures, and the way into the playground where it has the controls
// for such an arm and scheme.

import { loadCore } from "../classroom/core.js";
import { figurePlace, RunBench } from "../classroom/run-bench.js";
import { actionButton } from "../classroom/form.js";
import { showError, table } from "../classroom/parts.js";
import { element } from "../dom.js";
import { handOver } from "../handover.js";
import { quantity } from "../learn/preview.js";
import { localized, texts } from "../strings/classroom.js";
import { strings } from "../strings/index.js";

const own = texts.replay;
/** More curves than this in one figure nobody tells apart. */
const AT_A_TIME = 4;

/** The folded part of an attempt: computed when it is opened, gone when it is closed; one is open at a time. */
export function replayPart({ number, runs, grade, criteria }, metrics) {
  if (!runs || runs.length === 0) {
    return null;
  }
  const place = element("div", { class: "replay" });
  const fold = element("details", { class: "fold", name: "replay", "data-replay": number }, element("summary", {}, own.title), place);
  let stop = () => {};
  fold.addEventListener("toggle", () => (fold.open ? open() : close()));

  async function open() {
    place.replaceChildren(element("p", { class: "help" }, own.loading));
    try {
      const core = await loadCore();
      if (fold.open) {
        const shown = variants(runs, grade, criteria, metrics, core);
        stop = shown.stop;
        place.replaceChildren(shown.node);
      }
    } catch (error) {
      showError(place, error, open);
    }
  }

  function close() {
    stop();
    place.replaceChildren();
  }
  return fold;
}

/** A variant's values with their units, a line for each criterion. */
const measured = (graded, criteria, metrics) =>
  element(
    "ul",
    {},
    graded.map(({ value, share }, n) => element("li", {}, `${localized(criteria[n].label)}: ${own.value(quantity(metrics[n] ?? "", value), Math.round(100 * share))}`)),
  );

function variants(runs, grade, criteria, metrics, core) {
  const figures = element("div", {});
  let bench = null;
  const names = runs.map(({ hidden }, n) => (hidden ? own.hidden(place(runs, n)) : own.visible(place(runs, n))));
  const failure = element("div", { class: "failure" });
  const rows = runs.map(({ scenario, hidden }, n) => {
    const graded = hidden ? grade?.variants[place(runs, n) - 1] : null;
    const numbers = graded ? measured(graded.criteria, criteria, metrics) : "";
    const watch = element("button", { type: "button", "data-run": n, onclick: () => draw([named[n]]) }, own.show);
    const open = canOpen(scenario, core)
      ? actionButton(own.playground, failure, () => toPlayground(scenario), { "data-playground": n })
      : element("span", { class: "help" }, own.notInPlayground);
    return { cells: [names[n], numbers, element("div", { class: "actions" }, watch, open)] };
  });

  const named = runs.map(({ scenario }, n) => ({ id: `run-${n}`, name: names[n], document: scenario }));
  function draw(group) {
    const area = figurePlace(own.figures);
    figures.replaceChildren(area);
    bench?.stop();
    bench = new RunBench(core, group, area);
    bench.addEventListener("result", () => {
      area.dataset.replayed = group.map(({ id }) => id).join(" ");
      area.dataset.hashes = (bench.reports ?? []).map(({ trajectory_hash }) => trajectory_hash).join(" ");
    });
  }
  draw(named.slice(0, AT_A_TIME));
  const values = table({ caption: own.caption, heads: [own.variant, own.values, own.watch], rows });
  return { node: element("div", { class: "replay" }, values, failure, figures), stop: () => bench.stop() };
}

/** A run's number among those of its kind. */
function place(runs, n) {
  return runs.slice(0, n + 1).filter(({ hidden }) => hidden === runs[n].hidden).length;
}

/** The playground has controls for its own arm and schemes only. */
function canOpen({ robot, scheme }, { description }) {
  const [first] = description.robots;
  return (robot === undefined || robot === first.id) && description.schemes.some(({ id }) => id === scheme.kind);
}

async function toPlayground(scenario) {
  if (!handOver([scenario])) {
    throw new Error(strings.server.handoverFull);
  }
  location.assign("./");
}
