// Secrets in the address: taken out of the address bar at once, so that no history, screen or bookmark keeps them.

const SECRET = /^#(invitation|key|code)=([\w-]+)$/u;

/** What the address brings, as `{kind, secret}`, or null; the address then has it no more. */
export function takeSecret() {
  const [, kind, secret] = SECRET.exec(location.hash) ?? [];
  if (!kind) {
    return null;
  }
  history.replaceState(null, "", location.pathname + location.search);
  return { kind, secret };
}

/** The secret in a link that someone pasted, or the text itself: people paste either. */
export function secretIn(text) {
  const [, , secret] = /#(invitation|key|code)=([\w-]+)\s*$/u.exec(text) ?? [];
  return secret ?? text.trim();
}
