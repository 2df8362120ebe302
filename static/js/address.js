// The address bar: carries the settings, and opens what it is given.
//
// What comes first when the page loads: settings that this tab had under this very address (a reload, also of a moment that
// the address has not caught up with), then the address's link, then what an earlier visit left, then the paper's study.
// A link that cannot be read changes nothing and says why.

import { jump } from "./jump.js";
import { LinkError, decodeLink, encodeLink, isLink } from "./link-codec.js";
import { notice } from "./notice.js";
import { loadSession, saveSession } from "./storage.js";
import { strings } from "./strings/index.js";
import { failureOf } from "./wasm.js";

const KEY = "address";
const AFTER_MS = 250;
/** A download fires the same event as leaving, but nothing follows: after this the address catches up. */
const LEAVING_MS = 10_000;
/** In the browser's history: an address without a link that was left by this page stands for the paper's study. */
const MARK = { adaptarm: 1 };

export class Address {
  #app;
  #pending = null;
  /** Counts openings and writings, so that the last one wins whatever takes longest. */
  #turn = 0;

  constructor(app) {
    this.#app = app;
  }

  /** Settles what the page starts with, then keeps address and settings together. */
  async start() {
    const { state, history: steps } = this.#app;
    if (loadSession(KEY) === location.hash) {
      this.#resume(steps.current);
    } else if (isLink(location.hash)) {
      await this.#open(location.hash);
    } else if (isMarked()) {
      this.#apply(this.#paper());
    }
    steps.as({ kind: "visit" }, () => steps.catchUp());
    state.addEventListener("changed", () => this.#updateSoon());
    addEventListener("hashchange", () => this.#moved());
    addEventListener("beforeunload", () => this.#hold());
    addEventListener("pagehide", () => saveSession(KEY, location.hash));
    document.addEventListener("click", (event) => jump(event));
    await this.#update();
  }

  /** A link to the present settings, which opens them whatever its reader's page remembers. */
  async link() {
    return new URL(await this.#fragment(), location.href.split("#")[0]).href;
  }

  #fragment() {
    const { state, paper } = this.#app;
    return encodeLink({ documents: state.documents, visible: [...state.visible], hashes: state.hashes }, paper);
  }

  #paper() {
    return { documents: this.#app.paper, visible: Object.keys(this.#app.paper) };
  }

  #isPaper() {
    const { state, paper, words } = this.#app;
    return state.visible.size === Object.keys(paper).length && words.changes(paper, state.documents).length === 0;
  }

  #updateSoon() {
    clearTimeout(this.#pending);
    this.#pending = setTimeout(() => this.#update(), AFTER_MS);
  }

  /** A reload takes the address as it is now: written later, it would not be the one under which the settings are kept. */
  #hold() {
    this.#turn += 1;
    clearTimeout(this.#pending);
    this.#pending = setTimeout(() => this.#update(), LEAVING_MS);
  }

  async #update() {
    const turn = (this.#turn += 1);
    const fragment = this.#isPaper() ? "" : await this.#fragment();
    if (turn === this.#turn) {
      history.replaceState(MARK, "", location.pathname + location.search + fragment);
    }
  }

  /** Someone pasted a link, followed one, or went back. */
  async #moved() {
    clearTimeout(this.#pending);
    if (isLink(location.hash)) {
      await this.#open(location.hash);
    } else if (location.hash === "" && isMarked()) {
      this.#apply(this.#paper());
    }
    await this.#update();
  }

  async #open(fragment) {
    const turn = (this.#turn += 1);
    try {
      const link = await decodeLink(fragment, this.#app.paper);
      if (turn === this.#turn) {
        this.#apply(await this.#checked(link));
      }
    } catch (error) {
      const { linkErrors, linkRefused } = strings.compare;
      const why = error instanceof LinkError ? linkErrors[error.kind](error.detail) : linkErrors.refused(failureOf(error).message);
      notice(linkRefused(why), "error");
    }
  }

  /** The link's settings with every field filled in; throws what the core says against them. */
  #checked({ documents, visible, hashes }) {
    const { bindings, words } = this.#app;
    const full = {};
    const others = [];
    for (const [id, document] of Object.entries(documents)) {
      full[id] = JSON.parse(bindings.resolve(JSON.stringify(document)));
      if (full[id].scheme.kind !== id) {
        throw new LinkError("scheme", full[id].scheme.kind);
      }
      if (hashes[id] && !bindings.check(JSON.stringify(full[id])).startsWith(hashes[id])) {
        others.push(words.scheme(id));
      }
    }
    if (others.length > 0) {
      notice(strings.compare.linkReadDifferently(others.join(", ")), "warning");
    }
    return { documents: full, visible };
  }

  #apply({ documents, visible }) {
    const { state, history: steps, laboratory } = this.#app;
    steps.as({ kind: "link" }, () => {
      const failure = laboratory.replace(documents);
      if (failure) {
        throw failure;
      }
      state.show(visible);
    });
  }

  /** Settings of before a reload. They were checked then; if the page is newer and refuses them now, it keeps what it has. */
  #resume({ documents, visible }) {
    const { state } = this.#app;
    try {
      state.replace(documents);
      state.show(visible);
    } catch {
      notice(strings.stateDropped, "warning");
    }
  }
}

function isMarked() {
  return history.state?.adaptarm === MARK.adaptarm;
}
