// The glossary: every symbol with its meaning and unit, in a dialog that a button of the toolbar opens.

import { element } from "../dom.js";
import { strings } from "../strings/index.js";
import { math } from "./mathml.js";

/** By group: the text's key, the symbol in the notation of mathml.js, the unit. */
export const ENTRIES = {
  robot: [
    ["q", "q", "rad"],
    ["q_d", "q_d", "rad"],
    ["H", "H ( q )", "kg·m²"],
    ["C", "C ( q , dot(q) )", "N·m·s"],
    ["D", "D", "N·m·s"],
    ["f_c", "f_c", "N·m"],
    ["g_q", "g ( q )", "N·m"],
    ["tau", "τ", "N·m"],
    ["v", "v", "V"],
    ["Y", "Y", ""],
    ["theta", "θ", ""],
  ],
  signals: [
    ["e", "e", "rad"],
    ["e_dot", "dot(e)", "rad/s"],
    ["s", "s", "rad/s"],
    ["theta_hat", "hat(θ)", ""],
    ["theta_tilde", "tilde(θ)", ""],
    ["q_r_dot", "dot(q)_r", "rad/s"],
  ],
  laws: [
    ["K_v", "K_v", "N·m·s"],
    ["K_s", "K_s", "N·m·s"],
    ["Lambda", "Λ", "1/s"],
    ["Gamma", "Γ", ""],
    ["beta", "β", ""],
    ["delta_ta", "δ", ""],
    ["gamma", "γ", ""],
    ["forgetting", "λ", "1/s"],
    ["w", "w", ""],
    ["Z", "Z", ""],
    ["epsilon", "ε", "N·m"],
    ["W", "W ( s )", ""],
    ["rho", "ρ", ""],
    ["delta", "δ_i", ""],
    ["f_b", "f_b", ""],
  ],
  observer: [
    ["q_hat", "hat(q)", "rad"],
    ["z", "z", "rad"],
    ["xi", "ξ", "rad·s"],
    ["zeta", "ζ", "rad/s"],
    ["q_o_dot", "dot(q)_o", "rad/s"],
    ["Lambda_z", "Λ_z", "1/s"],
    ["Lambda_x", "Λ_x", "1/s"],
    ["K_d", "K_d", "1/s"],
  ],
};

/** Puts the button into `place`; the dialog is made when it is first opened. */
export function buildGlossary(place) {
  let dialog = null;
  const open = () => {
    dialog ??= build();
    dialog.showModal();
  };
  place.append(
    element("button", { type: "button", id: "glossary-open", "aria-haspopup": "dialog", onclick: open }, strings.explain.glossary.open),
  );
}

function build() {
  const words = strings.explain.glossary;
  const close = element("button", { type: "button", class: "info-close", "aria-label": strings.explain.close }, "×");
  const dialog = element(
    "dialog",
    { id: "glossary", "aria-labelledby": "glossary-title" },
    element("div", { class: "glossary-head" }, element("h2", { id: "glossary-title" }, words.title), close),
    element("div", { class: "glossary-body", tabindex: "0", role: "region", "aria-labelledby": "glossary-title" }, table(words)),
  );
  close.addEventListener("click", () => dialog.close());
  // A press beside the dialog hits the dialog itself, which its content fills.
  dialog.addEventListener("click", ({ target }) => target === dialog && dialog.close());
  document.body.append(dialog);
  return dialog;
}

function table(words) {
  const heads = [words.symbol, words.meaning, words.unit].map((text) => element("th", { scope: "col" }, text));
  const groups = Object.entries(ENTRIES).map(([group, entries]) =>
    element(
      "tbody",
      {},
      element("tr", {}, element("th", { scope: "rowgroup", colspan: 3 }, words.of[group])),
      entries.map(([key, notation, unit]) =>
        element(
          "tr",
          {},
          element("th", { scope: "row" }, math(notation)),
          element("td", {}, words.entries[key]),
          element("td", {}, unit),
        ),
      ),
    ),
  );
  return element("table", { class: "glossary-table" }, element("thead", {}, element("tr", {}, heads)), groups);
}
