// Times for people: how long ago, how long it took, and the exact moment in the reader's way of writing it.

import { element } from "../dom.js";

const UNITS = [
  ["second", 60],
  ["minute", 60],
  ["hour", 24],
  ["day", 30],
  ["month", 12],
  ["year", Infinity],
];
const REFRESH_MS = 15_000;

/** The reader's own variant of the page's language. */
export function locale() {
  const language = document.documentElement.lang || "en";
  return navigator.languages?.find((own) => own.split("-")[0] === language.split("-")[0]) ?? language;
}

/** "3 minutes ago" for a moment in milliseconds. */
export function ago(moment, now = Date.now()) {
  // Clocks differ a little: what has happened has not happened in the future.
  let amount = Math.max(0, (now - moment) / 1000);
  let unit = 0;
  while (amount >= UNITS[unit][1]) {
    amount /= UNITS[unit][1];
    unit += 1;
  }
  const whole = Math.floor(amount);
  // Seconds that tick are of no use to anybody.
  const rounded = unit === 0 ? whole - (whole % 15) : whole;
  return new Intl.RelativeTimeFormat(locale(), { numeric: "auto" }).format(-rounded, UNITS[unit][0]);
}

/** A duration in milliseconds, such as "1 min 5 sec". */
export function formatDuration(milliseconds) {
  const format = (value, unit, digits = 0) =>
    new Intl.NumberFormat(locale(), { style: "unit", unit, unitDisplay: "short", maximumFractionDigits: digits }).format(value);
  const seconds = milliseconds / 1000;
  if (seconds < 1) {
    return format(Math.max(1, Math.round(milliseconds)), "millisecond");
  }
  if (seconds < 60) {
    return format(seconds, "second", seconds < 10 ? 1 : 0);
  }
  const parts = [
    [Math.floor(seconds / 3600), "hour"],
    [Math.floor((seconds % 3600) / 60), "minute"],
    [Math.floor(seconds % 60), "second"],
  ];
  const first = parts.findIndex(([value]) => value > 0);
  return parts
    .slice(first, first + 2)
    .map(([value, unit]) => format(value, unit))
    .join(" ");
}

/** A share from 0 to 1 as a percentage; 100 % only when it is. */
export function formatShare(share) {
  return new Intl.NumberFormat(locale(), { style: "percent" }).format(Math.floor(100 * share) / 100);
}

/** A `<time>` that says how long ago something was, and exactly when where one points at it. Stays true. */
export function timeElement(timestamp) {
  const moment = Date.parse(timestamp);
  return element("time", { datetime: timestamp, title: exactly(moment), "data-moment": moment }, ago(moment));
}

/** Exactly when something was, and how long ago that is. */
export const exactTime = (timestamp) => [exactly(Date.parse(timestamp)), " (", timeElement(timestamp), ")"];

function exactly(moment) {
  return new Intl.DateTimeFormat(locale(), { dateStyle: "medium", timeStyle: "medium" }).format(moment);
}

setInterval(() => {
  if (!document.hidden) {
    for (const node of document.querySelectorAll("time[data-moment]")) {
      const text = ago(Number(node.dataset.moment));
      if (node.textContent !== text) {
        node.textContent = text;
      }
    }
  }
}, REFRESH_MS);
