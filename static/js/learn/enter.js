// The way in for students: a class's code and a name, or the personal link, or login and password.

import { element } from "../dom.js";
import { client } from "../classroom/client.js";
import { secretIn } from "../classroom/entry.js";
import { field, form } from "../classroom/form.js";
import { card, secretLink, showError } from "../classroom/parts.js";
import { texts } from "../strings/classroom.js";

const own = texts.enter;
const root = document.documentElement;

export class EnterView {
  node = element("div", { class: "class-view narrow" });
  #page;
  #secret;

  /** `secret` is what the address brought, if it brought something. */
  constructor(page, secret) {
    this.#page = page;
    this.#secret = secret;
  }

  async start() {
    if (this.#secret?.kind === "key") {
      await this.#byKey(this.#secret.secret);
      return;
    }
    this.#offer();
  }

  stop() {}

  /** A personal link was opened: nothing to type. */
  async #byKey(key) {
    const failure = element("div", { class: "failure" });
    this.node.replaceChildren(element("h1", { tabindex: "-1" }, own.signingIn), failure);
    try {
      await client.begin("session", { key });
      this.#page.done();
    } catch (error) {
      this.#offer();
      const place = element("div", { class: "failure" });
      this.node.querySelector("h1").after(place);
      showError(place, error, error.isPassing ? () => this.#byKey(key) : null);
    }
  }

  #offer() {
    const code = this.#secret?.kind === "code" ? this.#secret.secret : "";
    this.node.replaceChildren(
      element("h1", { tabindex: "-1" }, own.title),
      element("p", { class: "lead" }, own.lead),
      this.#joining(code),
      this.#returning(),
      element("p", {}, element("a", { href: "teach.html" }, own.teacher)),
    );
    root.dataset.state = "ready";
  }

  #joining(code) {
    const fields = [
      field({ name: "code", label: own.code, help: own.codeHelp, value: code, class: "code-input", autocapitalize: "characters", spellcheck: "false", maxlength: 40, read: (input) => input.value.trim().toUpperCase() }),
      field({ name: "name", label: texts.name, help: own.nameHelp, maxlength: 80, autocomplete: "name" }),
    ];
    const join = form({
      id: "join",
      groups: fields,
      submit: own.join,
      act: async (values) => {
        const session = await client.ask("POST", "students", values);
        this.#keepLink(session);
      },
    });
    return card(own.joinTitle, join);
  }

  /** The link is shown before anything else: it is the only way back. */
  #keepLink(session) {
    const done = async () => {
      await client.load();
      this.#page.done();
    };
    this.node.replaceChildren(element("h1", { tabindex: "-1" }, own.welcome(session.name)), secretLink(session, done));
    this.node.querySelector("h1").focus();
    root.dataset.view = "secret";
  }

  #returning() {
    const byLink = form({
      id: "by-link",
      groups: [field({ name: "key", label: own.link, help: own.linkHelp, spellcheck: "false", read: (input) => secretIn(input.value) })],
      submit: own.signIn,
      primary: false,
      act: async (values) => {
        await client.begin("session", values);
        this.#page.done();
      },
    });
    const box = card(own.returnTitle, byLink, passwordForm(() => this.#page.done()));
    return box;
  }
}

/** Signing in by login and password, folded. */
export function passwordForm(done) {
  const byPassword = form({
    id: "by-password",
    groups: [
      field({ name: "login", label: texts.login, autocomplete: "username", autocapitalize: "none", spellcheck: "false" }),
      field({ name: "password", label: texts.password, type: "password", autocomplete: "current-password" }),
    ],
    submit: own.signIn,
    primary: false,
    act: async (values) => {
      await client.begin("session", values);
      done();
    },
  });
  return element("details", { class: "fold" }, element("summary", {}, own.byPassword), byPassword);
}
