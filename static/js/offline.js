// The page without a server: registers the service worker (sw.js), says when everything is kept, and when a newer version
// waits. Where browsers allow no service worker, on an insecure connection say, the page works as it always did.

import { element } from "./dom.js";
import { notice } from "./notice.js";
import { strings } from "./strings/index.js";

/** After the first results, and while nobody moves a slider: downloading files must not compete with runs. */
const AFTER_MS = 1500;
const CHECK_EVERY_MS = 30 * 60_000;
/** A click on a download fires the same event as leaving, but nothing follows. */
const LEAVING_MS = 10_000;

const texts = strings.offline;
let leaving = false;

/** Keeps the page for use without a server. */
export function keepOffline() {
  const container = navigator.serviceWorker;
  if (!container) {
    return;
  }
  addEventListener("beforeunload", () => {
    leaving = true;
    setTimeout(() => {
      leaving = false;
    }, LEAVING_MS);
  });
  container.addEventListener("message", ({ data }) => hear(data));
  const begin = () => inRest(() => register(container));
  if (document.readyState === "complete") {
    begin();
  } else {
    addEventListener("load", begin);
  }
}

/** Calls `act` once nobody has put anything in for a while. */
function inRest(act) {
  let timer = null;
  const wait = () => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      removeEventListener("input", wait, true);
      act();
    }, AFTER_MS);
  };
  addEventListener("input", wait, true);
  wait();
}

async function register(container) {
  let registration;
  try {
    await container.register(new URL("../sw.js", import.meta.url), { updateViaCache: "none" });
    registration = await container.ready;
  } catch {
    // Forbidden, or this server has no list of files: then there is no offline use.
    return;
  }
  registration.active.postMessage({ type: "ask" });
  const check = () => registration.active.postMessage({ type: "check" });
  document.addEventListener("visibilitychange", () => document.visibilityState === "visible" && check());
  setInterval(check, CHECK_EVERY_MS);
}

function hear({ type, version }) {
  if (type === "kept" && version) {
    document.documentElement.dataset.keptVersion = version;
    document.getElementById("offline-state")?.remove();
    document.querySelector("footer")?.append(element("p", { id: "offline-state" }, texts.ready));
  } else if (type === "newer") {
    notice(texts.newer, "info", element("button", { type: "button", onclick: () => location.reload() }, texts.reload));
  } else if (type === "switched" && !leaving) {
    // Another tab got the new version. From now on this one would be given its files too: better all than some.
    location.reload();
  }
}
