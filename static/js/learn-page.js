// The students' page: joining a class, its assignments, one exercise, the own account. `learn.html#ID` is an assignment,
// `learn.html#account` the account; secrets in the address (`#key=`, `#code=`) are taken out of it at once.

import { AccountView } from "./classroom/account.js";
import { client } from "./classroom/client.js";
import { ClassPage } from "./classroom/page.js";
import { EnterView } from "./learn/enter.js";
import { ExerciseView } from "./learn/exercise.js";
import { ListView } from "./learn/list.js";
import { texts } from "./strings/classroom.js";

new ClassPage({
  role: "student",
  title: texts.learn.title,
  description: texts.learn.description,
  enter: (page, secret) => new EnterView(page, secret),
  view: (place, page) => {
    if (place === "account") {
      return new AccountView(() => page.route());
    }
    return place ? new ExerciseView(place) : new ListView();
  },
  other: () => texts.learn.teacherHere(client.session.name),
}).start();
