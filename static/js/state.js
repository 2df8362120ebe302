// What the visitor has set: one checked scenario document per scheme, which schemes are shown, which tab is open.
//
// Documents change only through `edit` and `replace`, and only into documents that the core allows; a refused edit
// leaves everything as it was. Emits "changed" when documents or the schemes shown are others, "shown" for the latter
// alone. Remembers itself across reloads. Knows nothing of workers or elements.

import { valueAt, withValueAt } from "./pointer.js";
import { load, save } from "./storage.js";

const KEY = "state";
const VERSION = 1;
const SAVE_AFTER_MS = 200;

export class State extends EventTarget {
  #check;
  #saving = null;
  /** Scheme to document, with everything filled in. */
  documents;
  /** Scheme to the hash of its document. */
  hashes = {};
  /** Identifiers of the schemes shown in figures; changed by `show`. */
  visible;
  /** The scheme whose gains are open. */
  tab;
  /** Whether what was remembered had to be dropped. */
  dropped = false;

  /** `check` returns a document's hash or throws `{pointer, message}`; `defaults` are the paper's documents. */
  constructor(check, defaults) {
    super();
    this.#check = check;
    const schemes = Object.keys(defaults);
    const saved = load(KEY);
    this.documents = structuredClone(defaults);
    try {
      if (saved) {
        if (saved.version !== VERSION || schemes.some((scheme) => saved.documents[scheme].scheme.kind !== scheme)) {
          throw new Error("another version's state");
        }
        this.#accept(Object.fromEntries(schemes.map((scheme) => [scheme, saved.documents[scheme]])));
      }
    } catch {
      this.dropped = true;
    }
    this.#accept(this.documents);
    this.visible = new Set(schemes.filter((scheme) => saved?.visible?.includes(scheme) ?? true));
    this.tab = schemes.includes(saved?.tab) ? saved.tab : schemes[0];
    addEventListener("pagehide", () => this.#save());
  }

  /** The value at a JSON pointer in a scheme's document. */
  valueAt(scheme, pointer) {
    return valueAt(this.documents[scheme], pointer);
  }

  /** Sets one value in the documents of `schemes`; returns the schemes that changed, or throws `{pointer, message}`. */
  edit(schemes, pointer, value) {
    return this.replace(Object.fromEntries(schemes.map((id) => [id, withValueAt(this.documents[id], pointer, value)])));
  }

  /** Replaces documents, all or none; returns the schemes that changed, or throws `{pointer, message}`. */
  replace(documents) {
    const before = { ...this.hashes };
    this.#accept(documents);
    const changed = Object.keys(documents).filter((scheme) => this.hashes[scheme] !== before[scheme]);
    if (changed.length > 0) {
      this.remember();
      this.dispatchEvent(new Event("changed"));
    }
    return changed;
  }

  /** Shows exactly these schemes in figures. */
  show(schemes) {
    const visible = new Set(schemes);
    if (visible.size !== this.visible.size || [...visible].some((scheme) => !this.visible.has(scheme))) {
      this.visible = visible;
      this.remember();
      this.dispatchEvent(new Event("shown"));
      this.dispatchEvent(new Event("changed"));
    }
  }

  /** Saves soon: a dragged slider must not write at every pixel. */
  remember() {
    clearTimeout(this.#saving);
    this.#saving = setTimeout(() => this.#save(), SAVE_AFTER_MS);
  }

  #accept(documents) {
    const hashes = {};
    for (const [scheme, document] of Object.entries(documents)) {
      hashes[scheme] = this.#check(document);
    }
    Object.assign(this.hashes, hashes);
    this.documents = { ...this.documents, ...documents };
  }

  #save() {
    save(KEY, { version: VERSION, documents: this.documents, visible: [...this.visible], tab: this.tab });
  }
}
