// Secrets in the address: taken out of the address bar at once, so that no history, screen or bookmark keeps them.

import { loadSession, saveSession } from "../storage.js";

/** An invitation stays in this tab until it is used: a reload before that must not lose it. */
const KEPT = "invitation";
const SECRET = /^#(invitation|key|code)=([\w-]+)$/u;

/** What the address brings, as `{kind, secret}`, or null; the address then has it no more. */
export function takeSecret() {
  const [, kind, secret] = SECRET.exec(location.hash) ?? [];
  if (!kind) {
    return null;
  }
  history.replaceState(null, "", location.pathname + location.search);
  if (kind === "invitation") {
    saveSession(KEPT, secret);
  }
  return { kind, secret };
}

/** The invitation that this tab was opened with and has not used, or null. */
export function keptInvitation() {
  const secret = loadSession(KEPT);
  return secret ? { kind: "invitation", secret } : null;
}

/** It is used, or not good, or not wanted. */
export function forgetInvitation() {
  saveSession(KEPT, null);
}

/** The secret in a link that someone pasted, or the text itself: people paste either. */
export function secretIn(text) {
  const [, , secret] = /#(invitation|key|code)=([\w-]+)\s*$/u.exec(text) ?? [];
  return secret ?? text.trim();
}
