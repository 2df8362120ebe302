// Asks for the token that servers reached from elsewhere want, and forgets it again.

import { setToken, token } from "../api.js";
import { element } from "../dom.js";
import { strings } from "../strings/index.js";

const texts = strings.server;
let count = 0;

/** A form for the token; calls `use` once it is set. A token that was sent and not taken is said to be wrong. */
export function tokenForm(use, error) {
  const id = `token-${(count += 1)}`;
  const input = element("input", {
    type: "password",
    id,
    name: "token",
    autocomplete: "off",
    spellcheck: "false",
    required: true,
    "aria-describedby": `${id}-help`,
  });
  const submit = (event) => {
    event.preventDefault();
    setToken(input.value.trim());
    use();
  };
  return element(
    "form",
    { class: "token-form", onsubmit: submit },
    element("label", { for: id }, texts.token),
    element("span", { class: "token-row" }, input, element("button", { type: "submit", class: "primary" }, texts.tokenUse)),
    token() === null ? null : element("p", { class: "field-error" }, texts.tokenWrong(error.message)),
    element("p", { class: "help", id: `${id}-help` }, texts.tokenHelp),
  );
}

/** A button that forgets the token; `show` shows it only while there is one. */
export function forgetButton(forgotten = () => {}) {
  const forget = () => {
    setToken(null);
    show();
    forgotten();
  };
  const button = element("button", { type: "button", class: "quiet forget-token", onclick: forget }, texts.tokenForget);
  const show = () => {
    button.hidden = token() === null;
  };
  show();
  return { button, show };
}
