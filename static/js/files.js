// Scenarios as files: reading what was picked or dropped, writing what is exported. Reads strictly: what is wrong is named.

import { strings } from "./strings/index.js";
import { failureOf } from "./wasm.js";

export const MAX_FILE_BYTES = 1_000_000;
const FORMAT = /^adaptarm\.scenario\/(\d+)$/u;
const VERSION = 1;

/** Why a file is refused, as a sentence. */
export class FileError extends Error {}

/**
 * Documents by scheme from files: each a scenario, or a study `{"scenarios": [...]}`. `resolve` checks a scenario's JSON text
 * and fills it in, or throws JSON text `{pointer, message}`. Throws a FileError.
 */
export async function readFiles(files, resolve) {
  const documents = {};
  for (const file of files) {
    if (file.size > MAX_FILE_BYTES) {
      throw new FileError(strings.compare.fileTooBig(file.name, file.size));
    }
    let text;
    try {
      text = await file.text();
    } catch (error) {
      throw new FileError(strings.compare.fileUnreadable(file.name, error.message));
    }
    for (const [place, scenario] of scenariosOf(text, file.name)) {
      const document = read(scenario, place, resolve);
      const { kind } = document.scheme;
      if (documents[kind]) {
        throw new FileError(strings.compare.fileTwice(place, kind));
      }
      documents[kind] = document;
    }
  }
  return documents;
}

/** `[[where it stands, scenario]]` of a file's text. */
function scenariosOf(text, name) {
  let content;
  try {
    content = JSON.parse(text);
  } catch (error) {
    throw new FileError(strings.compare.fileNotJson(name, error.message));
  }
  if (content === null || typeof content !== "object" || Array.isArray(content)) {
    throw new FileError(strings.compare.fileNotScenario(name));
  }
  if (!("scenarios" in content)) {
    return [[name, content]];
  }
  const unknown = Object.keys(content).find((field) => field !== "scenarios");
  if (unknown !== undefined) {
    throw new FileError(strings.compare.fileUnknownField(name, unknown));
  }
  if (!Array.isArray(content.scenarios) || content.scenarios.length === 0) {
    throw new FileError(strings.compare.fileNoScenarios(name));
  }
  return content.scenarios.map((scenario, n) => [strings.compare.fileScenario(name, n + 1), scenario]);
}

function read(scenario, place, resolve) {
  const version = Number(FORMAT.exec(scenario?.format)?.[1]);
  if (version > VERSION) {
    throw new FileError(strings.compare.fileNewer(place, scenario.format));
  }
  try {
    return JSON.parse(resolve(JSON.stringify(scenario)));
  } catch (error) {
    throw new FileError(strings.compare.fileRefused(place, failureOf(error).message));
  }
}

/** A document as a file's text: the document and nothing else. */
export function documentText(document) {
  return `${JSON.stringify(document, null, 2)}\n`;
}

/** Documents as a study's specification. */
export function studyText(documents) {
  return documentText({ scenarios: Object.values(documents) });
}
