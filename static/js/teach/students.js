// The students of a class: names and the school's numbers, and what a teacher does for one of them.

import { client } from "../classroom/client.js";
import { field, form, actionButton } from "../classroom/form.js";
import { card, copyable, facts, showError } from "../classroom/parts.js";
import { moment } from "../classroom/times.js";
import { element } from "../dom.js";
import { download, fileName } from "../download.js";
import { confirmButton } from "../jobs/confirm.js";
import { texts } from "../strings/classroom.js";

const own = texts.students;

/** A card with every student; `act(change)` does something and shows the class anew. */
export function studentTable(students, act) {
  const items = students.map((student) => studentItem(student, act));
  const list = items.length > 0 ? element("ul", { class: "student-list" }, items) : element("p", { class: "help" }, own.empty);
  const box = card(own.title(students.length), list);
  box.classList.add("students");
  return box;
}

function studentItem(student, act) {
  const { id, name, number, login, joined_at, has_password } = student;
  const place = element("div", {});
  const edit = form({
    id: `student-${id}`,
    groups: [
      field({ name: "name", label: texts.name, value: name, required: true, maxlength: 80 }),
      field({ name: "number", label: own.number, help: own.numberHelp, value: number ?? "", maxlength: 40, read: (input) => input.value.trim() || null }),
    ],
    submit: own.save,
    primary: false,
    act: async (values) => {
      await client.ask("PATCH", `students/${id}`, values);
      await act(() => {});
    },
  });
  const again = async (change) => {
    place.replaceChildren();
    try {
      await change();
    } catch (error) {
      showError(place, error);
    }
  };
  const newKey = confirmButton({ ...own.newKey, name: own.newKeyOf(name) }, () =>
    again(async () => {
      const { link } = await client.ask("POST", `students/${id}/key`);
      place.replaceChildren(element("p", {}, own.giveLink(name)), copyable(link, own.newKeyOf(name), "secret"));
    }),
  );
  const exported = actionButton(own.export, place, async () => {
    const data = await client.get(`students/${id}/export`);
    download(fileName(["student", name], "json"), JSON.stringify(data, null, 2), "application/json");
  });
  const erase = confirmButton({ ...own.erase, name: own.eraseOf(name) }, () => act(() => client.change("DELETE", `students/${id}`)));
  return element(
    "li",
    { "data-student": id },
    element(
      "details",
      { class: "fold" },
      element("summary", {}, element("strong", {}, name), element("span", { class: "help" }, number ? ` ${number}` : "")),
      facts([
        [texts.login, login],
        [own.joined, moment(joined_at)],
        [texts.password, has_password ? own.hasPassword : own.noPassword],
      ]),
      element("div", { class: "fold-part" }, edit),
      element("div", { class: "actions" }, newKey, exported, erase),
      place,
    ),
  );
}
