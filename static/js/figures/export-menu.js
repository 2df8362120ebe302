// The export menu of a figure: picture, drawing, and the samples of each shown run.
//
// A picture has the pixels of the screen and is as light or dark as shown; the stretch and the axis are those shown, too.
// The figure of all estimates also gives the paper's three figures of them, which the page itself does not show.

import { element } from "../dom.js";
import { notice } from "../notice.js";
import { strings } from "../strings/index.js";
import { failureOf } from "../wasm.js";
import { PAPER_ESTIMATES } from "./catalogue.js";
import { download, fileName } from "../download.js";
import { bindPopup } from "./popup.js";

const texts = strings.figures;
let menus = 0;

/** Puts the menu's button among a card's tools. */
export function addExportMenu(card, figures, { bindings, runs, timeline, description }) {
  const id = `figure-export-${(menus += 1)}`;
  const menu = element("div", { class: "figure-menu", id: `${id}-menu` });
  const named = { "aria-labelledby": `${id} ${card.titleId}` };
  const opener = element("button", { type: "button", id, ...named }, texts.export);
  const wrap = element("div", { class: "figure-export" }, opener, menu);
  card.tools.append(wrap);
  const close = bindPopup(wrap, opener, menu, () => {
    menu.replaceChildren(...rows());
    menu.querySelector("button").focus();
  });

  function rows() {
    const { figure } = card.dataset;
    const own = row(texts.titles[figure], [
      [texts.png, texts.pngHelp, () => png(figure, card.canvas)],
      [texts.svg, texts.svgHelp, () => svg(figure)],
    ]);
    const paper = figure === "estimates" ? PAPER_ESTIMATES.filter((id) => figures.draws(id)) : [];
    const more = paper.map((id) =>
      row(texts.titles[id], [
        [texts.png, texts.pngHelp, () => png(id, drawn(id))],
        [texts.svg, texts.svgHelp, () => svg(id)],
      ]),
    );
    const samples = figures.runs.map(({ id, name }) => row(name, [[texts.csv, texts.csvHelp, () => csv(id, name)]]));
    return [own, ...more, ...samples];
  }

  function row(label, actions) {
    const buttons = actions.map(([text, help, act]) => {
      const name = texts.exportAs(label, text);
      return element("button", { type: "button", "aria-label": name, title: help, onclick: () => attempt(act) }, text);
    });
    return element("div", { class: "figure-menu-row" }, element("span", {}, label), buttons);
  }

  function attempt(act) {
    try {
      act();
    } catch (error) {
      notice(texts.exportFailed(failureOf(error).message), "error");
    }
    close();
  }

  /** Which stretch a file shows; nothing where it shows everything. */
  function stretch() {
    const [from, to] = timeline.window;
    return timeline.isZoomed ? `${from.toFixed(3)}s-to-${to.toFixed(3)}s` : "";
  }

  function nameOf(figure, extension) {
    const axis = figures.hasSymlog(figure) && figures.axis === "symlog" ? "symlog" : "";
    return fileName([figure.replaceAll("_", "-"), axis, stretch(), figures.dark ? "dark" : "light"], extension);
  }

  function png(figure, canvas) {
    const name = nameOf(figure, "png");
    canvas.toBlob((blob) => (blob ? download(name, blob) : notice(texts.exportFailed(name), "error")), "image/png");
  }

  function svg(figure) {
    download(nameOf(figure, "svg"), bindings.export_svg(runs, figure, figures.viewOf(figure, 1)), "image/svg+xml");
  }

  function csv(id, name) {
    download(fileName([name, "samples"], "csv"), runs.csv(id), "text/csv");
  }

  /** A figure that the page does not show, at its natural size and the screen's resolution. */
  function drawn(figure) {
    const [width, height] = description.figures.find(({ id }) => id === figure).natural_size;
    const scale = devicePixelRatio || 1;
    const canvas = element("canvas", { width: Math.round(width * scale), height: Math.round(height * scale) });
    bindings.draw_figure(runs, canvas, figure, figures.viewOf(figure, scale));
    return canvas;
  }
}
