// Settings as a link's fragment and back: `#1.` and deflated JSON, or `#1j.` and plain JSON, in base64url.
//
// The JSON tells what differs from the paper's documents:
//   {"all": patch, "each": {scheme: patch}, "shown": [scheme], "hashes": {scheme: first digits of the scenario's hash}}
// with patches as in diff.js. Links are kept forever: version 1 must be read the same way by every later page, so a change
// of what this means is a version 2 with a decoder of its own. Knows no page and no core.

import { patchBetween, patched } from "./diff.js";

const VERSION = 1;
/** Digits of a hash that a link carries: enough to notice that settings are read differently. */
const HASH_DIGITS = 8;
/** Nobody's settings are longer; a small text that inflates to more is no link of ours. */
const MAX_BYTES = 256 * 1024;
const MAX_CHARACTERS = 64 * 1024;
const FIELDS = ["all", "each", "shown", "hashes"];

/** Why a link cannot be read: `kind` is newer, damaged, tooLong, unsupported, scheme or place. */
export class LinkError extends Error {
  constructor(kind, detail = "") {
    super(`${kind}: ${detail}`);
    this.kind = kind;
    this.detail = detail;
  }
}

/** Whether a fragment is meant to be settings, of whatever version. */
export function isLink(fragment) {
  return /^#\d+[a-z]*\./u.test(fragment);
}

/** The fragment for `{documents, visible, hashes}`, as they differ from `paper`'s documents. */
export async function encodeLink({ documents, visible, hashes }, paper) {
  const text = new TextEncoder().encode(JSON.stringify(toContent({ documents, visible, hashes }, paper)));
  if (!("CompressionStream" in globalThis)) {
    return `#${VERSION}j.${toBase64(text)}`;
  }
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  return `#${VERSION}.${toBase64(await collect(stream))}`;
}

/** `{documents, visible, hashes}` of a fragment, the hashes as it carries them; throws a LinkError. The core must check them. */
export async function decodeLink(fragment, paper) {
  const [, version, form, body] = /^#(\d+)([a-z]*)\.(.*)$/su.exec(fragment) ?? [];
  if (Number(version) > VERSION) {
    throw new LinkError("newer", version);
  }
  if (Number(version) !== VERSION || !["", "j"].includes(form)) {
    throw new LinkError("damaged");
  }
  if (body.length > MAX_CHARACTERS) {
    throw new LinkError("tooLong");
  }
  const bytes = fromBase64(body);
  return fromContent(parse(form === "j" ? bytes : await inflate(bytes)), paper);
}

function toContent({ documents, visible, hashes }, paper) {
  const schemes = Object.keys(paper);
  const patches = Object.fromEntries(schemes.map((id) => [id, patchBetween(paper[id], documents[id])]));
  const common = commonPatch(Object.values(patches));
  const isCommon = new Set(common.map((change) => JSON.stringify(change)));
  const content = { hashes: Object.fromEntries(schemes.map((id) => [id, hashes[id].slice(0, HASH_DIGITS)])) };
  const each = Object.entries(patches)
    .map(([id, patch]) => [id, patch.filter((change) => !isCommon.has(JSON.stringify(change)))])
    .filter(([, patch]) => patch.length > 0);
  if (common.length > 0) {
    content.all = common;
  }
  if (each.length > 0) {
    content.each = Object.fromEntries(each);
  }
  if (visible.length < schemes.length) {
    content.shown = visible;
  }
  return content;
}

/** The changes that all patches make. */
function commonPatch([first, ...others]) {
  const sets = others.map((patch) => new Set(patch.map((change) => JSON.stringify(change))));
  return first.filter((change) => sets.every((set) => set.has(JSON.stringify(change))));
}

function fromContent(content, paper) {
  const schemes = Object.keys(paper);
  const { all = [], each = {}, shown = schemes, hashes = {} } = content;
  const known = Object.keys(content).every((field) => FIELDS.includes(field));
  if (!known || !Array.isArray(shown) || ![each, hashes].every(isPlain) || ![all, ...Object.values(each)].every(isPatch)) {
    throw new LinkError("damaged");
  }
  const unknown = [...shown, ...Object.keys(each), ...Object.keys(hashes)].find((id) => !schemes.includes(id));
  if (unknown !== undefined) {
    throw new LinkError("scheme", String(unknown));
  }
  try {
    const documents = Object.fromEntries(schemes.map((id) => [id, patched(patched(paper[id], all), each[id] ?? [])]));
    return { documents, visible: schemes.filter((id) => shown.includes(id)), hashes };
  } catch (error) {
    throw new LinkError("place", error.message);
  }
}

const isPlain = (value) => value !== null && typeof value === "object" && !Array.isArray(value);
const isPatch = (value) =>
  Array.isArray(value) &&
  value.every((change) => Array.isArray(change) && typeof change[0] === "string" && (change.length === 1 || change.length === 2));

function parse(bytes) {
  let content;
  try {
    content = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
  } catch {
    throw new LinkError("damaged");
  }
  if (!isPlain(content)) {
    throw new LinkError("damaged");
  }
  return content;
}

async function inflate(bytes) {
  if (!("DecompressionStream" in globalThis)) {
    throw new LinkError("unsupported");
  }
  try {
    return await collect(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")));
  } catch (error) {
    throw error instanceof LinkError ? error : new LinkError("damaged");
  }
}

/** Everything a stream has to say, unless that is too much. */
async function collect(stream) {
  const reader = stream.getReader();
  const chunks = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) {
      return new Uint8Array(await new Blob(chunks).arrayBuffer());
    }
    length += value.length;
    if (length > MAX_BYTES) {
      await reader.cancel();
      throw new LinkError("tooLong");
    }
    chunks.push(value);
  }
}

function toBase64(bytes) {
  const text = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

function fromBase64(text) {
  if (!/^[\w-]+$/u.test(text)) {
    throw new LinkError("damaged");
  }
  try {
    return Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
  } catch {
    throw new LinkError("damaged");
  }
}
