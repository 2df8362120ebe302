// What survives a reload, as JSON under one prefix. Storage may be forbidden or full: then nothing survives, nothing fails.

const PREFIX = "adaptarm.";

/** What was saved under `key`, or null. */
export function load(key) {
  try {
    return JSON.parse(localStorage.getItem(PREFIX + key));
  } catch {
    return null;
  }
}

/** Saves a JSON value under `key`. */
export function save(key, value) {
  saveText(key, JSON.stringify(value));
}

/** Saves text as it is under `key`. */
export function saveText(key, text) {
  try {
    localStorage.setItem(PREFIX + key, text);
  } catch {
    // Forbidden or full.
  }
}

/** Text saved under `key`, or null. */
export function loadText(key) {
  try {
    return localStorage.getItem(PREFIX + key);
  } catch {
    return null;
  }
}
