// Moments of the classroom for people: when something is due, and how long that is from now.

import { element } from "../dom.js";
import { locale } from "../jobs/times.js";

const UNITS = [
  ["minute", 60],
  ["hour", 3600],
  ["day", 86_400],
];

/** A moment written out. */
export function moment(timestamp) {
  return new Intl.DateTimeFormat(locale(), { dateStyle: "medium", timeStyle: "short" }).format(Date.parse(timestamp));
}

/** How far away a moment is: "in 3 days", "2 hours ago". */
export function distance(timestamp, now = Date.now()) {
  const seconds = (Date.parse(timestamp) - now) / 1000;
  const [unit, length] = UNITS.findLast(([, size]) => Math.abs(seconds) >= size) ?? UNITS[0];
  return new Intl.RelativeTimeFormat(locale(), { numeric: "auto" }).format(Math.trunc(seconds / length), unit);
}

/** A moment with its distance, as an element. */
export function momentElement(timestamp) {
  return element("time", { datetime: timestamp }, `${moment(timestamp)} (${distance(timestamp)})`);
}

/** A moment as a `datetime-local` input holds it, in the reader's own time; empty for none. */
export function toLocal(timestamp) {
  if (!timestamp) {
    return "";
  }
  const date = new Date(timestamp);
  const two = (number) => String(number).padStart(2, "0");
  const day = [date.getFullYear(), two(date.getMonth() + 1), two(date.getDate())].join("-");
  return `${day}T${two(date.getHours())}:${two(date.getMinutes())}`;
}

/** What a `datetime-local` input holds, as a timestamp; null for nothing. */
export function fromLocal(value) {
  return value === "" ? null : new Date(value).toISOString();
}
