// Running the same documents on the server.

/** Builds it. */
export function buildServerRun(_place, _app) {}
