// Short texts where gains, signals and equations stand.

/** Builds it. */
export function buildExplain(_app) {}
