// The stage: the arm or arms, what is said about them, and the transport below.
//
// What the canvas says is brought up to date when time rests.

import "../elements/arm-view.js";
import "../elements/transport-bar.js";
import { byId, element, swatch } from "../dom.js";
import { formatNumber, formatSeconds } from "../format.js";
import { load, save } from "../storage.js";
import { strings } from "../strings/index.js";
import { isDark, onTheme } from "../theme.js";

const KEY = "stage";
const TIMES = [1, 5, 20];
/** Narrower windows start with one arm. */
const WIDE = "(min-width: 700px)";
/** Time rests after so long without moving, ms. */
const REST_MS = 250;
/** Where the pose of an arm has its numbers: see `arm_pose` of the module. */
const TIP = 12;
const TIP_OFF = 30;
const BEYOND = 31;

/** Builds it; returns a function to call when the runs have changed. */
export function buildStage(place, app) {
  const { description, state, runs, bindings, timeline, laboratory } = app;
  const texts = strings.stage;
  const schemes = description.schemes;
  const saved = load(KEY);
  const settings = {
    race: saved?.race ?? matchMedia(WIDE).matches,
    scheme: schemes.some(({ id }) => id === saved?.scheme) ? saved.scheme : state.tab,
    exaggeration: TIMES.includes(saved?.exaggeration) ? saved.exaggeration : 1,
  };
  const view = element("arm-view");
  const transport = element("transport-bar", { role: "group", "aria-label": texts.transport });
  const labels = element("div", { class: "arm-labels" });
  const empty = element("p", { class: "arm-empty", hidden: true }, texts.nothing);

  const shownArms = () => {
    const visible = schemes.filter(({ id }) => state.visible.has(id));
    const focused = visible.find(({ id }) => id === settings.scheme) ?? visible[0];
    return settings.race || !focused ? visible : [focused];
  };
  const wanted = () => ({
    arms: shownArms().map(({ id }) => id),
    time_s: timeline.time,
    dark: isDark(),
    exaggeration: settings.exaggeration,
  });

  const controls = buildControls(settings, schemes, view.orbit, () => {
    save(KEY, settings);
    arrange();
  });
  place.setAttribute("aria-label", texts.title);
  place.append(
    element("div", { class: "stage-head" }, element("h3", {}, texts.title), controls.node),
    element("div", { class: "stage-box" }, view, labels, empty, controls.camera),
    element("p", { class: "stage-legend" }, texts.legend),
    transport,
    element("p", { class: "visually-hidden", id: "stage-hint" }, texts.hint),
  );

  let readOuts = [];
  /** Which arms there are has changed. */
  function arrange() {
    const arms = shownArms();
    controls.show(arms, state.visible);
    empty.hidden = arms.length > 0;
    labels.style.setProperty("--arms", Math.max(arms.length, 1));
    readOuts = arms.map((scheme) => ({ scheme, off: element("span", { class: "arm-off" }) }));
    labels.replaceChildren(
      ...readOuts.map(({ scheme, off }) =>
        element("div", { class: "arm-label" }, swatch(scheme), element("span", { class: "arm-name" }, scheme.name), off),
      ),
    );
    view.redraw();
  }

  let resting = null;
  view.addEventListener("drawn", ({ detail: { time_s, exaggeration } }) => {
    for (const { scheme, off } of readOuts) {
      const pose = bindings.arm_pose(runs, scheme.id, time_s, exaggeration);
      const beyond = pose?.[BEYOND] === 1 ? ` · ${texts.beyondLimits}` : "";
      const report = laboratory.results[scheme.id]?.report;
      const ended = report?.outcome === "diverged" && time_s >= report.at_s;
      const said = ended ? strings.divergedShort(formatSeconds(report.at_s)) : pose && texts.tipOff(millimetres(pose));
      const text = (said ?? texts.waiting) + beyond;
      if (off.textContent !== text) {
        off.textContent = text;
      }
    }
    clearTimeout(resting);
    if (!timeline.isPlaying) {
      resting = setTimeout(() => (view.description = describe(time_s)), REST_MS);
    }
  });

  function describe(time_s) {
    const sentences = readOuts.map(({ scheme }) => {
      const pose = bindings.arm_pose(runs, scheme.id, time_s, 1);
      if (!pose) {
        return texts.nowhere(scheme.name);
      }
      const [x, y, z] = pose.subarray(TIP, TIP + 3);
      return texts.where(scheme.name, metres(x), metres(y), metres(z), millimetres(pose));
    });
    return `${texts.title}. ${texts.atTime(time_s.toFixed(2), sentences.join(" ") || texts.nothing)}`;
  }

  view.addEventListener("flat", () => controls.hideCamera());
  place.addEventListener("keydown", (event) => {
    // Buttons and choices have a space of their own.
    if (event.key === " " && !event.target.matches("button, select")) {
      event.preventDefault();
      transport.toggle();
    }
  });
  transport.configure(timeline);
  view.configure(app, wanted);
  timeline.addEventListener("time", () => view.redraw());
  timeline.addEventListener("playing", () => view.redraw());
  laboratory.addEventListener("shown", arrange);
  laboratory.addEventListener("asked", () => view.runsAsked());
  onTheme(() => view.redraw());
  arrange();
  return () => view.redrawRuns();
}

/** One arm or all, which, how large errors are drawn, and the buttons of the camera. */
function buildControls(settings, schemes, orbit, changed) {
  const texts = strings.stage;
  const mode = (race, text) =>
    element("button", { type: "button", onclick: () => change({ race }) }, text);
  const modes = [mode(false, texts.one), mode(true, texts.race)];
  const scheme = element(
    "select",
    { "aria-label": texts.scheme, onchange: () => change({ scheme: scheme.value }) },
    schemes.map(({ id, name }) => element("option", { value: id }, name)),
  );
  const times = element(
    "select",
    { id: "stage-errors", onchange: () => change({ exaggeration: Number(times.value) }) },
    TIMES.map((factor) => element("option", { value: factor }, texts.errorTimes(factor))),
  );
  times.value = settings.exaggeration;
  const button = (text, glyph, act) =>
    element("button", { type: "button", "aria-label": text, title: text, onclick: act }, glyph);
  const camera = element("div", { class: "stage-camera" },
    button(texts.zoomOut, "−", () => orbit.farther()),
    button(texts.zoomIn, "+", () => orbit.nearer()),
    button(texts.resetView, "↺", () => orbit.reset()),
  );
  function change(part) {
    Object.assign(settings, part);
    changed();
  }
  return {
    camera,
    node: element("div", { class: "stage-controls" },
      element("div", { class: "stage-modes", role: "group", "aria-label": texts.mode }, modes),
      scheme,
      element("div", { class: "stage-errors" }, element("label", { for: times.id }, texts.errors), times),
    ),
    /** Shows which arms there are; schemes that are hidden cannot be chosen. */
    show(arms, visible) {
      modes.forEach((node, n) => node.setAttribute("aria-pressed", String(settings.race === (n === 1))));
      scheme.hidden = settings.race;
      scheme.value = arms[0]?.id ?? settings.scheme;
      for (const option of scheme.options) {
        option.disabled = !visible.has(option.value);
      }
    },
    hideCamera() {
      camera.hidden = true;
    },
  };
}

function metres(value) {
  return value.toFixed(3).replace("-", "−");
}

function millimetres(pose) {
  return formatNumber(1000 * pose[TIP_OFF], 2);
}
