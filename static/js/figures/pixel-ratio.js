// Tells when a layout pixel becomes another number of device pixels: the page was zoomed or moved to another screen.

/** Calls `listener` after each change. */
export function onPixelRatio(listener) {
  const query = matchMedia(`(resolution: ${devicePixelRatio || 1}dppx)`);
  const changed = () => {
    listener();
    onPixelRatio(listener);
  };
  query.addEventListener("change", changed, { once: true });
}
