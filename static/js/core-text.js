// What the core says in English, in the reader's language: its description is translated once, when it is read, so that
// whoever shows a part of it need not know.

import { strings } from "./strings/index.js";

const texts = strings.core;

/** The core's text of a kind (a group of strings/en/core.js) and identifier in the reader's language, else as the core says it. */
export function coreText(kind, id, fallback) {
  return texts[kind]?.[id] ?? fallback;
}

/** The core's description with its texts in the reader's language. */
export function translated(description) {
  const { schemes, robots, presets, ...rest } = description;
  return {
    ...rest,
    schemes: schemes?.map((scheme) => ({
      ...scheme,
      name: coreText("schemes", scheme.id, scheme.name),
      gains: scheme.gains.map((gain) => ({ ...gain, meaning: gainMeaning(scheme, gain) })),
    })),
    robots: robots?.map((robot) => ({
      ...robot,
      name: coreText("robots", robot.id, robot.name),
      joints: robot.joints.map((name) => coreText("joints", name, name)),
      parameters: robot.parameters.map((one) => ({ ...one, meaning: parameterMeaning(robot, one) })),
    })),
    presets: presets?.map((preset) => ({
      ...preset,
      title: coreText("presets", preset.id, preset.title),
      description: coreText("presetDescriptions", preset.id, preset.description),
    })),
  };
}

/** Every robot has a θ1: plain symbols are the A465's. */
function parameterMeaning(robot, { symbol, meaning }) {
  return coreText("parameters", robot.id === "crs_a465" ? symbol : `${robot.id}.${symbol}`, meaning);
}

/** The same name may mean something else in another scheme; mostly it does not. */
function gainMeaning(scheme, { name, meaning }) {
  return coreText("gains", `${scheme.id}.${name}`, coreText("gains", name, meaning));
}
