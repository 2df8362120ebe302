// The theme: follows the system until the visitor chooses, then remembers the choice (see early-theme.js).

import { loadText, saveText } from "./storage.js";
import { strings } from "./strings/index.js";

const root = document.documentElement;
const listeners = [];

/** Whether the page is dark now. */
export function isDark() {
  return root.dataset.theme === "dark";
}

/** Calls `listener` after each change of theme. */
export function onTheme(listener) {
  listeners.push(listener);
}

/** Makes `button` switch themes. */
export function initTheme(button) {
  const show = (theme) => {
    root.dataset.theme = theme;
    button.textContent = isDark() ? strings.themeLight : strings.themeDark;
    for (const listener of listeners) {
      listener();
    }
  };
  show(root.dataset.theme ?? "light");
  button.addEventListener("click", () => {
    show(isDark() ? "light" : "dark");
    saveText("theme", root.dataset.theme);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) => {
    if (loadText("theme") === null) {
      show(event.matches ? "dark" : "light");
    }
  });
}
