// What gains are worth on the visible variants, by the core that grades on the server: the same functions, other variants.

import { formatLocal } from "../jobs/numbers.js";

/** Endings of metrics and what they are measured in. */
const UNITS = [
  [/_deg_s(_\d+)?$/u, "°/s"],
  [/_deg(_\d+)?$/u, "°"],
  [/_nm(_\d+)?$/u, "N·m"],
  [/_v(_\d+)?$/u, "V"],
  [/_s(_\d+)?$/u, "s"],
  [/_percent(_\d+)?$/u, "%"],
];

export class Preview {
  #exercise;

  /** `bindings` have `Exercise`; `document` and `seed` are the student's. Throws what the core says against them. */
  constructor(bindings, document, seed) {
    this.#exercise = new bindings.Exercise(JSON.stringify(document), seed);
  }

  /** The scenarios of the visible variants with these gains; throws what the core says against the gains. */
  documents(gains) {
    return JSON.parse(this.#exercise.runs(JSON.stringify(gains)));
  }

  /** The grade of the variants' reports. */
  grade(gains, reports) {
    return JSON.parse(this.#exercise.grade(JSON.stringify(gains), JSON.stringify(reports)));
  }
}

/** A metric's value with its unit. */
export function quantity(metric, value) {
  const unit = UNITS.find(([ending]) => ending.test(metric))?.[1] ?? "";
  const number = formatLocal(value, 3);
  return unit === "°" || unit === "°/s" ? `${number}${unit}` : `${number}\u00a0${unit}`.trimEnd();
}
