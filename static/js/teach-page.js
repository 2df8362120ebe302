// The teachers' page: classes, one class, the board of an assignment, one student's work, the own account.
// `teach.html#class/ID`, `#assignment/ID`, `#assignment/ID/STUDENT`, `#account`; secrets in the address (`#invitation=`,
// `#key=`) are taken out of it at once.

import { AccountView } from "./classroom/account.js";
import { client } from "./classroom/client.js";
import { ClassPage } from "./classroom/page.js";
import { texts } from "./strings/classroom.js";
import { BoardView } from "./teach/board.js";
import { ClassView } from "./teach/class.js";
import { ClassesView } from "./teach/classes.js";
import { EnterView } from "./teach/enter.js";
import { WorkView } from "./teach/work.js";

/** The view for a place in the address; whatever names none is the list of classes. */
function viewOf(place, page) {
  const [kind, id, student] = place.split("/");
  if (kind === "account") {
    return new AccountView(() => page.route());
  }
  if (kind === "class" && id) {
    return new ClassView(id);
  }
  if (kind === "assignment" && id) {
    return student ? new WorkView(id, student) : new BoardView(id);
  }
  return new ClassesView();
}

new ClassPage({
  role: "teacher",
  title: texts.teach.title,
  description: texts.teach.description,
  enter: (page, secret) => new EnterView(page, secret),
  view: viewOf,
  other: () => texts.teach.studentHere(client.session.name),
}).start();
