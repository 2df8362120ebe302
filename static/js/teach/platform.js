// What a learning platform has to do with a class and an assignment: members who come from it, marks that go to it.
//
// Classes that are no platform's course show nothing of this. `docs/lti.md` says what happens on the other side.

import { announce } from "../announce.js";
import { client } from "../classroom/client.js";
import { actionButton } from "../classroom/form.js";
import { card, facts } from "../classroom/parts.js";
import { element } from "../dom.js";
import { texts } from "../strings/classroom.js";

const own = texts.platform;

/** A card with the course's platform and a button that takes its list of members over; `changed()` shows the class anew. */
export function courseCard(id, { platform, members }, changed) {
  if (!platform) {
    return "";
  }
  const failure = element("div", { class: "failure" });
  const fetchMembers = actionButton(
    own.fetch,
    failure,
    async () => {
      const { listed, added, left_out } = await client.ask("POST", `classes/${id}/lti/members`);
      await changed();
      announce(own.fetched(listed, added, left_out));
    },
    { id: "fetch-members" },
  );
  const box = card(
    own.course,
    element("p", {}, own.courseOf(platform)),
    members ? element("div", { class: "actions" }, fetchMembers) : element("p", { class: "help" }, own.noMembers),
    failure,
  );
  box.classList.add("course-card");
  return box;
}

/** A card with what has become of an assignment's marks on their way to platforms; nothing where no link leads to it. */
export function passbackCard({ links, columns, sent, waiting, error }) {
  if (links === 0) {
    return "";
  }
  const box = card(
    own.grades,
    facts([
      [own.sent, element("span", { id: "grades-sent" }, String(sent))],
      [own.waiting, element("span", { id: "grades-waiting" }, String(waiting))],
      [own.columns, columns < links ? own.columnsMissing(links - columns) : null],
    ]),
    error ? element("p", { class: "trouble" }, own.trouble(error)) : null,
  );
  box.classList.add("passback-card");
  return box;
}
