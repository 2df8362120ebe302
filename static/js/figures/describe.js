// What figures say to those who cannot see them: each run's figures in words, from its report.

import { formatNumber, formatSeconds } from "../format.js";
import { strings } from "../strings/index.js";

const texts = strings.figures;

/** Sentence, field of the report and unit. */
const SUMMARY = {
  tracking_errors: [texts.altIndices, "index_e_deg", "°"],
  velocity_errors: [texts.altIndices, "index_de_deg_s", "°/s"],
  phase_plane: [texts.altPeaks, "e_peak_deg", "°"],
  observer_errors: [texts.altPeaks, "z_peak_deg", "°"],
  torques: [texts.altPeaks, "tau_peak_nm", "N·m"],
  voltages: [texts.altPeaks, "voltage_peak_v", "V"],
};

/** Which of the estimates a figure shows: first and number. */
const ESTIMATES = { estimates: [0, 18], estimates_1: [0, 6], estimates_2: [6, 6], estimates_3: [12, 6] };

/** The text alternative of a figure; `reports` by scheme, of `schemes` in the order of drawing. */
export function describeFigure(id, schemes, reports, seconds) {
  const parts = schemes.filter((scheme) => reports[scheme.id]).map((scheme) => summarise(id, scheme, reports[scheme.id]));
  const known = parts.filter((part) => part !== null);
  const summary = known.length === 0 && id === "observer_errors" ? texts.noObserver : known.join(" ");
  return texts.alt(texts.titles[id], formatSeconds(seconds), summary);
}

function summarise(id, scheme, report) {
  const list = (numbers) => numbers.map((number) => formatNumber(number, 3)).join(", ");
  const ended = report.outcome === "diverged" ? ` ${strings.divergedShort(formatSeconds(report.at_s))}.` : "";
  if (id in SUMMARY) {
    const [sentence, field, unit] = SUMMARY[id];
    return report[field] ? sentence(scheme.name, unit, list(report[field])) + ended : null;
  }
  if (id in ESTIMATES) {
    const [first, count] = ESTIMATES[id];
    return texts.altEnd(scheme.name, list(report.theta_hat_end.slice(first, first + count))) + ended;
  }
  return texts.altShown(scheme.name) + ended;
}

/** The values under the cursor, for people who hear them. `reading` is what `read_figure` gives, `lines` name them. */
export function describeReading(reading, lines) {
  const names = new Map(lines.map(({ id, name }) => [id, name]));
  const panels = reading.panels.map(({ label, values }) => {
    const parts = values.map(({ id, value }) => `${names.get(id) ?? id} ${formatNumber(value, 3)}`);
    return `${label}: ${parts.join(", ")}`;
  });
  return texts.reading(formatSeconds(reading.time_s), panels.join(". "));
}
