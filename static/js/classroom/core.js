// The core in the browser for the classroom: loaded when the first exercise is opened, once.

import { translated } from "../core-text.js";
import { learnNames } from "../refusal.js";
import { loadModule } from "../wasm.js";

/** What `load` gives, once; if that fails, asked for again it is tried again. */
function once(load) {
  let loading = null;
  return () => {
    loading ??= load().catch((error) => {
      loading = null;
      throw error;
    });
    return loading;
  };
}

/** The simulation and its figures: `{bindings, module, description}`; throws with a reason for people. */
export const loadCore = once(async () => {
  const { bindings, module } = await loadModule();
  const description = translated(JSON.parse(bindings.describe()));
  learnNames(description);
  return { bindings, module, description };
});

/** Exercises, a module of its own: its bindings. */
export const loadExercises = once(async () => (await loadModule("adaptarm_exercise")).bindings);
