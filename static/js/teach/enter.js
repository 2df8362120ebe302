// The way in for teachers: the invitation that the server printed or a colleague gave, the personal link, or login and password.

import { client } from "../classroom/client.js";
import { forgetInvitation, secretIn } from "../classroom/entry.js";
import { field, form } from "../classroom/form.js";
import { card } from "../classroom/parts.js";
import { SignInView } from "../classroom/sign-in.js";
import { element } from "../dom.js";
import { texts } from "../strings/classroom.js";

const own = texts.teachEnter;
const root = document.documentElement;

// It scrolls where it is wider than the page: reachable by keyboard.
const command = (text) => element("pre", { tabindex: "0" }, element("code", {}, text));

export class EnterView extends SignInView {
  async start() {
    const { kind, secret } = this.secret ?? {};
    if (kind === "invitation") {
      this.#redeem(secret);
    } else {
      await super.start();
    }
  }

  #redeem(invitation) {
    const redeem = form({
      id: "redeem",
      groups: [
        field({ name: "name", label: texts.name, required: true, maxlength: 80, autocomplete: "name" }),
        field({ name: "login", label: texts.login, help: own.loginHelp, required: true, minlength: 3, maxlength: 40, autocomplete: "username", autocapitalize: "none", spellcheck: "false" }),
        field({ name: "password", label: texts.password, help: own.passwordHelp, type: "password", minlength: 10, maxlength: 200, autocomplete: "new-password" }),
      ],
      submit: own.create,
      act: async ({ password, ...values }) => {
        const body = { invitation, ...values, ...(password ? { password } : {}) };
        this.keepLink(await this.#begin(body));
      },
    });
    const leave = element("button", { type: "button", class: "quiet", onclick: () => this.done() }, own.haveAccount);
    this.node.replaceChildren(element("h1", { tabindex: "-1" }, own.invited), element("p", { class: "lead" }, own.invitedLead), card(own.account, redeem), element("div", { class: "actions" }, leave));
    root.dataset.state = "ready";
  }

  /** An invitation that is used up, or was never good, is not asked for again. */
  async #begin(body) {
    try {
      const session = await client.ask("POST", "teachers", body);
      forgetInvitation();
      return session;
    } catch (error) {
      if (error.kind === "sign-in") {
        forgetInvitation();
      }
      throw error;
    }
  }

  offer() {
    const byLink = form({
      id: "by-link",
      groups: [field({ name: "link", label: own.link, help: own.linkHelp, required: true, spellcheck: "false" })],
      submit: texts.enter.signIn,
      act: async ({ link }) => {
        if (link.includes("#invitation=")) {
          this.#redeem(secretIn(link));
        } else {
          await this.signIn({ key: secretIn(link) });
        }
      },
    });
    this.node.replaceChildren(
      element("h1", { tabindex: "-1" }, own.title),
      element("p", { class: "lead" }, own.lead),
      card(own.signInTitle, byLink, this.passwordForm()),
      card(own.firstTitle, element("p", {}, own.firstHelp), command("adaptarm teacher link --data DIR"), element("p", {}, own.lostHelp), command("adaptarm teacher link --data DIR --login LOGIN")),
      element("p", {}, element("a", { href: "learn.html" }, own.student)),
    );
    root.dataset.state = "ready";
  }
}
