// A teacher's classes, a form for another one, and the invitation of a colleague.

import { client } from "../classroom/client.js";
import { actionButton, field, form } from "../classroom/form.js";
import { card, copyable } from "../classroom/parts.js";
import { momentElement } from "../classroom/times.js";
import { View } from "../classroom/view.js";
import { element } from "../dom.js";
import { texts } from "../strings/classroom.js";

const own = texts.classes;

export class ClassesView extends View {
  load() {
    return client.get("classes");
  }

  draw({ classes }) {
    const items = classes.map(({ id, name, student_count, code, joining }) =>
      element(
        "li",
        { class: "card assignment-item", "data-class": id },
        element("a", { class: "assignment-title", href: `#class/${id}` }, name),
        element("p", { class: "class-line" }, own.students(student_count)),
        element("p", { class: "class-line" }, joining ? own.codeIs : own.codeClosed, joining ? element("code", {}, ` ${code}`) : ""),
      ),
    );
    const add = form({
      id: "new-class",
      groups: [field({ name: "name", label: own.name, required: true, maxlength: 80 })],
      submit: own.create,
      act: async (values) => {
        const { id } = await client.ask("POST", "classes", values);
        location.hash = `#class/${id}`;
      },
    });
    this.node.replaceChildren(
      element("h1", { tabindex: "-1" }, own.title),
      this.failure,
      items.length > 0 ? element("ul", { class: "assignment-list" }, items) : element("p", { class: "empty" }, own.empty),
      card(own.newTitle, add),
      client.session.course_account ? "" : this.#invitation(),
    );
  }

  #invitation() {
    const place = element("div", {});
    const invite = actionButton(own.invite, place, async () => {
      const { link, expires_at } = await client.ask("POST", "invitations");
      place.replaceChildren(copyable(link, own.inviteTitle, "secret"), element("p", { class: "help" }, own.inviteUntil, " ", momentElement(expires_at)));
    });
    return card(own.inviteTitle, element("p", {}, own.inviteHelp), element("div", { class: "actions" }, invite), place);
  }
}
