// The manual's experiments, one click away from the form that submits them.

import { ask } from "../api.js";
import { announce } from "../announce.js";
import { element } from "../dom.js";
import { texts } from "./experiment-texts.js";
import { showError } from "./message.js";

/** Buttons that call `chosen` with an example's document. They are loaded when the form is first opened. */
export function buildExamples(chosen, failure) {
  const list = element("ul");
  const node = element("div", { class: "examples", hidden: true }, element("p", {}, texts.examples), list);
  const load = async () => {
    try {
      const examples = await ask("experiments");
      list.replaceChildren(...examples.map((example) => element("li", {}, button(example))));
      node.hidden = false;
    } catch (error) {
      showError(failure, error, { retry: load });
    }
  };
  const button = ({ id, title, experiment }) =>
    element(
      "button",
      {
        type: "button",
        "data-example": id,
        onclick: () => {
          chosen(experiment);
          announce(texts.exampleLoaded(title));
        },
      },
      title,
    );
  // Whoever only reads the list of jobs does not need them.
  queueMicrotask(() => node.closest("details")?.addEventListener("toggle", load, { once: true }));
  return node;
}
