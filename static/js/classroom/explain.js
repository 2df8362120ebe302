// What the classroom refused, as a sentence in the reader's language.

import { texts } from "../strings/classroom.js";
import { failureOf } from "../wasm.js";
import { moment } from "./times.js";

const { errors, fields } = texts;

/** What the server found wrong in a field, in the reader's language; `reason` is its name for what a deadline cannot be. */
export function explainField({ kind, problem }) {
  const { pointer, reason, min, max, unit } = problem;
  const [field] = pointer.split("/").slice(1);
  switch (kind) {
    case "out-of-range":
      return unit === "characters" ? fields.characters(min, max) : unit === "years" ? fields.moment : fields.between(min, max);
    case "conflict":
      return fields.deadlines[reason] ?? (field === "deadline" ? fields.deadlines.opens : fields.other);
    default:
      return fields.malformed[field] ?? fields.other;
  }
}

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
    case "out-of-range": {
      const { value, min, max, unit } = problem;
      return unit === "characters" ? errors.length(value, min, max) : errors.outOfRange(value, min, max);
    }
    default:
      return status === 404 ? errors.notFound : status === 422 ? errors.refused(error.message) : errors.other(status, error.message);
  }
}
