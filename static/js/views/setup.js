// The setup that all schemes share: study, duration, step, friction, start. Edits go to every scheme's document.

import "../elements/number-field.js";
import { choose, element } from "../dom.js";
import { valueAt } from "../pointer.js";
import { linear, logarithmic } from "../scale.js";
import { strings } from "../strings/index.js";

const CUSTOM = "custom";

/** The numbers, in order: where they stand in a document, and their sliders. */
const numbers = (limits) => [
  { pointer: "/integration/duration_s", caption: strings.duration, unit: "s", scale: linear(1, 60, 118) },
  { pointer: "/integration/step_s", caption: strings.step, unit: "s", scale: logarithmic(0.001, ...limits.step_s) },
  {
    pointer: "/plant/friction/width_rad_s",
    caption: strings.friction,
    help: strings.frictionHelp,
    unit: "rad/s",
    scale: logarithmic(0.01, ...limits.friction_width_rad_s),
  },
];

/** Builds the setup into `container`; returns a function that shows the state again. */
export function buildSetup(container, { description, state, laboratory, resetAll }) {
  const schemes = description.schemes.map(({ id }) => id);
  const [paper] = description.studies;
  const valueOf = (pointer) => state.valueAt(schemes[0], pointer);

  const study = element(
    "select",
    { id: "study", "aria-describedby": "study-help" },
    description.studies.map(({ id }) => element("option", { value: id }, strings.studies[id])),
    element("option", { value: CUSTOM, disabled: true }, strings.studyCustom),
  );
  const help = element("p", { class: "help", id: "study-help" });
  study.addEventListener("change", () => {
    laboratory.replace(structuredClone(description.studies.find(({ id }) => id === study.value).documents));
  });

  const fields = numbers(description.limits).map(({ pointer, caption, help: title, unit, scale }) => {
    const field = element("number-field", { "data-pointer": pointer, title });
    const defaultValue = valueAt(paper.documents[schemes[0]], pointer);
    field.configure({ caption, label: title ? `${caption}: ${title}` : caption, unit, scale, defaultValue });
    field.addEventListener("edit", ({ detail }) => {
      const failure = laboratory.edit(schemes, pointer, detail.value);
      if (failure) {
        field.error = failure.message;
      } else {
        field.accept(detail.value);
      }
    });
    return { field, pointer };
  });

  const starts = [
    ["desired", strings.startDesired],
    ["rest", strings.startRest],
  ].map(([value, text]) => {
    const radio = element("input", {
      type: "radio",
      name: "start",
      value,
      onchange: () => laboratory.edit(schemes, "/initial/velocity", value),
    });
    return { radio, value, label: element("label", { class: "choice" }, radio, element("span", {}, text)) };
  });

  container.append(
    // A form of its own: what Chromium goes over when the choice changes, which happens while a finger moves, is this form.
    element("form", { class: "study-row" }, element("label", { for: "study" }, strings.study), study),
    help,
    ...fields.map(({ field }) => field),
    element("fieldset", { class: "choices" }, element("legend", {}, strings.start), starts.map(({ label }) => label)),
    element("button", { type: "button", class: "quiet wide", id: "reset-all", onclick: resetAll }, strings.resetAll),
  );

  /** Refused texts stay unless `anew`. */
  return function show(anew = false) {
    const chosen = studyOf(description.studies, state);
    choose(study, chosen);
    // The same text anew would lay the controls out again.
    if (help.textContent !== strings.studyHelp[chosen]) {
      help.textContent = strings.studyHelp[chosen];
    }
    for (const { field, pointer } of fields) {
      field[anew ? "accept" : "show"](valueOf(pointer));
    }
    for (const { radio, value } of starts) {
      radio.checked = valueOf("/initial/velocity") === value;
    }
  };
}

/** The study whose scenarios the state holds, by their hashes. */
function studyOf(studies, state) {
  const same = ({ hashes }) => Object.entries(hashes).every(([scheme, hash]) => state.hashes[scheme] === hash);
  return studies.find(same)?.id ?? CUSTOM;
}
