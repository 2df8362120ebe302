// The gains: one tab per scheme, one slider per number, built from the core's description of each gain.

import "../elements/number-field.js";
import { element, swatch, symbol } from "../dom.js";
import { infoButton } from "../explain/info.js";
import { withValueAt } from "../pointer.js";
import { linear, logarithmic } from "../scale.js";
import { strings } from "../strings/index.js";

const PROJECTION = "/scheme/gains/projection/";

/** Builds the tabs into `container`; returns a function that shows the state again. */
export function buildGains(container, { description, state, laboratory }) {
  const [robot] = description.robots;
  const panels = description.schemes.map((scheme) => {
    const fields = [];
    const group = (gain) => buildGain(gain, scheme, robot, laboratory, fields);
    const plain = scheme.gains.filter(({ pointer }) => !pointer.startsWith(PROJECTION));
    const shaped = (shape) => plain.filter((gain) => gain.shape === shape).map(group);
    const projection = scheme.gains.filter(({ pointer }) => pointer.startsWith(PROJECTION));
    const reset = element(
      "button",
      { type: "button", class: "quiet wide", "data-reset": scheme.id, onclick: () => resetGains(scheme) },
      strings.resetScheme(scheme.name),
    );
    const panel = element(
      "div",
      { role: "tabpanel", id: `panel-${scheme.id}`, "aria-labelledby": `tab-${scheme.id}`, "data-scheme": scheme.id },
      shaped("joint"),
      shaped("scalar"),
      shaped("parameter"),
      projection.length > 0 ? foldedGroup(strings.projection, String(projection.length), projection.map(group)) : null,
      reset,
    );
    panel.style.setProperty("--scheme", `var(--scheme-${scheme.id})`);
    return { scheme, panel, fields };
  });

  function resetGains(scheme) {
    const { scheme: paper } = description.studies[0].documents[scheme.id];
    laboratory.replace({ [scheme.id]: withValueAt(state.documents[scheme.id], "/scheme", structuredClone(paper)) });
  }

  const tabs = panels.map(({ scheme }) =>
    element(
      "button",
      {
        type: "button",
        role: "tab",
        id: `tab-${scheme.id}`,
        "aria-controls": `panel-${scheme.id}`,
        onclick: () => open(scheme.id),
        onkeydown: (event) => step(event, scheme.id),
      },
      swatch(scheme),
      element("span", {}, scheme.name),
    ),
  );
  container.append(
    element("div", { role: "tablist", "aria-label": strings.schemes, class: "tabs" }, tabs),
    ...panels.map(({ panel }) => panel),
  );

  function open(id) {
    state.tab = id;
    state.remember();
    showTab();
  }

  function step(event, id) {
    const ids = panels.map(({ scheme }) => scheme.id);
    const move = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (move) {
      event.preventDefault();
      const next = ids[(ids.indexOf(id) + move + ids.length) % ids.length];
      open(next);
      document.getElementById(`tab-${next}`).focus();
    }
  }

  function showTab() {
    panels.forEach(({ scheme, panel }, n) => {
      const selected = scheme.id === state.tab;
      panel.hidden = !selected;
      tabs[n].setAttribute("aria-selected", String(selected));
      tabs[n].tabIndex = selected ? 0 : -1;
    });
  }

  /** Refused texts stay unless `anew`. */
  return function show(anew = false) {
    for (const { scheme, fields } of panels) {
      for (const { field, pointer } of fields) {
        field[anew ? "accept" : "show"](state.valueAt(scheme.id, pointer));
      }
    }
    showTab();
  };
}

/** One gain: a heading with its symbol and meaning, and a field per number; the long ones folded. */
function buildGain(gain, scheme, robot, laboratory, fields) {
  const single = gain.shape === "scalar";
  const rows = gain.default.map((defaultValue, n) => {
    const pointer = single ? gain.pointer : `${gain.pointer}/${n}`;
    const [caption, name] = names(gain, n, robot);
    const field = element("number-field", { "data-pointer": pointer });
    const scale = defaultValue > 0 ? logarithmic(defaultValue, gain.min, gain.max) : linear(gain.min, gain.max);
    field.configure({ caption, label: `${name}`, unit: gain.unit, scale, defaultValue });
    field.addEventListener("edit", ({ detail }) => {
      const failure = laboratory.edit([scheme.id], pointer, detail.value);
      if (failure) {
        field.error = failure.message;
      } else {
        field.accept(detail.value);
      }
    });
    fields.push({ field, pointer });
    return field;
  });
  const info = infoButton("gain", `${scheme.id}/${gain.name}`);
  if (gain.shape === "parameter") {
    const help = element("p", { class: "help" }, gain.meaning, info);
    return foldedGroup(gain.symbol, strings.eighteen(rows.length), [help, ...rows]);
  }
  const head = single
    ? element("p", { class: "gain-meaning" }, gain.meaning, info)
    : element("p", { class: "gain-meaning" }, element("strong", {}, symbol(gain.symbol)), " ", gain.meaning, info);
  return element("div", { class: `gain ${gain.shape}`, role: "group", "aria-label": `${gain.symbol}: ${gain.meaning}` }, head, rows);
}

/** Short caption and full name of one number of a gain. */
function names(gain, n, robot) {
  if (gain.shape === "scalar") {
    return [gain.symbol, gain.symbol];
  }
  if (gain.shape === "joint") {
    return [strings.jointShort(n + 1), `${gain.symbol}, ${strings.joint(n + 1, robot.joints[n])}`];
  }
  const { symbol: theta, meaning } = robot.parameters[n];
  return [theta, `${gain.symbol}, ${theta}: ${meaning}`];
}

function foldedGroup(title, note, children) {
  const summary = element("summary", {}, element("strong", {}, symbol(title)), " ", element("span", { class: "note" }, note));
  return element("details", { class: "gain folded" }, summary, children);
}
