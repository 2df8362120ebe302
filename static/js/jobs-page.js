// The jobs page: the list of jobs, or one of them where the address names it (`jobs.html#ID`, `jobs.html#ID/SCENARIO`).

import { byId } from "./dom.js";
import { JobDetails } from "./jobs/details.js";
import { JobList } from "./jobs/list.js";
import { buildMasthead, comeAlive } from "./masthead.js";
import { strings } from "./strings/index.js";

const root = document.documentElement;
const ADDRESS = /^#([0-9a-f-]{36})(?:\/(\d+))?$/u;

function main() {
  comeAlive();
  buildMasthead("jobs");
  const place = byId("content");
  const list = new JobList();
  let details = null;

  function route() {
    const [, id, scenario] = ADDRESS.exec(location.hash) ?? [];
    if (id && details?.id === id) {
      details.choose(Number(scenario ?? 0));
      return;
    }
    const before = details;
    details?.stop();
    details = id ? new JobDetails(id, Number(scenario ?? 0)) : null;
    const view = details ?? list;
    root.dataset.state = "loading";
    root.dataset.view = details ? "details" : "list";
    place.replaceChildren(view.node);
    document.title = `${strings.server.title} · adaptarm`;
    if (details) {
      list.stop();
      details.start();
      details.heading.focus();
    } else {
      list.start(before?.id ?? null);
    }
  }

  document.querySelector(".skip-link").addEventListener("click", (event) => {
    // The address says which job is shown.
    event.preventDefault();
    place.focus();
  });
  addEventListener("hashchange", route);
  route();
}

main();
