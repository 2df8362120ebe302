// The way in for students: a class's code and a name, or the personal link, or login and password.

import { client } from "../classroom/client.js";
import { secretIn } from "../classroom/entry.js";
import { field, form } from "../classroom/form.js";
import { card } from "../classroom/parts.js";
import { SignInView } from "../classroom/sign-in.js";
import { element } from "../dom.js";
import { texts } from "../strings/classroom.js";

const own = texts.enter;
const root = document.documentElement;

export class EnterView extends SignInView {
  async byKey(key) {
    this.node.replaceChildren(element("h1", { tabindex: "-1" }, own.signingIn));
    await super.byKey(key);
  }

  offer() {
    const code = this.secret?.kind === "code" ? this.secret.secret : "";
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
      act: async (values) => this.keepLink(await client.ask("POST", "students", values)),
    });
    return card(own.joinTitle, join);
  }

  #returning() {
    const byLink = form({
      id: "by-link",
      groups: [field({ name: "key", label: own.link, help: own.linkHelp, spellcheck: "false", read: (input) => secretIn(input.value) })],
      submit: own.signIn,
      primary: false,
      act: (values) => this.signIn(values),
    });
    return card(own.returnTitle, byLink, this.passwordForm());
  }
}
