// Pieces that the classroom's pages are made of: cards, tables, badges, messages, something to copy, rendered text.

import { announce } from "../announce.js";
import { element, symbol } from "../dom.js";
import { formatExact } from "../format.js";
import { locale } from "../jobs/times.js";
import { localized, texts } from "../strings/classroom.js";
import { explain } from "./explain.js";

let named = 0;

/** A card with a heading of its own. */
export function card(title, ...children) {
  const id = `card-${(named += 1)}`;
  const heading = element("h2", { id }, title);
  return element("section", { class: "card", "aria-labelledby": id }, heading, ...children);
}

/** A table: heads are texts or nodes, rows lists of cells; the first cell of a row names it. */
export function table({ caption, heads, rows, className = "" }) {
  const head = element("tr", {}, heads.map((text) => element("th", { scope: "col" }, text)));
  const cell = (content, n) => element(n === 0 ? "th" : "td", n === 0 ? { scope: "row" } : { "data-column": heads[n] }, content);
  const body = rows.map(({ cells, ...attributes }) => element("tr", attributes, cells.map(cell)));
  return element(
    "table",
    { class: `stacked ${className}`.trim() },
    element("caption", {}, caption),
    element("thead", {}, head),
    element("tbody", {}, body),
  );
}

/** People in the order of their names, as the reader's language has it. */
export const byName = (people) => people.toSorted((one, other) => one.name.localeCompare(other.name, locale(), { numeric: true }));

/** What was handed in, in one line: each gain as the exercise calls it, with its unit. */
export function gainsLine(moves, gains) {
  const said = moves.map(({ name, label, unit = "" }) => [...symbol(localized(label)), `:\u00a0${formatExact(gains[name])}${unit && `\u00a0${unit}`}`]);
  return element("p", { class: "help gains-line" }, said.flatMap((one, n) => (n === 0 ? one : [" · ", ...one])));
}

/** Facts by name; those without a value are left out. */
export function facts(pairs) {
  const shown = pairs.filter(([, value]) => value !== null && value !== undefined && value !== "");
  return element(
    "dl",
    { class: "class-facts" },
    shown.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))),
  );
}

/** A word for how something stands. */
export const badge = (state, text) => element("span", { class: "class-badge", "data-state": state }, text);

/** Points as they are, with at most two decimals: what the server says is what is shown. */
export function points(value) {
  return value === null || value === undefined ? "—" : new Intl.NumberFormat(locale(), { maximumFractionDigits: 2 }).format(value);
}

/** Points out of how many. */
export const pointsOf = (value, of) => texts.pointsOf(points(value), points(of));

/** A share as a bar with words; nothing depends on its colour. */
export function meter(share, label) {
  const bar = element("progress", { class: "share", max: 1, value: share, "aria-label": label });
  bar.dataset.full = String(share >= 1);
  return bar;
}

/** Shows an error in `place` until the next attempt; `retry`, where there is one, is called at a click. */
export function showError(place, error, retry = null) {
  const again = () => {
    place.replaceChildren();
    retry();
  };
  place.replaceChildren(
    element(
      "div",
      { class: "message error", "data-kind": error.kind ?? "" },
      element("p", { role: "alert" }, explain(error)),
      retry ? element("div", { class: "message-actions" }, element("button", { type: "button", class: "retry", onclick: again }, texts.retry)) : null,
    ),
  );
}

/** Text with a button that copies it; where the clipboard is not allowed, it is selected to be copied by hand. */
export function copyable(text, label, className = "") {
  const shown = element("code", { class: `copy-text ${className}`.trim() }, text);
  const button = element("button", { type: "button", "aria-label": texts.copyNamed(label), onclick: () => copy() }, texts.copy);
  async function copy() {
    try {
      await navigator.clipboard.writeText(text);
      button.textContent = texts.copied;
      announce(texts.copied);
    } catch {
      getSelection().selectAllChildren(shown);
      announce(texts.copyByHand);
    }
  }
  return element("div", { class: "copyable" }, shown, button);
}

/** A personal link, which is shown this once: what it is for, the link, and a button that says it is kept. */
export function secretLink({ link, login, role, has_password }, kept) {
  const own = texts.secret[role];
  const box = card(
    texts.secret.title,
    element("p", {}, texts.secret.what),
    copyable(link, texts.secret.title, "secret"),
    element("p", { class: "warning" }, element("strong", {}, own.warning)),
    login ? element("p", { class: "help" }, has_password ? texts.secret.loginAndPassword(login) : texts.secret.login(login)) : null,
    element("button", { type: "button", class: "primary", id: "link-kept", onclick: () => kept() }, texts.secret.kept),
  );
  box.classList.add("secret-card");
  return box;
}

/** Text that the server has made of an exercise's Markdown; it lets nothing through but text, its structure and formulas. */
export function rendered(html, className = "prose") {
  const template = element("template");
  template.innerHTML = html;
  return element("div", { class: className }, template.content);
}
