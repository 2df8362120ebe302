// What the pages of students and teachers share: the session, the head with name and way out, and which view is shown.
//
// A view has `node`, `start()`, `stop()` and, where it is somebody's own, `resume()` for when their session had ended and they are
// back; it focuses its own heading. `data-state` of the document tells how the page
// stands: loading, ready, failed; `data-view` which view it is.

import { byId, element, fillTexts } from "../dom.js";
import { jump } from "../jump.js";
import { buildMasthead, comeAlive } from "../masthead.js";
import { texts } from "../strings/classroom.js";
import { strings } from "../strings/index.js";
import { signOutButton } from "./account.js";
import { client } from "./client.js";
import { forgetInvitation, keptInvitation, takeSecret } from "./entry.js";
import { showError } from "./parts.js";
import { ComeBack } from "./sign-in.js";

const root = document.documentElement;

/** The place that an address names; none where it is not one that was ever made. */
function placeIn(hash) {
  try {
    return decodeURIComponent(hash.slice(1));
  } catch {
    return "";
  }
}

export class ClassPage {
  #role;
  #enter;
  #view;
  #other;
  #shown = null;
  #secret = null;
  /** Who is shown what is theirs, by identifier, or null. */
  #person = null;
  /** Asks whose session has ended to come back, or null. */
  #comeBack = null;
  #isFirst = true;
  #place = byId("content");
  #who = byId("who");

  /** `enter` makes the view for nobody, `view` the one for a place in the address, `other` says what the other role is told. */
  constructor({ role, title, description, enter, view, other }) {
    this.#role = role;
    this.#enter = enter;
    this.#view = view;
    this.#other = other;
    comeAlive();
    buildMasthead("classroom", title, description);
    fillTexts({ ...strings, ...texts });
    document.addEventListener("click", (event) => jump(event));
    addEventListener("hashchange", () => this.#moved());
    addEventListener("online", () => {
      this.#online();
      this.#again();
    });
    addEventListener("offline", () => this.#online());
  }

  async start() {
    this.#online();
    this.#secret = takeSecret() ?? (this.#role === "teacher" ? keptInvitation() : null);
    root.dataset.state = "loading";
    try {
      await client.load();
    } catch (error) {
      root.dataset.state = "failed";
      const failure = element("div", { class: "failure" });
      this.#place.replaceChildren(failure);
      showError(failure, error, () => this.start());
      return;
    }
    client.addEventListener("session", () => this.#sessionChanged());
    this.route();
  }

  /** Somebody came or went. Whoever was sent away keeps what they were doing until they are back or give it up. */
  #sessionChanged() {
    if (client.isLost && this.#person !== null) {
      this.#comeBack ??= new ComeBack(() => this.route(), this.#role);
    } else if (this.#comeBack && client.session.id === this.#person) {
      this.#comeBack.close();
      this.#comeBack = null;
      this.#shown.resume();
    } else {
      this.route();
    }
  }

  /** Shows what the session and the address ask for. */
  route() {
    this.#comeBack?.close();
    this.#comeBack = null;
    this.#shown?.stop();
    const { session } = client;
    this.#head(session);
    root.dataset.state = "loading";
    if (session.role !== null && session.role !== this.#role && !this.#secret) {
      this.#shown = null;
      this.#person = null;
      root.dataset.view = "other";
      this.#place.replaceChildren(this.#otherRole());
      root.dataset.state = "ready";
      return;
    }
    const isEntry = session.role !== this.#role || this.#secret !== null;
    this.#person = isEntry ? null : session.id;
    const place = placeIn(location.hash);
    this.#shown = isEntry ? this.#enter(this, this.#secret) : this.#view(place, this);
    root.dataset.view = isEntry ? "enter" : place.split("/")[0] || "home";
    this.#place.replaceChildren(this.#shown.node);
    scrollTo(0, 0);
    this.#begin(this.#shown);
  }

  /** Starts a view. Whoever came from another one begins at its heading; a page that was just opened at its top. */
  async #begin(view) {
    const first = this.#isFirst;
    this.#isFirst = false;
    await view.start();
    if (!first && view === this.#shown && document.activeElement === document.body) {
      view.node.querySelector("h1")?.focus({ preventScroll: true });
    }
  }

  /** The secret of the address has been used, or is not wanted. */
  done() {
    forgetInvitation();
    this.#secret = null;
    this.route();
  }

  #moved() {
    const secret = takeSecret();
    this.#secret = secret ?? this.#secret;
    this.route();
  }

  #head({ role, name, class: own }) {
    const account = element("a", { href: "#account", id: "account-link" }, own ? `${name} · ${own.name}` : name);
    this.#who.replaceChildren(...(role === this.#role ? [account] : []));
  }

  #otherRole() {
    const failure = element("div", { class: "failure" });
    const target = this.#role === "student" ? "teach.html" : "learn.html";
    return element(
      "div",
      { class: "class-view" },
      element("h1", { tabindex: "-1" }, texts.otherRole),
      element("p", {}, this.#other()),
      failure,
      element("div", { class: "actions" }, element("a", { class: "button", href: target }, texts.toOwnPage), signOutButton(failure)),
    );
  }

  /** What could not be shown without a connection is asked for anew. */
  #again() {
    if (this.#shown) {
      this.#shown.resume?.();
    } else if (root.dataset.state === "failed") {
      this.start();
    }
  }

  /** The classroom is the server's; without it the page can only say so. */
  #online() {
    byId("offline-note").textContent = navigator.onLine === false ? texts.errors.offline : "";
  }
}
