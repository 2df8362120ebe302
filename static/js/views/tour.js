// The guided tour of the paper.

/** Builds it. */
export function buildTour(_app) {}
