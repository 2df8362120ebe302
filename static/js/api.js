// The server's HTTP API as the pages use it: requests, the token that some servers want, and errors that say what is wrong.
//
// The token lives in this tab's session storage only. Knows nothing of elements or of texts.

const KEY = "adaptarm.token";
/** Addresses are relative, so that the pages also work below a path of a larger site. */
const ROOT = new URL("api/v1/", document.baseURI);
const PATIENCE_MS = 30_000;

/** An answer that is an error, or none: `status` is 0 where no answer came. */
export class ApiError extends Error {
  /** `problem` is the answer's RFC 9457 document, as far as there is one; `retryAfter` is in seconds. */
  constructor(status, problem = {}, retryAfter = null) {
    super(problem.detail ?? problem.title ?? "");
    this.status = status;
    this.problem = problem;
    this.retryAfter = retryAfter;
  }

  /** Stable name of the kind of error, without its path: "quota", "token". */
  get kind() {
    return (this.problem.type ?? "").split("/").pop();
  }

  /** Whether the same request may succeed later. */
  get isPassing() {
    return this.status === 0 || this.status === 408 || this.status === 429 || this.status >= 500;
  }
}

/** The token of this tab, or null. */
export function token() {
  try {
    return sessionStorage.getItem(KEY);
  } catch {
    return kept;
  }
}

// Where storage is forbidden, the token lasts as long as the page.
let kept = null;

/** Sets the token of this tab; null forgets it. */
export function setToken(value) {
  kept = value;
  try {
    if (value === null) {
      sessionStorage.removeItem(KEY);
    } else {
      sessionStorage.setItem(KEY, value);
    }
  } catch {
    // Forbidden.
  }
}

/** The address of something below the API's root. */
export function address(path) {
  return new URL(path, ROOT).href;
}

/** A request's response; throws `ApiError` unless it is a good one. Without `signal` it may not take long. */
export async function send(path, { method = "GET", headers = {}, body, signal = AbortSignal.timeout(PATIENCE_MS) } = {}) {
  const credentials = token() ? { Authorization: `Bearer ${token()}` } : {};
  let response;
  try {
    response = await fetch(address(path), { method, headers: { ...credentials, ...headers }, body, signal, cache: "no-store" });
  } catch (error) {
    if (error.name === "AbortError") {
      throw error;
    }
    throw new ApiError(0);
  }
  if (!response.ok) {
    throw new ApiError(response.status, await problemOf(response), secondsOf(response.headers.get("Retry-After")));
  }
  return response;
}

/** A request's answer as JSON. */
export async function ask(path, options) {
  const response = await send(path, options);
  try {
    return await response.json();
  } catch {
    // A connection that broke off, or something that is not the API.
    throw new ApiError(0);
  }
}

async function problemOf(response) {
  try {
    const problem = await response.json();
    return problem !== null && typeof problem === "object" ? problem : {};
  } catch {
    return { title: response.statusText };
  }
}

function secondsOf(header) {
  const seconds = Number.parseInt(header ?? "", 10);
  return Number.isFinite(seconds) ? seconds : null;
}

/** A name for one request, so that sending it again makes no second job. */
export function newKey() {
  // Not randomUUID, which exists only on secure connections.
  return [...crypto.getRandomValues(new Uint8Array(16))].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** Submits a job; `body` is JSON text. */
export const submitJob = (body, key) =>
  ask("jobs", { method: "POST", headers: { "Content-Type": "application/json", "Idempotency-Key": key }, body });

export const readJob = (id, options) => ask(`jobs/${id}`, options);
export const cancelJob = (id) => ask(`jobs/${id}/cancel`, { method: "POST" });
export const deleteJob = (id) => send(`jobs/${id}`, { method: "DELETE" });
export const readResult = (id) => ask(`jobs/${id}/result`);
export const readScenario = (id, n) => ask(`jobs/${id}/scenarios/${n}`);
export const listJobs = (query, options) => ask(`jobs?${new URLSearchParams(query)}`, options);

/** Whether a job in this state changes no more. */
export const isFinal = (state) => state === "succeeded" || state === "failed" || state === "canceled";
