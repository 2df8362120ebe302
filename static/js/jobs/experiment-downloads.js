// Files of an experiment to keep: the same bytes as the command line writes.

import { element } from "../dom.js";
import { strings } from "../strings/index.js";
import { fileLink } from "./downloads.js";
import { texts } from "./experiment-texts.js";

/** Links to `files` of the job `id` and to the figure that is shown; errors go to `failure`. */
export function buildExperimentDownloads(id, files, figure, failure) {
  const base = `adaptarm-${id.slice(0, 13)}`;
  const links = files.map((name) => [name, `jobs/${id}/result/files/${name}`, `${base}-${name}`]);
  for (const format of ["svg", "png"].filter(() => figure.path("svg"))) {
    links.push([format, figure.path(format), `${base}-${figure.fileName}.${format}`]);
  }
  const title = strings.server.downloads;
  const item = ([kind, path, name]) => element("li", {}, fileLink(kind, path, name, texts.files[kind] ?? name, failure));
  return element("nav", { class: "downloads", "aria-label": title }, element("h3", {}, title), element("ul", {}, links.map(item)));
}
