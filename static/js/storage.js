// What survives, as JSON under one prefix: a visit (`load`, `save`) or, per tab, a reload (`loadSession`, `saveSession`).
// Storage may be forbidden or full: then nothing survives, nothing fails.

const PREFIX = "adaptarm.";

/** What was saved under `key`, or null. */
export function load(key) {
  return parsed(() => localStorage, key);
}

/** Saves a JSON value under `key`; false if there is no room. */
export function save(key, value) {
  return saveText(key, JSON.stringify(value));
}

/** What was saved under `key` in this tab, or null. */
export function loadSession(key) {
  return parsed(() => sessionStorage, key);
}

/** Saves a JSON value under `key` for this tab; false if there is no room. */
export function saveSession(key, value) {
  return put(() => sessionStorage, key, JSON.stringify(value));
}

/** Saves text as it is under `key`; false if there is no room. */
export function saveText(key, text) {
  return put(() => localStorage, key, text);
}

/** Text saved under `key`, or null. */
export function loadText(key) {
  return taken(() => localStorage, key);
}

// The stores come as functions: where storage is forbidden, already naming one throws.

function put(store, key, text) {
  try {
    store().setItem(PREFIX + key, text);
    return true;
  } catch {
    return false;
  }
}

function taken(store, key) {
  try {
    return store().getItem(PREFIX + key);
  } catch {
    return null;
  }
}

function parsed(store, key) {
  try {
    return JSON.parse(taken(store, key));
  } catch {
    return null;
  }
}
