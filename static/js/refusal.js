// What the core refuses, as a sentence in the reader's language that names the field as the page does, not by its path.

import { formatExact } from "./format.js";
import { strings } from "./strings/index.js";

const texts = strings.errors;
/** Pointer without its index, to the names that the schemes give it. */
const names = new Map();
let parameters = [];

/** Learns what fields are called from the core's description. */
export function learnNames({ schemes, robots }) {
  const setup = {
    "/integration/duration_s": strings.duration,
    "/integration/step_s": strings.step,
    "/plant/friction/width_rad_s": strings.friction,
  };
  for (const [pointer, name] of Object.entries(setup)) {
    names.set(pointer, { called: new Set([name]) });
  }
  for (const { gains } of schemes) {
    for (const { pointer, symbol, shape } of gains) {
      const known = names.get(pointer) ?? { called: new Set(), shape };
      known.called.add(symbol);
      names.set(pointer, known);
    }
  }
  parameters = robots[0].parameters.map(({ symbol }) => symbol);
}

/** The sentence for a failure `{pointer, message, problem}`, by the field's own name or the one given; the core's own message where
 * there is nothing better. */
export function refusal({ pointer, message, problem }, name = nameOf(pointer)) {
  switch (problem?.problem) {
    case "out_of_range": {
      const [value, min, max] = [problem.value, problem.min, problem.max].map(formatExact);
      return texts.outOfRange(name, value, min, max, problem.unit);
    }
    case "wrong_length":
      return texts.wrongLength(name, problem.found, problem.expected);
    case "too_many":
      return texts.tooMany(name, problem.found, problem.most);
    case "unknown":
      return texts.unknown(name, problem.value, problem.allowed);
    default: {
      // The document's reader says this in words only.
      const typed = /: invalid type: string ("(?:[^"\\]|\\.)*"), expected a number$/u.exec(message);
      return typed ? texts.notANumber(name, JSON.parse(typed[1])) : message;
    }
  }
}

function nameOf(pointer) {
  const [, field, index] = /^(.*?)(?:\/(\d+))?$/u.exec(pointer);
  const known = names.get(field);
  const called = known ? [...known.called].join(" / ") : lastPart(field);
  if (index === undefined) {
    return called;
  }
  const n = Number(index);
  if (known?.shape === "joint") {
    return texts.ofJoint(called, n + 1);
  }
  return known?.shape === "parameter" ? texts.ofParameter(called, parameters[n]) : texts.element(called, n + 1);
}

function lastPart(field) {
  return field.split("/").pop() || texts.someValue;
}
