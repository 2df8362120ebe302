// What the ways in for students and teachers share: a personal link that is opened or pasted, login and password, and the
// new link that is shown once. Also the way back in for whoever's session ended while they were at work.

import { element } from "../dom.js";
import { texts } from "../strings/classroom.js";
import { client } from "./client.js";
import { secretIn } from "./entry.js";
import { actionButton, field, form } from "./form.js";
import { secretLink, showError } from "./parts.js";

const own = texts.enter;
const root = document.documentElement;

export class SignInView {
  node = element("div", { class: "class-view narrow" });
  secret;
  #page;

  /** `secret` is what the address brought, if it brought something. */
  constructor(page, secret) {
    this.#page = page;
    this.secret = secret;
  }

  /** Shows the ways in. */
  offer() {}

  async start() {
    if (this.secret?.kind === "key") {
      await this.byKey(this.secret.secret);
    } else {
      this.offer();
    }
  }

  stop() {}

  /** A personal link was opened: nothing to type. */
  async byKey(key) {
    try {
      await this.signIn({ key });
    } catch (error) {
      this.offer();
      const place = element("div", { class: "failure" });
      this.node.querySelector("h1").after(place);
      showError(place, error, error.isPassing ? () => this.byKey(key) : null);
    }
  }

  /** Begins a session with a key, or with login and password. */
  async signIn(values) {
    await client.begin("session", values);
    this.done();
  }

  /** The secret of the address has done its work, or is not wanted. */
  done() {
    this.#page.done();
  }

  /** The link is shown before anything else: it is the only way back. */
  keepLink(session) {
    const done = async () => {
      await client.load();
      this.#page.done();
    };
    this.node.replaceChildren(element("h1", { tabindex: "-1" }, own.welcome(session.name)), secretLink(session, done));
    this.node.querySelector("h1").focus();
    root.dataset.view = "secret";
  }

  /** Signing in by a personal link that is pasted. */
  linkForm() {
    return form({
      id: "by-link",
      groups: [field({ name: "key", label: own.link, help: own.linkHelp, spellcheck: "false", read: (input) => secretIn(input.value) })],
      submit: own.signIn,
      primary: false,
      act: (values) => this.signIn(values),
    });
  }

  /** Signing in by login and password, folded. */
  passwordForm() {
    const byPassword = form({
      id: "by-password",
      groups: [
        field({ name: "login", label: texts.login, required: true, autocomplete: "username", autocapitalize: "none", spellcheck: "false" }),
        field({ name: "password", label: texts.password, required: true, type: "password", autocomplete: "current-password" }),
      ],
      submit: own.signIn,
      primary: false,
      act: (values) => this.signIn(values),
    });
    return element("details", { class: "fold" }, element("summary", {}, own.byPassword), byPassword);
  }
}

/** A dialog over what somebody was doing when their session ended; the page closes it when they are back. */
export class ComeBack extends SignInView {
  #dialog;

  /** `giveUp` is called when what lies behind is not wanted any more; `role` says whose page this is. */
  constructor(giveUp, role) {
    super({ done: () => {} }, null);
    const words = texts.comeBack;
    const failure = element("div", { class: "failure" });
    const elsewhere = actionButton(words.elsewhere, failure, async () => {
      if ((await client.load()).role === null) {
        failure.replaceChildren(element("p", { class: "message error", role: "alert" }, words.notYet));
      }
    });
    const byPassword = this.passwordForm();
    byPassword.open = true;
    this.#dialog = element(
      "dialog",
      { class: "come-back classroom", "aria-labelledby": "come-back-title", oncancel: giveUp },
      element("h1", { id: "come-back-title" }, words.title),
      element("p", {}, words.what),
      this.linkForm(),
      byPassword,
      role === "student" ? element("p", { class: "help" }, words.noWayIn) : null,
      failure,
      element("div", { class: "actions" }, elsewhere, element("button", { type: "button", id: "give-up", onclick: giveUp }, words.giveUp)),
    );
    document.body.append(this.#dialog);
    this.#dialog.showModal();
  }

  close() {
    this.#dialog.close();
    this.#dialog.remove();
  }
}
