// The theme toggle: follows the system until the visitor chooses, then remembers the choice (see early-theme.js).

import { loadText, saveText } from "./storage.js";
import { strings } from "./strings.js";

const root = document.documentElement;

/** Whether the page is dark now. */
export function isDark() {
  return root.dataset.theme === "dark";
}

/** Makes `button` switch themes; calls `changed` after each switch. */
export function initTheme(button, changed) {
  const show = (theme) => {
    root.dataset.theme = theme;
    button.textContent = isDark() ? strings.themeLight : strings.themeDark;
  };
  show(root.dataset.theme ?? "light");
  button.addEventListener("click", () => {
    show(isDark() ? "light" : "dark");
    saveText("theme", root.dataset.theme);
    changed();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) => {
    if (loadText("theme") === null) {
      show(event.matches ? "dark" : "light");
      changed();
    }
  });
}
