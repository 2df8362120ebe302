// The arm and its playback.

/** Builds it. */
export function buildStage(_place, _app) {}
