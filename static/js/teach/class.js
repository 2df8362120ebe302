// One class: its code to show and to change, students, assignments, gradebook, and what was done.

import { client } from "../classroom/client.js";
import { actionButton, field, form } from "../classroom/form.js";
import { badge, byName, card, copyable, points } from "../classroom/parts.js";
import { momentElement } from "../classroom/times.js";
import { View } from "../classroom/view.js";
import { element } from "../dom.js";
import { download, fileName } from "../download.js";
import { confirmButton } from "../jobs/confirm.js";
import { localized, texts } from "../strings/classroom.js";
import { assignmentCard } from "./assign.js";
import { auditCard } from "./audit.js";
import { courseCard } from "./platform.js";
import { projector } from "./projector.js";
import { studentTable } from "./students.js";

const own = texts.class_;
const SHAPES = ["plain", "moodle", "canvas"];

export class ClassView extends View {
  #id;

  constructor(id) {
    super();
    this.#id = id;
  }

  async load() {
    const [group, { exercises }, course] = await Promise.all([
      client.get(`classes/${this.#id}`),
      client.get("exercises"),
      client.get(`classes/${this.#id}/lti`),
    ]);
    return { group, exercises, course };
  }

  draw({ group, exercises, course }) {
    document.title = `${group.name} · adaptarm`;
    this.node.replaceChildren(
      element("p", {}, element("a", { class: "back", href: "#" }, `← ${texts.classes.title}`)),
      element("h1", { tabindex: "-1" }, group.name),
      this.failure,
      courseCard(this.#id, course, () => this.start()),
      this.#joining(group),
      this.#assignments(group),
      assignmentCard(exercises, (body) => this.#assign(body)),
      studentTable(byName(group.students), (change) => this.act(change)),
      this.#gradebook(group),
      this.#settings(group),
      auditCard(this.#id, group),
    );
  }

  async #assign(body) {
    await client.ask("POST", `classes/${this.#id}/assignments`, body);
    await this.start();
    this.node.querySelector(".assignment-list li:last-child a")?.focus();
  }

  #joining({ code, link, joining, name }) {
    const toggle = actionButton(joining ? own.closeCode : own.openCode, this.failure, () =>
      this.act(() => client.ask("PATCH", `classes/${this.#id}`, { joining: !joining })),
    );
    const rotate = confirmButton({ ...own.rotate, name: own.rotate.label }, () => this.act(() => client.ask("POST", `classes/${this.#id}/code`)));
    return card(
      own.joinTitle,
      joining ? element("p", { class: "class-code", id: "class-code" }, code) : element("p", {}, own.joinClosed),
      joining ? element("p", { class: "help" }, own.joinHelp) : null,
      joining ? copyable(link, own.joinLink) : null,
      element("div", { class: "actions" }, joining ? projector({ code, link, name }) : null, toggle, rotate),
    );
  }

  #assignments({ assignments }) {
    const items = assignments.map((assignment) => {
      const { id, title, deadline, attempts, points: most, released } = assignment;
      return element(
        "li",
        { class: "card assignment-item", "data-assignment": id, "data-exercise": assignment.exercise },
        element("a", { class: "assignment-title", href: `#assignment/${id}` }, localized(title)),
        element("span", { class: "badges" }, released ? badge("released", own.released) : null),
        element("p", { class: "class-line" }, ...(deadline ? [texts.list.due, " ", momentElement(deadline)] : [texts.list.noDeadline])),
        element("p", { class: "class-line" }, own.conditions(points(most), attempts)),
      );
    });
    const list = items.length > 0 ? element("ul", { class: "assignment-list" }, items) : element("p", { class: "help" }, own.noAssignments);
    return element("section", { class: "assignments", "aria-labelledby": "assignments-title" }, element("h2", { id: "assignments-title" }, own.assignments), list);
  }

  #gradebook({ name }) {
    const failure = element("div", { class: "failure" });
    const buttons = SHAPES.map((shape) =>
      actionButton(own.shapes[shape], failure, async () => {
        const blob = await (await client.fetch(`classes/${this.#id}/gradebook.csv?shape=${shape}`)).blob();
        download(fileName(["gradebook", name, shape], "csv"), blob);
      }, { "data-shape": shape }),
    );
    return card(own.gradebook, element("p", {}, own.gradebookHelp), element("div", { class: "actions" }, buttons), failure);
  }

  #settings({ name }) {
    const rename = form({
      id: "rename-class",
      groups: [field({ name: "name", label: texts.classes.name, required: true, value: name, maxlength: 80 })],
      submit: own.rename,
      primary: false,
      act: async (values) => {
        await client.ask("PATCH", `classes/${this.#id}`, values);
        await this.start();
      },
    });
    const remove = confirmButton({ ...own.remove, name: own.remove.label }, async () => {
      await client.change("DELETE", `classes/${this.#id}`);
      location.hash = "";
    });
    return card(own.settings, rename, element("div", { class: "actions" }, remove));
  }
}
