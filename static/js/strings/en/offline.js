// Texts: use without a server, and new versions of the page.

export const offline = {
  ready: "Ready to work offline.",
  newer: "A new version of this page is ready.",
  reload: "Reload",
};
