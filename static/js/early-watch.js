// Says so when a page does not come to life: then what would say it is what is missing. The first of the page's scripts and
// a classic one, with texts of its own in every language at once: strings/ comes by modules, and so does what knows the
// reader's language. A page is alive once its modules are there (`comeAlive` in masthead.js); what follows speaks for itself.
(() => {
  const PATIENCE_MS = 12_000;
  const KEY = "adaptarm.reloaded";
  const TEXTS = {
    missing: { en: "A part of this page did not arrive.", es: "Una parte de esta página no ha llegado." },
    late: { en: "This page is taking long to load.", es: "Esta página tarda en cargar." },
    reload: { en: "Load again", es: "Volver a cargar" },
  };
  const root = document.documentElement;
  const isAlive = () => root.dataset.alive !== undefined;
  let shown = null;

  function inEachLanguage(name, texts, between) {
    const node = document.createElement(name);
    for (const [lang, text] of Object.entries(texts)) {
      const part = Object.assign(document.createElement("span"), { lang, textContent: text });
      node.append(...(node.firstChild ? [between, part] : [part]));
    }
    return node;
  }

  function say(text, kind) {
    const place = document.getElementById("notices");
    if (!place) {
      addEventListener("DOMContentLoaded", () => isAlive() || say(text, kind), { once: true });
      return;
    }
    shown?.remove();
    shown = document.createElement("p");
    shown.className = `notice ${kind}`;
    shown.id = "not-alive";
    const button = inEachLanguage("button", TEXTS.reload, " · ");
    button.type = "button";
    button.addEventListener("click", () => location.reload());
    shown.append(inEachLanguage("span", text, " "), button);
    place.append(shown);
  }

  /** Whether the page may load itself again; remembers that it did. Until it was alive, it may once. */
  function mayReload() {
    try {
      const before = sessionStorage.getItem(KEY);
      sessionStorage.setItem(KEY, "once");
      return before === null && navigator.onLine && shown === null;
    } catch {
      // Where nothing can be remembered, it could go on for ever.
      return false;
    }
  }

  /** Something is missing or does not fit, as in the middle of a server's update: before it is alive, a page has nothing to lose. */
  function fail() {
    if (isAlive()) {
      return;
    }
    if (mayReload()) {
      location.reload();
    } else {
      clearTimeout(late);
      say(TEXTS.missing, "error");
    }
  }

  // In the capture phase: a file's failure does not bubble. A module's is that of the script that imports it.
  addEventListener("error", ({ target }) => (target === window || target instanceof HTMLScriptElement) && fail(), true);
  addEventListener("unhandledrejection", fail);
  const late = setTimeout(() => say(TEXTS.late, "warning"), PATIENCE_MS);
  const observer = new MutationObserver(() => {
    clearTimeout(late);
    observer.disconnect();
    shown?.remove();
    try {
      sessionStorage.removeItem(KEY);
    } catch {
      // Forbidden; then nothing was remembered.
    }
  });
  observer.observe(root, { attributes: true, attributeFilter: ["data-alive"] });
})();
