// Files of a scenario to keep. Plain links where no token is needed; with one, fetched and saved from memory.

import { address, send, token } from "../api.js";
import { element } from "../dom.js";
import { download } from "../download.js";
import { strings } from "../strings/index.js";
import { figurePath } from "./figures.js";
import { showError } from "./message.js";

const texts = strings.server;

/** Links to the files of the scenario number `n` of the job `id`; errors go to `failure`. */
export function buildDownloads(id, n, figure, failure) {
  const series = (format) => `jobs/${id}/result/series?scenario=${n}&format=${format}`;
  const base = `adaptarm-${id.slice(0, 13)}-${n + 1}`;
  const files = [
    ["csv", series("csv"), `${base}.csv`],
    ["npz", series("npz"), `${base}.npz`],
    ["parquet", series("parquet"), `${base}.parquet`],
    ["svg", figurePath(id, n, figure, "svg"), `${base}-${figure}.svg`],
    ["png", figurePath(id, n, figure, "png"), `${base}-${figure}.png`],
    ["scenario", `jobs/${id}/scenarios/${n}`, `${base}.json`],
    ["result", `jobs/${id}/result`, `adaptarm-${id.slice(0, 13)}.json`],
  ];
  const link = ([kind, path, name]) => element("li", {}, fileLink(kind, path, name, texts.downloadNames[kind], failure));
  return element("nav", { class: "downloads", "aria-label": texts.downloads }, element("h3", {}, texts.downloads), element("ul", {}, files.map(link)));
}

/** A link to the file at `path`, to be kept as `name`. */
export function fileLink(kind, path, name, text, failure) {
  const node = element("a", { href: address(path), download: name, "data-download": kind }, text);
  node.addEventListener("click", (event) => {
    if (token() !== null) {
      event.preventDefault();
      fetchFile(path, name).catch((error) => showError(failure, error));
    }
  });
  return node;
}

async function fetchFile(path, name) {
  // Large files take their time: no limit but the reader's patience.
  const response = await send(path, { signal: new AbortController().signal });
  download(name, await response.blob());
}
