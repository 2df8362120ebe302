// Texts: what gains, signals and equations mean.

import { gains } from "./explain/gains.js";
import { glossary } from "./explain/glossary.js";
import { signals } from "./explain/signals.js";
import { why } from "./explain/why.js";

export const explain = {
  about: (name) => `About ${name}`,
  close: "Close",
  source: (number) => `Paper, eq. ${number}.`,
  mended: "The printed equation has a misprint; this is the form that is computed.",
  noSource: "Not in the paper.",
  unit: (unit) => `Unit: ${unit}.`,
  noUnit: "No unit of its own.",
  tooSmall: (factor) => `Small (× ${factor})`,
  tooLarge: (factor) => `Large (× ${factor})`,
  range: (unit, paper, low, high) => `The paper's value: ${paper}${unit}. Allowed: ${low} to ${high}${unit}.`,
  perParameter: (low, high) => `${low} to ${high}, one per parameter`,
  tried: (low, high) => `Runs reach their end from ${low} to ${high} times the paper's value.`,
  tryIt: "Try it",
  trySmall: (factor) => `× ${factor}`,
  tryLarge: (factor) => `× ${factor}`,
  tryBack: "Back",
  trySmallLabel: (name, factor) => `Set ${name} to ${factor} times the paper's value`,
  tryBackLabel: (name) => `Set ${name} back to what it was`,
  indices: (joints) => `I(e) = ${joints}°`,
  now: (text) => `Now: ${text}`,
  before: (text) => `Before: ${text}`,
  computing: "computing…",
  diverged: (time) => `the run diverges at ${time}`,
  basis: "Found by running it with everything else as in the paper (12 s, steps of 1 ms).",
  numbers: "Its numbers now",
  schemeNames: { proposed: "proposed scheme", tang_arteaga: "Tang and Arteaga", slotine_li: "Slotine and Li" },
  choices: { velocity: "Velocity it uses", feedback: "Feedback law", adaptation: "Adaptation law" },
  gains,
  signals,
  glossary,
  why,
};
