// Sets the theme before the first paint: the remembered choice, else what the system prefers. A classic script on purpose.
(() => {
  let chosen = null;
  try {
    chosen = localStorage.getItem("adaptarm.theme");
  } catch {
    // Storage may be forbidden; then nothing is remembered.
  }
  const dark = chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = dark ? "dark" : "light";
})();
