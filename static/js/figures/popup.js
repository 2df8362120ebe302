// A button that opens a small panel; Escape, a click elsewhere or leaving it by keyboard closes it.

/** Makes `opener` open and close `panel`, both inside `wrap`; `opened` is called each time it opens. Returns `close()`. */
export function bindPopup(wrap, opener, panel, opened = () => {}) {
  function open(shown) {
    panel.hidden = !shown;
    opener.setAttribute("aria-expanded", String(shown));
    if (shown) {
      opened();
    }
  }
  const close = () => {
    open(false);
    opener.focus();
  };
  open(false);
  opener.setAttribute("aria-controls", panel.id);
  opener.addEventListener("click", () => open(panel.hidden));
  wrap.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !panel.hidden) {
      event.stopPropagation();
      close();
    }
  });
  wrap.addEventListener("focusout", ({ relatedTarget }) => {
    if (relatedTarget && !wrap.contains(relatedTarget)) {
      open(false);
    }
  });
  document.addEventListener("pointerdown", ({ target }) => {
    if (!panel.hidden && !wrap.contains(target)) {
      open(false);
    }
  });
  return close;
}
