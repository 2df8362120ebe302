// The way in for teachers: the invitation that the server printed or a colleague gave, the personal link, or login and password.

import { client } from "../classroom/client.js";
import { secretIn } from "../classroom/entry.js";
import { field, form } from "../classroom/form.js";
import { card, secretLink, showError } from "../classroom/parts.js";
import { element } from "../dom.js";
import { passwordForm } from "../learn/enter.js";
import { texts } from "../strings/classroom.js";

const own = texts.teachEnter;
const root = document.documentElement;

export class EnterView {
  node = element("div", { class: "class-view narrow" });
  #page;
  #secret;

  constructor(page, secret) {
    this.#page = page;
    this.#secret = secret;
  }

  async start() {
    const { kind, secret } = this.#secret ?? {};
    if (kind === "key") {
      await this.#byKey(secret);
    } else if (kind === "invitation") {
      this.#redeem(secret);
    } else {
      this.#offer();
    }
  }

  stop() {}

  async #byKey(key) {
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

  #redeem(invitation) {
    const redeem = form({
      id: "redeem",
      groups: [
        field({ name: "name", label: texts.name, maxlength: 80, autocomplete: "name" }),
        field({ name: "login", label: texts.login, help: own.loginHelp, maxlength: 40, autocomplete: "username", autocapitalize: "none", spellcheck: "false" }),
        field({ name: "password", label: texts.password, help: own.passwordHelp, type: "password", maxlength: 200, autocomplete: "new-password" }),
      ],
      submit: own.create,
      act: async ({ password, ...values }) => {
        const body = { invitation, ...values, ...(password ? { password } : {}) };
        this.#keepLink(await client.ask("POST", "teachers", body));
      },
    });
    this.node.replaceChildren(element("h1", { tabindex: "-1" }, own.invited), element("p", { class: "lead" }, own.invitedLead), card(own.account, redeem));
    root.dataset.state = "ready";
  }

  #keepLink(session) {
    const done = async () => {
      await client.load();
      this.#page.done();
    };
    this.node.replaceChildren(element("h1", { tabindex: "-1" }, texts.enter.welcome(session.name)), secretLink(session, done));
    this.node.querySelector("h1").focus();
    root.dataset.view = "secret";
  }

  #offer() {
    const byLink = form({
      id: "by-link",
      groups: [field({ name: "link", label: own.link, help: own.linkHelp, spellcheck: "false" })],
      submit: texts.enter.signIn,
      act: async ({ link }) => {
        if (link.includes("#invitation=")) {
          this.#redeem(secretIn(link));
        } else {
          await client.begin("session", { key: secretIn(link) });
          this.#page.done();
        }
      },
    });
    this.node.replaceChildren(
      element("h1", { tabindex: "-1" }, own.title),
      element("p", { class: "lead" }, own.lead),
      card(own.signInTitle, byLink, passwordForm(() => this.#page.done())),
      card(own.firstTitle, element("p", {}, own.firstHelp), element("pre", {}, element("code", {}, "adaptarm teacher link"))),
      element("p", {}, element("a", { href: "learn.html" }, own.student)),
    );
    root.dataset.state = "ready";
  }
}
