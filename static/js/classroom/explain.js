// What the classroom refused, as a sentence in the reader's language.

import { texts } from "../strings/classroom.js";
import { failureOf } from "../wasm.js";
import { moment } from "./times.js";

const errors = texts.errors;

/** An error of a request, or of the page itself, in a sentence or two. */
export function explain(error) {
  const { status, kind, problem, retryAfter } = error;
  if (status === undefined) {
    return errors.unexpected(failureOf(error).message);
  }
  if (status === 0) {
    return navigator.onLine === false ? errors.offline : errors.unreachable;
  }
  switch (kind) {
    case "session":
      return errors.session;
    case "sign-in":
      return errors.signIn;
    case "role":
      return errors.role;
    case "course-account":
      return errors.courseAccount;
    case "lti-platform":
      return errors.platform(error.message);
    case "csrf":
      return errors.csrf;
    case "taken":
      return errors.taken;
    case "closed":
      return problem.closes_at ? errors.closedSince(moment(problem.closes_at)) : errors.closed;
    case "attempts":
      return errors.attempts(problem.allowed);
    case "full":
      return errors.full(problem.most);
    case "rate-limit":
      return errors.tooOften(retryAfter);
    default:
      return status === 404 ? errors.notFound : status === 422 ? unacceptable(error.message) : errors.other(status, error.message);
  }
}

/** What is out of its range, in the reader's words; the server's own for the rest. */
function unacceptable(message) {
  const [, value, min, max, unit] = /: (\S+) is outside the allowed range (\S+) to (\S+)(?: (\S+))?$/u.exec(message) ?? [];
  if (value === undefined) {
    return errors.refused(message);
  }
  return unit === "characters" ? errors.length(value, min, max) : errors.outOfRange(value, min, max);
}
