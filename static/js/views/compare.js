// Undo, redo, history, pinned runs.

/** Builds it. */
export function buildCompare(_place, _app) {}
