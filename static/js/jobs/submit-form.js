// Submitting a study by hand: JSON pasted or from a file; what the server finds wrong is said with its place.

import { newKey, submitJob } from "../api.js";
import { buildExamples } from "./examples.js";
import { element } from "../dom.js";
import { notice } from "../notice.js";
import { strings } from "../strings/index.js";
import { showError } from "./message.js";
import { nameOf } from "./row.js";

const texts = strings.server;

/** A folded form; calls `submitted` with the job. */
export function buildSubmitForm(submitted) {
  const text = element("textarea", { id: "submit-text", rows: 8, spellcheck: "false", "aria-describedby": "submit-help submit-error" });
  const label = element("input", { type: "text", id: "submit-label", maxlength: 200, autocomplete: "off" });
  const file = element("input", { type: "file", id: "submit-file", accept: ".json,application/json" });
  const wrong = element("div", { id: "submit-error", class: "field-error", role: "alert" });
  const failure = element("div", { class: "failure" });
  const button = element("button", { type: "submit", class: "primary" }, texts.submitButton);
  // The same text sent twice, after a lost answer say, is one request.
  let sent = { body: null, key: null };

  const examples = buildExamples((example) => {
    text.value = JSON.stringify(example, null, 2);
    label.value = "";
    refuse(null);
    text.focus();
  }, failure);

  file.addEventListener("change", async () => {
    const [chosen] = file.files;
    if (chosen) {
      text.value = await chosen.text();
      label.value ||= chosen.name.replace(/\.json$/u, "");
      refuse(null);
    }
  });
  text.addEventListener("input", () => refuse(null));

  function refuse(message) {
    wrong.textContent = message ?? "";
    if (message === null) {
      text.removeAttribute("aria-invalid");
    } else {
      text.setAttribute("aria-invalid", "true");
      text.focus();
    }
  }

  async function send(event) {
    event?.preventDefault();
    failure.replaceChildren();
    const body = readBody(text.value, label.value.trim(), refuse);
    if (body === null) {
      return;
    }
    if (body !== sent.body) {
      sent = { body, key: newKey() };
    }
    button.disabled = true;
    try {
      const job = await submitJob(body, sent.key);
      sent = { body: null, key: null };
      text.value = "";
      label.value = "";
      file.value = "";
      notice(texts.submitDone(nameOf(job)), "info");
      submitted(job);
    } catch (error) {
      if (error.problem?.pointer !== undefined) {
        refuse(atPlace(error.problem.pointer || "/", error.message));
      } else {
        showError(failure, error, { retry: () => send() });
      }
    } finally {
      button.disabled = false;
    }
  }

  return element(
    "details",
    { class: "card submit-study" },
    element("summary", {}, texts.submitTitle),
    element(
      "form",
      { onsubmit: send },
      element("p", { class: "help", id: "submit-help" }, texts.submitHelp),
      element("label", { for: label.id }, texts.submitLabel),
      label,
      element("label", { for: text.id }, texts.submitText),
      examples,
      text,
      wrong,
      element("label", { for: file.id }, texts.submitFile),
      file,
      button,
      failure,
    ),
  );
}

/** What is wrong, with its place once: the server's sentence may begin with the end of it. */
function atPlace(pointer, message) {
  const [, place, rest] = /^(\S+): (.+)$/su.exec(message) ?? [];
  const path = place?.replace(/\[(\d+)\]/gu, ".$1").split(".").join("/");
  const isSaid = path !== undefined && `/${pointer}`.endsWith(`/${path}`);
  return `${texts.submitAt(pointer)} ${isSaid ? rest : message}`;
}

/** The request's body for what was typed: a request, an experiment, a study or one scenario. Null, and why, where it is no JSON. */
function readBody(text, label, refuse) {
  if (text.trim() === "") {
    refuse(texts.submitEmpty);
    return null;
  }
  let document;
  try {
    document = JSON.parse(text);
  } catch (error) {
    refuse(texts.submitNotJson(error.message));
    return null;
  }
  let request = document;
  if (String(document?.format).startsWith("adaptarm.experiment/")) {
    request = { kind: document.kind, spec: document, ...(document.title ? { label: document.title } : {}) };
  } else if (Array.isArray(document?.scenarios)) {
    request = { kind: "study", spec: document };
  } else if (document?.scheme) {
    request = { kind: "study", spec: { scenarios: [document] } };
  }
  return JSON.stringify(label ? { ...request, label } : request);
}
