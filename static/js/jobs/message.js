// What the server refused, in words, with a way on: try again, or give a token. Stays until it is dismissed.

import { element } from "../dom.js";
import { strings } from "../strings/index.js";
import { tokenForm } from "./token-form.js";

const texts = strings.server;

/** An error of the API in a sentence or two. */
export function explain(error) {
  const { status, kind, problem, retryAfter } = error;
  const detail = error.message;
  if (status === undefined) {
    return texts.unexpected(detail);
  }
  switch (status) {
    case 0:
      return navigator.onLine === false ? texts.offline : texts.unreachable;
    case 401:
      return texts.tokenWanted;
    case 403:
      return texts.forbidden(detail);
    case 404:
      return texts.notFound;
    case 410:
      return texts.notKept;
    case 413:
      return texts.tooLarge(problem.max_bytes ?? null);
    case 422:
      return texts.refused(detail);
    case 429:
      return kind === "quota" ? texts.quota(detail) : texts.tooOften(retryAfter);
    case 503:
      return texts.unavailable(detail);
    default:
      return texts.otherError(status, detail);
  }
}

/** Shows `error` in `place` until it is dismissed, instead of what is there. `retry`, where there is one, is called at a click. */
export function showError(place, error, { retry = null, dismissed = () => {} } = {}) {
  const clear = () => {
    place.replaceChildren();
    dismissed();
  };
  const again = () => {
    place.replaceChildren();
    retry();
  };
  const wantsToken = error.status === 401;
  place.replaceChildren(
    element(
      "div",
      { class: "message error", "data-status": error.status ?? "" },
      element("p", { role: "alert" }, explain(error)),
      wantsToken ? tokenForm(retry ? again : clear, error) : null,
      element(
        "div",
        { class: "message-actions" },
        retry && !wantsToken ? element("button", { type: "button", class: "retry", onclick: again }, texts.retry) : null,
        element("button", { type: "button", class: "quiet", onclick: clear }, strings.dismiss),
      ),
    ),
  );
}
