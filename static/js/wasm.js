// A module of the core on the main thread: loaded once, compiled once; the simulation's is shared with the workers.

import { refusal } from "./refusal.js";

/** Loads the simulation, or another module. Throws with a reason for people when it is missing or broken. */
export async function loadModule(name = "adaptarm_web") {
  // Imported here and not above: a missing file must be a message, not a page that stays blank.
  const bindings = await import(`../generated/${name}.js`);
  const url = new URL(`../generated/${name}_bg.wasm`, import.meta.url);
  const response = await fetch(url);
  if (!response.ok) {
    throw new Error(`${url.pathname}: HTTP ${response.status}`);
  }
  const module = await WebAssembly.compile(await response.arrayBuffer());
  await bindings.default({ module_or_path: module });
  return { bindings, module };
}

/** What a core function threw, as `{pointer, message}`, the message in the reader's language. */
export function failureOf(error) {
  if (typeof error === "string") {
    try {
      const failure = JSON.parse(error);
      return { ...failure, message: refusal(failure) };
    } catch {
      return { pointer: "", message: error };
    }
  }
  return { pointer: "", message: String(error?.message ?? error) };
}
