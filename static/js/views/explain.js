// Short texts where gains, signals and equations stand: info buttons, the glossary, and why the worst joint is worst.

import { byId } from "../dom.js";
import { buildGlossary } from "../explain/glossary.js";
import { infoButton, prepareInfo } from "../explain/info.js";
import { buildWhy } from "../explain/why.js";

/** Builds it. */
export function buildExplain(app) {
  prepareInfo(app);
  buildGlossary(byId("tour-start"));
  addToFigures();
  const show = buildWhy(byId("why"), app);
  app.laboratory.addEventListener("result", () => app.calm.ask(show));
}

/** A button in the head of every figure among the results, beside the figure's own tools where it has some. */
function addToFigures() {
  for (const card of document.querySelectorAll(".results figure-card")) {
    const place = card.querySelector(".figure-tools") ?? card.querySelector(".figure-head");
    place.append(infoButton("figure", card.dataset.figure) ?? "");
  }
}
