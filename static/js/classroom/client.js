// The classroom's requests: below api/v1/classroom, with the session's cookie and its token against requests of other sites.
//
// Knows the session of this browser, or that there is none; says "session" when that changes. `docs/classroom.md` is the
// contract.

import { ask, send } from "../api.js";

const ROOT = "classroom/";
const NOBODY = { role: null };

class Client extends EventTarget {
  /** Who is signed in, as the server said it; `{role: null}` for nobody. */
  session = NOBODY;
  /** Whether there was a session that ended without anybody here ending it. */
  isLost = false;

  /** Asks the server who is signed in. */
  async load() {
    this.#enter(await ask(`${ROOT}session`));
    return this.session;
  }

  /** Makes a session: by a key, a login, an invitation or a class's code. Returns it, with what is shown only this once. */
  async begin(path, body) {
    const session = await this.#json("POST", path, body);
    this.#enter(session);
    return session;
  }

  /** Ends the session: this one, or all of them (`path` "sessions"). */
  async end(path = "session") {
    await this.change("DELETE", path);
    this.leave();
  }

  /** Forgets the session. */
  leave() {
    this.#enter(NOBODY);
  }

  /** What a GET answers, as JSON. */
  get(path, options) {
    return this.#guarded(() => ask(ROOT + path, options));
  }

  /** What a GET answers, as it is. */
  fetch(path, options) {
    return this.#guarded(() => send(ROOT + path, options));
  }

  /** A request that changes something and answers with JSON. */
  async ask(method, path, body, headers) {
    return (await this.change(method, path, body, headers)).json();
  }

  /** A request that changes something; the response. */
  change(method, path, body, headers = {}) {
    return this.#guarded(() => this.#send(method, path, body, headers));
  }

  async #json(method, path, body) {
    return (await this.#send(method, path, body, {})).json();
  }

  #send(method, path, body, headers) {
    const own = this.session.csrf ? { "X-CSRF-Token": this.session.csrf } : {};
    const type = body === undefined ? {} : { "Content-Type": "application/json" };
    return send(ROOT + path, { method, headers: { ...own, ...type, ...headers }, body: body && JSON.stringify(body) });
  }

  async #guarded(act) {
    try {
      return await act();
    } catch (error) {
      if (error.kind === "session") {
        this.#enter(NOBODY, true);
      }
      throw error;
    }
  }

  #enter(session, isLost = false) {
    // The key is shown once, by whoever began the session; nothing else keeps it.
    const { key, link, ...rest } = session;
    const other = rest.id !== this.session.id || rest.role !== this.session.role;
    this.session = rest;
    this.isLost = isLost && (other || this.isLost);
    if (other) {
      this.dispatchEvent(new Event("session"));
    }
  }
}

/** This page's. */
export const client = new Client();
