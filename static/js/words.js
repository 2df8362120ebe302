// What changed, in words: names for places in a document, and sentences for the differences between two settings.
//
// Settings are `{documents, visible}`: a document per scheme and the schemes shown.

import { differences } from "./diff.js";
import { symbol } from "./dom.js";
import { formatExact } from "./format.js";
import { strings } from "./strings/index.js";

const SPELLED_OUT = 2;

/** Words for the documents that a description of the core is about. */
export class Words {
  #description;
  #names = new Map();
  #units = new Map();
  /** Finds the gains' symbols in a sentence. */
  #symbols;

  constructor(description) {
    this.#description = description;
    const [robot] = description.robots;
    for (const [pointer, name, unit] of [
      ["/integration/duration_s", strings.duration, "s"],
      ["/integration/step_s", strings.step, "s"],
      ["/plant/friction/width_rad_s", strings.friction, "rad/s"],
      ["/initial/velocity", strings.start, ""],
    ]) {
      this.#names.set(pointer, name);
      this.#units.set(pointer, unit);
    }
    robot.parameters.forEach(({ symbol }, n) => {
      this.#names.set(`/plant/theta_scale/${n}`, strings.compare.thetaScale(symbol));
    });
    const gains = description.schemes.flatMap((scheme) => scheme.gains);
    const written = new Set(gains.map((gain) => gain.symbol).filter((text) => /^\p{L}+_\w+$/u.test(text)));
    this.#symbols = new RegExp(`((?:${[...written].join("|")})(?![\\w]))`, "u");
    for (const gain of gains) {
      const ofNumber = {
        joint: (n) => strings.compare.ofJoint(gain.symbol, n + 1),
        parameter: (n) => strings.compare.ofParameter(gain.symbol, robot.parameters[n].symbol),
      }[gain.shape];
      this.#names.set(gain.pointer, gain.symbol);
      gain.default.forEach((_, n) => ofNumber && this.#names.set(`${gain.pointer}/${n}`, ofNumber(n)));
    }
  }

  /** What stands at a pointer. */
  name(pointer) {
    return this.#names.get(pointer) ?? pointer.slice(1).replaceAll("/", ".");
  }

  /** A value as it is set. */
  value(value) {
    if (typeof value === "number") {
      return formatExact(value);
    }
    const texts = { rest: strings.startRest, desired: strings.startDesired, undefined: strings.compare.absent };
    return texts[value] ?? (typeof value === "string" ? value : JSON.stringify(value));
  }

  /** A value with its unit, where it is one of the setup. */
  quantity(pointer, value) {
    return `${this.value(value)} ${this.#units.get(pointer) ?? ""}`.trimEnd();
  }

  /** A sentence with its symbols written as such, for an element. */
  rich(text) {
    return text.split(this.#symbols).flatMap((part, n) => (n % 2 ? symbol(part) : part));
  }

  /** Differences of two sets of documents: `[{pointer, before, after, schemes}]`, equal ones of several schemes together. */
  changes(before, after) {
    const found = new Map();
    for (const { id } of this.#description.schemes) {
      for (const change of differences(before[id], after[id])) {
        const key = JSON.stringify([change.pointer, change.before, change.after]);
        found.set(key, found.get(key) ?? { ...change, schemes: [] });
        found.get(key).schemes.push(id);
      }
    }
    return [...found.values()];
  }

  /** The schemes that a change concerns, as a suffix; nothing if it is all of them. */
  suffix(schemes) {
    return schemes.length === this.#description.schemes.length ? "" : strings.compare.of(schemes.map((id) => this.scheme(id)).join(", "));
  }

  /** A scheme's name. */
  scheme(id) {
    return this.#description.schemes.find((scheme) => scheme.id === id).name;
  }

  /** The study that documents are, or null. */
  study(documents) {
    const study = this.#description.studies.find((candidate) => this.changes(candidate.documents, documents).length === 0);
    return study ? strings.studies[study.id] : null;
  }

  /** One sentence on the way from one setting to another. */
  step(before, after) {
    const changes = this.changes(before.documents, after.documents);
    const study = changes.length > 1 ? this.study(after.documents) : null;
    const parts = study
      ? [strings.compare.toStudy(study)]
      : changes.slice(0, changes.length > SPELLED_OUT + 1 ? SPELLED_OUT : undefined).map((change) => this.#sentence(change));
    if (!study && changes.length > parts.length) {
      parts.push(strings.compare.more(changes.length - parts.length));
    }
    const names = (ids) => ids.map((id) => this.scheme(id)).join(", ");
    const shown = after.visible.filter((id) => !before.visible.includes(id));
    const hidden = before.visible.filter((id) => !after.visible.includes(id));
    if (shown.length > 0) {
      parts.push(strings.compare.shown(names(shown)));
    }
    if (hidden.length > 0) {
      parts.push(strings.compare.hidden(names(hidden)));
    }
    return parts.join("; ");
  }

  #sentence({ pointer, before, after, schemes }) {
    return strings.compare.change(this.name(pointer), this.value(before), this.quantity(pointer, after)) + this.suffix(schemes);
  }
}
