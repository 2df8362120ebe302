// Links, import and export.

/** Builds it. */
export function buildShare(_place, _app) {}
