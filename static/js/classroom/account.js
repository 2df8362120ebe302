// What everybody can do with their own account: password, a new personal link, signing out; students also get and erase their data.

import { announce } from "../announce.js";
import { element } from "../dom.js";
import { download, fileName } from "../download.js";
import { confirmButton } from "../jobs/confirm.js";
import { texts } from "../strings/classroom.js";
import { client } from "./client.js";
import { actionButton, field, form } from "./form.js";
import { card, facts, secretLink, showError } from "./parts.js";
import { View } from "./view.js";

const own = texts.account;

/** The account; `changed` is called when the session says something else. */
export class AccountView extends View {
  #changed;

  constructor(changed) {
    super();
    this.#changed = changed;
  }

  draw() {
    const { session } = client;
    const { failure } = this;
    const link = element("div", {});
    const attempt = async (act) => {
      failure.replaceChildren();
      try {
        await act();
      } catch (error) {
        showError(failure, error);
      }
    };
    const known = facts([
      [texts.name, session.name],
      [texts.login, session.login],
      [texts.class, session.class?.name],
    ]);
    const everywhere = actionButton(own.signOutEverywhere, failure, () => client.end("sessions"));
    this.node.replaceChildren(
      element("p", {}, element("a", { class: "back", href: "#" }, `← ${texts.back}`)),
      element("h1", { tabindex: "-1" }, own.title),
      failure,
      card(own.you, known, element("div", { class: "actions" }, signOutButton(failure), everywhere)),
      ...(session.course_account
        ? [element("p", {}, own.ofCourse)]
        : [passwordCard(session, this.#changed), card(own.newLinkTitle, element("p", {}, own.newLinkHelp), newLinkButton(attempt, link, session), link)]),
      session.role === "student" ? dataCard(attempt, failure) : "",
    );
  }
}

/** A button that signs out. */
export const signOutButton = (failure) => actionButton(own.signOut, failure, () => client.end(), { id: "sign-out" });

function newLinkButton(attempt, place, session) {
  return confirmButton({ ...own.newLink, name: own.newLink.label }, () =>
    attempt(async () => {
      const { link } = await client.ask("POST", "me/key");
      place.replaceChildren(secretLink({ ...session, link }, () => place.replaceChildren()));
    }),
  );
}

function passwordCard(session, changed) {
  const secret = { type: "password", required: true, minlength: 10, maxlength: 200 };
  const current = session.has_password
    ? [field({ ...secret, name: "current", label: own.currentPassword, autocomplete: "current-password" })]
    : [];
  const fresh = field({ ...secret, name: "password", label: own.newPassword, help: own.passwordHelp, autocomplete: "new-password" });
  const after = async (text) => {
    await client.load();
    announce(text);
    changed();
  };
  const set = form({
    id: "password",
    groups: [...current, fresh],
    submit: session.has_password ? own.changePassword : own.setPassword,
    primary: false,
    act: async (values) => {
      await client.change("PUT", "me/password", values);
      await after(own.passwordSet);
    },
  });
  const remove = session.has_password
    ? form({
        id: "no-password",
        groups: [field({ ...secret, name: "current", label: own.currentPassword, autocomplete: "current-password" })],
        submit: own.removePassword,
        primary: false,
        act: async (values) => {
          await client.change("DELETE", "me/password", values);
          await after(own.passwordRemoved);
        },
      })
    : null;
  return card(own.passwordTitle, element("p", {}, own.passwordWhat(session.login)), set, remove);
}

function dataCard(attempt, failure) {
  const exported = actionButton(own.exportData, failure, async () => {
    const data = await client.get("me/export");
    download(fileName(["my-data"], "json"), JSON.stringify(data, null, 2), "application/json");
  });
  const erase = confirmButton({ ...own.erase, name: own.erase.label }, () => attempt(() => client.end("me")));
  return card(own.dataTitle, element("p", {}, own.dataHelp), element("div", { class: "actions" }, exported, erase));
}
