// Hands files to the visitor.

import { element } from "./dom.js";

/** Long enough for any browser to have begun. */
const KEEP_MS = 60_000;

/** Saves a blob, or text of a type, as `name`. */
export function download(name, content, type) {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const url = URL.createObjectURL(blob);
  const link = element("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), KEEP_MS);
}

/** A file name from parts: small letters, digits, dashes and points. */
export function fileName(parts, extension) {
  const clean = parts
    .filter((part) => part !== null && part !== "")
    .map((part) => part.normalize("NFKD").toLowerCase().replace(/[^a-z0-9.]+/gu, "-").replace(/^-+|-+$/gu, ""))
    .filter((part) => part !== "");
  return `${["adaptarm", ...clean].join("-")}.${extension}`;
}
