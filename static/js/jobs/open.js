// Opening a job's scenarios in the playground: fetched as the job runs them, handed over, checked there by the core.

import { ask, readScenario } from "../api.js";
import { handOver } from "../handover.js";
import { strings } from "../strings/index.js";

/** How many scenarios are looked at to find each scheme, where no report tells which have it. */
const LOOKED_AT = 8;

/** Opens scenarios, by number, of the job `id`. */
export async function openScenarios(id, numbers) {
  const scenarios = await Promise.all(numbers.map((n) => readScenario(id, n)));
  go(scenarios);
}

/** Opens the first scenario of each scheme of a job with `count` scenarios, whose reports are known as far as there are any. */
export async function openStudy(id, count, reports) {
  const found = new Map();
  for (let n = 0; n < count; n += 1) {
    if (reports[n] && !found.has(reports[n].scheme)) {
      found.set(reports[n].scheme, readScenario(id, n));
    } else if (!reports[n] && n < LOOKED_AT) {
      const scenario = await readScenario(id, n);
      if (!found.has(scenario.scheme.kind)) {
        found.set(scenario.scheme.kind, scenario);
      }
    }
  }
  go(await Promise.all(found.values()));
}

/** Opens the scenario that is at a path below the API's root. */
export async function openDocument(path) {
  go([await ask(path)]);
}

function go(scenarios) {
  if (!handOver(scenarios)) {
    throw new Error(strings.server.handoverFull);
  }
  location.assign("./");
}
