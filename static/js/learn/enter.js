// The way in for students: a class's code and a name, or the personal link, or login and password.

import { client } from "../classroom/client.js";
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

  /** Whether whoever is signed in here wants to join all the same. */
  #joins = false;

  offer() {
    if (this.secret?.kind === "code" && client.session.role !== null && !this.#joins) {
      this.#ask(client.session);
      return;
    }
    const code = this.secret?.kind === "code" ? this.secret.secret : "";
    this.node.replaceChildren(
      element("h1", { tabindex: "-1" }, own.title),
      element("p", { class: "lead" }, own.lead),
      this.#joining(code),
      card(own.returnTitle, this.linkForm(), this.passwordForm()),
      element("p", {}, element("a", { href: "teach.html" }, own.teacher)),
    );
    root.dataset.state = "ready";
  }

  /** Joining would end the session of somebody who only opened a link, and make a student of nobody. */
  #ask({ role, name, class: of }) {
    const isTeacher = role === "teacher";
    const join = () => {
      this.#joins = true;
      this.offer();
      this.node.querySelector("#join-name").focus();
    };
    this.node.replaceChildren(
      element("h1", { tabindex: "-1" }, own.already),
      element("p", {}, isTeacher ? own.alreadyTeacher(name) : own.alreadyStudent(name, of?.name ?? "")),
      element(
        "div",
        { class: "actions" },
        isTeacher
          ? element("a", { class: "button", href: "teach.html" }, texts.toOwnPage)
          : element("button", { type: "button", class: "primary", id: "go-on", onclick: () => this.done() }, own.goOn(name)),
        element("button", { type: "button", id: "join-anyway", onclick: join }, own.joinAnyway),
      ),
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
}
